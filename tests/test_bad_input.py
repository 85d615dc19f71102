"""Whatever is passed, the answer is right or it is one error that names the argument, the place and the value."""

import re
from dataclasses import fields, is_dataclass

import numpy as np
import pytest

import rlnav as rl
from rlnav import designs, planning
from rlnav.env import GridRobotEnv, to_mdp

pytestmark = pytest.mark.usefixtures("no_hang")

POSE = rl.Pose(0, 0, 0)
WORLD = rl.GridWorld.from_ascii("..G\n.#.\nS..")
TASK = rl.Task(WORLD, rl.Robot(slip=0.2))
MDP = TASK.mdp()
STAY = np.zeros(MDP.S, int)
LEARNERS = [rl.q_learning, rl.sarsa, rl.expected_sarsa, rl.double_q_learning, rl.monte_carlo]

# Two states, one action, two successors: a coin flip between staying and leaving
COIN = {
    "next_state": [[[0, 1]], [[1, 1]]],
    "prob": [[[0.5, 0.5]], [[1.0, 0.0]]],
    "reward": [[[0.0, 1.0]], [[0.0, 0.0]]],
    "gamma": 0.9,
    "terminal": [False, True],
    "start": 0,
}
TABLE = {0: {0: [(1.0, 1, 1.0, True)]}, 1: {0: [(1.0, 1, 0.0, True)]}}


def plainly(value):
    """Name a case of a test without the addresses of functions, which differ from process to process."""
    return re.sub(r" at 0x[0-9a-f]+", "", str(value))


def refusal(function, *arguments, **keywords):
    """Call the function, which must refuse; return the kind and the text of its one error."""
    with pytest.raises((ValueError, TypeError)) as caught:
        function(*arguments, **keywords)
    assert caught.type in (ValueError, TypeError)  # and not some relative of theirs, raised by a library further down
    return caught.type, str(caught.value)


def assert_refused(name, parts, function, *arguments, **keywords):
    """Check that the error names the argument, says what is wanted and quotes what it got."""
    _, text = refusal(function, *arguments, **keywords)
    assert text.startswith(f"`{name}` must be "), text
    assert "; got " in text
    assert "\n" not in text
    for part in parts if isinstance(parts, tuple) else (parts,):
        assert part in text


# ---------------------------------------------------------------- the model
@pytest.mark.parametrize(
    ("change", "name", "parts"),
    [
        ({"prob": [[[0.5, 0.6]], [[1.0, 0.0]]]}, "prob", ("sum to 1", "1.1", "s=0, a=0")),
        ({"prob": [[[0.5, 0.5]], [[0.5, 0.4]]]}, "prob", ("0.9", "s=1, a=0")),
        ({"prob": [[[1.5, -0.5]], [[1.0, 0.0]]]}, "prob", ("at least 0", "-0.5", "s=0, a=0, k=1")),
        ({"prob": [[[np.nan, 0.5]], [[1.0, 0.0]]]}, "prob", ("nan", "[0, 0, 0]")),
        ({"prob": [[[np.inf, 0.5]], [[1.0, 0.0]]]}, "prob", ("inf", "[0, 0, 0]")),
        ({"prob": [[0.5, 0.5], [1.0, 0.0]]}, "prob", "shape (2, 2)"),
        ({"prob": np.zeros((0, 1, 1))}, "prob", "shape (0, 1, 1)"),
        ({"prob": np.zeros((2, 0, 2))}, "prob", "shape (2, 0, 2)"),
        ({"prob": [[[0.5, 0.5]], [[1.0]]]}, "prob", "different lengths"),
        ({"prob": [[["a", "b"]], [["c", "d"]]]}, "prob", "type <U1"),
        ({"prob": None}, "prob", "type object"),
        ({"prob": np.ones((2, 1, 2), bool)}, "prob", "type bool"),
        ({"prob": np.full((2, 1, 2), 0.5 + 0j)}, "prob", "type complex128"),
        ({"next_state": [[[0, 2]], [[1, 1]]]}, "next_state", ("0 to 1", "2 at s=0, a=0, k=1")),
        ({"next_state": [[[0, -1]], [[1, 1]]]}, "next_state", "-1 at s=0, a=0, k=1"),
        ({"next_state": [[[0.0, 1.0]], [[1.0, 1.0]]]}, "next_state", "float64"),
        ({"next_state": [[[0, 1]]]}, "next_state", ("(2, 1, 2)", "(1, 1, 2)")),
        ({"next_state": [[[0, 2**40]], [[1, 1]]]}, "next_state", str(2**40)),
        ({"reward": [[[0.0, np.nan]], [[0.0, 0.0]]]}, "reward", ("nan", "[0, 0, 1]")),
        ({"reward": [[[0.0, -np.inf]], [[0.0, 0.0]]]}, "reward", "-inf"),
        ({"reward": [[[0.0, 1e300]], [[0.0, 0.0]]]}, "reward", ("1e+300", "1e+100")),
        ({"reward": [[[0.0]], [[0.0]]]}, "reward", "(2, 1, 1)"),
        ({"reward": "much"}, "reward", "type"),
        ({"gamma": 1.01}, "gamma", "1.01"),
        ({"gamma": -0.1}, "gamma", "-0.1"),
        ({"gamma": np.nan}, "gamma", "nan"),
        ({"gamma": "0.9"}, "gamma", "'0.9' (str)"),
        ({"gamma": True}, "gamma", "True (bool)"),
        ({"gamma": None}, "gamma", "None"),
        ({"gamma": [0.9]}, "gamma", "[0.9]"),
        ({"terminal": [True, True], "start": 1}, "terminal", ("way out to state 1", "s=0, a=0")),
        ({"terminal": [False]}, "terminal", "shape (1,)"),
        ({"terminal": [0, 1]}, "terminal", "int64"),
        ({"reward": [[[0.0, 1.0]], [[0.5, 0.0]]]}, "terminal", ("reward 0.5", "s=1, a=0, k=0")),
        ({"start": 2}, "start", "2"),
        ({"start": -1}, "start", "-1"),
        ({"start": 1}, "start", "terminal state 1"),
        ({"start": []}, "start", "type float64"),
        ({"start": np.array([], int)}, "start", "none"),
        ({"start": 0.0}, "start", "float64"),
        ({"start": [[0], [0, 1]]}, "start", "different lengths"),
        ({"start": [[0]]}, "start", "shape (1, 1)"),
        ({"goal": [True, False]}, "goal", "state 0"),
        ({"goal": [False]}, "goal", "shape (1,)"),
        ({"goal": 1}, "goal", "int64"),
    ],
    ids=plainly,
)
def test_a_model_that_is_none_is_refused(change, name, parts):
    assert_refused(name, parts, rl.MDP, **COIN | change)


def test_a_terminal_state_may_leave_only_with_probability_zero():
    assert rl.MDP(**COIN | {"next_state": [[[0, 1]], [[1, 0]]]}).terminal[1]  # that successor never comes
    assert_refused("terminal", "way out", rl.MDP, **COIN | {"next_state": [[[0, 1]], [[0, 1]]]})


# ---------------------------------------------------------------- robot, world, task
@pytest.mark.parametrize(
    ("function", "arguments", "name", "parts"),
    [
        (rl.Pose, (0.5, 0, 0), "x", "0.5 (float)"),
        (rl.Pose, (0, "1", 0), "y", "'1'"),
        (rl.Pose, (0, 0, 30), "theta", ("45", "30")),
        (rl.Pose, (0, 0, 45.0), "theta", "45.0"),
        (rl.Pose, (0, 0, True), "theta", "True"),
        (rl.Pose, (10**400, 0, 0), "x", "1000000"),
        (rl.Robot, ((),), "steering", "empty"),
        (rl.Robot, ((0, 30),), "steering", "30 at place 1"),
        (rl.Robot, ((0, 225),), "steering", "225"),
        (rl.Robot, ((45, 0, 45),), "steering", "45 twice"),
        (rl.Robot, ((0, 45.0),), "steering", "45.0"),
        (rl.Robot, ((0, np.nan),), "steering", "nan"),
        (rl.Robot, ("0, 45",), "steering", "'0, 45'"),
        (rl.Robot, (45,), "steering", "45"),
        (rl.Robot, (None,), "steering", "None"),
        (rl.Robot, ((False, 45),), "steering", "False"),
        (rl.Robot, ((0,), 1.5), "slip", "1.5"),
        (rl.Robot, ((0,), -0.1), "slip", "-0.1"),
        (rl.Robot, ((0,), np.nan), "slip", "nan"),
        (rl.Robot, ((0,), "much"), "slip", "'much'"),
        (rl.Robot().move, (POSE, 30), "a", "30 degrees"),
        (rl.Robot().move, (POSE, None), "a", "None"),
        (rl.Robot().move, ((0, 0, 0), 0), "pose", "(0, 0, 0) (tuple)"),
        (rl.Robot().outcomes, (5,), "a", ("0 to 4", "5")),
        (rl.Robot().outcomes, (-1,), "a", "-1"),
        (rl.GridWorld, (0, 3, (0, 0)), "width", "0"),
        (rl.GridWorld, (3, 301, (0, 0)), "height", ("300", "301")),
        (rl.GridWorld, (3.0, 3, (0, 0)), "width", "3.0"),
        (rl.GridWorld, (3, 3, (3, 0)), "goal", ("3 x 3", "(3, 0)")),
        (rl.GridWorld, (3, 3, (-1, 0)), "goal", "(-1, 0)"),
        (rl.GridWorld, (3, 3, None), "goal", "None"),
        (rl.GridWorld, (3, 3, (1, 1, 1)), "goal", "(1, 1, 1)"),
        (rl.GridWorld, (3, 3, (0.5, 1)), "goal", "0.5"),
        (rl.GridWorld, (3, 3, "11"), "goal", "'11'"),
        (rl.GridWorld, (3, 3, (1, 1), [(1, 1)]), "goal", ("(1, 1)", "obstacle")),
        (rl.GridWorld, (3, 3, (1, 1), [(3, 3)]), "obstacles", "(3, 3)"),
        (rl.GridWorld, (3, 3, (1, 1), "wall"), "obstacles", "'wall'"),
        (rl.GridWorld, (3, 3, (1, 1), 5), "obstacles", "5"),
        (rl.GridWorld, (3, 1, (2, 0), [(1, 0)], [POSE]), "goal", ("(0, 0)", "no way")),
        (rl.GridWorld, (3, 1, (2, 0), [(1, 0)]), "goal", "walled in"),
        (rl.GridWorld, (1, 1, (0, 0)), "goal", "walled in"),
        (rl.GridWorld, (2, 1, (1, 0), (), [(0, 0)]), "starts", "(0, 0) (tuple)"),
        (rl.GridWorld, (2, 1, (1, 0), (), [rl.Pose(1, 0, 0)]), "starts", "(1, 0), the goal"),
        (rl.GridWorld, (2, 1, (1, 0), (), [rl.Pose(2, 0, 0)]), "starts", "(2, 0), outside"),
        (rl.GridWorld, (3, 1, (2, 0), [(0, 0)], [POSE]), "starts", "(0, 0), an obstacle"),
        (rl.GridWorld, (2, 1, (1, 0), (), 7), "starts", "7"),
        (WORLD.blocked, (0.5, 0), "x", "0.5"),
        (WORLD.crash, (0, 0, None, 0), "x_next", "None"),
        (rl.maps.random, (1,), "width", "1"),
        (rl.maps.random, (3, 1000), "height", "1000"),
        (lambda density: rl.maps.random(3, density=density), (0.9,), "density", "0.9"),
        (lambda rng: rl.maps.random(3, rng=rng), (-1,), "rng", "-1"),
        (rl.Task, (None,), "world", "None"),
        (rl.Task, ("..G",), "world", "'..G' (str)"),
        (rl.Task, (WORLD, None), "robot", "None"),
        (rl.Task, (WORLD, rl.Robot(), 10), "reward", "10"),
        (rl.Task, (WORLD, rl.Robot(), designs.Payment(), []), "features", "none"),
        (rl.Task, (WORLD, rl.Robot(), designs.Payment(), "cell"), "features", "'cell'"),
        (rl.Task, (WORLD, rl.Robot(), designs.Payment(), [designs.cell]), "features", "function"),
        (rl.Task, (WORLD, rl.Robot(), designs.Payment(), None, 2), "gamma", "2"),
        (TASK.pose, (TASK.crashed + 1,), "s", str(TASK.crashed + 1)),
        (TASK.pose, (-1,), "s", "-1"),
        (TASK.index, (rl.Pose(1, 1, 0),), "pose", "x=1, y=1"),
        (TASK.index, (rl.Pose(9, 9, 0),), "pose", "x=9, y=9"),
        (TASK.index, (0,), "pose", "0"),
        (TASK.transition, (POSE, 10), "a", "10 degrees"),
        (designs.Payment, (np.inf,), "goal", "inf"),
        (designs.Payment, (1, "x"), "crash", "'x'"),
        (designs.Payment, (1, 1, None), "step", "None"),
        (designs.Payment, (1, 1, 1, np.nan), "turn", "nan"),
        (designs.Payment, (10**400,), "goal", "100000"),
        (designs.Progress, ((1,),), "goal", "(1,)"),
        (designs.Progress, ((1, 2), np.nan), "weight", "nan"),
        (designs.Progress, ((1, 2), 1.0, "yes"), "only_closer", "'yes'"),
        (designs.Shaped, (None, len, 0.9), "reward", "None"),
        (designs.Shaped, (len, 3, 0.9), "potential", "3"),
        (designs.Shaped, (len, len, 9), "gamma", "9"),
        (designs.Total, (len, 3), "rewards", "3"),
        (designs.distance, (POSE, 3), "goal", "3"),
        (designs.distance, ((0, 0), (1, 1)), "pose", "(0, 0)"),
        (rl.Feature, (3, 2, len), "name", "3"),
        (rl.Feature, ("f", 0, len), "levels", "0"),
        (rl.Feature, ("f", 2.5, len), "levels", "2.5"),
        (rl.Feature, ("f", 2, 1), "of", "1"),
        (designs.goal_bearing, (1,), "sectors", "1"),
        (designs.goal_bearing, (4.5,), "sectors", "4.5"),
        (designs.goal_distance, ((),), "bins", "()"),
        (designs.goal_distance, ((3.0, 1.0),), "bins", "(3.0, 1.0)"),
        (designs.goal_distance, ((1.0, np.nan),), "bins", "nan"),
        (designs.goal_distance, (2.0,), "bins", "2.0"),
    ],
    ids=plainly,
)
def test_robots_worlds_and_tasks_that_cannot_be_are_refused(function, arguments, name, parts):
    assert_refused(name, parts, function, *arguments)


@pytest.mark.parametrize(
    ("drawing", "name", "parts"),
    [
        ("..G\n..", "drawing", ("3 characters", "2 in row 2", "'..'")),
        ("..G\n....", "drawing", "4 in row 2"),
        ("..G\n.x.", "drawing", ("'x' in row 2", "'.x.'")),
        ("..G\n.0.", "drawing", "'0'"),
        ("..G\n. .", "drawing", "' '"),
        ("..g", "drawing", "'g'"),
        ("..G\né..", "drawing", "'é'"),
        ("...", "drawing", ("one goal", "none")),
        ("G.G", "drawing", "2 of them, at [(0, 0), (2, 0)]"),
        ("", "drawing", "empty"),
        ("  \n\n  ", "drawing", "empty"),
        (None, "drawing", "None"),
        (["..G"], "drawing", "(list)"),
        (b"..G", "drawing", "(bytes)"),
        (5, "drawing", "5 (int)"),
        ("G", "goal", "walled in"),
        ("#G#\n###\n...", "goal", "walled in"),
        ("S#G", "goal", ("(0, 0)", "no way")),
        (">.#G\n...#", "goal", "no way"),
        ("S..#G\nS..#.", "goal", "no way"),
        ("." * 301 + "G", "width", "302"),
    ],
    ids=plainly,
)
def test_a_drawing_that_is_no_map_is_refused(drawing, name, parts):
    assert_refused(name, parts, rl.GridWorld.from_ascii, drawing)


# ---------------------------------------------------------------- planners, policies, scores
PLANNERS = [rl.value_iteration, rl.solve]


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize(
    ("keywords", "name", "part"),
    [
        ({"tol": 0}, "tol", "0"),
        ({"tol": -1e-8}, "tol", "-1e-08"),
        ({"tol": np.nan}, "tol", "nan"),
        ({"tol": "small"}, "tol", "'small'"),
        ({"max_sweeps": 0}, "max_sweeps", "0"),
        ({"max_sweeps": 2.0}, "max_sweeps", "2.0"),
        ({"max_sweeps": True}, "max_sweeps", "True"),
    ],
    ids=plainly,
)
def test_stopping_rules_that_never_stop_are_refused(planner, keywords, name, part):
    assert_refused(name, part, planner, MDP, **keywords)


@pytest.mark.parametrize("function", [rl.value_iteration, rl.policy_iteration, rl.solve, *LEARNERS])
@pytest.mark.parametrize("mdp", [None, "mdp", TASK, rl.MDP], ids=plainly)
def test_everything_but_an_mdp_is_refused(function, mdp):
    keywords = {"episodes": 1} if function in LEARNERS else {}
    assert_refused("mdp", "MDP", function, mdp, **keywords)


POLICY_USERS = [
    rl.evaluate_policy,
    rl.evaluate,
    lambda mdp, pi: rl.rollout(mdp, pi, rng=0),
    lambda mdp, pi: rl.td_prediction(mdp, pi, episodes=1, rng=0),
    lambda mdp, pi: rl.mc_prediction(mdp, pi, episodes=1, rng=0),
]


@pytest.mark.parametrize("function", POLICY_USERS)
@pytest.mark.parametrize(
    ("pi", "parts"),
    [
        (STAY[:-1], (f"{MDP.S - 1} actions", "pi[phi]")),
        (np.zeros(3, int), ("3 actions", "pi[phi]")),
        (STAY + 5, ("0 to 4", "5 in state 0")),
        (STAY - 1, "-1 in state 0"),
        (STAY * 1.0, "float64"),
        (STAY > 0, "bool"),
        (None, "type object"),
        ("left", "type"),
        (0, "shape ()"),
        ([], "0 actions"),
        ([[0], [0, 1]], "different lengths"),
        (np.full((MDP.S, 5), 0.25), ("distribution", "in state 0")),
        (np.tile([1.5, -0.5, 0, 0, 0], (MDP.S, 1)), ("1.5, -0.5", "in state 0")),
        (np.full((MDP.S, 5), np.nan), "nan"),
        (np.full((MDP.S, 4), 0.25), f"({MDP.S}, 4)"),
        (np.full((3, 5), 0.2), "(3, 5)"),
        (np.zeros((MDP.S, 5, 1), int), "shape"),
    ],
    ids=lambda x: x if isinstance(x, str) else "",
)
def test_a_policy_that_is_none_is_refused(function, pi, parts):
    assert_refused("pi", parts, function, MDP, pi)


@pytest.mark.parametrize("pi", [STAY[:-1], STAY + 5, STAY * 1.0, np.full((MDP.S, 5), 0.2), 0, "left", [[0], [0, 1]]])
def test_policy_iteration_begins_with_one_action_a_state(pi):
    assert_refused("pi", "got", lambda: rl.policy_iteration(MDP, pi=pi))


@pytest.mark.parametrize(
    ("function", "arguments", "keywords", "name", "part"),
    [
        (rl.action_values, (MDP, np.zeros(3)), {}, "V", "shape (3,)"),
        (rl.action_values, (MDP, np.full(MDP.S, np.nan)), {}, "V", "nan at [0]"),
        (rl.action_values, (MDP, "V"), {}, "V", "type"),
        (rl.action_values, (None, [0]), {}, "mdp", "None"),
        (rl.greedy, ([1.0, 2.0],), {}, "Q", "shape (2,)"),
        (rl.greedy, ([[1.0, np.nan]],), {}, "Q", "nan at [0, 1]"),
        (rl.greedy, (np.zeros((2, 0)),), {}, "Q", "(2, 0)"),
        (rl.greedy, (None,), {}, "Q", "object"),
        (rl.greedy, ([[1.0], [1.0, 2.0]],), {}, "Q", "different lengths"),
        (rl.epsilon_greedy, ([[1.0]], 1.1), {}, "epsilon", "1.1"),
        (rl.epsilon_greedy, ([[1.0]], None), {}, "epsilon", "None"),
        (rl.rollout, (MDP, STAY), {"start": MDP.S}, "start", str(MDP.S)),
        (rl.rollout, (MDP, STAY), {"start": -1}, "start", "-1"),
        (rl.rollout, (MDP, STAY), {"start": [0]}, "start", "[0]"),
        (rl.rollout, (MDP, STAY), {"max_steps": 0}, "max_steps", "0"),
        (rl.rollout, (MDP, STAY), {"max_steps": 10**9}, "max_steps", "1000000000"),
        (rl.rollout, (MDP, STAY), {"rng": "seed"}, "rng", "'seed'"),
        (rl.rollout, (MDP, STAY), {"rng": 0.5}, "rng", "0.5"),
        (rl.rollout, (MDP, STAY), {"rng": True}, "rng", "True"),
        (rl.rollout, (MDP, STAY), {"rng": np.random.RandomState}, "rng", "RandomState"),
        (rl.evaluate, (MDP, STAY), {"max_steps": 0}, "max_steps", "0"),
        (rl.evaluate, (MDP, STAY), {"max_steps": 1.5}, "max_steps", "1.5"),
        (rl.returns, ([1.0, None], 0.9), {}, "rewards", "object"),
        (rl.returns, ([[1.0]], 0.9), {}, "rewards", "shape (1, 1)"),
        (rl.returns, ([np.inf], 0.9), {}, "rewards", "inf at [0]"),
        (rl.returns, ([1.0], 1.5), {}, "gamma", "1.5"),
        (rl.source, (3,), {}, "function", "3"),
        (rl.source, (print,), {}, "function", "print"),
        (GridRobotEnv, (WORLD,), {}, "task", "GridWorld"),
        (GridRobotEnv, (TASK,), {"max_steps": 0}, "max_steps", "0"),
        (GridRobotEnv, (TASK,), {"render_mode": "human"}, "render_mode", "'human'"),
        (GridRobotEnv(TASK).step, (5,), {}, "action", "5"),
        (GridRobotEnv(TASK).step, (-1,), {}, "action", "-1"),
        (GridRobotEnv(TASK).step, (1.0,), {}, "action", "1.0"),
        (GridRobotEnv(TASK).step, (None,), {}, "action", "None"),
        (to_mdp, (None, 0.9), {}, "env", "None"),
        (to_mdp, (3, 0.9), {}, "env", "3 (int)"),
        (to_mdp, ({}, 0.9), {}, "env", "without states"),
        (to_mdp, ({1: {0: []}}, 0.9), {}, "env", "(dict)"),
        (to_mdp, (GridRobotEnv(TASK), 0.9), {}, "env", "GridRobotEnv"),
        (to_mdp, ({0: {0: [(1.0, 0, 0.0, False)]}, 1: {}}, 0.9), {}, "env", "without states or actions"),
        (to_mdp, ([[[], []], [[]]], 0.9), {}, "env", "1 in state 1"),
        (to_mdp, ({0: {0: [(0.5, 0, 0.0, False)]}}, 0.9), {}, "env.P[0][0]", "sum 0.5"),
        (to_mdp, ({0: {0: []}}, 0.9), {}, "env.P[0][0]", "sum 0"),
        (to_mdp, ({0: {0: [(1.0, 0, 0.0)]}}, 0.9), {}, "env.P[0][0]", "ValueError"),
        (to_mdp, ({0: {1: [(1.0, 0, 0.0, False)]}}, 0.9), {}, "env.P[0][0]", "KeyError"),
        (to_mdp, ({0: {0: None}}, 0.9), {}, "env.P[0][0]", "TypeError"),
        (to_mdp, ({0: {0: [(1.0, 1, 0.0, False)]}}, 0.9), {}, "s' of env.P[0][0]", "1"),
        (to_mdp, ({0: {0: [(1.0, 0.0, 0.0, False)]}}, 0.9), {}, "s' of env.P[0][0]", "0.0"),
        (to_mdp, ({0: {0: [(1.5, 0, 0.0, False)]}}, 0.9), {}, "p of env.P[0][0]", "1.5"),
        (to_mdp, ({0: {0: [(1.0, 0, np.nan, False)]}}, 0.9), {}, "r of env.P[0][0]", "nan"),
        (to_mdp, ({0: {0: [(1.0, 0, 0.0, 0)]}}, 0.9), {}, "terminated of env.P[0][0]", "0"),
        (to_mdp, (TABLE, 2), {}, "gamma", "2"),
        (to_mdp, (TABLE, 0.9), {"start": 5}, "start", "5"),
        (to_mdp, (TABLE, 0.9), {"start": "first"}, "start", "type"),
        (to_mdp, ({0: {0: [(1.0, 0, 0.0, True)]}}, 0.9), {}, "start", "none"),
    ],
    ids=plainly,
)
def test_arguments_that_make_no_sense_are_refused(function, arguments, keywords, name, part):
    assert_refused(name, part, function, *arguments, **keywords)


# ---------------------------------------------------------------- learners
@pytest.mark.parametrize("learner", [*LEARNERS, lambda mdp, **k: rl.learn(mdp, rl.sarsa_rule, **k)])
@pytest.mark.parametrize(
    ("keywords", "name", "parts"),
    [
        ({"episodes": 0}, "episodes", "0"),
        ({"episodes": -3}, "episodes", "-3"),
        ({"episodes": 10.0}, "episodes", "10.0"),
        ({"episodes": True}, "episodes", "True"),
        ({"episodes": None}, "episodes", "None"),
        ({"episodes": 10**12}, "episodes", "1000000000000"),
        ({"alpha": 0}, "alpha", "0"),
        ({"alpha": 1.1}, "alpha", "1.1"),
        ({"alpha": -0.1}, "alpha", "-0.1"),
        ({"alpha": np.nan}, "alpha", "nan"),
        ({"alpha": "0.1"}, "alpha", "0.1"),
        ({"alpha": None}, "alpha", "None"),
        ({"alpha": True}, "alpha", "True"),
        ({"alpha": [0.1, 0.2]}, "alpha", ("(3)", "(2,)")),
        ({"alpha": [0.1, 0.0, 0.1]}, "alpha", ("(0, 1]", "0 in episode 1")),
        ({"alpha": [0.1, 0.2, np.inf]}, "alpha", "inf at [2]"),
        ({"alpha": [[0.1], [0.2, 0.3]]}, "alpha", "different lengths"),
        ({"epsilon": 1.1}, "epsilon", "1.1"),
        ({"epsilon": -0.1}, "epsilon", "-0.1"),
        ({"epsilon": np.nan}, "epsilon", "nan"),
        ({"epsilon": [0.1, 0.2, 1.2]}, "epsilon", ("[0, 1]", "1.2 in episode 2")),
        ({"epsilon": np.array([])}, "epsilon", "(0,)"),
        ({"max_steps": 0}, "max_steps", "0"),
        ({"max_steps": 10**30}, "max_steps", "1000000"),
        ({"max_steps": 5.0}, "max_steps", "5.0"),
        ({"rng": -1}, "rng", "-1"),
        ({"rng": 0.0}, "rng", "0.0"),
        ({"rng": "0"}, "rng", "'0'"),
        ({"rng": [1, 2]}, "rng", "[1, 2]"),
        ({"Q0": np.nan}, "Q0", "nan"),
        ({"Q0": None}, "Q0", "None"),
        ({"Q0": 1e300}, "Q0", "1e+300"),
        ({"Q0": np.zeros((2, 2))}, "Q0", "(2, 2)"),
        ({"Q0": np.full((MDP.S, 5), np.inf)}, "Q0", "inf at [0, 0]"),
        ({"snapshots": -1}, "snapshots", "-1"),
        ({"snapshots": 4}, "snapshots", ("at most 3", "4")),
        ({"snapshots": 1.0}, "snapshots", "1.0"),
        ({"phi": STAY[:-1]}, "phi", f"({MDP.S - 1},)"),
        ({"phi": STAY - 1}, "phi", "-1 in state 0"),
        ({"phi": STAY * 1.0}, "phi", "float64"),
        ({"phi": STAY + 10**12}, "phi", "500,000,000"),
        ({"phi": "poses"}, "phi", "type"),
    ],
    ids=plainly,
)
def test_learners_refuse_what_they_cannot_use(learner, keywords, name, parts):
    assert_refused(name, parts, learner, MDP, **{"episodes": 3, "rng": 0} | keywords)


# ---------------------------------------------------------------- functions of one's own
def raises(*_):
    """A mistake in a reader's function."""
    return {}["missing"]


@pytest.mark.parametrize(
    ("reward", "parts"),
    [
        (raises, ("KeyError", "'missing'", "Transition(")),
        (lambda: 1.0, "TypeError"),
        (lambda t: None, ("None", "Transition(s=Pose(x=0, y=0, theta=0), a=-90")),
        (lambda t: float("nan"), ("nan", "Transition(")),
        (lambda t: float("inf") if t.goal else 0.0, ("inf", "goal=True")),
        (lambda t: "10", "'10'"),
        (lambda t: True, "True"),
        (lambda t: [1.0], "[1.0]"),
        (lambda t: 1j, "1j"),
        (lambda t: 10**400, "got"),
        (lambda t: t.nothing, "AttributeError"),
    ],
)
def test_a_reward_that_fails_is_named_with_its_transition(reward, parts):
    _, text = refusal(rl.Task(WORLD, reward=reward).mdp)
    assert text.startswith("`reward")
    for part in parts if isinstance(parts, tuple) else (parts,):
        assert part in text


def test_a_potential_that_fails_is_named_as_part_of_the_reward():
    for potential in (raises, lambda pose: None, lambda pose: float("nan")):
        _, text = refusal(rl.Task(WORLD, reward=designs.Shaped(designs.Payment(), potential, 0.9)).mdp)
        assert text.startswith("`reward")


@pytest.mark.parametrize(
    ("of", "parts"),
    [
        (raises, ("KeyError", "Pose(")),
        (lambda pose: 0, "TypeError"),
        (lambda pose, world, robot: 3, ("0 to 2", "3", "Pose(x=0, y=0, theta=0)")),
        (lambda pose, world, robot: -1, "-1"),
        (lambda pose, world, robot: None, "None"),
        (lambda pose, world, robot: 1.0, "1.0"),
        (lambda pose, world, robot: True, "True"),
        (lambda pose, world, robot: "north", "'north'"),
        (lambda pose, world, robot: float("nan"), "nan"),
        (lambda pose, world, robot: 3 if pose.x == 2 and pose.theta == 45 else 0, "Pose(x=2, y=0, theta=45)"),
    ],
)
def test_a_feature_outside_its_levels_is_named_with_its_pose(of, parts):
    _, text = refusal(rl.Task(WORLD, features=rl.Feature("compass", 3, of)).phi)
    assert text.startswith("`compass")
    for part in parts if isinstance(parts, tuple) else (parts,):
        assert part in text


@pytest.mark.parametrize("levels", [raises, lambda world, robot: 0, lambda world, robot: None, lambda: 3])
def test_levels_that_fail_are_named(levels):
    _, text = refusal(rl.Task(WORLD, features=rl.Feature("compass", levels, lambda *_: 0)).phi)
    assert text.startswith("`levels of 'compass'` must be ")


@pytest.mark.parametrize(
    "features", [raises, lambda pose: None, lambda pose: -1, lambda pose: 0.5, lambda pose: 10**12, lambda: 0]
)
def test_a_function_of_the_pose_that_fails_is_named_with_the_pose(features):
    _, text = refusal(rl.Task(WORLD, features=features).phi)
    assert text.startswith("`features")
    assert "Pose(x=0, y=0, theta=0)" in text


def test_a_table_that_would_be_too_large_is_refused_before_it_is_made():
    features = [designs.moves_ahead(), designs.cell(), designs.goal_bearing(360), designs.goal_direction()]
    robot = rl.Robot(tuple(range(-180, 181, 45)))
    assert_refused("features", ("10,000,000", "14,929,920"), rl.Task(WORLD, robot, features=features).phi)
    feature = rl.Feature("huge", 10**30, lambda *_: 0)
    assert_refused("features", "10,000,000", rl.Task(WORLD, features=[feature, feature]).phi)


@pytest.mark.parametrize(
    ("rule", "kind", "parts"),
    [
        (raises, ValueError, ("KeyError", "'missing'")),
        (lambda Q, s: None, ValueError, "TypeError"),
        (lambda Q, s, a, r, s_next, a_next, gamma, alpha: 1.0, TypeError, ("returns nothing", "1.0")),
        (lambda Q, *_: Q, TypeError, "returns nothing"),
        (lambda Q, s, *_: Q.__setitem__(s, np.nan), ValueError, ("finite", "nan")),
        (lambda Q, s, *_: Q.__setitem__(s, np.inf), ValueError, ("finite", "inf")),
        (lambda Q, *_: Q.__setitem__(10**6, 0.0), ValueError, "IndexError"),
        (lambda Q, *_: Q.__setitem__(slice(None), np.nan), ValueError, "finite"),
        (lambda Q, *_: Q.__setitem__(-1, np.nan), ValueError, "finite"),
    ],
)
def test_a_rule_that_fails_is_named(rule, kind, parts):
    found, text = refusal(rl.learn, MDP, rule, episodes=3, rng=0)
    assert found is kind
    assert text.startswith("`rule` must be ")
    for part in parts if isinstance(parts, tuple) else (parts,):
        assert part in text


@pytest.mark.parametrize("rule", [None, 3, "sarsa", rl.MDP(**COIN)], ids=plainly)
def test_a_rule_that_is_no_function_is_refused(rule):
    assert_refused("rule", "rule(Q, s, a", rl.learn, MDP, rule, episodes=3)


# ---------------------------------------------------------------- anything at all
class Unprintable:
    """An object whose description fails."""

    def __repr__(self):
        raise RuntimeError("no description")


class Unconvertible:
    """An object that NumPy cannot make an array of."""

    def __array__(self, *_, **__):
        raise RuntimeError("no array")


class Incomparable:
    """An object that cannot be compared."""

    __hash__ = None

    def __eq__(self, other):
        raise RuntimeError("no comparison")


JUNK = [
    *(None, True, False, "", "x", "..G\nS..", b"x", ..., object(), type, len, print, np),
    *(0, 1, -1, 2, 3, 2**31, 2**32, 2**63, 2**64, 10**30, -(10**30), 10**400),
    *(0.0, 1.0, 1.5, -0.5, 5e-324, 1e308, -1e308, float("nan"), float("inf"), -float("inf"), 1j),
    *([], [[]], [[[]]], {}, {1: 2}, set(), (), (1,), (1, 2), (1, 2, 3), [1, "a"], [None], [True], [1.5], [[1], [2, 3]]),
    *([float("nan")], [[float("nan")]], range(3), np.array([]), np.array(0), np.array(1.5), np.array([np.nan])),
    *(np.zeros((2, 2)), np.zeros((2, 2, 2)), np.zeros((2, 2, 2, 2)), np.array(["a"]), np.array([object()])),
    *(np.array([1 + 2j]), np.array([2**63], np.uint64), np.array([1], "datetime64[s]"), np.full(MDP.S, 1e308)),
    *(np.float32(1), np.int8(1), np.bool_(True), np.random.default_rng(0), np.random.RandomState(0)),
    *(lambda: 1, lambda *_: None, lambda *_: float("nan"), lambda *_: "x", lambda *_: 10**400, lambda *_: -1, raises),
    *(POSE, rl.Pose, WORLD, rl.Robot(), TASK, MDP, rl.MDP, designs.cell(), [designs.cell()], bytearray(b"ab")),
    *(Unprintable(), Unconvertible(), Incomparable()),
]
LEARNING = {
    **{"mdp": MDP, "episodes": 3, "alpha": 0.5, "epsilon": 0.1, "max_steps": 5, "rng": 0, "Q0": 0.0, "snapshots": 1},
    "phi": np.arange(MDP.S),
}

PREDICTION = {"mdp": MDP, "pi": STAY, "episodes": 3, "alpha": 0.5, "max_steps": 5, "rng": 0, "V0": 0.0, "snapshots": 1}


def model_of(**keywords):
    """A task's model and its state design, which is where its functions are called."""
    task = rl.Task(**keywords)
    return task.mdp(), task.phi()


def rows_of(**keywords):
    """The state design of one feature, which is where its functions are called."""
    return rl.Task(WORLD, features=rl.Feature(**keywords)).phi()


DOORS = [
    (rl.Pose, {"x": 0, "y": 0, "theta": 0}),
    (rl.Robot, {"steering": (0, 45), "slip": 0.1}),
    (rl.Robot().move, {"pose": POSE, "a": 0}),
    (rl.Robot().outcomes, {"a": 0}),
    (rl.GridWorld, {"width": 3, "height": 3, "goal": (2, 2), "obstacles": [(0, 0)], "starts": [rl.Pose(1, 0, 0)]}),
    (rl.GridWorld.from_ascii, {"drawing": ".G"}),
    (WORLD.blocked, {"x": 0, "y": 0}),
    (WORLD.crash, {"x": 0, "y": 0, "x_next": 1, "y_next": 0}),
    (rl.maps.random, {"width": 3, "height": 3, "density": 0.1, "rng": 0}),
    (designs.Payment, {"goal": 1.0, "crash": 1.0, "step": 1.0, "turn": 1.0}),
    (designs.Progress, {"goal": (1, 1), "weight": 1.0, "only_closer": False}),
    (designs.Shaped, {"reward": designs.Payment(), "potential": lambda pose: 0.0, "gamma": 0.9}),
    (designs.distance, {"pose": POSE, "goal": (1, 1)}),
    (rl.Feature, {"name": "f", "levels": 2, "of": lambda *_: 0}),
    (rows_of, {"name": "f", "levels": 2, "of": lambda *_: 0}),
    (designs.goal_bearing, {"sectors": 8}),
    (designs.goal_distance, {"bins": (1.0, 2.0)}),
    (model_of, {"world": WORLD, "robot": rl.Robot(), "reward": designs.Payment(), "features": None, "gamma": 0.9}),
    (TASK.pose, {"s": 0}),
    (TASK.index, {"pose": POSE}),
    (TASK.transition, {"pose": POSE, "a": 0}),
    (rl.MDP, COIN | {"goal": [False, True]}),
    (rl.action_values, {"mdp": MDP, "V": np.zeros(MDP.S)}),
    (rl.greedy, {"Q": [[1.0, 2.0]]}),
    (rl.epsilon_greedy, {"Q": [[1.0, 2.0]], "epsilon": 0.1}),
    (rl.value_iteration, {"mdp": MDP, "tol": 1e-6, "max_sweeps": 5}),
    (rl.solve, {"mdp": MDP, "tol": 1e-6, "max_sweeps": 5}),
    (rl.policy_iteration, {"mdp": MDP, "pi": STAY}),
    (rl.evaluate_policy, {"mdp": MDP, "pi": STAY}),
    (rl.evaluate, {"mdp": MDP, "pi": STAY, "max_steps": 5}),
    *[(predictor, PREDICTION) for predictor in (rl.td_prediction, rl.mc_prediction)],
    (rl.rollout, {"mdp": MDP, "pi": STAY, "start": 0, "max_steps": 5, "rng": 0}),
    (rl.returns, {"rewards": [1.0, 2.0], "gamma": 0.9}),
    (rl.learn, LEARNING | {"rule": rl.sarsa_rule}),
    *[(learner, LEARNING) for learner in LEARNERS],
    (rl.source, {"function": rl.sarsa}),
    (GridRobotEnv, {"task": TASK, "max_steps": 5, "render_mode": "ansi"}),
    (to_mdp, {"env": TABLE, "gamma": 0.9, "start": 0}),
]


def finite(value):
    """Whether no number in a result is NaN or infinite."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return bool(np.isfinite(value).all())
    if isinstance(value, float):
        return bool(np.isfinite(value))
    if isinstance(value, tuple):
        return all(map(finite, value))
    if is_dataclass(value) and not isinstance(value, type):
        return all(finite(getattr(value, field.name)) for field in fields(value))
    return True


# Sizes are judged by what has to fit: the goal into the grid, the successors to the probabilities.  What is wrong with
# functions shows when they are called: a feature is then named by its own name, here "f".
ALSO = {"width": "goal", "height": "goal", "drawing": "goal", "prob": "next_state", "levels": "features", "of": "f"}


@pytest.mark.parametrize(
    ("function", "good", "name"),
    [(function, good, name) for function, good in DOORS for name in good],
    ids=lambda x: getattr(x, "__qualname__", x if isinstance(x, str) else ""),
)
def test_anything_is_accepted_or_refused_by_name(function, good, name, capsys):  # `print` is one of the functions tried
    function(**good)
    for junk in JUNK:
        try:
            result = function(**good | {name: junk})
        except (ValueError, TypeError) as error:
            refused = error
        else:
            refused = None
            assert finite(result), f"{name}={junk!r} gives {result}"
        if refused is not None:
            assert type(refused) in (ValueError, TypeError)
            assert re.match(f"`({name}|{ALSO.get(name, name)})( .*|\\..*)?` must be .*; got ", str(refused))


def test_every_public_function_and_class_is_tried():
    tried = {getattr(function, "__self__", function) for function, _ in DOORS} | {function for function, _ in DOORS}
    results = {
        rl.Episode,
        rl.Evaluation,
        rl.Prediction,
        rl.Solution,
        rl.Training,
        rl.Transition,
    }  # what the library makes itself
    rules = {rl.q_learning_rule, rl.sarsa_rule}  # called by `learn` alone, with what it has checked
    through = {rl.Task}  # model_of
    public = {getattr(rl, name) for name in rl.__all__ if callable(getattr(rl, name))}
    assert public - results - rules - through <= tried


# ---------------------------------------------------------------- numbers at the edge of what can be computed
@pytest.mark.parametrize("planner", PLANNERS)
def test_a_discount_too_near_to_one_is_an_error_and_not_a_hang(planner, monkeypatch):
    monkeypatch.setattr(planning, "MOST_SWEEPS", 5000)  # the library's own limit takes some seconds
    mdp = rl.MDP([[[0]]], [[[1.0]]], [[[1.0]]], 1 - 1e-9, [False], 0)
    assert_refused("mdp", ("5,000 sweeps", "0.999999999"), planner, mdp)
    assert rl.policy_iteration(mdp).V[0] == pytest.approx(1e9, rel=1e-6)


def test_a_chance_to_end_that_is_lost_in_rounding_is_an_error():
    mdp = rl.MDP(**COIN | {"prob": [[[1.0, 1e-17]], [[1.0, 0.0]]], "reward": [[[1.0, 1.0]], [[0, 0]]], "gamma": 1.0})
    assert_refused("pi", "rounding", rl.evaluate_policy, mdp, [0, 0])


def test_large_rewards_give_large_values_and_no_overflow():
    mdp = rl.MDP([[[0]]], [[[1.0]]], [[[1e99]]], 0.9, [False], 0)
    for planner in (rl.value_iteration, rl.policy_iteration, rl.solve):
        assert planner(mdp).V[0] == pytest.approx(1e100)


def test_nothing_for_ever_is_better_than_a_cost_at_gamma_one():
    # state 0 may stay for nothing or leave for -1: staying is worth 0, wherever policy iteration begins
    mdp = rl.MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [[[0.0], [-1.0]], [[0.0], [0.0]]], 1.0, [False, True], 0)
    for pi in (None, [0, 0], [1, 0]):
        assert rl.policy_iteration(mdp, pi=pi).V[0] == 0
    for planner in PLANNERS:
        assert planner(mdp).V[0] == 0
