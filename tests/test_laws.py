"""Laws that hold for every problem, tried on random ones."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rlnav as rl
from rlnav.robot import HEADINGS

from .strategies import SEEDS, SLIPS, STEERINGS, mdps, policies, values, worlds

pytestmark = pytest.mark.usefixtures("no_hang")

PLANNERS = [rl.value_iteration, rl.policy_iteration, rl.solve]


def backup(mdp, V):
    return rl.action_values(mdp, V).max(axis=1)


def lookahead(mdp, pi, V):
    """The expectation backup of a policy."""
    pi = np.eye(mdp.A)[pi] if pi.ndim == 1 else pi
    return (pi * rl.action_values(mdp, V)).sum(axis=1)


def changed(mdp, **new):
    """The same problem with other arrays."""
    fields = ("next_state", "prob", "reward", "gamma", "terminal", "start", "goal")
    return rl.MDP(**{name: getattr(mdp, name) for name in fields} | new)


# ---------------------------------------------------------------- backups
@given(st.data())
def test_the_max_backup_is_a_contraction(data):
    mdp = data.draw(mdps())
    U, V = data.draw(values(mdp)), data.draw(values(mdp))
    after = np.abs(backup(mdp, U) - backup(mdp, V)).max()
    assert after <= mdp.gamma * np.abs(U - V).max() + 1e-12


@given(st.data())
def test_backups_are_monotone(data):
    mdp = data.draw(mdps())
    V = data.draw(values(mdp))
    higher = V + np.abs(data.draw(values(mdp)))
    pi = data.draw(policies(mdp))
    assert (backup(mdp, higher) >= backup(mdp, V) - 1e-12).all()
    assert (lookahead(mdp, pi, higher) >= lookahead(mdp, pi, V) - 1e-12).all()


@given(st.data())
def test_adding_a_constant_to_all_values_adds_the_discounted_constant(data):
    mdp = data.draw(mdps())
    V = data.draw(values(mdp))
    np.testing.assert_allclose(rl.action_values(mdp, V + 7), rl.action_values(mdp, V) + 7 * mdp.gamma, atol=1e-9)


# ---------------------------------------------------------------- values and policies
@given(st.data())
def test_no_policy_is_better_than_the_optimal_values(data):
    mdp = data.draw(mdps())
    V = rl.evaluate_policy(mdp, data.draw(policies(mdp)))
    assert (V <= rl.solve(mdp, tol=1e-11).V + 1e-7).all()


@given(st.data())
def test_the_values_of_a_policy_keep_its_backup_still(data):
    mdp = data.draw(mdps())
    pi = data.draw(policies(mdp))
    V = rl.evaluate_policy(mdp, pi)
    np.testing.assert_allclose(lookahead(mdp, pi, V), V, atol=1e-7)


@pytest.mark.parametrize("planner", PLANNERS)
@given(mdp=mdps())
def test_the_greedy_policy_of_the_optimal_values_reaches_them(planner, mdp):
    solution = planner(mdp)
    np.testing.assert_allclose(rl.evaluate_policy(mdp, solution.pi), solution.V, atol=1e-5)


@given(st.data())
def test_being_greedy_never_makes_a_policy_worse(data):
    mdp = data.draw(mdps())
    V = rl.evaluate_policy(mdp, data.draw(policies(mdp)))
    better = rl.evaluate_policy(mdp, rl.greedy(rl.action_values(mdp, V)))
    assert (better >= V - 1e-7).all()


@pytest.mark.parametrize("planner", PLANNERS)
@given(mdp=mdps(ends=(1, 3)))
def test_terminal_states_are_worth_nothing(planner, mdp):
    assert (planner(mdp).V[mdp.terminal] == 0).all()


@given(mdps(), st.sampled_from([1e-1, 1e-3, 1e-6]))
def test_the_stopping_rule_keeps_its_promise(mdp, tol):
    truth = rl.policy_iteration(mdp).V
    for planner in (rl.value_iteration, rl.solve):
        solution = planner(mdp, tol=tol)
        assert solution.converged
        assert solution.residuals[-1] <= tol
        assert np.abs(solution.V - truth).max() <= mdp.gamma / (1 - mdp.gamma) * tol + 1e-9


@given(mdps(), st.integers(1, 4))
def test_planners_say_when_the_limit_of_sweeps_stopped_them(mdp, limit):
    for planner in (rl.value_iteration, rl.solve):
        solution = planner(mdp, tol=1e-9, max_sweeps=limit)
        assert solution.residuals.size <= limit
        assert solution.converged == (solution.residuals[-1] <= 1e-9)


@given(mdps())
def test_the_changes_of_value_iteration_shrink_by_the_discount(mdp):
    residuals = rl.value_iteration(mdp).residuals
    assert (residuals[1:] <= mdp.gamma * residuals[:-1] + 1e-9).all()


# ---------------------------------------------------------------- rewards
@given(mdps(ends=(0, 0)), st.floats(-5, 5))
def test_a_bonus_on_every_step_of_an_endless_problem_adds_its_return(mdp, bonus):
    shifted = rl.solve(changed(mdp, reward=mdp.reward + bonus), tol=1e-11)
    np.testing.assert_allclose(shifted.V, rl.solve(mdp, tol=1e-11).V + bonus / (1 - mdp.gamma), atol=1e-6)


@given(mdps(), st.floats(0.1, 10))
def test_values_scale_with_the_rewards(mdp, factor):
    scaled = rl.solve(changed(mdp, reward=factor * mdp.reward), tol=1e-11)
    np.testing.assert_allclose(scaled.V, factor * rl.solve(mdp, tol=1e-11).V, atol=1e-6)


@given(st.data())
def test_potential_shaping_lowers_action_values_by_the_potential(data):
    # A. Y. Ng, D. Harada and S. Russell, ICML 1999, with a potential of 0 in terminal states
    mdp = data.draw(mdps())
    potential = np.where(mdp.terminal, 0.0, data.draw(values(mdp)))
    shaping = mdp.gamma * potential[mdp.next_state] - potential[:, None, None]
    plain, shaped = rl.solve(mdp, tol=1e-11), rl.solve(changed(mdp, reward=mdp.reward + shaping), tol=1e-11)
    np.testing.assert_allclose(shaped.Q, plain.Q - potential[:, None], atol=1e-6)
    np.testing.assert_allclose(rl.evaluate_policy(mdp, shaped.pi), plain.V, atol=1e-5)


@settings(max_examples=15)
@given(worlds(), SLIPS)
def test_shaping_by_distance_keeps_the_robots_optimal_policy(world, slip):
    def closeness(pose):
        return -rl.designs.distance(pose, world.goal)

    plain = rl.Task(world, rl.Robot(slip=slip), gamma=0.9)
    reward = rl.designs.Shaped(rl.designs.Payment(), closeness, gamma=0.9)
    shaped = rl.Task(world, rl.Robot(slip=slip), reward, gamma=0.9)
    mdp, best = plain.mdp(), rl.solve(shaped.mdp(), tol=1e-11)
    ends = mdp.terminal[:-1]
    potential = np.append(np.where(ends, 0.0, [closeness(pose) for pose in plain.poses]), 0.0)
    np.testing.assert_allclose(best.Q, rl.solve(mdp, tol=1e-11).Q - potential[:, None], atol=1e-6)
    np.testing.assert_allclose(rl.evaluate_policy(mdp, best.pi), rl.solve(mdp, tol=1e-11).V, atol=1e-6)


# ---------------------------------------------------------------- evaluation against sampling
@given(st.data())
def test_chances_of_success_crash_and_time_out_sum_to_one(data):
    mdp = data.draw(mdps(ends=(0, 3)))
    score = rl.evaluate(mdp, data.draw(policies(mdp)), max_steps=data.draw(st.integers(1, 30)))
    chances = np.array([score.success, score.crash, score.timeout])
    assert (chances >= -1e-12).all()
    assert chances.sum() == pytest.approx(1)
    assert score.gap >= -1e-7


@settings(max_examples=10)
@given(st.data())
def test_exact_scores_agree_with_episodes_that_are_played(data):
    # 2000 episodes: every frequency and mean lies within 5 standard errors, which the ten examples do not exceed
    mdp = data.draw(mdps(gammas=st.just(0.9), ends=(1, 3)))
    pi, n = data.draw(policies(mdp)), 2000
    score = rl.evaluate(mdp, pi, max_steps=12)
    rng = np.random.default_rng(data.draw(SEEDS))
    episodes = [rl.rollout(mdp, pi, max_steps=12, rng=rng) for _ in range(n)]
    won = np.array([mdp.goal[episode.states[-1]] for episode in episodes])
    late = np.array([episode.truncated for episode in episodes])
    steps = np.array([episode.actions.size for episode in episodes])
    for exact, seen in ((score.success, won), (score.timeout, late), (score.steps, steps)):
        assert abs(seen.mean() - exact) <= 5 * seen.std() / np.sqrt(n) + 1e-3


@settings(max_examples=10)
@given(st.data())
def test_exact_values_agree_with_returns_that_are_sampled(data):
    mdp = data.draw(mdps(gammas=st.just(0.5), ends=(0, 2)))
    pi, n = data.draw(policies(mdp)), 2000
    rng = np.random.default_rng(data.draw(SEEDS))
    G = np.array([rl.returns(rl.rollout(mdp, pi, start=0, max_steps=40, rng=rng).rewards, 0.5)[0] for _ in range(n)])
    assert abs(G.mean() - rl.evaluate_policy(mdp, pi)[0]) <= 5 * G.std() / np.sqrt(n) + 1e-6


# ---------------------------------------------------------------- the robot's worlds
def values_by_pose(world, robot):
    task = rl.Task(world, robot, gamma=0.9)
    return dict(zip(task.poses, rl.solve(task.mdp(), tol=1e-11).V[:-1], strict=True))


def drawn(rows):
    return rl.GridWorld.from_ascii("\n".join("".join(row) for row in rows))


@settings(max_examples=25)
@given(worlds(), st.sampled_from([(-90, -45, 0, 45, 90), (-45, 0, 45), (-180, -90, 90, 180)]), SLIPS)
def test_the_mirror_image_of_a_world_has_the_mirrored_values(world, steering, slip):
    robot = rl.Robot(steering, slip)
    image = drawn(reversed(row) for row in str(world).splitlines())
    V, V_image = values_by_pose(world, robot), values_by_pose(image, robot)
    for pose, v in V.items():
        assert V_image[rl.Pose(world.width - 1 - pose.x, pose.y, 180 - pose.theta)] == pytest.approx(v, abs=1e-8)


@settings(max_examples=25)
@given(worlds(), STEERINGS, SLIPS)
def test_a_world_turned_by_a_quarter_has_the_turned_values(world, steering, slip):
    robot = rl.Robot(steering, slip)
    columns = list(zip(*str(world).splitlines(), strict=True))
    turned = drawn(reversed(columns))  # counter-clockwise: the rightmost column becomes the top row
    V, V_turned = values_by_pose(world, robot), values_by_pose(turned, robot)
    for pose, v in V.items():
        assert V_turned[rl.Pose(world.height - 1 - pose.y, pose.x, pose.theta + 90)] == pytest.approx(v, abs=1e-8)


@settings(max_examples=15)
@given(worlds())
def test_a_robot_that_hardly_slips_has_almost_the_values_of_one_that_never_does(world):
    firm, slippery = values_by_pose(world, rl.Robot()), values_by_pose(world, rl.Robot(slip=1e-9))
    assert max(abs(firm[pose] - slippery[pose]) for pose in firm) < 1e-5


@settings(max_examples=15)
@given(worlds())
def test_a_robot_that_slips_is_never_better_off(world):
    # because one that does not slip can imitate it, by choosing its steering at random
    robot = rl.Robot(slip=0.5)
    mdp = rl.Task(world, robot).mdp()
    imitation = np.zeros((mdp.S, mdp.A))
    for a in range(mdp.A):
        for steering, p in robot.outcomes(a):
            imitation[:, robot.steering.index(steering)] += p / mdp.A
    firm = rl.Task(world).mdp()
    uniform = np.full((mdp.S, mdp.A), 1 / mdp.A)
    np.testing.assert_allclose(rl.evaluate_policy(mdp, uniform), rl.evaluate_policy(firm, imitation), atol=1e-8)
    assert (rl.solve(firm).V >= rl.solve(mdp).V - 1e-6).all()


@settings(max_examples=15)
@given(worlds(), STEERINGS, SLIPS)
def test_every_task_is_a_problem_whose_states_are_the_poses_and_the_crash(world, steering, slip):
    task = rl.Task(world, rl.Robot(steering, slip))
    mdp = task.mdp()
    assert len(task.poses) == len(world.free) * len(HEADINGS) == mdp.S - 1
    assert all(task.pose(task.index(pose)) == pose for pose in task.poses)
    assert not mdp.goal[task.crashed]
    assert mdp.terminal[task.crashed]
    assert set(mdp.start.tolist()) == {task.index(pose) for pose in world.starts}
