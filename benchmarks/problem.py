"""The problem that everybody solves: the robot of the book on a random n x n map."""

from __future__ import annotations

import numpy as np

import rlnav as rl
from limits import BUILT

GAMMA = 0.99  # values have to travel far
FIELDS = ("next_state", "prob", "reward", "terminal", "start", "goal")


def robot(n: int, slip: float = 0.2, density: float = 0.2) -> rl.MDP:
    """Return a task as an MDP of about 6 n^2 states, 5 actions, 3 successors.

    It is built once, which takes half a minute at n = 300, and then read from a file.
    """
    file = BUILT / f"robot-{n}-{slip:g}-{density:g}.npz"
    if not file.exists():
        mdp = rl.Task(rl.maps.random(n, density=density, rng=0), rl.Robot(slip=slip), gamma=GAMMA).mdp()
        file.parent.mkdir(parents=True, exist_ok=True)
        np.savez(file, **{name: getattr(mdp, name) for name in FIELDS})
    with np.load(file) as stored:
        arrays = {name: stored[name] for name in FIELDS}
    for array in arrays.values():
        array.flags.writeable = False  # an MDP shares what nobody can change
    return rl.MDP(**arrays, gamma=GAMMA)
