"""What all learners share: checked arguments, a log that loops write, and the result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from ._compile import inline
from ._sampling import arrays
from .mdp import MDP, greedy

MOST_NUMBERS = 500_000_000  # in one table, or in all its snapshots together
MOST_EPISODES = 10_000_000


@dataclass(frozen=True, eq=False)
class Training:
    """Hold what a learner learned, and how it got there.

    Attributes
    ----------
    Q : float array [Z, A]
        The final table.
    pi : int array [Z]
        Its greedy policy; `pi[phi]` is the policy over the states of the MDP.
    returns : float array [episodes]
        Discounted return of each episode, from its start, exploration included.
    steps : int array [episodes]
        Length of each episode.
    terminated : bool array [episodes]
        Whether it ended in a terminal state, rather than by running out of steps.
    success : bool array [episodes]
        Whether that state was a goal.
    snapshots : float array [n, Z, A]
        The table after the episodes `snapshot_episodes`.
    snapshot_episodes : int array [n]
        Numbers of finished episodes.
    """

    Q: NDArray[np.float64]
    pi: NDArray[np.int64]
    returns: NDArray[np.float64]
    steps: NDArray[np.int64]
    terminated: NDArray[np.bool_]
    success: NDArray[np.bool_]
    snapshots: NDArray[np.float64]
    snapshot_episodes: NDArray[np.int64]

    def __repr__(self) -> str:
        share = self.success[-100:].mean()
        return (
            f"Training({self.steps.size:,} episodes, {self.steps.sum():,} steps, success {share:.2f} in the last 100)"
        )


class Log(NamedTuple):
    """What a loop writes down at the end of each episode."""

    returns: NDArray[np.float64]
    steps: NDArray[np.int64]
    last: NDArray[np.int64]  # the state in which the episode stopped
    slot: NDArray[np.int64]  # where in `tables` to keep a copy after this episode, or -1
    tables: NDArray[np.float64]


@inline
def record(log, e, Q, G, t, s):
    """Write down the end of episode `e`."""
    log.returns[e], log.steps[e], log.last[e] = G, t, s
    if log.slot[e] >= 0:
        for z in range(Q.shape[0]):  # not `tables[slot] = Q`: its check of shapes takes numba seconds to compile
            for a in range(Q.shape[1]):
                log.tables[log.slot[e], z, a] = Q[z, a]


def train(
    loop: Callable[..., None],
    mdp: MDP,
    phi: ArrayLike | None,
    episodes: int,
    alpha: float | ArrayLike,
    epsilon: float | ArrayLike,
    max_steps: int,
    rng: object,
    Q0: float | ArrayLike,
    snapshots: int,
) -> Training:
    """Check the arguments that all learners share, run the loop, and give what it wrote down a name."""
    _check.instance("mdp", mdp, MDP)
    phi = check_phi(mdp, phi)
    episodes = _check.integer("episodes", episodes, 1, MOST_EPISODES)
    alpha = schedule("alpha", alpha, episodes, above=True)
    epsilon = schedule("epsilon", epsilon, episodes)
    max_steps = _check.integer("max_steps", max_steps, 1, _check.MOST_STEPS)
    Q = _initial_table(Q0, int(phi.max()) + 1, mdp.A)
    after = snapshot_episodes(_check.integer("snapshots", snapshots, 0), episodes, Q.size)
    log = empty_log(episodes, after, Q)
    loop(arrays(mdp), phi.astype(np.uint32), Q, alpha, epsilon, max_steps, _check.generator(rng), log)
    ended, success = mdp.terminal[log.last], mdp.goal[log.last]
    return Training(Q, greedy(Q), log.returns, log.steps, ended, success, log.tables, after)


def check_phi(mdp: MDP, phi: ArrayLike | None) -> NDArray[np.int64]:
    """Return the state design as int array [S]; None gives every state its own row."""
    if phi is None:
        return np.arange(mdp.S)
    phi = _check.array("phi", phi, "integer", (mdp.S,), "one row for each state").astype(np.int64)
    if phi.min() < 0:
        s = int((phi < 0).argmax())
        _check.fail("phi", "rows of at least 0", f"{phi[s]} in state {s}")
    return phi


def schedule(name: str, value: float | ArrayLike, episodes: int, *, above: bool = False) -> NDArray[np.float64]:
    """Return one number for each episode."""
    value = _check.plain(name, value, "one number, or one for each episode")
    if value.ndim == 0:
        return np.full(episodes, _check.number(name, value, 0, 1, above=above))
    values = _check.array(name, value, "real", (episodes,), "one number, or one for each episode").astype(np.float64)
    bad = (values < 0) | (values > 1) | (above & (values == 0))
    if bad.any():
        interval = "(0, 1]" if above else "[0, 1]"
        _check.fail(name, f"in {interval} for every episode", f"{values[bad][0]:g} in episode {bad.argmax()}")
    return values


def _initial_table(Q0: float | ArrayLike, Z: int, A: int) -> NDArray[np.float64]:
    if Z * A > MOST_NUMBERS:
        _check.fail("phi", f"the design of a table of at most {MOST_NUMBERS:,} numbers", f"{Z:,} rows of {A}")
    Q0 = _check.plain("Q0", Q0, "one number, or an initial table")
    if Q0.ndim == 0:
        return np.full((Z, A), _check.number("Q0", Q0))
    return np.array(_check.array("Q0", Q0, "real", (Z, A), "one number, or an initial table"), np.float64)


def snapshot_episodes(n: int, episodes: int, size: int) -> NDArray[np.int64]:
    """Return after which episodes the table is kept, n of them, evenly spaced."""
    if n > episodes or n * size > MOST_NUMBERS:
        most = min(episodes, MOST_NUMBERS // size)
        _check.fail("snapshots", f"at most {most:,} for {episodes:,} episodes and {size:,} numbers a table", str(n))
    return np.round(np.linspace(0, episodes, n + 1)[1:]).astype(np.int64)


def empty_log(episodes: int, after: NDArray[np.int64], table: NDArray) -> Log:
    """Make room for what a loop writes down, and for copies of `table` after some of the episodes."""
    slot = np.full(episodes, -1)
    slot[after - 1] = np.arange(after.size)
    return Log(
        np.zeros(episodes),
        np.zeros(episodes, np.int64),
        np.zeros(episodes, np.int64),
        slot,
        np.zeros((after.size, *table.shape)),
    )
