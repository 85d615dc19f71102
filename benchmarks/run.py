"""Measure rlnav against hand-written C and against what people would use instead; print Markdown tables.

    .venv/bin/python benchmarks/run.py                      # everything, some minutes
    .venv/bin/python benchmarks/run.py planning learning    # or some of the tables that --help names

README.md says how to read them.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

import controls
import limits
import peers
import rlnav as rl
import simulator
from measure import fresh, ratio
from problem import GAMMA, robot

BOOK = Path(__file__).parent.parent / "book"
ERROR = 1e-6  # how near to v* every planner must come
TOL = ERROR * (1 - GAMMA) / (2 * GAMMA)  # the last change of a value that guarantees half of it, by the contraction
SLIP = 0.2
SETTINGS: dict[str, Any] = {"alpha": 0.1, "epsilon": 0.1, "max_steps": 200, "rng": 1}

Rows = Iterator[tuple[object, ...]]


def planning() -> Rows:
    """Time to solve, in units of C, and memory."""
    yield "n", "planner", "units", "CPU ms", "bytes per (s, a)"
    for n in (20, 100, 300):
        for solve in planners(robot(4)).values():
            solve()  # imports and compilation
        jobs = planners(robot(n))
        unit = next(iter(jobs.values()))
        for name, solve in jobs.items():
            if name == "rl.value_iteration" and n > 100:
                continue  # a minute of NumPy
            share, seconds, V = ratio(solve, unit)
            if np.abs(V - unit()).max() > 2 * ERROR:
                raise ArithmeticError(f"{name} gives a wrong answer at n = {n}")
            memory = fresh("memory", n) if name == "rl.solve" and n >= 100 else ""
            yield n, name, share, 1000 * seconds, memory


def planners(mdp: rl.MDP) -> dict[str, Callable[[], np.ndarray]]:
    """Return everybody who can solve the problem; the unit comes first."""
    r = np.einsum("sak,sak->sa", mdp.prob, mdp.reward)
    return {
        "C, synchronous sweeps": partial(limits.value_iteration, mdp, r, TOL),
        "rl.solve": lambda: rl.solve(mdp, tol=TOL).V,
        "rl.value_iteration": lambda: rl.value_iteration(mdp, tol=TOL).V,
        **peers.planners(mdp, r, ERROR),
    }


def learning() -> Rows:
    """Time per step of Q-learning, in units of C."""
    yield "n", "learner", "units", "million steps / s", "success of the greedy policy"
    for n in (20, 100):
        mdp = robot(n, SLIP)
        unit = partial(limits.q_learning, mdp, SLIP, episodes=100_000, **SETTINGS)
        jobs: dict[str, Callable[[], Any]] = {
            "C, two tables": unit,
            "rl.q_learning": partial(ours, mdp, episodes=100_000),
            "Gymnasium, loop of its tutorial": partial(peers.tutorial, mdp, SLIP, episodes=1000, **SETTINGS),
        }
        for name, learn in jobs.items():
            share, seconds, (Q, steps) = ratio(learn, unit)
            success = rl.evaluate(mdp, rl.greedy(Q)).success
            yield n, name, share * unit()[1] / steps, steps / seconds / 1e6, f"{success:.0%}"


def ours(mdp: rl.MDP, episodes: int) -> tuple[np.ndarray, int]:
    """Return (Q, steps)."""
    run = rl.q_learning(mdp, episodes=episodes, **SETTINGS)
    return run.Q, int(run.steps.sum())


def classroom() -> Rows:
    """Measure what a lesson waits for: 500 episodes of Q-learning on a 10 x 10 map, slip 0.1."""
    yield "CPU time", "warm, ms", "first result in a new process, s", "first result ever, s"
    for numba in (True, False):
        with tempfile.TemporaryDirectory() as cache:
            cold, warm = (median("first_use", numba, cache, times) for times in (1, 5))
        yield "with numba" if numba else "without", 1000 * fresh("lesson", numba=numba), warm, cold


def imports() -> Rows:
    """Measure what an import costs after NumPy."""
    yield "CPU seconds", "import rlnav", "... and every name of its core"
    for numba in (True, False):
        yield "with numba" if numba else "without", *median("imports", numba)


def book() -> Rows:
    """Measure what a reader waits for when a chapter runs from top to bottom."""
    import nbformat
    from nbclient import NotebookClient

    yield "notebook", "seconds"
    for path in notebooks():
        began = time.perf_counter()
        NotebookClient(nbformat.read(path, 4), resources={"metadata": {"path": str(path.parent)}}).execute()
        yield path.relative_to(BOOK), time.perf_counter() - began


def waits() -> Rows:
    """Measure what a reader waits for after moving a control of a chapter."""
    yield "notebook", "controls", "control", "CPU ms, median", "most"
    # a process for each, because what a chapter leaves in memory counts
    alone = ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1)
    for rows in alone.map(controls.rows, notebooks()):
        yield from rows


def notebooks() -> list[Path]:
    """List the chapters that run."""
    return [path for path in sorted(BOOK.rglob("[!.]*.ipynb")) if path.parent.name != ".ipynb_checkpoints"]


def median(function: str, numba: bool, cache: str | None = None, times: int = 5) -> Any:
    """Return medians over fresh processes."""
    return np.median([fresh(function, numba=numba, cache=cache) for _ in range(times)], axis=0)


def show(rows: Rows) -> None:
    """Print a Markdown table line by line, as it comes."""
    for i, row in enumerate(rows):
        print("|", " | ".join(f"{x:.3g}" if isinstance(x, float) else str(x) for x in row), "|", flush=True)
        if i == 0:
            print("|" + "---|" * len(row))


if __name__ == "__main__":
    tables = {
        "planning": planning,
        "learning": learning,
        "classroom": classroom,
        "import": imports,
        "book": book,
        "controls": waits,
        "simulator": simulator.speed,
        "weight": simulator.weight,
    }
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", nargs="*", help=f"some of {', '.join(tables)}; by default all")
    chosen = parser.parse_args().table or list(tables)
    if unknown := set(chosen) - set(tables):
        parser.error(f"`table` must be some of {', '.join(tables)}; got {', '.join(unknown)}.")
    for name in chosen:
        print(f"\n{tables[name].__doc__}\n")
        show(tables[name]())
