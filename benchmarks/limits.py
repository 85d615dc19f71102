"""The C limits as Python functions: built by gcc at their first use, and kept in `_build/benchmarks`."""

from __future__ import annotations

import ctypes as c
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np

import rlnav as rl

SOURCE = Path(__file__).with_name("limits.c")
BUILT = Path(__file__).parent.parent / "_build/benchmarks"
FLAGS = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC"]


@cache
def library() -> c.CDLL:
    """Build `limits.c` if it has changed, and load it."""
    built = BUILT / "limits.so"
    if not built.exists() or built.stat().st_mtime < SOURCE.stat().st_mtime:
        if not shutil.which("gcc"):
            sys.exit("The C limits need gcc, and none was found. On Debian or Ubuntu: sudo apt install gcc")
        BUILT.mkdir(parents=True, exist_ok=True)
        subprocess.run(["gcc", *FLAGS, str(SOURCE), "-o", str(built), "-lm"], check=True)
    loaded = c.CDLL(str(built))
    loaded.value_iteration.restype = loaded.q_learning.restype = c.c_long
    return loaded


def value_iteration(mdp: rl.MDP, r: np.ndarray, tol: float) -> np.ndarray:
    """Return V; `r` holds the expected rewards [S, A]."""
    V = np.empty(mdp.S)
    model = c.c_long(mdp.S), mdp.A, mdp.K, mdp.next_state.ctypes, mdp.prob.ctypes, r.ctypes
    library().value_iteration(*model, c.c_double(mdp.gamma), c.c_double(tol), V.ctypes)
    return V


def q_learning(
    mdp: rl.MDP, slip: float, *, episodes: int, alpha: float, epsilon: float, max_steps: int, rng: int
) -> tuple[np.ndarray, int]:
    """Return (Q, steps); a robot's first successor is the steering as told, so those tables are all that C needs."""
    Q = np.empty((mdp.S, mdp.A))
    tables = np.ascontiguousarray(mdp.next_state[:, :, 0]), np.ascontiguousarray(mdp.reward[:, :, 0]), mdp.terminal
    steps = library().q_learning(
        c.c_long(mdp.S), mdp.A, *(x.ctypes for x in (*tables, mdp.start)), c.c_long(mdp.start.size),
        c.c_double(mdp.gamma), c.c_double(slip), c.c_long(episodes), c.c_double(alpha), c.c_double(epsilon), max_steps,
        c.c_uint64(rng), Q.ctypes,
    )  # fmt: skip
    return Q, steps
