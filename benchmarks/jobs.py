"""What is measured in a process of its own: first uses, memory, and life without numba."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

import measure

LESSON: dict[str, Any] = {"episodes": 500, "alpha": 0.1, "epsilon": 0.1, "max_steps": 200, "rng": 0}


def lesson() -> float:
    """Return the CPU seconds of the classroom's job: 500 episodes of Q-learning on a 10 x 10 map, warm."""
    import rlnav as rl
    from problem import robot

    mdp = robot(10, slip=0.1, density=0.1)
    rl.q_learning(mdp, **LESSON)
    return float(np.median([measure.seconds(lambda: rl.q_learning(mdp, **LESSON)) for _ in range(9)]))


def first_use() -> float:
    """Return the CPU seconds from `import rlnav` to a first trained result, after NumPy."""
    np.random.default_rng(0).random()
    began = time.process_time()
    import rlnav as rl

    task = rl.Task(rl.maps.random(10, density=0.1, rng=0), rl.Robot(slip=0.1))
    rl.q_learning(task.mdp(), **LESSON)
    return time.process_time() - began


def imports() -> tuple[float, float]:
    """Return the CPU seconds of `import rlnav` after NumPy, and with every name that needs nothing else."""
    began = time.process_time()
    import rlnav as rl

    alone = time.process_time() - began
    for name in set(rl.__all__) - {"plot", "env", "widgets"}:
        getattr(rl, name)
    return alone, time.process_time() - began


def memory(n: int) -> float:
    """Return the bytes a pair (s, a) that a model and its solution take at most, the model's own 60 included."""
    import rlnav as rl
    from problem import robot

    rl.solve(robot(4))  # imports and compilation stay outside
    before = measure.resident()
    mdp = robot(n)
    rl.solve(mdp)
    return (measure.resident("VmHWM") - before) / (mdp.S * mdp.A)
