"""Prediction from experience: the values of a given policy, from episodes that it has driven, without the model.

Two algorithms, one kind of episode.  Monte Carlo waits for the return; the temporal difference TD(0) looks one step
ahead and believes the table for the rest.  The policy never looks at the table, so with the same seed both learn from
the same episodes: those that `rollout` plays with one generator (a number for the start, and two in each step).

A step into a terminal state has gamma = 0: nothing follows.  Running out of steps is not an end: gamma stays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from ._compile import inline, kernel
from ._sampling import arrays, draw_from, draw_start, step
from ._training import MOST_EPISODES, empty_log, schedule, snapshot_episodes
from .mdp import MDP, check_policy


@dataclass(frozen=True, eq=False)
class Prediction:
    """Hold the values that were estimated, and how they came about.

    Attributes
    ----------
    V : float array [S]
        The final table; 0 in terminal states.
    returns : float array [episodes]
        Discounted return of each episode, from its start.
    steps : int array [episodes]
        Length of each episode.
    terminated : bool array [episodes]
        Whether it ended in a terminal state, rather than by running out of steps.
    snapshots : float array [n, S]
        The table after the episodes `snapshot_episodes`.
    snapshot_episodes : int array [n]
        Numbers of finished episodes.
    """

    V: NDArray[np.float64]
    returns: NDArray[np.float64]
    steps: NDArray[np.int64]
    terminated: NDArray[np.bool_]
    snapshots: NDArray[np.float64]
    snapshot_episodes: NDArray[np.int64]

    def __repr__(self) -> str:
        return f"Prediction({self.steps.size:,} episodes, {self.steps.sum():,} steps, {self.V.size:,} values)"


def td_prediction(
    mdp: MDP,
    pi: ArrayLike,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    V0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Prediction:
    """Estimate the values of a policy by TD(0), eq. :eq:`eq-td`: after each step, towards what it paid and led to.

    Parameters
    ----------
    mdp : MDP
        The world to drive in; the estimator sees only s, r, s'.
    pi : int array [S] or float array [S, A]
        The policy that drives: an action for each state, or a distribution over actions.
    episodes : int
    alpha : float or float array [episodes]
        Step size in (0, 1].
    max_steps : int
        Episodes are cut (truncated, not terminated) after so many steps.
    rng : None, int or numpy.random.Generator
        Where chance comes from; the same seed gives the same episodes, whatever is learned from them.
    V0 : float or float array [S]
        Initial table; terminal states are worth 0 all the same.
    snapshots : int
        Number of evenly spaced copies of the table to keep.

    Returns
    -------
    Prediction

    Raises
    ------
    TypeError, ValueError
        For an argument outside its range.

    References
    ----------
    Sutton, Learning to predict by the methods of temporal differences, Machine Learning 3, 1988.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
    >>> rl.td_prediction(mdp, rl.solve(mdp).pi, episodes=200, rng=0).V[mdp.start].round(3)
    array([9.4])
    """
    return _predict(_td_prediction, mdp, pi, episodes, alpha, max_steps, rng, V0, snapshots)


def mc_prediction(
    mdp: MDP,
    pi: ArrayLike,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    V0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Prediction:
    """Estimate the values of a policy by Monte Carlo, eq. :eq:`eq-mc-prediction`: every visit, towards its return.

    An episode that ran out of steps has no return yet: the value of the last state stands for the rest.
    Parameters, result and errors are those of `td_prediction`.

    References
    ----------
    Sutton and Barto, Reinforcement Learning, 2nd ed., MIT Press, 2018, sections 5.1 and 6.1.
    """
    return _predict(_mc_prediction, mdp, pi, episodes, alpha, max_steps, rng, V0, snapshots)


def _predict(
    loop: Callable[..., None],
    mdp: MDP,
    pi: ArrayLike,
    episodes: int,
    alpha: float | ArrayLike,
    max_steps: int,
    rng: object,
    V0: float | ArrayLike,
    snapshots: int,
) -> Prediction:
    """Check the arguments, run the loop, and give what it wrote down a name."""
    _check.instance("mdp", mdp, MDP)
    pi = check_policy(mdp, pi)
    chances = np.ascontiguousarray(np.eye(mdp.A)[pi] if pi.ndim == 1 else pi)
    episodes = _check.integer("episodes", episodes, 1, MOST_EPISODES)
    alpha = schedule("alpha", alpha, episodes, above=True)
    max_steps = _check.integer("max_steps", max_steps, 1, _check.MOST_STEPS)
    V = _initial_values(V0, mdp)
    after = snapshot_episodes(_check.integer("snapshots", snapshots, 0), episodes, V.size)
    log = empty_log(episodes, after, V)
    loop(arrays(mdp), chances, V, alpha, max_steps, _check.generator(rng), log)
    return Prediction(V, log.returns, log.steps, mdp.terminal[log.last], log.tables, after)


def _initial_values(V0: float | ArrayLike, mdp: MDP) -> NDArray[np.float64]:
    V0 = _check.plain("V0", V0, "one number, or one value a state")
    if V0.ndim == 0:
        V = np.full(mdp.S, _check.number("V0", V0))
    else:
        V = np.array(_check.array("V0", V0, "real", (mdp.S,), "one number, or one value a state"), np.float64)
    V[mdp.terminal] = 0.0
    return V


@inline
def note(log, e, V, G, t, s):
    """Write down the end of episode `e`."""
    log.returns[e], log.steps[e], log.last[e] = G, t, s
    if log.slot[e] >= 0:
        log.tables[log.slot[e], :] = V


# ---------------------------------------------------------------- the boxes: one complete loop each
@kernel
def _td_prediction(mdp, pi, V, alpha, max_steps, rng, log):
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            which, luck = rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, draw_from(pi, s, which), luck)
            V[s] += alpha[e] * (r + gamma * V[s_next] - V[s])
            G, discount = G + discount * r, discount * mdp.gamma
            s = s_next
            if mdp.terminal[s]:
                break
        note(log, e, V, G, t, s)


@kernel
def _mc_prediction(mdp, pi, V, alpha, max_steps, rng, log):
    path, rewards = np.zeros(max_steps, np.uint32), np.zeros(max_steps)
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        for t in range(1, max_steps + 1):
            which, luck = rng.random(), rng.random()
            path[t - 1] = s
            s, rewards[t - 1], _ = step(mdp, s, draw_from(pi, s, which), luck)
            if mdp.terminal[s]:
                break
        G, G_played = V[s], 0.0
        for i in range(t - 1, -1, -1):
            G = rewards[i] + mdp.gamma * G
            G_played = rewards[i] + mdp.gamma * G_played
            V[path[i]] += alpha[e] * (G - V[path[i]])
        note(log, e, V, G_played, t, s)
