"""Episodes played by a fixed policy, and their returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from ._sampling import arrays, draw_from, draw_start, step
from .mdp import MDP, check_policy


@dataclass(frozen=True, eq=False)
class Episode:
    """Hold one episode of T steps.

    Attributes
    ----------
    states : int array [T + 1]
        S_0 ... S_T.
    actions : int array [T]
        A_0 ... A_{T-1}.
    rewards : float array [T]
        R_1 ... R_T: rewards[t] came for action t, together with state t + 1.
    terminated : bool
        Whether S_T is terminal; else the episode was cut for lack of time (truncated).
    """

    states: NDArray[np.int64]
    actions: NDArray[np.int64]
    rewards: NDArray[np.float64]
    terminated: bool

    @property
    def truncated(self) -> bool:
        """Whether time ran out before the episode was over."""
        return not self.terminated

    def __repr__(self) -> str:
        end = "terminated" if self.terminated else "truncated"
        return f"Episode({self.actions.size} steps, {end} in state {self.states[-1]}, rewards {self.rewards.sum():g})"


def rollout(mdp: MDP, pi: ArrayLike, *, start: int | None = None, max_steps: int = 200, rng: object = None) -> Episode:
    """Play one episode by a policy.

    Parameters
    ----------
    mdp : MDP
    pi : int array [S] or float array [S, A]
        An action for each state, or a distribution over actions.
    start : int, optional
        First state; by default one of the start states, by chance.
    max_steps : int
        The episode is cut after so many steps.
    rng : None, int or numpy.random.Generator
        Where chance comes from: one number for the start, and two in each step (action, successor).

    Returns
    -------
    Episode

    Raises
    ------
    TypeError, ValueError
        If `pi` is not a policy of `mdp`, or `start` not a state.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
    >>> rl.rollout(mdp, rl.solve(mdp).pi, rng=0)
    Episode(2 steps, terminated in state 16, rewards 9.9)
    """
    _check.instance("mdp", mdp, MDP)
    pi = check_policy(mdp, pi)
    max_steps = _check.integer("max_steps", max_steps, 1, _check.MOST_STEPS)
    generator, model = _check.generator(rng), arrays(mdp)
    chance = generator.random()
    s = int(draw_start(model, chance)) if start is None else _check.integer("start", start, 0, mdp.S - 1)
    states: list[int] = [s]
    actions: list[int] = []
    rewards: list[float] = []
    while len(actions) < max_steps and not mdp.terminal[s]:
        which, luck = generator.random(), generator.random()
        a = int(pi[s]) if pi.ndim == 1 else draw_from(pi, s, which)
        s, r, _ = step(model, s, a, luck)
        s = int(s)
        states.append(s)
        actions.append(a)
        rewards.append(float(r))
    over = bool(mdp.terminal[s])
    return Episode(np.array(states), np.array(actions, np.int64), np.array(rewards, np.float64), over)


def returns(rewards: ArrayLike, gamma: float) -> NDArray[np.float64]:
    """Compute the return from every step of an episode, backwards by eq. :eq:`eq-return`.

    Parameters
    ----------
    rewards : float array [T]
        R_1 ... R_T.
    gamma : float
        Discount factor in [0, 1].

    Returns
    -------
    G : float array [T]
        G_0 ... G_{T-1}.

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.returns([0, 0, 8], gamma=0.5)
    array([2., 4., 8.])
    """
    R = _check.array("rewards", rewards, "real", (None,), "one reward a step")
    gamma = _check.number("gamma", gamma, 0, 1)
    G = np.zeros(R.size)
    following = 0.0
    for t in reversed(range(R.size)):
        following = G[t] = R[t] + gamma * following
    return G
