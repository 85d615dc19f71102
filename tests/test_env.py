"""The bridge to Gymnasium, in both directions."""

import importlib

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import rlnav as rl
from rlnav.env import GridRobotEnv, to_mdp

ID = "rlnav/GridRobot-v0"
FEATURES = [rl.designs.goal_bearing(), rl.designs.moves_ahead()]


CIRCLE = rl.Task(rl.GridWorld.from_ascii("....\n....\n.>..\n...G"))  # action 4, a turn to the left, can go on for ever


@pytest.fixture
def slippery():
    return rl.Task(rl.GridWorld.from_ascii("..G\n.#.\n..."), rl.Robot(slip=0.3))


def drive(env, actions, seed=0):
    """Reset and take these actions; return (observation, reward, terminated, truncated, info) of each step."""
    env.reset(seed=seed)
    return [env.step(a) for a in actions]


# ---------------------------------------------------------------- the robot as an environment
@pytest.mark.parametrize("keywords", [{}, {"render_mode": "ansi"}, {"max_steps": 5}], ids=str)
def test_gymnasiums_checker_is_content(keywords):
    check_env(gymnasium.make(ID, **keywords).unwrapped)


def test_gymnasiums_checker_is_content_with_a_task_of_ones_own(slippery):
    for features in (None, FEATURES):
        task = rl.Task(slippery.world, slippery.robot, features=features)
        check_env(gymnasium.make(ID, task=task).unwrapped)


def test_make_works_without_an_import_of_its_own():
    assert isinstance(gymnasium.make(f"rlnav.env:{ID}").unwrapped, GridRobotEnv)


def test_a_reload_registers_the_environment_only_once():
    importlib.reload(rl.env)
    gymnasium.make(ID)


def test_observation_and_action_spaces_are_those_of_the_table(slippery):
    env = GridRobotEnv(slippery)
    assert (env.observation_space.n, env.action_space.n) == (slippery.mdp().S, 5)
    designed = rl.Task(slippery.world, slippery.robot, features=FEATURES)
    assert GridRobotEnv(designed).observation_space.n == designed.phi().max() + 1


def test_a_robot_that_does_not_slip_does_exactly_what_its_model_says():
    task = rl.Task(rl.GridWorld.from_ascii("..G\n.#.\n..."), features=FEATURES)
    mdp, phi, env = task.mdp(), task.phi(), GridRobotEnv(task)
    rng = np.random.default_rng(0)
    seen = set()
    for _ in range(2500):
        observation, info = env.reset(seed=int(rng.integers(2**32)))
        over = False
        while not over:
            s, a = info["state"], int(rng.integers(5))
            assert observation == phi[s]
            observation, r, over, truncated, info = env.step(a)
            s_next = mdp.next_state[s, a, 0]
            assert (info["state"], r, over, truncated) == (s_next, mdp.reward[s, a, 0], mdp.terminal[s_next], False)
            seen.add((s, a))
    assert len(seen) == 7 * 8 * 5  # all poses off the goal, with all actions


def test_a_robot_that_slips_has_the_chances_of_its_model(slippery):
    # Pearson's statistic over every (s, a) that was tried often: within 4 standard deviations of its mean
    mdp, env = slippery.mdp(), GridRobotEnv(slippery)
    rng = np.random.default_rng(1)
    counts = np.zeros((mdp.S, mdp.A, mdp.S))
    observation, _ = env.reset(seed=1)
    for _ in range(60_000):
        a = int(rng.integers(5))
        s_next, _, terminated, truncated, _ = env.step(a)
        counts[observation, a, s_next] += 1
        observation = env.reset()[0] if terminated or truncated else s_next
    model = np.zeros_like(counts)
    np.add.at(model, (np.arange(mdp.S)[:, None, None], np.arange(5)[:, None], mdp.next_state), mdp.prob)
    assert (counts[model == 0] == 0).all()
    tried = counts.sum(axis=2, keepdims=True)
    expected = np.where(tried >= 100, tried * model, 0)
    cells = expected > 0
    statistic = ((counts[cells] - expected[cells]) ** 2 / expected[cells]).sum()
    freedom = cells.sum() - cells.any(axis=2).sum()
    assert freedom > 100
    assert abs(statistic - freedom) < 4 * np.sqrt(2 * freedom)


def test_episodes_begin_equally_often_at_every_start():
    # 8 starts in 8000 episodes: 1000 each, standard deviation 30
    task = rl.Task(rl.GridWorld.from_ascii("..G\nS.."))
    env, starts = GridRobotEnv(task), task.mdp().start
    env.reset(seed=0)
    counts = np.bincount([env.reset()[0] for _ in range(8000)], minlength=task.crashed + 1)
    assert starts.size == 8
    assert counts[starts].sum() == 8000
    assert np.abs(counts[starts] - 1000).max() < 150


def test_the_same_seed_gives_the_same_episode(slippery):
    env = GridRobotEnv(slippery)
    for seed in range(20):
        assert drive(env, [2], seed) == drive(GridRobotEnv(slippery), [2], seed)
    assert len({str(drive(env, [2], seed)) for seed in range(20)}) > 5


def test_the_goal_ends_the_episode(corridor):
    _, (_, r, terminated, truncated, info) = drive(GridRobotEnv(corridor), [2, 2])
    assert (r, terminated, truncated) == (10.0, True, False)
    assert (info["goal"], info["crash"], info["pose"]) == (True, False, rl.Pose(2, 0, 0))


def test_a_crash_ends_the_episode_where_the_robot_was(corridor):
    ((observation, r, terminated, truncated, info),) = drive(GridRobotEnv(corridor), [4])
    assert (observation, r, terminated, truncated) == (corridor.crashed, -10.0, True, False)
    assert (info["goal"], info["crash"], info["pose"]) == (False, True, rl.Pose(0, 0, 0))


def test_running_out_of_steps_truncates_and_does_not_terminate():
    env = GridRobotEnv(CIRCLE, max_steps=3)
    steps = drive(env, [4, 4, 4])
    assert [step[2:4] for step in steps] == [(False, False), (False, False), (False, True)]


def test_an_end_in_the_last_step_is_an_end_and_not_a_cut(corridor):
    *_, (_, _, terminated, truncated, _) = drive(GridRobotEnv(corridor, max_steps=2), [2, 2])
    assert (terminated, truncated) == (True, False)


def test_the_limit_of_gymnasium_works_too():
    env = gymnasium.make(ID, task=CIRCLE, max_episode_steps=2)
    assert [step[3] for step in drive(env, [4, 4])] == [False, True]


@pytest.mark.parametrize("actions", [[], [2, 2], [4], [3]], ids=["new", "goal", "crash", "cut"])
def test_a_step_outside_an_episode_asks_for_a_reset(corridor, actions):
    env = GridRobotEnv(corridor, max_steps=2 if len(actions) == 2 else 1)
    if actions:
        drive(env, actions)
    with pytest.raises(gymnasium.error.ResetNeeded, match="reset"):
        env.step(2)
    env.reset()
    env.step(2)


def test_text_shows_the_robot_as_an_arrow_on_the_map():
    env = GridRobotEnv(rl.Task(rl.GridWorld.from_ascii("..G\n.#.\n>..")), render_mode="ansi")
    env.reset(seed=0)
    assert env.render() == "..G\n.#.\n→.."
    env.step(2)
    assert env.render() == "..G\n.#.\n.→."
    env.step(3)
    assert env.render() == "..G\n.#.\n..↗"


def test_text_shows_where_the_robot_crashed(corridor):
    env = GridRobotEnv(corridor, render_mode="ansi")
    drive(env, [2, 4])
    assert env.render() == ".XG"


def test_text_shows_the_robot_on_the_goal(corridor):
    env = GridRobotEnv(corridor, render_mode="ansi")
    drive(env, [2, 2])
    assert env.render() == "..→"


def test_nothing_is_drawn_without_a_render_mode(corridor):
    env = GridRobotEnv(corridor)
    env.reset()
    assert env.render() is None


def test_q_learning_through_gymnasium_reaches_what_the_model_promises(corridor):
    env, Q = GridRobotEnv(corridor), np.zeros((corridor.crashed + 1, 5))
    rng = np.random.default_rng(0)
    for episode in range(300):
        s, _ = env.reset(seed=episode)
        over = False
        while not over:
            a = int(rng.integers(5))
            s_next, r, terminated, truncated, _ = env.step(a)
            Q[s, a] += 0.5 * (r + corridor.gamma * (not terminated) * Q[s_next].max() - Q[s, a])
            s, over = s_next, terminated or truncated
    best = rl.solve(corridor.mdp())
    start = corridor.index(rl.Pose(0, 0, 0))
    assert Q[start].max() == pytest.approx(best.V[start], abs=0.01)


# ---------------------------------------------------------------- toy-text tables as MDPs
def frozen_lake(**keywords):
    return gymnasium.make("FrozenLake-v1", **keywords)


@pytest.mark.parametrize(("gamma", "known"), [(1.0, 14 / 17), (0.99, 0.5420)])
def test_frozen_lake_is_worth_what_is_known(gamma, known):
    mdp = to_mdp(frozen_lake(), gamma)
    assert rl.solve(mdp, tol=1e-12).V[0] == pytest.approx(known, abs=5e-5)
    assert (mdp.S, mdp.A, mdp.start.tolist()) == (16, 4, [0])
    assert np.flatnonzero(mdp.terminal).tolist() == [5, 7, 11, 12, 15]
    assert np.flatnonzero(mdp.goal).tolist() == [15]


def test_without_a_discount_the_value_of_frozen_lake_is_the_chance_of_success():
    mdp = to_mdp(frozen_lake(), 1.0)
    score = rl.evaluate(mdp, rl.solve(mdp, tol=1e-12).pi, max_steps=5000)
    assert score.success == pytest.approx(14 / 17, abs=1e-6)
    assert score.crash == pytest.approx(3 / 17, abs=1e-6)


def test_the_cliff_of_gymnasium_takes_thirteen_steps():
    mdp = to_mdp(gymnasium.make("CliffWalking-v1"), 1.0)
    assert rl.solve(mdp).V[mdp.start] == pytest.approx(-13)
    assert np.flatnonzero(mdp.goal).tolist() == [47]
    assert rl.rollout(mdp, rl.solve(mdp).pi, rng=0).actions.size == 13


def test_the_taxi_earns_eight_on_average():
    # T. G. Dietterich, Hierarchical reinforcement learning with the MAXQ value function decomposition, JAIR 13, 2000,
    # has the domain; 7.93 is the mean over its 300 start states, by breadth-first search in the test below
    mdp = to_mdp(gymnasium.make("Taxi-v4"), 1.0)
    V = rl.solve(mdp).V[mdp.start]
    assert (mdp.start.size, V.mean()) == (300, pytest.approx(7.93))
    assert rl.evaluate(mdp, rl.solve(mdp).pi).success == pytest.approx(1)


def test_the_taxis_values_count_the_steps_of_a_shortest_ride():
    env = gymnasium.make("Taxi-v4").unwrapped
    mdp = to_mdp(env, 1.0)
    steps = {s: 1 for s in env.P for a in env.P[s] if env.P[s][a][0][3]}  # one step before the end
    while True:
        near = {s: onward(env.P[s], steps) for s in env.P if s not in steps}
        if not any(near.values()):
            break
        steps |= {s: 1 + min(counts) for s, counts in near.items() if counts}
    rides = np.array([steps[s] for s in mdp.start])
    np.testing.assert_allclose(rl.solve(mdp).V[mdp.start], 21 - rides)


def onward(row, steps):
    """Steps that are left after each action from whose successor they are known."""
    return [steps[s_next] for ((_, s_next, _, over),) in row.values() if s_next in steps and not over]


def test_states_that_are_also_lived_in_get_a_terminal_twin():
    mdp = to_mdp(gymnasium.make("Taxi-v4"), 0.9)
    assert (mdp.S, np.flatnonzero(mdp.terminal).tolist()) == (504, [500, 501, 502, 503])
    assert mdp.goal.tolist() == mdp.terminal.tolist()
    assert 500 in mdp.next_state[16]  # the passenger is in the taxi, at the destination 0


@pytest.mark.parametrize(
    ("name", "keywords"),
    [
        ("FrozenLake-v1", {}),
        ("FrozenLake-v1", {"map_name": "8x8"}),
        ("CliffWalking-v1", {}),
        ("CliffWalking-v1", {"is_slippery": True}),
        ("Taxi-v4", {}),
        ("Taxi-v4", {"is_rainy": True, "fickle_passenger": True}),
    ],
    ids=str,
)
def test_values_are_those_of_the_table_in_every_state_that_goes_on(name, keywords):
    P = gymnasium.make(name, **keywords).unwrapped.P
    V = np.zeros(len(P))
    for _ in range(250):  # value iteration on the table itself, where an ending step has no future
        V = np.array(
            [max(sum(p * (r + 0.9 * V[t] * (not over)) for p, t, r, over in row) for row in P[s].values()) for s in P]
        )
    mdp = to_mdp(P, 0.9)
    lived = ~mdp.terminal[: len(P)]
    np.testing.assert_allclose(rl.solve(mdp, tol=1e-12).V[: len(P)][lived], V[lived], atol=1e-8)


def test_equal_outcomes_are_merged_and_impossible_ones_dropped():
    often = [(0.25, 1, 1.0, True), (0.25, 1, 1.0, True), (0.5, 0, 0.0, False), (0.0, 1, 9.0, True)]
    P = {0: {0: often}, 1: {0: [(1.0, 1, 0, True)]}}
    mdp = to_mdp(P, 0.5)
    assert mdp.K == 2
    assert sorted(zip(mdp.next_state[0, 0].tolist(), mdp.prob[0, 0].tolist(), strict=True)) == [(0, 0.5), (1, 0.5)]
    assert rl.solve(mdp).V[0] == pytest.approx(0.5 / 0.75)


def test_a_state_entered_both_ways_is_worth_nothing_only_where_the_step_ends():
    # from 0, action 0 ends in 1; action 1 goes on to 1, which is worth 5
    P = [
        [[(1.0, 1, 1.0, True)], [(1.0, 1, 0.0, False)]],
        [[(1.0, 2, 5.0, True)], [(1.0, 2, 5.0, True)]],
        [[(1.0, 2, 0.0, True)], [(1.0, 2, 0.0, True)]],
    ]
    mdp = to_mdp(P, 0.9, start=0)
    np.testing.assert_allclose(rl.solve(mdp).Q[0], [1.0, 4.5])
    assert np.flatnonzero(mdp.terminal).tolist() == [2, 3]


def test_goals_are_the_ends_that_pay_best():
    P = {s: {a: [(1.0, a + 1, float(a), True)] for a in range(3)} for s in range(4)}
    assert np.flatnonzero(to_mdp(P, 0.9, start=0).goal).tolist() == [3]


def test_a_table_that_never_ends_has_no_terminal_state():
    mdp = to_mdp({0: {0: [(1.0, 0, 1.0, False)]}}, 0.5)
    assert not mdp.terminal.any()
    assert rl.solve(mdp).V[0] == pytest.approx(2)


def test_a_start_of_ones_own_replaces_that_of_the_environment():
    assert to_mdp(frozen_lake(), 0.9, start=[1, 2]).start.tolist() == [1, 2]


def test_start_states_that_are_not_equally_likely_are_refused():
    env = frozen_lake().unwrapped
    env.initial_state_distrib = np.array([0.75, 0.25] + [0.0] * 14)
    with pytest.raises(ValueError, match=r"`env` .*0\.25 to 0\.75.*`start`"):
        to_mdp(env, 0.9)
