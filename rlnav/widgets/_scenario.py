"""What a run is made of, as plain data that Python and the browser share; `rlnav/js/scenario` is the other side.

A scenario holds a task and a learner. A reward or features that are functions of the reader's own cannot be data: then
Python sends tables, the model that they make, and the browser plays with these.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import _check, designs, learning, maps, montecarlo
from .._training import Training
from ..designs import Nearness, Payment, Progress, Shaped, Total
from ..mdp import MDP
from ..robot import HEADINGS, Pose, Robot
from ..task import Task
from ..world import GridWorld
from ._arrays import pack
from ._schedule import RATIOS, SCHEDULES, schedule

LARGEST_SIDE = 30  # cells along one side that the browser shows
MOST_EPISODES = 1_000_000
MOST_STEPS = 10_000  # of one episode
REWARDS = {"goal": 10, "crash": -10, "step": -0.1, "turn": 0, "progress": 0, "only_closer": False, "shaping": 0}
LEARNER: dict[str, Any] = {
    "algorithm": "q_learning",
    "alpha": 0.2,
    "alpha_schedule": "constant",
    "alpha_end": 0.01,
    "epsilon": 0.2,
    "epsilon_schedule": "constant",
    "epsilon_end": 0.01,
    "episodes": 1000,
    "max_steps": 200,
    "Q0": 0,
    "seed": 0,
}
ALGORITHMS = {
    "q_learning": learning.q_learning,
    "sarsa": learning.sarsa,
    "expected_sarsa": learning.expected_sarsa,
    "double_q_learning": learning.double_q_learning,
    "monte_carlo": montecarlo.monte_carlo,
}
FEATURES = ("cell", "heading", "goal_direction", "goal_bearing", "goal_distance", "moves_ahead")


# ---------------------------------------------------------------- a task as data, and back
def scenario_of(task: Task, **learner: Any) -> dict[str, Any]:
    """Write a task, and settings of a learner, as a scenario; designs that are no data keep their defaults."""
    world = _check.instance("task", task, Task).world
    if max(world.width, world.height) > LARGEST_SIDE:
        expected = f"a task in a world of at most {LARGEST_SIDE} x {LARGEST_SIDE} cells"
        _check.fail("task", expected, f"{world.width} x {world.height}")
    everywhere = len(GridWorld(world.width, world.height, world.goal, world.obstacles).starts)
    scenario = {
        "map": _rows(world),
        "starts": None if len(world.starts) == everywhere else [[p.x, p.y, p.theta] for p in world.starts],
        "steering": list(task.robot.steering),
        "slip": task.robot.slip,
        "gamma": task.gamma,
        "reward": _reward(task) or REWARDS,
        "features": _features(task),
    }
    return checked({**scenario, **LEARNER, **learner})


def own_designs(task: Task) -> dict[str, Any]:
    """Return the reward and the features of a task, as far as they are functions of the reader's own."""
    own: dict[str, Any] = {} if _reward(task) else {"reward": task.reward}
    named = task.features is None or _features(task) is not None
    return own if named else own | {"features": task.features}


def task_of(scenario: Mapping[str, Any], own: Mapping[str, Any] | None = None) -> Task:
    """Build the task of a scenario; designs of the reader's own, where there are any, take the place of its designs."""
    world = world_of(scenario)
    robot = Robot(tuple(scenario["steering"]), scenario["slip"])
    made = {"reward": _make_reward(scenario, world), "features": _make_features(scenario["features"])}
    return Task(world, robot, **{**made, **(own or {})}, gamma=scenario["gamma"])


def world_of(scenario: Mapping[str, Any]) -> GridWorld:
    """Build the world of a scenario."""
    rows = scenario["map"]
    cells = {(x, len(rows) - 1 - i): symbol for i, row in enumerate(rows) for x, symbol in enumerate(row)}
    (goal,) = (cell for cell, symbol in cells.items() if symbol == "G")
    obstacles = frozenset(cell for cell, symbol in cells.items() if symbol == "#")
    starts = tuple(Pose(*start) for start in scenario["starts"] or ())
    return GridWorld(len(rows[0]), len(rows), goal, obstacles, starts)


def train(scenario: Mapping[str, Any], task: Task) -> Training:
    """Run the learner of a scenario: the run of the browser, to the last bit."""
    rates: dict[str, Any] = {
        name: schedule(scenario[f"{name}_schedule"], scenario[name], scenario[f"{name}_end"], scenario["episodes"])
        for name in ("alpha", "epsilon")
    }
    shared = {name: scenario[name] for name in ("episodes", "max_steps", "Q0")}
    return ALGORITHMS[scenario["algorithm"]](task.mdp(), task.phi(), **shared, **rates, rng=scenario["seed"])


# ---------------------------------------------------------------- tables: what only Python can compute
def tables_of(scenario: Mapping[str, Any], own: Mapping[str, Any]) -> dict[str, Any]:
    """Write the model and the state design of a task with designs of the reader's own.

    Returns
    -------
    dict
        ``own``: which designs are the reader's, of "reward" and "features"; their keys in the scenario mean nothing.
        ``task``: the part of the scenario that the arrays are made for. While it differs from the scenario in the
        browser, they are out of date. ``mdp`` and ``phi``: the arguments of the JavaScript class MDP, and the state
        design, packed; or, in place of both, ``error``: why there is no model, such as a goal that is walled in.
    """
    made: dict[str, Any] = {"own": sorted(own), "task": task_part(scenario)}
    try:
        task = task_of(scenario, own)
        return {**made, "mdp": _packed(task.mdp()), "phi": pack(task.phi(), "int32")}
    except (TypeError, ValueError) as reason:
        return {**made, "error": str(reason)}


def task_part(scenario: Mapping[str, Any]) -> dict[str, Any]:
    """Return the part of a scenario that a model depends on, beside designs of the reader's own."""
    return {key: scenario[key] for key in ("map", "starts", "steering", "slip", "gamma")}


def _packed(mdp: MDP) -> dict[str, Any]:
    return {
        "S": mdp.S,
        "A": mdp.A,
        "K": mdp.next_state.shape[2],
        "gamma": mdp.gamma,
        "nextState": pack(mdp.next_state, "int32"),
        "prob": pack(_repeated(mdp.prob), "float64"),
        "reward": pack(mdp.reward, "float64"),
        "terminal": pack(mdp.terminal, "uint8"),
        "start": pack(mdp.start, "int32"),
        "goal": pack(mdp.goal, "uint8"),
    }


def playback(run: Training) -> dict[str, Any]:
    """Write a run with snapshots as arrays: single precision, which is enough to look at."""
    return {
        "episodes": run.snapshot_episodes.tolist(),
        "snapshots": pack(run.snapshots, "float32"),
        "returns": pack(run.returns, "float32"),
        "steps": pack(run.steps, "int32"),
        "success": pack(run.success, "uint8"),
    }


def _repeated(prob: np.ndarray) -> np.ndarray:
    """Show a robot's slip, the same in every state, as an array that repeats: it is sent once."""
    same = bool((prob == prob[0]).all())
    return np.broadcast_to(prob[0], prob.shape) if same else prob


# ---------------------------------------------------------------- checks
def checked(scenario: Any) -> dict[str, Any]:
    """Return a complete scenario.

    Whether its goal can be reached is not asked here: a reader who is drawing may wall it in for a moment. Then the
    scenario has no task, and `task_of` says why.

    Raises
    ------
    TypeError, ValueError
        If a key is unknown or a value is not one that it can have; the message names the key.
    """
    if not isinstance(scenario, Mapping):
        _check.fail("scenario", "a dict", _check.show(scenario), kind=TypeError)
    _only("scenario", scenario, DEFAULTS)
    complete = {**DEFAULTS, **scenario}
    complete["map"] = _checked_map(complete["map"])
    complete["starts"] = _checked_starts(complete["starts"], complete["map"])
    robot = Robot(complete["steering"], complete["slip"])
    complete["steering"], complete["slip"] = list(robot.steering), robot.slip
    complete["gamma"] = _check.number("gamma", complete["gamma"], 0, 1)
    complete["reward"] = _checked_reward(complete["reward"])
    _make_features(complete["features"])
    return _check_learner(complete)


def _checked_map(given: Any) -> list[str]:
    expected = f"rows of '.', '#' and one 'G', all of one length, at most {LARGEST_SIDE}"
    rows = _check.items("map", given, expected)
    for row in rows:
        if not isinstance(row, str) or set(row) - set(".#G") or not 0 < len(row) == len(rows[0]) <= LARGEST_SIDE:
            _check.fail("map", expected, f"the row {_check.show(row)}")
    if not 0 < len(rows) <= LARGEST_SIDE:
        _check.fail("map", f"1 to {LARGEST_SIDE} rows", str(len(rows)))
    if (goals := sum(row.count("G") for row in rows)) != 1:
        _check.fail("map", "a map with one goal 'G'", f"{goals} of them")
    return list(rows)


def _checked_starts(starts: Any, rows: list[str]) -> list[list[int]] | None:
    if starts is None:
        return None
    poses: dict[Pose, list[int]] = {}
    for start in _check.items("starts", starts, "poses [x, y, theta], or None for everywhere"):
        numbers = _check.items("starts", start, "poses [x, y, theta]")
        if len(numbers) != 3:
            _check.fail("starts", "poses [x, y, theta]", _check.show(start))
        pose = Pose(*numbers)
        inside = 0 <= pose.x < len(rows[0]) and 0 <= pose.y < len(rows)
        symbol = rows[len(rows) - 1 - pose.y][pose.x] if inside else "outside the grid"
        if symbol != ".":
            where = {"#": "an obstacle", "G": "the goal"}.get(symbol, symbol)
            _check.fail("starts", "free cells away from the goal", f"({pose.x}, {pose.y}), {where}")
        poses[pose] = [pose.x, pose.y, pose.theta]
    return list(poses.values()) or None


def _checked_reward(given: Any) -> dict[str, Any]:
    if not isinstance(given, Mapping):
        _check.fail("reward", "a dict", _check.show(given), kind=TypeError)
    _only("reward", given, REWARDS)
    reward = {**REWARDS, **given}
    _check.instance("only_closer", reward["only_closer"], bool)
    for name in reward:
        if name != "only_closer":
            reward[name] = _check.number(name, reward[name])
    return reward


def _check_learner(scenario: dict[str, Any]) -> dict[str, Any]:
    one_of("algorithm", scenario["algorithm"], ALGORITHMS)
    for name in ("alpha", "epsilon"):
        one_of(f"{name}_schedule", scenario[f"{name}_schedule"], SCHEDULES)
        for key in (name, f"{name}_end"):
            scenario[key] = _check.number(key, scenario[key], 0, 1, above=name == "alpha")
            if scenario[key] == 0 and (kind := scenario[f"{name}_schedule"]) in RATIOS:
                advice = "Take a small number, or a linear schedule."
                _check.fail(key, f"above 0 with a schedule that is {kind}", "0", advice)
    scenario["episodes"] = _check.integer("episodes", scenario["episodes"], 1, MOST_EPISODES)
    scenario["max_steps"] = _check.integer("max_steps", scenario["max_steps"], 1, MOST_STEPS)
    scenario["seed"] = _check.integer("seed", scenario["seed"], 0)
    scenario["Q0"] = _check.number("Q0", scenario["Q0"])
    return scenario


def _only(name: str, given: Mapping[str, Any], known: Mapping[str, Any]) -> None:
    for key in given:
        if key not in known:
            _check.fail(name, f"a dict with the keys {', '.join(known)}", f"the key {_check.show(key)}")


def one_of(name: str, value: Any, options: Any) -> None:
    """Refuse a value that is not among the options."""
    if not isinstance(value, str) or value not in options:
        _check.fail(name, f"one of {', '.join(map(repr, options))}", _check.show(value))


# ---------------------------------------------------------------- designs as data, and back
def _rows(world: GridWorld) -> list[str]:
    def symbol(x: int, y: int) -> str:
        return "G" if (x, y) == world.goal else "#" if (x, y) in world.obstacles else "."

    return ["".join(symbol(x, y) for x in range(world.width)) for y in reversed(range(world.height))]


def _reward(task: Task) -> dict[str, Any] | None:
    """Return the numbers of a reward that the library's designs make; None for any other."""
    reward, shaping = task.reward, 0.0
    if type(reward) is Shaped and type(reward.potential) is Nearness:
        potential = reward.potential
        if potential.goal != task.world.goal or reward.gamma != task.gamma:
            return None
        reward, shaping = reward.reward, potential.weight
    parts = reward.rewards if type(reward) is Total else (reward,)
    payments = [part for part in parts if type(part) is Payment] or [Payment(0, 0, 0, 0)]
    progress = [part for part in parts if type(part) is Progress] or [Progress(task.world.goal, 0)]
    known = sum(type(part) in (Payment, Progress) for part in parts)
    if known < len(parts) or len(payments) > 1 or len(progress) > 1 or progress[0].goal != task.world.goal:
        return None
    numbers = {name: getattr(payments[0], name) for name in ("goal", "crash", "step", "turn")}
    closer = {"progress": progress[0].weight, "only_closer": progress[0].only_closer}
    return {**numbers, **closer, "shaping": shaping}


def _make_reward(scenario: Mapping[str, Any], world: GridWorld) -> Any:
    given = scenario["reward"]
    reward: Any = Payment(*(given[name] for name in ("goal", "crash", "step", "turn")))
    if given["progress"]:
        reward = Total(reward, Progress(world.goal, given["progress"], given["only_closer"]))
    if given["shaping"]:
        reward = Shaped(reward, Nearness(world.goal, given["shaping"]), scenario["gamma"])
    return reward


def _features(task: Task) -> list[Any] | None:
    """Return the names of features that the library's designs make; None for the whole pose, and for any other."""
    if not isinstance(task.features, tuple) or not all(feature.made_by for feature in task.features):
        return None
    return [_recipe(feature) for feature in task.features]


def _recipe(feature: designs.Feature) -> Any:
    name, *argument = feature.made_by
    return [name, *(list(a) if isinstance(a, tuple) else a for a in argument)] if argument else name


def _make_features(recipes: Any) -> tuple[designs.Feature, ...] | None:
    if recipes is None:
        return None
    made = []
    for recipe in _check.items("features", recipes, "names of features, or None for the whole pose"):
        name, *argument = (recipe,) if isinstance(recipe, str) else _check.items("features", recipe, "names")
        one_of("features", name, FEATURES)
        if len(argument) > (name in ("goal_bearing", "goal_distance")):
            _check.fail("features", f"{name!r} without an argument", _check.show(recipe))
        made.append(getattr(designs, name)(*argument))
    if not made:
        _check.fail("features", "at least one feature, or None for the whole pose", "none")
    return tuple(made)


DEFAULTS: dict[str, Any] = {
    "map": _rows(GridWorld.from_ascii(maps.FREE_SPACE)),
    "starts": [[2, 2, theta] for theta in HEADINGS],
    "steering": [-90, -45, 0, 45, 90],
    "slip": 0.0,
    "gamma": 0.95,
    "reward": REWARDS,
    "features": None,
    **LEARNER,
}
