"""What all tests share: no windows, steady random examples, and an end to whatever hangs."""

import faulthandler
import hashlib
import os
import signal
import sys
from pathlib import Path

# Machine code is kept for the next run, but not beyond a change of the source: numba notices one in the file of a loop,
# but none in a file from which the loop takes functions.  It has to know the folder before it is imported.
ROOT = Path(__file__).parents[1]
SOURCE = b"".join(path.read_bytes() for path in sorted(ROOT.glob("rlnav/*.py")))
os.environ["NUMBA_CACHE_DIR"] = str(ROOT / ".pytest_cache" / f"numba-{hashlib.sha256(SOURCE).hexdigest()[:12]}")
os.environ["MPLBACKEND"] = "Agg"

import pytest  # noqa: E402
from hypothesis import settings  # noqa: E402

import rlnav as rl  # noqa: E402

# The same examples in every run; HYPOTHESIS_PROFILE=explore looks for new ones, many more of them.
settings.register_profile("steady", derandomize=True, database=None, deadline=None, max_examples=60)
settings.register_profile("explore", deadline=None, max_examples=2000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))

PATIENCE = 60  # seconds


@pytest.fixture(scope="session")
def compiled():
    """All loops as machine code, so that no later test has to wait for the compiler."""
    mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
    rl.solve(mdp)
    for predictor in (rl.td_prediction, rl.mc_prediction):
        predictor(mdp, [0] * mdp.S, episodes=1, rng=0)
    for learner in (rl.q_learning, rl.sarsa, rl.expected_sarsa, rl.double_q_learning, rl.monte_carlo):
        learner(mdp, episodes=1, rng=0)


@pytest.fixture
def no_hang(compiled):
    """Fail a test that takes too long, and stop Python itself if the time is spent inside compiled code."""

    def give_up(*_):
        pytest.fail(f"still running after {PATIENCE} s")

    before = signal.signal(signal.SIGALRM, give_up)
    signal.alarm(PATIENCE)
    faulthandler.dump_traceback_later(2 * PATIENCE, exit=True, file=sys.__stderr__)
    yield
    faulthandler.cancel_dump_traceback_later()
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.fixture
def corridor():
    """A task whose optimal path is two steps straight on."""
    return rl.Task(rl.GridWorld.from_ascii(">.G"))


@pytest.fixture
def small_task():
    """A task with an obstacle in the way and a robot that slips, 65 states."""
    return rl.Task(rl.GridWorld.from_ascii("..G\n.#.\nS.."), rl.Robot(slip=0.2))
