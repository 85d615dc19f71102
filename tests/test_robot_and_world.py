"""The robot, its grid and its task, move by move."""

import math

import numpy as np
import pytest

import rlnav as rl
from rlnav.robot import HEADINGS

MAPS = [getattr(rl.maps, name) for name in rl.maps.NAMES]


# ---------------------------------------------------------------- robot
@pytest.mark.parametrize("theta", HEADINGS)
@pytest.mark.parametrize("a", range(-180, 181, 45))
def test_the_robot_drives_to_the_cell_nearest_to_one_unit_ahead(theta, a):
    # no multiple of 22.5 degrees has the sine or the cosine 1/2, so there is only one nearest cell
    robot = rl.Robot(tuple(range(-180, 181, 45)))
    direction = math.radians(theta + a / 2)
    pose = robot.move(rl.Pose(10, 20, theta), a)
    assert abs(pose.x - (10 + math.cos(direction))) < 0.5
    assert abs(pose.y - (20 + math.sin(direction))) < 0.5
    assert pose.theta == (theta + a) % 360
    assert max(abs(pose.x - 10), abs(pose.y - 20)) == 1


def test_moves_of_the_book():
    robot = rl.Robot()
    moves = {a: robot.move(rl.Pose(0, 0, 0), a) for a in robot.steering}
    assert moves == {
        -90: rl.Pose(1, -1, 270),
        -45: rl.Pose(1, 0, 315),
        0: rl.Pose(1, 0, 0),
        45: rl.Pose(1, 0, 45),
        90: rl.Pose(1, 1, 90),
    }
    assert robot.move(rl.Pose(5, 5, 45), 0) == rl.Pose(6, 6, 45)


def test_moves_far_from_the_origin_and_below_it_are_snapped_alike():
    robot = rl.Robot()
    for a in robot.steering:
        near = robot.move(rl.Pose(0, 0, 135), a)
        for x, y in ((-7, -300), (299, 299), (-1, 0)):
            far = robot.move(rl.Pose(x, y, 135), a)
            assert (far.x - x, far.y - y) == (near.x, near.y)


def test_headings_wrap_around():
    assert rl.Pose(0, 0, 360) == rl.Pose(0, 0, 0)
    assert rl.Pose(0, 0, -45) == rl.Pose(0, 0, 315)
    assert rl.Pose(0, 0, 765).theta == 45


def test_poses_that_are_equal_have_equal_hashes():
    assert len({rl.Pose(0, 0, 360), rl.Pose(0, 0, 0), rl.Pose(np.int64(0), 0, 0)}) == 1


def test_a_steering_set_is_kept_in_ascending_order():
    assert rl.Robot((90, 0, -90)).steering == (-90, 0, 90)
    assert rl.Robot(np.array([45, -45])).steering == (-45, 45)


def test_without_slip_an_action_has_one_outcome():
    assert [rl.Robot().outcomes(a) for a in range(5)] == [((turn, 1.0),) for turn in (-90, -45, 0, 45, 90)]


def test_slip_puts_half_its_chance_one_notch_to_each_side():
    assert rl.Robot(slip=0.2).outcomes(2) == ((0, 0.8), (-45, 0.1), (45, 0.1))
    assert rl.Robot((-90, 0, 45), slip=0.5).outcomes(1) == ((0, 0.5), (-90, 0.25), (45, 0.25))


def test_slip_is_clipped_at_the_ends_of_the_steering_set():
    assert rl.Robot(slip=0.2).outcomes(0) == ((-90, 0.8), (-90, 0.1), (-45, 0.1))
    assert rl.Robot(slip=0.2).outcomes(4) == ((90, 0.8), (45, 0.1), (90, 0.1))
    assert {turn for turn, _ in rl.Robot((45,), slip=1.0).outcomes(0)} == {45}


# ---------------------------------------------------------------- world
def test_a_drawing_is_read_with_the_top_row_highest():
    world = rl.GridWorld.from_ascii("#.G\n>..")
    assert (world.width, world.height, world.goal) == (3, 2, (2, 1))
    assert world.obstacles == {(0, 1)}
    assert world.starts == (rl.Pose(0, 0, 0),)


def test_drawn_starts_have_the_drawn_headings():
    world = rl.GridWorld.from_ascii(">^<v\nG..S")
    headings = {(pose.x, pose.y): [] for pose in world.starts}
    for pose in world.starts:
        headings[pose.x, pose.y].append(pose.theta)
    assert headings == {(0, 1): [0], (1, 1): [90], (2, 1): [180], (3, 1): [270], (3, 0): list(HEADINGS)}


def test_without_a_drawn_start_every_pose_with_a_way_to_the_goal_is_one():
    world = rl.GridWorld.from_ascii("..#.\nG.##")
    cells = {(pose.x, pose.y) for pose in world.starts}
    assert cells == {(0, 1), (1, 1), (1, 0)}
    assert len(world.starts) == 3 * 8


@pytest.mark.parametrize("drawing", MAPS, ids=rl.maps.NAMES)
def test_a_world_prints_as_the_drawing_it_was_read_from(drawing):
    world = rl.GridWorld.from_ascii(drawing)
    assert str(world).split() == drawing.split()
    assert rl.GridWorld.from_ascii(str(world)) == world


def test_blank_lines_and_indentation_do_not_matter():
    assert rl.GridWorld.from_ascii("\n\n    ..G\n    S#.\n\n") == rl.GridWorld.from_ascii("..G\nS#.")


@pytest.mark.parametrize(
    ("move", "crash"),
    [
        (((0, 0), (1, 0)), False),
        (((1, 0), (1, 1)), True),  # the obstacle itself
        (((0, 0), (1, 1)), True),
        (((0, 1), (1, 2)), True),  # a corner of it
        (((1, 2), (0, 1)), True),
        (((1, 0), (2, 1)), True),
        (((0, 0), (0, -1)), True),  # off the grid
        (((2, 2), (3, 3)), True),
        (((2, 0), (3, 1)), True),
        (((0, 2), (0, 1)), False),
    ],
)
def test_moves_crash_into_obstacles_and_edges_and_corners(move, crash):
    world = rl.GridWorld.from_ascii("..G\n.#.\n...")
    (x, y), (x_next, y_next) = move
    assert world.crash(x, y, x_next, y_next) is crash


def test_a_diagonal_move_between_free_cells_is_safe():
    world = rl.GridWorld.from_ascii(".G\n..")
    assert not world.crash(0, 0, 1, 1)
    assert not world.crash(1, 0, 0, 1)


def test_a_gap_that_is_only_diagonal_is_no_way():
    with pytest.raises(ValueError, match="no way"):
        rl.GridWorld.from_ascii("#G\n>#")


def regions(world):
    """The sets of free cells between which one can move, found by merging labels until nothing changes."""
    label = {cell: i for i, cell in enumerate(world.free)}
    changed = True
    while changed:
        changed = False
        for x, y in world.free:
            for dx, dy in ((1, 0), (0, 1), (1, 1), (1, -1)):
                square = {(x, y), (x + dx, y), (x, y + dy), (x + dx, y + dy)}
                if square <= label.keys() and label[x, y] != label[x + dx, y + dy]:
                    label[x, y] = label[x + dx, y + dy] = min(label[x, y], label[x + dx, y + dy])
                    changed = True
    return [{cell for cell in label if label[cell] == i} for i in set(label.values())]


@pytest.mark.parametrize("seed", range(20))
def test_random_worlds_have_the_goal_and_the_starts_in_their_largest_region(seed):
    world = rl.maps.random(7, 5, density=0.5, rng=seed)
    largest = max(map(len, regions(world)))
    (home,) = [region for region in regions(world) if world.goal in region]
    assert len(home) == largest
    assert {(pose.x, pose.y) for pose in world.starts} == home - {world.goal}


def test_random_worlds_follow_their_seed_and_density():
    assert rl.maps.random(9, rng=3) == rl.maps.random(9, rng=3) != rl.maps.random(9, rng=4)
    assert not rl.maps.random(9, density=0.0, rng=3).obstacles
    share = np.mean([len(rl.maps.random(30, density=0.3, rng=seed).obstacles) for seed in range(10)]) / 900
    assert share == pytest.approx(0.3, abs=0.02)  # 9000 cells, standard error 0.005


# ---------------------------------------------------------------- task
def test_states_are_poses_cell_by_cell_and_the_crash_comes_last():
    task = rl.Task(rl.GridWorld.from_ascii("#G\n>."))
    assert [task.pose(s) for s in (0, 7, 8, 16)] == [
        rl.Pose(0, 0, 0),
        rl.Pose(0, 0, 315),
        rl.Pose(1, 0, 0),
        rl.Pose(1, 1, 0),
    ]
    assert task.crashed == 24
    assert task.pose(24) is None


def test_the_default_rewards_are_those_of_the_book():
    task = rl.Task(rl.GridWorld.from_ascii(">.G"))
    mdp = task.mdp()
    start, middle = task.index(rl.Pose(0, 0, 0)), task.index(rl.Pose(1, 0, 0))
    assert mdp.gamma == 0.95
    assert mdp.reward[start, :, 0].tolist() == [-10, -0.1, -0.1, -0.1, -10]
    assert mdp.reward[middle, :, 0].tolist() == [-10, 10, 10, 10, -10]
    np.testing.assert_allclose(rl.solve(mdp).V[[start, middle]], [-0.1 + 0.95 * 10, 10])


def test_goal_and_crash_end_the_episode_and_only_the_goal_is_a_success():
    task = rl.Task(rl.GridWorld.from_ascii(">.G"))
    mdp = task.mdp()
    on_goal = [task.index(rl.Pose(2, 0, theta)) for theta in HEADINGS]
    assert np.flatnonzero(mdp.terminal).tolist() == [*on_goal, task.crashed]
    assert np.flatnonzero(mdp.goal).tolist() == on_goal


@pytest.mark.parametrize("slip", [0.0, 0.3])
@pytest.mark.parametrize("steering", [(-90, -45, 0, 45, 90), (0, 90), (45,)])
def test_the_model_agrees_with_the_robot_and_the_world_one_transition_at_a_time(slip, steering):
    world, robot = rl.GridWorld.from_ascii("...G\n.#..\nS..#"), rl.Robot(steering, slip)
    task = rl.Task(world, robot)
    mdp = task.mdp()
    for s, pose in enumerate(task.poses):
        for a in range(len(steering)):
            expected = {}
            for turn, p in robot.outcomes(a):
                to = robot.move(pose, turn)
                crash = world.crash(pose.x, pose.y, to.x, to.y)
                r = -10.0 if crash else 10.0 if (to.x, to.y) == world.goal else -0.1
                key = (task.crashed, r) if crash else (task.index(to), r)
                expected[key] = expected.get(key, 0.0) + p
            if (pose.x, pose.y) == world.goal:
                expected = {(s, 0.0): 1.0}
            found = {}
            for k in range(mdp.K):
                key = (int(mdp.next_state[s, a, k]), float(mdp.reward[s, a, k]))
                found[key] = found.get(key, 0.0) + float(mdp.prob[s, a, k])
            assert found == pytest.approx(expected)


def test_a_reward_function_sees_each_transition_as_it_is():
    seen = []

    def reward(t):
        seen.append(t)
        return 1.0

    task = rl.Task(rl.GridWorld.from_ascii(">G"), reward=reward)
    task.mdp()
    assert len(seen) == 8 * 5
    assert rl.Transition(rl.Pose(0, 0, 0), 0, rl.Pose(1, 0, 0), crash=False, goal=True) in seen
    assert rl.Transition(rl.Pose(0, 0, 0), 90, rl.Pose(1, 1, 90), crash=True, goal=False) in seen
    assert not any(t.crash and t.goal for t in seen)


def test_a_reward_of_ones_own_may_be_an_integer_or_a_numpy_number():
    world = rl.GridWorld.from_ascii(">G")
    for one in (1, np.float32(1), np.int64(1), np.float64(1)):
        assert rl.Task(world, reward=lambda t, one=one: one).mdp().reward.max() == 1.0


def test_the_model_of_a_task_is_read_only():
    mdp = rl.Task(rl.GridWorld.from_ascii(">G")).mdp()
    for name in ("next_state", "prob", "reward", "terminal", "start", "goal"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(mdp, name)[...] = 0


def test_an_mdp_keeps_its_own_copy_of_arrays_that_can_be_written():
    prob = np.ones((1, 1, 1))
    mdp = rl.MDP([[[0]]], prob, [[[1.0]]], 0.5, [False], 0)
    prob[...] = 0.3
    assert mdp.prob[0, 0, 0] == 1.0


def test_the_ten_lines_of_a_student_run():
    world = rl.GridWorld.from_ascii(rl.maps.FREE_SPACE)
    task = rl.Task(world, rl.Robot(), gamma=0.95)
    mdp, phi = task.mdp(), task.phi()
    best = rl.value_iteration(mdp)
    run = rl.q_learning(mdp, phi, episodes=5000, rng=0)
    V = rl.evaluate_policy(mdp, run.pi[phi])
    assert (V <= best.V + 1e-6).all()
    assert rl.rollout(mdp, run.pi[phi], rng=0).terminated
