"""What learners promise beyond their formulas: convergence, ends and cuts, ties, seeds, snapshots."""

from itertools import pairwise

import numpy as np
import pytest

import rlnav as rl

LEARNERS = [rl.q_learning, rl.sarsa, rl.expected_sarsa, rl.double_q_learning, rl.monte_carlo]
every_learner = pytest.mark.parametrize("learner", LEARNERS, ids=lambda learner: learner.__name__)

# State 0 goes to 1 and 1 to the terminal 2, action 0 for a reward of 1 and action 1 for nothing
CHAIN = rl.MDP(
    next_state=[[[1], [1]], [[2], [2]], [[2], [2]]],
    prob=np.ones((3, 2, 1)),
    reward=[[[1.0], [0.0]], [[1.0], [0.0]], [[0.0], [0.0]]],
    gamma=0.9,
    terminal=[False, False, True],
    start=0,
)
# One state for ever, a reward of 1 a step: worth 10
LOOP = rl.MDP([[[0]]], [[[1.0]]], [[[1.0]]], 0.9, [False], 0)


def assert_same(one, two):
    """Compare all arrays of two results to the last bit."""
    for name in vars(one):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name), err_msg=name)


# ---------------------------------------------------------------- convergence
@every_learner
def test_with_shrinking_steps_learners_come_close_to_the_true_values(learner):
    # Episodes start in every pose and all actions are random, so everything is tried for ever; the step sizes
    # 1 / (1 + e / 2000) satisfy Robbins and Monro.  Off-policy learners approach q*, on-policy ones the values of the
    # random policy.  Seed 0, two million episodes; the largest error found was 0.31 where values range from -10 to 10.
    n, task = 2_000_000, rl.Task(rl.GridWorld.from_ascii("..G\n.#.\n..."), rl.Robot(slip=0.2))
    mdp = task.mdp()
    best, chance = rl.solve(mdp), np.full((mdp.S, mdp.A), 1 / mdp.A)
    off_policy = learner in (rl.q_learning, rl.double_q_learning)
    truth = best.Q if off_policy else rl.action_values(mdp, rl.evaluate_policy(mdp, chance))
    run = learner(mdp, episodes=n, alpha=1 / (1 + np.arange(n) / 2000), epsilon=1.0, rng=0)
    assert np.abs(run.Q - truth)[~mdp.terminal].max() < 0.4
    if off_policy:
        assert rl.evaluate(mdp, run.pi).gap == pytest.approx(0, abs=1e-6)


@every_learner
def test_every_learner_finds_the_way(learner, corridor):
    mdp = corridor.mdp()
    for seed in range(10):
        run = learner(mdp, episodes=500, rng=seed)
        assert rl.rollout(mdp, run.pi, rng=0).rewards.tolist() == [-0.1, 10.0]


# ---------------------------------------------------------------- ends and cuts
@every_learner
def test_the_value_of_a_terminal_state_is_zero_whatever_its_row_holds(learner):
    # all of Q starts at 5; a terminal row that is looked at would drive the last step towards 1 + 0.9 * 5
    run = learner(CHAIN, episodes=4000, epsilon=0.5, Q0=5.0, rng=0)
    np.testing.assert_array_equal(run.Q[2], [5.0, 5.0])  # never updated
    np.testing.assert_allclose(run.Q[1], [1.0, 0.0], atol=1e-6)


@every_learner
def test_the_last_transition_is_learned_from(learner):
    assert learner(CHAIN, episodes=400, epsilon=1.0, rng=0).Q[1, 0] == pytest.approx(1.0, abs=1e-3)


@every_learner
def test_running_out_of_steps_does_not_cut_the_future_off(learner):
    run = learner(LOOP, episodes=20_000, max_steps=1, alpha=0.05, rng=0)
    assert run.Q[0, 0] == pytest.approx(10, abs=1e-3)  # 1 + 0.9 * 10; a cut future would leave 1
    assert not run.terminated.any()


def test_an_own_rule_receives_no_discount_at_the_end_and_the_full_one_at_a_cut():
    seen = []

    def rule(Q, s, a, r, s_next, a_next, gamma, alpha):
        seen.append((s, r, s_next, gamma, alpha))

    rl.learn(CHAIN, rule, episodes=1, alpha=0.25, epsilon=0.0, rng=0)
    assert [(s, s_next, gamma, alpha) for s, _, s_next, gamma, alpha in seen] == [(0, 1, 0.9, 0.25), (1, 2, 0.0, 0.25)]
    seen.clear()
    rl.learn(CHAIN, rule, episodes=2, max_steps=1, rng=0)
    assert [gamma for *_, gamma, _ in seen] == [0.9, 0.9]


def test_an_own_rule_receives_rows_of_the_designed_table_and_the_action_that_follows():
    seen = []
    rl.learn(CHAIN, lambda Q, *args: seen.append((Q.shape, *args)), [4, 1, 0], episodes=30, epsilon=1.0, rng=0)
    assert {(shape, s, s_next) for shape, s, _, _, s_next, *_ in seen} == {((5, 2), 4, 1), ((5, 2), 1, 0)}
    for (_, s, _, _, s_next, a_next, *_), (_, s_then, a_then, *_) in pairwise(seen):
        assert s != 4 or (s_next, a_next) == (s_then, a_then)


def test_the_log_tells_how_episodes_ended(corridor):
    mdp = corridor.mdp()
    run = rl.q_learning(mdp, episodes=400, rng=0)
    assert run.success[-100:].mean() > 0.7
    assert (run.success <= run.terminated).all()
    crashed = run.terminated & ~run.success
    assert (run.returns[crashed] < -9).all()
    assert run.returns.max() == pytest.approx(-0.1 + 0.95 * 10)
    assert run.steps.min() >= 1
    assert (rl.q_learning(mdp, episodes=50, max_steps=1, rng=0).steps == 1).all()


@every_learner
def test_returns_are_discounted_sums_of_the_rewards(learner):
    run = learner(LOOP, episodes=3, max_steps=4, rng=0)
    np.testing.assert_allclose(run.returns, 1 + 0.9 + 0.9**2 + 0.9**3)
    assert run.steps.tolist() == [4, 4, 4]


# ---------------------------------------------------------------- ties
def test_ties_are_broken_at_random_while_learning():
    # a table of zeros and no exploration: the first of five actions should be chosen in a fifth of 2000 seeds (sd 18)
    mdp = rl.MDP(np.ones((2, 5, 1), int), np.ones((2, 5, 1)), np.zeros((2, 5, 1)), 0.9, [False, True], 0)
    chosen = []
    for seed in range(2000):
        rl.learn(mdp, lambda Q, s, a, *_: chosen.append(a), episodes=1, epsilon=0.0, rng=seed)
    counts = np.bincount(chosen, minlength=5)
    assert np.abs(counts - 400).max() < 5 * 18


def test_only_the_best_actions_share_a_tie():
    mdp = rl.MDP(np.ones((2, 5, 1), int), np.ones((2, 5, 1)), np.zeros((2, 5, 1)), 0.9, [False, True], 0)
    Q0 = np.array([[0.0, 1.0, 1.0, 0.5, 1.0], [0.0] * 5])
    chosen = []
    rl.learn(mdp, lambda Q, s, a, *_: chosen.append(a), episodes=3000, epsilon=0.0, Q0=Q0, rng=0)
    counts = np.bincount(chosen, minlength=5)
    assert counts[[0, 3]].tolist() == [0, 0]
    assert np.abs(counts[[1, 2, 4]] - 1000).max() < 5 * 26


def test_exploration_chooses_all_actions_equally_often():
    mdp = rl.MDP(np.ones((2, 4, 1), int), np.ones((2, 4, 1)), np.zeros((2, 4, 1)), 0.9, [False, True], 0)
    Q0 = np.array([[9.0, 0.0, 0.0, 0.0], [0.0] * 4])
    chosen = []
    rl.learn(mdp, lambda Q, s, a, *_: chosen.append(a), episodes=8000, epsilon=0.4, Q0=Q0, rng=0)
    counts = np.bincount(chosen, minlength=4)
    assert counts[0] == pytest.approx(8000 * 0.7, abs=5 * 41)  # 0.6 + 0.4 / 4
    assert np.abs(counts[1:] - 800).max() < 5 * 27


def test_a_policy_is_read_off_with_the_first_of_equals():
    assert rl.greedy([[1.0, 1.0 + 1e-10, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1e-8]]).tolist() == [0, 1, 2]


def test_random_ties_find_a_distant_goal_that_the_first_action_would_never_reach():
    # only the goal pays, and the robot explores little: with ties to the first action it would turn in circles
    world = rl.GridWorld.from_ascii("......\n......\n....G.\n......\n.>....\n......")
    task = rl.Task(world, reward=rl.designs.Payment(goal=1, crash=0, step=0))
    firsts = [rl.q_learning(task.mdp(), episodes=400, rng=seed).success.argmax() for seed in range(20)]
    assert np.median(firsts) < 50


# ---------------------------------------------------------------- schedules, seeds, snapshots
@every_learner
def test_a_constant_schedule_equals_the_number(learner, small_task):
    mdp = small_task.mdp()
    number = learner(mdp, episodes=30, alpha=0.3, epsilon=0.2, rng=0)
    assert_same(number, learner(mdp, episodes=30, alpha=np.full(30, 0.3), epsilon=[0.2] * 30, rng=0))


@pytest.mark.parametrize("learner", [rl.q_learning, rl.sarsa, rl.expected_sarsa, rl.monte_carlo])
def test_each_episode_uses_its_own_entry_of_a_schedule(learner):
    one_step = rl.MDP([[[1]], [[1]]], np.ones((2, 1, 1)), [[[1.0]], [[0.0]]], 0.9, [False, True], 0)
    run = learner(one_step, episodes=4, alpha=[0.5, 1.0, 0.25, 0.125], Q0=9.0, snapshots=4, rng=0)
    assert run.snapshots[:, 0, 0].tolist() == [5.0, 1.0, 1.0, 1.0]
    run = learner(one_step, episodes=3, alpha=[0.5, 0.25, 0.125], Q0=9.0, snapshots=3, rng=0)
    assert run.snapshots[:, 0, 0].tolist() == [5.0, 4.0, 3.625]


def test_each_episode_explores_as_its_entry_says():
    mdp = rl.MDP(np.ones((2, 2, 1), int), np.ones((2, 2, 1)), np.zeros((2, 2, 1)), 0.9, [False, True], 0)
    chosen = []
    epsilon = np.repeat([0.0, 1.0, 0.0], 300)
    rl.learn(
        mdp, lambda Q, s, a, *_: chosen.append(a), episodes=900, epsilon=epsilon, Q0=[[1.0, 0.0], [0.0, 0.0]], rng=0
    )
    shares = np.array(chosen).reshape(3, 300).mean(axis=1)
    assert shares[[0, 2]].tolist() == [0, 0]
    assert shares[1] == pytest.approx(0.5, abs=5 * 0.029)


@every_learner
def test_the_same_seed_gives_the_same_bits(learner, small_task):
    mdp = small_task.mdp()
    assert_same(learner(mdp, episodes=50, rng=7), learner(mdp, episodes=50, rng=7))
    assert (learner(mdp, episodes=50, rng=7).Q != learner(mdp, episodes=50, rng=8).Q).any()


@every_learner
def test_a_generator_goes_on_where_it_stopped(learner, small_task):
    mdp = small_task.mdp()
    rng = np.random.default_rng(7)
    first, second = learner(mdp, episodes=50, rng=rng), learner(mdp, episodes=50, rng=rng)
    assert_same(first, learner(mdp, episodes=50, rng=7))
    assert (first.Q != second.Q).any()


@every_learner
def test_without_a_seed_every_run_is_another(learner, small_task):
    mdp = small_task.mdp()
    assert (learner(mdp, episodes=50).Q != learner(mdp, episodes=50).Q).any()


def test_a_run_can_go_on_from_its_table(small_task):
    mdp = small_task.mdp()
    rng = np.random.default_rng(0)
    half = rl.q_learning(mdp, episodes=40, rng=rng)
    rest = rl.q_learning(mdp, episodes=60, rng=rng, Q0=half.Q)
    whole = rl.q_learning(mdp, episodes=100, rng=0)
    np.testing.assert_array_equal(rest.Q, whole.Q)
    np.testing.assert_array_equal(np.append(half.returns, rest.returns), whole.returns)


@every_learner
def test_snapshots_are_the_tables_after_their_episodes(learner, small_task):
    mdp = small_task.mdp()
    run = learner(mdp, episodes=100, snapshots=4, rng=0)
    assert run.snapshot_episodes.tolist() == [25, 50, 75, 100]
    for n, table in zip(run.snapshot_episodes, run.snapshots, strict=True):
        np.testing.assert_array_equal(table, learner(mdp, episodes=int(n), rng=0).Q)


def test_snapshots_do_not_change_the_run(small_task):
    mdp = small_task.mdp()
    with_them, without = rl.sarsa(mdp, episodes=60, snapshots=60, rng=0), rl.sarsa(mdp, episodes=60, rng=0)
    np.testing.assert_array_equal(with_them.Q, without.Q)
    assert without.snapshots.shape == (0, mdp.S, mdp.A)
    assert with_them.snapshot_episodes.tolist() == list(range(1, 61))


# ---------------------------------------------------------------- arrays go in and come out unharmed
@every_learner
def test_arguments_are_never_changed(learner, small_task):
    mdp, phi = small_task.mdp(), np.arange(small_task.crashed + 1)
    arguments = {"Q0": np.ones((mdp.S, mdp.A)), "alpha": np.full(20, 0.5), "epsilon": np.full(20, 0.1)}
    copies = {name: value.copy() for name, value in arguments.items()}
    run = learner(mdp, phi, episodes=20, rng=0, **arguments)
    for name, value in arguments.items():
        np.testing.assert_array_equal(value, copies[name])
        assert not np.shares_memory(run.Q, value)
    np.testing.assert_array_equal(phi, np.arange(mdp.S))


@every_learner
def test_results_share_no_memory_with_each_other_or_the_arguments(learner, small_task):
    mdp = small_task.mdp()
    run = learner(mdp, episodes=20, rng=0, snapshots=1)
    run.Q[...] = -1
    assert (run.snapshots[0] != -1).any()
    again = learner(mdp, episodes=20, rng=0, snapshots=1)
    assert (again.Q != -1).any()


def test_planners_and_looks_ahead_never_change_their_arguments(small_task):
    mdp = small_task.mdp()
    V, pi = np.ones(mdp.S), np.ones(mdp.S, int)
    Q = rl.action_values(mdp, V)
    rl.greedy(Q)
    rl.epsilon_greedy(Q, 0.3)
    rl.evaluate_policy(mdp, pi)
    rl.policy_iteration(mdp, pi=pi)
    rl.rollout(mdp, pi, rng=0)
    assert (V == 1).all()
    assert (pi == 1).all()
    np.testing.assert_array_equal(Q, rl.action_values(mdp, V))


# ---------------------------------------------------------------- episodes
def test_a_rollout_lists_states_actions_and_rewards_in_step(corridor):
    mdp = corridor.mdp()
    episode = rl.rollout(mdp, rl.solve(mdp).pi, rng=0)
    s, s_next, s_last = episode.states
    assert corridor.pose(s) == rl.Pose(0, 0, 0)
    assert [s_next, s_last] == [mdp.next_state[s, episode.actions[0], 0], mdp.next_state[s_next, episode.actions[1], 0]]
    assert episode.rewards.tolist() == [-0.1, 10.0]
    assert (episode.terminated, episode.truncated) == (True, False)


def test_a_rollout_that_runs_out_of_steps_is_truncated():
    episode = rl.rollout(LOOP, [0], max_steps=3, rng=0)
    assert (episode.actions.size, episode.terminated, episode.truncated) == (3, False, True)


def test_a_rollout_from_a_terminal_state_has_no_steps():
    episode = rl.rollout(CHAIN, [0, 0, 0], start=2, rng=0)
    assert (episode.states.tolist(), episode.actions.size, episode.terminated) == ([2], 0, True)


def test_a_rollout_follows_the_chances_of_a_random_policy():
    pi = np.array([[0.2, 0.8], [1.0, 0.0], [0.5, 0.5]])
    rng = np.random.default_rng(0)
    first = np.array([rl.rollout(CHAIN, pi, rng=rng).actions for _ in range(4000)])
    assert first[:, 0].mean() == pytest.approx(0.8, abs=5 * 0.0063)
    assert (first[:, 1] == 0).all()


def test_the_same_seed_gives_the_same_episode(small_task):
    mdp = small_task.mdp()
    pi = np.full((mdp.S, mdp.A), 1 / mdp.A)
    one, two = rl.rollout(mdp, pi, rng=5), rl.rollout(mdp, pi, rng=5)
    np.testing.assert_array_equal(one.states, two.states)


def test_evaluating_with_exploration_scores_the_policy_that_explores():
    # one step from the goal a random action crashes with probability 2/5: the sharp turns leave the corridor
    mdp = rl.Task(rl.GridWorld.from_ascii(">G")).mdp()
    for epsilon in (0.0, 0.1, 0.5, 1.0):
        score = rl.evaluate(mdp, rl.epsilon_greedy(rl.solve(mdp).Q, epsilon))
        assert score.success == pytest.approx(1 - 0.4 * epsilon)
        assert score.crash == pytest.approx(0.4 * epsilon)


# ---------------------------------------------------------------- gamma = 1
def stay_or_go(stay, go):
    """State 0 may stay for a reward or go to the end for another one, undiscounted."""
    to = [[[0], [1]], [[1], [1]]]
    return rl.MDP(to, np.ones((2, 2, 1)), [[[stay], [go]], [[0.0], [0.0]]], 1.0, [False, True], 0)


def test_a_policy_that_never_ends_has_no_value_without_discount():
    with pytest.raises(ValueError, match=r"`pi` .*never ends from state 0"):
        rl.evaluate_policy(stay_or_go(-1.0, 5.0), [0, 0])
    with pytest.raises(ValueError, match=r"`pi` .*never ends from state 0"):
        rl.evaluate(stay_or_go(-1.0, 5.0), [0, 0])


def test_a_policy_that_never_ends_and_is_never_paid_is_worth_nothing():
    assert rl.evaluate_policy(stay_or_go(0.0, 5.0), [0, 0]).tolist() == [0, 0]


@pytest.mark.parametrize("planner", [rl.value_iteration, rl.solve, rl.policy_iteration])
def test_planners_avoid_policies_that_never_end_where_they_only_cost(planner):
    solution = planner(stay_or_go(-1.0, -5.0))
    assert solution.V[0] == pytest.approx(-5)
    assert solution.pi[0] == 1


@pytest.mark.parametrize("planner", [rl.value_iteration, rl.solve, rl.policy_iteration])
def test_reward_without_end_is_an_error_and_not_a_hang(planner, no_hang):
    with pytest.raises(ValueError, match="gamma"):
        planner(stay_or_go(1.0, 5.0))


@pytest.mark.parametrize("planner", [rl.value_iteration, rl.solve])
def test_a_cost_that_nobody_can_escape_is_an_error_and_not_a_hang(planner, no_hang):
    mdp = rl.MDP([[[0]]], [[[1.0]]], [[[-1.0]]], 1.0, [False], 0)
    with pytest.raises(ValueError, match="gamma"):
        planner(mdp)


@every_learner
def test_learning_without_a_discount_stays_finite_where_nothing_ends(learner, no_hang):
    mdp = rl.MDP([[[0]]], [[[1.0]]], [[[1.0]]], 1.0, [False], 0)
    run = learner(mdp, episodes=50, max_steps=20, rng=0)
    assert np.isfinite(run.Q).all()
