"""How to measure on a machine that others use too: CPU time, ratios of neighbors in time, and fresh processes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

SHORTEST = 0.02  # seconds; what is quicker is repeated until so much has passed
PATIENCE = 10.0  # seconds for the pairs of one row, the one under way apart
MOST_PAIRS = 9


def seconds(job: Callable[[], object]) -> float:
    """Return the CPU time of one call."""
    calls, began = 0, time.process_time()
    while (spent := time.process_time() - began) < SHORTEST:
        job()
        calls += 1
    return spent / calls


def ratio(job: Callable[[], Any], unit: Callable[[], object]) -> tuple[float, float, Any]:
    """Measure unit, job, unit ... unit; return the median of job / mean of its two units, seconds, and the answer."""
    answer = job()  # compilation and caches stay outside the clock
    jobs: list[float] = []
    units, began = [seconds(unit)], time.monotonic()
    while not jobs or (len(jobs) < MOST_PAIRS and time.monotonic() - began < PATIENCE):
        jobs.append(seconds(job))
        units.append(seconds(unit))
    ratios = np.array(jobs) * 2 / (np.array(units[:-1]) + units[1:])
    return float(np.median(ratios)), float(np.median(jobs)), answer


def fresh(function: str, *arguments: object, numba: bool = True, cache: str | None = None) -> Any:
    """Call `jobs.function(*arguments)` in a new process and return its result; `numba=False` hides numba from it."""
    hide = "" if numba else "sys.modules['numba'] = None; "
    code = f"import sys, json; {hide}import jobs; print(json.dumps(jobs.{function}(*json.loads(sys.argv[1]))))"
    environment = os.environ | ({"NUMBA_CACHE_DIR": cache} if cache else {})
    command = [sys.executable, "-c", code, json.dumps(arguments)]
    done = subprocess.run(command, cwd=Path(__file__).parent, env=environment, stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def resident(what: str = "VmRSS") -> int:
    """Return the bytes of memory that this process holds, or with "VmHWM" the most it has held; Linux only."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith(what))
