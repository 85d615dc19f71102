"""Rewards and state features."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rlnav as rl
from rlnav import designs

from .strategies import STEERINGS, worlds

FEATURES = [
    designs.cell(),
    designs.heading(),
    designs.goal_direction(),
    designs.goal_bearing(),
    designs.goal_bearing(5),
    designs.goal_distance(),
    designs.moves_ahead(),
]


def transition(pose=(0, 0, 0), a=0, to=(1, 0, 0), crash=False, goal=False):
    return rl.Transition(rl.Pose(*pose), a, rl.Pose(*to), crash, goal)


# ---------------------------------------------------------------- rewards
def test_payment_depends_on_how_the_step_ends():
    pay = designs.Payment(goal=5, crash=-3, step=-1, turn=-0.5)
    assert pay(transition()) == -1
    assert pay(transition(goal=True)) == 5
    assert pay(transition(crash=True)) == -3
    assert pay(transition(a=-90)) == pay(transition(a=90)) == -1.5
    assert pay(transition(a=45, goal=True)) == 4.75


def test_progress_pays_for_the_distance_that_is_gained():
    closer, away = transition(to=(1, 0, 0)), transition(to=(-1, 0, 0))
    assert designs.Progress((3, 0), weight=2)(closer) == 2
    assert designs.Progress((3, 0), weight=2)(away) == -2
    assert designs.Progress((3, 0), only_closer=True)(away) == 0


def test_paying_only_for_progress_makes_circling_pay_for_ever():
    # the classic hack: "+1 when closer" without a charge for going away
    world = rl.GridWorld.from_ascii(".....\n.....\n..G..\n.....\n>....")
    honest, hacked = (
        rl.Task(world, reward=designs.Progress(world.goal, only_closer=flag), gamma=0.99) for flag in (False, True)
    )
    best = {task: rl.solve(task.mdp()) for task in (honest, hacked)}
    assert rl.evaluate(honest.mdp(), best[honest].pi).success == pytest.approx(1)
    assert rl.evaluate(hacked.mdp(), best[hacked].pi).timeout == pytest.approx(1)


def test_nearness_is_minus_the_distance():
    potential = designs.Nearness(goal=(3, 4), weight=0.5)
    assert potential(rl.Pose(0, 0, 90)) == -2.5
    assert potential(rl.Pose(3, 4, 90)) == 0
    with pytest.raises(TypeError, match="`goal` must be a cell"):
        designs.Nearness(goal=5)


def test_shaping_adds_the_discounted_gain_in_potential():
    reward = designs.Shaped(designs.Payment(), lambda pose: float(pose.x), gamma=0.5)
    assert reward(transition((4, 0, 0), 0, (5, 0, 0))) == pytest.approx(-0.1 + 0.5 * 5 - 4)


def test_the_potential_after_an_end_is_zero():
    reward = designs.Shaped(designs.Payment(), lambda pose: float(pose.x), gamma=0.5)
    assert reward(transition((4, 0, 0), 0, (5, 0, 0), goal=True)) == 10 - 4
    assert reward(transition((4, 0, 0), 0, (5, 0, 0), crash=True)) == -10 - 4


def test_a_total_is_the_sum_of_its_rewards():
    reward = designs.Total(designs.Payment(), designs.Progress((3, 0)), lambda t: 0.25)
    assert reward(transition()) == pytest.approx(-0.1 + 1 + 0.25)
    assert designs.Total()(transition()) == 0


# ---------------------------------------------------------------- features
@settings(max_examples=15)
@given(worlds(), STEERINGS)
def test_features_stay_within_their_levels(world, steering):
    task = rl.Task(world, rl.Robot(steering))
    for feature in FEATURES:
        size = feature.size(world, task.robot)
        assert all(0 <= feature.level(pose, world, task.robot) < size for pose in task.poses)


def test_the_goal_direction_is_the_pair_of_signs():
    task = rl.Task(rl.GridWorld.from_ascii("...\n.G.\n..."))
    levels = [designs.goal_direction().level(pose, task.world, task.robot) for pose in task.poses[::8]]
    assert levels == [8, 7, 6, 5, 4, 3, 2, 1, 0]  # seen from the bottom left the goal is up and to the right


@pytest.mark.parametrize(
    ("pose", "sector"),
    [
        ((0, 2, 0), 0),
        ((2, 0, 90), 0),
        ((2, 0, 0), 2),
        ((2, 0, 180), 6),
        ((4, 2, 0), 4),
        ((0, 0, 0), 1),
        ((0, 0, 45), 0),
    ],
)
def test_the_goal_bearing_counts_sectors_to_the_left_of_straight_ahead(pose, sector):
    world = rl.GridWorld.from_ascii(".....\n.....\n..G..\n.....\n.....")
    assert designs.goal_bearing().level(rl.Pose(*pose), world, rl.Robot()) == sector


def test_the_goal_bearing_does_not_change_when_world_and_robot_turn_together():
    world, robot = rl.GridWorld.from_ascii(".....\n.....\n..G..\n.....\n....."), rl.Robot()
    bearing = designs.goal_bearing(16)
    for pose in rl.Task(world).poses:
        turned = rl.Pose(4 - pose.y, pose.x, pose.theta + 90)  # about the goal, which is in the middle
        if (pose.x, pose.y) != world.goal:
            assert bearing.level(pose, world, robot) == bearing.level(turned, world, robot)


def test_the_goal_distance_counts_the_limits_that_are_exceeded():
    world, feature = rl.GridWorld.from_ascii("G......."), designs.goal_distance((1.0, 3.0))
    levels = [feature.level(rl.Pose(x, 0, 0), world, rl.Robot()) for x in range(8)]
    assert levels == [0, 0, 1, 1, 2, 2, 2, 2]


def test_moves_ahead_has_one_bit_for_each_move_that_would_crash():
    world, robot = rl.GridWorld.from_ascii("...\n..G\n>.."), rl.Robot()
    level = designs.moves_ahead().level(rl.Pose(0, 0, 0), world, robot)
    assert level == 0b00001  # only the sharp turn to the right leaves the grid
    assert designs.moves_ahead().level(rl.Pose(0, 0, 180), world, robot) == 0b11111


def test_the_table_index_is_the_mixed_radix_number_of_the_levels():
    world = rl.GridWorld.from_ascii("..G\n.#.\nS..")
    task = rl.Task(world, features=[designs.goal_direction(), designs.heading(), designs.moves_ahead()])
    phi, robot = task.phi(), task.robot
    for s, pose in enumerate(task.poses):
        if (pose.x, pose.y) != world.goal:
            levels = [feature.level(pose, world, robot) for feature in task.features]
            assert phi[s] == np.ravel_multi_index(levels, (9, 8, 32))
    assert phi.max() == phi[task.crashed] == 9 * 8 * 32


def test_every_ended_episode_has_the_same_row_and_nothing_else_has_it():
    task = rl.Task(rl.GridWorld.from_ascii("..G\nS.."), features=designs.heading())
    phi, terminal = task.phi(), task.mdp().terminal
    assert set(phi[terminal]) == {8}
    assert phi[~terminal].max() < 8


def test_without_features_every_state_has_its_own_row():
    task = rl.Task(rl.GridWorld.from_ascii("..G\nS.."))
    assert task.phi().tolist() == list(range(49))


def test_a_table_has_the_same_shape_on_every_map():
    features = [designs.goal_bearing(), designs.moves_ahead()]
    sizes = set()
    for name in rl.maps.NAMES:
        sizes.add(int(rl.Task(rl.GridWorld.from_ascii(getattr(rl.maps, name)), features=features).phi().max()))
    assert sizes == {8 * 32}


def test_a_table_learned_on_one_map_runs_on_another():
    # seeds 0 and 1; some poses look at a wall so closely that no steering avoids it
    features = [designs.goal_bearing(), designs.moves_ahead()]
    here = rl.Task(rl.GridWorld(10, 10, goal=(7, 7)), features=features)
    there = rl.Task(rl.maps.random(8, density=0.0, rng=1), features=features)
    run = rl.q_learning(here.mdp(), here.phi(), episodes=5000, rng=0)
    assert rl.evaluate(there.mdp(), run.pi[there.phi()]).success > 0.8
    assert rl.evaluate(there.mdp(), np.zeros(there.crashed + 1, int)).success < 0.1


def test_features_of_ones_own_may_be_a_plain_function_of_the_pose():
    world = rl.GridWorld.from_ascii("..G\nS..")
    phi = rl.Task(world, features=lambda pose: pose.y).phi()
    assert sorted(set(phi)) == [0, 1, 2]


def test_levels_of_ones_own_may_be_numpy_integers():
    feature = rl.Feature("y", 2, lambda pose, world, robot: np.int64(pose.y))
    assert rl.Task(rl.GridWorld.from_ascii("..G\nS.."), features=feature).phi().max() == 2


@given(st.integers(-9, 9), st.integers(-9, 9))
def test_distance_is_euclids(x, y):
    assert designs.distance(rl.Pose(x, y, 0), (1, 2)) == pytest.approx(math.dist((x, y), (1, 2)))
