"""Prediction: what a given policy is worth."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from .mdp import MDP, under_policy

EXACT = 1e-10  # relative error
SLOW, SMALL = 0.999, 4000  # beyond this gamma, up to so many states, the linear system is solved directly
MOST_SWEEPS = 1_000_000


def evaluate_policy(mdp: MDP, pi: ArrayLike) -> NDArray[np.float64]:
    """Find the values of a policy: the solution of eq. :eq:`eq-linear-system`, v = r_pi + gamma P_pi v.

    The expectation backup, eq. :eq:`eq-policy-evaluation`, is repeated until its contraction bounds the error by 1e-10
    times the largest value.  Beyond gamma = 0.999, where this would take long, a system of up to 4000 states is solved
    directly; a larger one is swept until the bound for gamma = 0.999 holds, and its error may be larger.

    Parameters
    ----------
    mdp : MDP
    pi : int array [S] or float array [S, A]
        An action for each state, or a distribution over actions.

    Returns
    -------
    V : float array [S]

    Raises
    ------
    ValueError
        If `pi` is not a policy of `mdp`; at gamma = 1, if it never ends from some state and is paid on the way.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.MDP([[[0, 1]], [[1, 1]]], [[[0.5, 0.5]], [[1, 0]]], [[[0, 1.0]], [[0, 0.0]]], 1.0, [False, True], 0)
    >>> rl.evaluate_policy(mdp, [0, 0]).round(9)
    array([1., 0.])
    """
    _check.instance("mdp", mdp, MDP)
    next_state, prob, r = under_policy(mdp, pi)
    if mdp.gamma == 1:
        _check_that_it_ends(mdp, next_state, prob, r)
    if mdp.gamma > SLOW and mdp.S <= SMALL:
        return _solve_directly(mdp, next_state, prob, r)
    V = np.zeros(mdp.S)
    for _ in range(MOST_SWEEPS):
        V_new = r + mdp.gamma * np.einsum("sn,sn->s", prob, V[next_state])
        change, size = float(np.abs(V_new - V).max()), float(np.abs(V_new).max())
        V = V_new
        if change * mdp.gamma <= (1 - min(mdp.gamma, SLOW)) * EXACT * size:
            return V
    return _check.fail("pi", "a policy whose episodes end sooner", f"values that move after {MOST_SWEEPS:,} sweeps")


def _solve_directly(mdp: MDP, next_state: NDArray, prob: NDArray, r: NDArray) -> NDArray[np.float64]:
    """Solve (I - gamma P) v = r, leaving out states from which no reward ever comes: at gamma = 1 they have no row."""
    P = np.zeros((mdp.S, mdp.S))
    np.add.at(P, (np.arange(mdp.S)[:, None], next_state), prob)
    paid, before = r != 0, 0
    while paid.sum() > before:
        before = paid.sum()
        paid = paid | (P[:, paid] > 0).any(axis=1)
    V = np.zeros(mdp.S)
    try:
        V[paid] = np.linalg.solve(np.eye(paid.sum()) - mdp.gamma * P[np.ix_(paid, paid)], r[paid])
    except np.linalg.LinAlgError:
        advice = "Take a smaller gamma, or a larger chance of an end."
        _check.fail("pi", "a policy that ends", "one whose chance to end is lost in rounding", advice)
    return V


def _reaches_end(mdp: MDP, next_state: NDArray, prob: NDArray) -> NDArray[np.bool_]:
    """Find the states from which the chain [S, N] comes to a terminal state with positive probability."""
    reached = mdp.terminal
    while True:
        wider = reached | (reached[next_state] & (prob > 0)).any(axis=1)
        if (wider == reached).all():
            return reached
        reached = wider


def _check_that_it_ends(mdp: MDP, next_state: NDArray, prob: NDArray, r: NDArray) -> None:
    endless = np.flatnonzero(~_reaches_end(mdp, next_state, prob) & (r != 0))
    if endless.size:
        got = f"one that never ends from state {endless[0]}"
        _check.fail("pi", "a policy that ends when gamma = 1", got, "Its value is infinite. Take gamma < 1 or mend it.")
