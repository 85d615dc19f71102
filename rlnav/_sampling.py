"""What chance decides in an episode, each as a function of uniform numbers in [0, 1).

These few lines are compiled into every loop that calls them.  Integer arguments of compiled loops are unsigned where
they index: machine code then need not test for negative ones, which Python would count from the end.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._compile import inline


class Arrays(NamedTuple):
    """The arrays of an MDP as compiled loops take them."""

    next_state: NDArray[np.uint32]
    prob: NDArray[np.float64]
    reward: NDArray[np.float64]
    gamma: float
    terminal: NDArray[np.bool_]
    start: NDArray[np.uint32]


def arrays(mdp: Any) -> Arrays:
    """Give the arrays of an MDP to a compiled loop, without copying the model."""
    return Arrays(
        mdp.next_state.view(np.uint32), mdp.prob, mdp.reward, mdp.gamma, mdp.terminal, mdp.start.astype(np.uint32)
    )


@inline
def draw_start(mdp, u):
    """Choose one of the start states."""
    return mdp.start[int(u * mdp.start.size)]


@inline
def step(mdp, s, a, u):
    """Take one step; return (s_next, r, gamma), where gamma is 0 if the episode is over: no value follows."""
    k, likeliest = 0, 0
    while k < mdp.prob.shape[2]:
        u -= mdp.prob[s, a, k]
        if u < 0.0:
            break
        if mdp.prob[s, a, k] > mdp.prob[s, a, likeliest]:
            likeliest = k
        k += 1
    else:
        k = likeliest  # the probabilities sum to one only within rounding, and u lay in the gap
    s_next = mdp.next_state[s, a, k]
    return s_next, mdp.reward[s, a, k], 0.0 if mdp.terminal[s_next] else mdp.gamma


@inline
def largest(Q, z):
    """max_a Q[z, a]."""
    best = Q[z, 0]
    for a in range(1, Q.shape[1]):
        best = max(best, Q[z, a])
    return best


@inline
def first_best(Q, z):
    """argmax_a Q[z, a], the first of equals."""
    best = 0
    for a in range(1, Q.shape[1]):
        if Q[z, a] > Q[z, best]:
            best = a
    return best


@inline
def draw_action(Q, z, epsilon, u, w):
    """Epsilon-greedy: `u` decides whether to explore, `w` which action or which of the tied best."""
    if u < epsilon:
        return int(w * Q.shape[1])
    best, ties, choice = largest(Q, z), 0, 0
    for a in range(Q.shape[1] - 1, -1, -1):
        tied = Q[z, a] == best
        ties += tied
        choice = a if tied else choice  # no branch on a coin flip: the processor would guess wrong half of the time
    for _ in range(int(w * ties) if ties > 1 else 0):
        choice += 1
        while Q[z, choice] != best:
            choice += 1
    return choice


@inline
def draw_from(pi, s, u):
    """Choose an action with the probabilities pi[s, a] of a policy."""
    total, choice = 0.0, 0
    for a in range(pi.shape[1]):
        total += pi[s, a]
        if pi[s, a] > 0.0:
            choice = a  # the last one with a chance, should the sum end below `u` by rounding
        if u < total:
            break
    return choice


@inline
def expected(Q, z, epsilon):
    """sum_a pi(a | z) Q[z, a] under the epsilon-greedy policy; tied best actions have equal values."""
    best, total = largest(Q, z), 0.0
    for a in range(Q.shape[1]):
        total += Q[z, a]
    return (1.0 - epsilon) * best + epsilon * total / Q.shape[1]
