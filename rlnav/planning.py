"""Planning: from the model p(s', r | s, a) to values and an optimal policy.

All planners end with the action values of their V and the greedy policy of that Q.  For gamma < 1 a backup is a
contraction with factor gamma in the maximum norm, so when a sweep changes no value by more than `tol`, every value is
within gamma / (1 - gamma) * tol of the fixed point.  "The last change was small" alone is a weaker statement than "the
error is small": multiply first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from ._compile import kernel
from .mdp import MDP, TIE, action_values, greedy
from .prediction import evaluate_policy

EVALUATIONS = 10  # policy sweeps of `solve` between two greedy ones, at most
ENOUGH = 0.1  # ... and they stop early once they change values by less than this share of the greedy sweep's change
MOST_SWEEPS = 200_000  # where neither the reader nor the contraction sets a lower limit


@dataclass(frozen=True, eq=False)
class Solution:
    """Hold what a planner found.

    Attributes
    ----------
    V : float array [S]
        State values.
    Q : float array [S, A]
        Action values, one look-ahead from V.
    pi : int array [S]
        The greedy policy of Q.
    residuals : float array [sweeps]
        Largest change of a value in each sweep (for policy iteration: in each improvement).
    converged : bool
        Whether the stopping rule was met, rather than the limit of sweeps reached.
    """

    V: NDArray[np.float64]
    Q: NDArray[np.float64]
    pi: NDArray[np.int64]
    residuals: NDArray[np.float64]
    converged: bool

    def __repr__(self) -> str:
        end = "converged" if self.converged else "not converged"
        n = self.residuals.size
        return f"Solution({self.V.size:,} states, {n} iteration{'s' * (n != 1)}, {end})"


def value_iteration(mdp: MDP, *, tol: float = 1e-8, max_sweeps: int | None = None) -> Solution:
    """Apply the max backup to all states at once until nothing moves, eq. :eq:`eq-value-iteration`.

    Parameters
    ----------
    mdp : MDP
    tol : float
        Stop after the first sweep that changes no value by more than this.
    max_sweeps : int, optional
        Stop after so many sweeps in any case; `converged` says which it was.

    Returns
    -------
    Solution
        With V within gamma / (1 - gamma) * tol of v*, if converged and gamma < 1.

    Raises
    ------
    ValueError
        If the values grow without bound, which only gamma = 1 allows.

    References
    ----------
    Bellman, Dynamic Programming, Princeton University Press, 1957.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.MDP([[[0, 1]], [[1, 1]]], [[[0.5, 0.5]], [[1, 0]]], [[[0, 1.0]], [[0, 0.0]]], 0.9, [False, True], 0)
    >>> float(rl.value_iteration(mdp).V[0].round(6))
    0.909091
    """
    tol, limit = _stopping_rule(mdp, tol, max_sweeps)
    V = np.zeros(mdp.S)
    residuals: list[float] = []
    while len(residuals) < limit:
        V_new = action_values(mdp, V).max(axis=1)
        residuals.append(float(np.abs(V_new - V).max()))
        V = V_new
        if residuals[-1] <= tol:
            break
    return _solution(mdp, V, action_values(mdp, V), residuals, tol, max_sweeps)


def policy_iteration(mdp: MDP, *, pi: ArrayLike | None = None) -> Solution:
    """Evaluate a policy exactly, be greedy, repeat until the policy keeps still, eq. :eq:`eq-policy-improvement`.

    An action is replaced only by a strictly better one, so that equally good policies cannot take turns for ever.

    Parameters
    ----------
    mdp : MDP
    pi : int array [S], optional
        The first policy. By default one that ends: every action leads towards a terminal state, where there is one.

    Returns
    -------
    Solution
        Its residuals are the largest improvement that each step still promised.

    Raises
    ------
    ValueError
        At gamma = 1, if a policy on the way never ends.

    References
    ----------
    Howard, Dynamic Programming and Markov Processes, MIT Press, 1960.
    """
    _check.instance("mdp", mdp, MDP)
    policy = _towards_the_end(mdp) if pi is None else _check.plain("pi", pi, "one action a state")
    if policy.ndim != 1:
        _check.fail("pi", "one action a state", f"shape {policy.shape}")
    s = np.arange(mdp.S)
    rest, stay = _at_rest(mdp)
    residuals: list[float] = []
    while True:
        V = evaluate_policy(mdp, policy)
        Q = action_values(mdp, V)
        Q[rest, stay] = np.maximum(Q[rest, stay], 0.0)  # nothing for ever is worth 0, whatever V says so far
        gain = Q.max(axis=1) - Q[s, policy]
        residuals.append(float(gain.max()))
        better = gain > TIE * max(1.0, float(np.abs(V).max()))
        if not better.any():
            return Solution(V, Q, policy, np.array(residuals), True)
        policy = np.where(better, Q.argmax(axis=1), policy)


def solve(mdp: MDP, *, tol: float = 1e-8, max_sweeps: int | None = None) -> Solution:
    """Find v* and pi* by the fastest general method here: modified policy iteration with Gauss-Seidel sweeps.

    A greedy sweep (eq. :eq:`eq-value-iteration`, but each new value is used at once) is followed by a few sweeps of the
    policy that it found, which cost a fraction of it.  The direction alternates, because values travel backwards from
    the goal and nobody knows from which side of the table.

    Parameters
    ----------
    mdp : MDP
    tol : float
        Stop after the first greedy sweep that changes no value by more than this.
    max_sweeps : int, optional
        Stop after so many greedy sweeps in any case; `converged` says which it was.

    Returns
    -------
    Solution
        With V within gamma / (1 - gamma) * tol of v*, if converged and gamma < 1.  `residuals` belong to greedy sweeps.

    Raises
    ------
    ValueError
        If the values grow without bound, which only gamma = 1 allows.

    References
    ----------
    Puterman, Markov Decision Processes, Wiley, 1994, section 6.5 (modified policy iteration).
    """
    tol, limit = _stopping_rule(mdp, tol, max_sweeps)
    model = mdp.next_state.view(np.uint32), mdp.prob, np.einsum("sak,sak->sa", mdp.prob, mdp.reward), mdp.gamma
    chosen = np.zeros((mdp.S, mdp.K), np.uint32), np.zeros((mdp.S, mdp.K)), np.zeros(mdp.S)
    actions, successors = (0,) * mdp.A, (0,) * mdp.K
    V = np.zeros(mdp.S)
    residuals: list[float] = []
    forward = False
    while len(residuals) < limit:
        residuals.append(_greedy_sweep(*model, *chosen, V, forward, actions, successors))
        forward = not forward
        if residuals[-1] <= tol:
            break
        for _ in range(EVALUATIONS):
            change = _policy_sweep(*chosen, mdp.gamma, V, forward, successors)
            forward = not forward
            if change <= ENOUGH * residuals[-1]:
                break
    Q = _look_ahead(*model, V)
    return _solution(mdp, V, Q, residuals, tol, max_sweeps)


# A and K reach the kernels as the lengths of two tuples: a length is part of the tuple's type, so the compiler knows it
# and unrolls the loops.  The chosen actions' rows are copied together, so that a policy sweep reads little memory.


@kernel
def _greedy_sweep(next_state, prob, r, gamma, chosen_next, chosen_prob, chosen_r, V, forward, actions, successors):
    S = V.size
    change = 0.0
    for i in range(S):
        s = i if forward else S - 1 - i
        best, choice = -np.inf, 0
        for a in range(len(actions)):
            v = 0.0
            for k in range(len(successors)):
                v += prob[s, a, k] * V[next_state[s, a, k]]
            q = r[s, a] + gamma * v
            if q > best:
                best, choice = q, a
        for k in range(len(successors)):
            chosen_next[s, k], chosen_prob[s, k] = next_state[s, choice, k], prob[s, choice, k]
        chosen_r[s] = r[s, choice]
        change = max(change, abs(best - V[s]))
        V[s] = best
    return change


@kernel
def _policy_sweep(chosen_next, chosen_prob, chosen_r, gamma, V, forward, successors):
    S = V.size
    change = 0.0
    for i in range(S):
        s = i if forward else S - 1 - i
        v = 0.0
        for k in range(len(successors)):
            v += chosen_prob[s, k] * V[chosen_next[s, k]]
        q = chosen_r[s] + gamma * v
        change = max(change, abs(q - V[s]))
        V[s] = q
    return change


@kernel
def _look_ahead(next_state, prob, r, gamma, V):
    """Turn r(s, a) into Q(s, a) in place: the model is large, and a second array beside it would be too."""
    S, A, K = prob.shape
    for s in range(S):
        for a in range(A):
            v = 0.0
            for k in range(K):
                v += prob[s, a, k] * V[next_state[s, a, k]]
            r[s, a] += gamma * v
    return r


def _stopping_rule(mdp: MDP, tol: float, max_sweeps: int | None) -> tuple[float, int]:
    """Check both; without a limit, take one that the contraction guarantees to be enough."""
    _check.instance("mdp", mdp, MDP)
    tol = _check.number("tol", tol, 0, above=True)
    if max_sweeps is not None:
        return tol, _check.integer("max_sweeps", max_sweeps, 1)
    largest = max(float(mdp.reward.max()), -float(mdp.reward.min()), tol)
    if mdp.gamma == 1:
        return tol, 10_000 + 10 * mdp.S
    if mdp.gamma == 0:
        return tol, 2
    return tol, min(MOST_SWEEPS, 2 + max(0, math.ceil(math.log(tol / largest) / math.log(mdp.gamma))))


def _solution(mdp: MDP, V: NDArray, Q: NDArray, residuals: list[float], tol: float, max_sweeps: int | None) -> Solution:
    converged = residuals[-1] <= tol
    if mdp.gamma == 1 and max_sweeps is None and not converged:
        got = f"values that still move by {residuals[-1]:.3g} after {len(residuals)} sweeps"
        advice = "Some policy collects reward without end, or none ends. Take gamma < 1, or mend rewards or ends."
        _check.fail("mdp", "a problem whose optimal values are finite at gamma = 1", got, advice)
    if max_sweeps is None and not converged and len(residuals) == MOST_SWEEPS:
        got = f"values that still move by {residuals[-1]:.3g}, at gamma = {mdp.gamma!r}"
        advice = "Take a smaller gamma, a larger tol or `policy_iteration`."
        _check.fail("mdp", f"a problem that {MOST_SWEEPS:,} sweeps can solve", got, advice)
    return Solution(V, Q, greedy(Q), np.array(residuals), converged)


def _at_rest(mdp: MDP) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """At gamma = 1: states that need never be left, except for each other, nor paid for; and an action that does so."""
    possible = mdp.prob > 0
    unpaid = (~possible | (mdp.reward == 0)).all(axis=2)
    rest = np.full(mdp.S, mdp.gamma == 1)
    while True:
        stays = unpaid & (~possible | rest[mdp.next_state]).all(axis=2)
        if (stays.any(axis=1) == rest).all():
            return np.flatnonzero(rest), stays.argmax(axis=1)[rest]
        rest = stays.any(axis=1)


def _towards_the_end(mdp: MDP) -> NDArray[np.int64]:
    """Return a policy whose every action has a successor nearer to a terminal state, where there is a way."""
    pi = np.zeros(mdp.S, np.int64)
    reached = mdp.terminal
    while True:
        leads = np.any(reached[mdp.next_state] & (mdp.prob > 0), axis=2)
        new = ~reached & leads.any(axis=1)
        if not new.any():
            return pi
        pi[new] = leads[new].argmax(axis=1)
        reached = reached | new
