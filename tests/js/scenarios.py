"""Random scenarios for the tests, and the page that runs them: `sc` holds everything in rlnav/js/scenario."""

import json

import numpy as np

from rlnav import maps
from rlnav.widgets import _scenario

MODULES = [
    "scenario/scenario.js",
    "scenario/schedule.js",
    "scenario/edits.js",
    "scenario/model.js",
    "scenario/address.js",
    "scenario/drawn.js",
    "scenario/python.js",
    "scenario/session.js",
    "scenario/metrics.js",
    "scenario/exact.js",
    "scenario/playback.js",
    "simulator/view.js",
]
LOAD = """async modules => {
  window.sc = Object.assign({}, ...await Promise.all(modules.map(name => import(`/${name}`))));
  window.plain = value => JSON.parse(JSON.stringify(value));
}"""
STEERINGS = [[-90, -45, 0, 45, 90], [-45, 0, 45], [0, 90], [45], [-180, -90, 0, 90, 180]]
FEATURES = [
    None,
    None,
    ["cell"],
    ["heading", "goal_direction"],
    [["goal_bearing", 8], "moves_ahead"],
    ["goal_bearing", ["goal_distance", [0.5, 1.5, 4]]],
    [["goal_distance", [1]], "moves_ahead", "heading", ["goal_bearing", 7]],
]
REWARDS = [
    {},
    {"step": -1, "turn": -0.3},
    {"goal": 1, "crash": -0.7, "step": 0, "progress": 0.3},
    {"progress": 1, "only_closer": True, "shaping": 2.5},
    {"shaping": 1},
]


def any_scenario(i):
    """Random scenario number i, complete and solvable, as plain data."""
    random = np.random.default_rng(3000 + i)
    pick = lambda options: options[random.integers(len(options))]  # noqa: E731
    width, height = (int(n) for n in random.integers(4, 10, 2))
    world = maps.random(width, height, density=pick([0.0, 0.15, 0.3]), rng=i)
    rows = [row.translate(str.maketrans("S<>^v", ".....")) for row in str(world).split("\n")]
    near = [[p.x, p.y, p.theta] for p in world.starts]
    few = [near[j] for j in sorted(random.choice(len(near), min(len(near), 3), replace=False).tolist())]
    one_cell = [pose for pose in near if pose[:2] == near[0][:2]]
    changed = {
        "map": rows,
        "starts": pick([None, few, one_cell, few[:1]]),
        "steering": pick(STEERINGS),
        "slip": pick([0, 0, 0.1, 0.3, 1]),
        "gamma": pick([0, 0.5, 0.95, 0.99, 1]),
        "reward": pick(REWARDS),
        "features": pick(FEATURES),
        "algorithm": pick(list(_scenario.ALGORITHMS)),
        "alpha": pick([0.2, 1, 0.05]),
        "alpha_schedule": pick(["constant", "linear", "harmonic", "exponential"]),
        "alpha_end": pick([0.01, 0.2, 1]),
        "epsilon": pick([0.2, 1, 0.01]),
        "epsilon_schedule": pick(["constant", "linear", "harmonic", "exponential"]),
        "epsilon_end": pick([0.05, 0.3]),
        "episodes": int(pick([1, 7, 60])),
        "max_steps": int(pick([200, 13])),
        "Q0": pick([0, 0, 2.5]),
        "seed": int(random.integers(2**40)),
    }
    kept = {key: value for key, value in changed.items() if key == "map" or random.random() < 0.7}
    kept.setdefault("starts", None)  # those of the default belong to another map
    kept.setdefault("episodes", 40)
    return _scenario.checked(kept)


def same(theirs, ours):
    """Whether two pieces of plain data are the same, where 1 and 1.0 are."""
    return json.loads(json.dumps(theirs)) == json.loads(json.dumps(ours))
