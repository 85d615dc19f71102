"""A finite Markov decision process as arrays, and the look-ahead on which everything rests.

For each state s and action a there are K successors k, each with a next state, a probability and a reward:

    Q[s, a] = sum_k prob[s, a, k] * (reward[s, a, k] + gamma * V[next_state[s, a, k]])
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check

TIE = 1e-9  # actions whose values differ by less are equally good when a policy is read off
SUM = 1e-9  # how far the probabilities of one (s, a) may be from summing to one


@dataclass(frozen=True, eq=False, repr=False)
class MDP:
    """Hold the model p(s', r | s, a) of eq. :eq:`eq-dynamics` as successor arrays, checked once and read-only.

    Terminal states are self-loops without reward, so no algorithm needs to ask whether an episode is over.
    An array that is already read-only (and of the right type) is shared; a writable one is copied.

    Parameters
    ----------
    next_state : int array [S, A, K]
        Successor states s'.
    prob : float array [S, A, K]
        Their probabilities; each row prob[s, a] sums to one.
    reward : float array [S, A, K]
        The reward that comes with each successor.
    gamma : float
        Discount factor in [0, 1].
    terminal : bool array [S]
        States in which the episode is over.
    start : int or int array [N]
        States in which an episode may start, all equally likely; none is terminal.
    goal : bool array [S], optional
        Terminal states that count as a success. By default all of them do.

    Raises
    ------
    TypeError, ValueError
        With the name of the argument and the first offending state and action.

    Examples
    --------
    A coin flip between staying and leaving, with one unit of reward for leaving:

    >>> import rlnav as rl
    >>> mdp = rl.MDP(next_state=[[[0, 1]], [[1, 1]]], prob=[[[0.5, 0.5]], [[1, 0]]], reward=[[[0, 1.0]], [[0, 0.0]]],
    ...              gamma=0.9, terminal=[False, True], start=0)
    >>> mdp
    MDP(2 states, 1 action, 2 successors, gamma=0.9)
    """

    next_state: NDArray[np.int32]
    prob: NDArray[np.float64]
    reward: NDArray[np.float64]
    gamma: float
    terminal: NDArray[np.bool_]
    start: NDArray[np.int64]
    goal: Any = None

    def __post_init__(self) -> None:
        prob = _check.array("prob", self.prob, "real", (None, None, None), "probabilities [S, A, K]")
        S = prob.shape[0]
        if 0 in prob.shape:
            _check.fail("prob", "of at least one state, action and successor", f"shape {prob.shape}")
        fields = {
            "next_state": (_check.array("next_state", self.next_state, "integer", prob.shape, "states"), np.int32),
            "prob": (prob, np.float64),
            "reward": (_check.array("reward", self.reward, "real", prob.shape, "rewards"), np.float64),
            "terminal": (_check.array("terminal", self.terminal, "bool", (S,), "one flag a state"), np.bool_),
            "start": (_check.states("start", self.start), np.int64),
        }
        goal = fields["terminal"][0] if self.goal is None else self.goal
        fields["goal"] = (_check.array("goal", goal, "bool", (S,), "one flag a state"), np.bool_)
        _check_states(fields["next_state"][0], S)
        _check_distributions(prob)
        _check_ends(*(fields[name][0] for name in ("next_state", "prob", "reward", "terminal")))
        _check_start(fields["start"][0], fields["terminal"][0])
        _check_goal(fields["goal"][0], fields["terminal"][0])
        object.__setattr__(self, "gamma", _check.number("gamma", self.gamma, 0, 1))
        for name, (value, dtype) in fields.items():
            object.__setattr__(self, name, _frozen(value, dtype))

    @property
    def S(self) -> int:
        """Number of states."""
        return self.prob.shape[0]

    @property
    def A(self) -> int:
        """Number of actions."""
        return self.prob.shape[1]

    @property
    def K(self) -> int:
        """Largest number of successors that a state and action have."""
        return self.prob.shape[2]

    def __repr__(self) -> str:
        counted = zip(self.prob.shape, ("state", "action", "successor"), strict=True)
        counts = (f"{n:,} {word}{'s' * (n != 1)}" for n, word in counted)
        return f"MDP({', '.join(counts)}, gamma={self.gamma:g})"


def action_values(mdp: MDP, V: ArrayLike) -> NDArray[np.float64]:
    """Look one step ahead from every state and action, eq. :eq:`eq-q-from-v`.

    Parameters
    ----------
    mdp : MDP
    V : float array [S]
        Values of the successor states.

    Returns
    -------
    Q : float array [S, A]
        Q[s, a] = sum over s' of p(s' | s, a) (r + gamma V[s']).

    Raises
    ------
    TypeError, ValueError
        If V is not one finite number a state.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.MDP([[[0, 1]], [[1, 1]]], [[[0.5, 0.5]], [[1, 0]]], [[[0, 1.0]], [[0, 0.0]]], 0.9, [False, True], 0)
    >>> rl.action_values(mdp, [10, 0])
    array([[5.],
           [0.]])
    """
    _check.instance("mdp", mdp, MDP)
    V = _check.array("V", V, "real", (mdp.S,), "one value a state")
    return (mdp.prob * (mdp.reward + mdp.gamma * V[mdp.next_state])).sum(axis=2)


def greedy(Q: ArrayLike) -> NDArray[np.int64]:
    """Choose the best action of every row, eq. :eq:`eq-greedy`; of equally good ones (within 1e-9) the first.

    Parameters
    ----------
    Q : float array [Z, A]

    Returns
    -------
    pi : int array [Z]

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.greedy([[1.0, 3.0, 2.0], [5.0, 5.0, 0.0]])
    array([1, 0])
    """
    Q = _check.array("Q", Q, "real", (None, None), "a table [Z, A]")
    if Q.shape[1] == 0:
        _check.fail("Q", "a table with at least one action", f"shape {Q.shape}")
    best = np.take_along_axis(Q, Q.argmax(axis=1)[:, None], axis=1)  # in short rows argmax is faster than max
    return np.greater_equal(Q, best - TIE).argmax(axis=1)


def epsilon_greedy(Q: ArrayLike, epsilon: float) -> NDArray[np.float64]:
    """Give the probabilities pi(a | z) of the epsilon-greedy policy of a table, eq. :eq:`eq-epsilon-greedy`.

    Of equally good actions the first has the greedy share, as in `greedy`; learners share it by chance.

    Parameters
    ----------
    Q : float array [Z, A]
    epsilon : float
        Chance in [0, 1] of a uniformly random action.

    Returns
    -------
    pi : float array [Z, A]
        Rows sum to one.

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.epsilon_greedy([[1.0, 3.0]], 0.5)
    array([[0.25, 0.75]])
    """
    best = greedy(Q)
    epsilon = _check.number("epsilon", epsilon, 0, 1)
    A = np.shape(Q)[1]
    pi = np.full((best.size, A), epsilon / A)
    pi[np.arange(best.size), best] += 1 - epsilon
    return pi


def check_policy(mdp: MDP, pi: ArrayLike) -> NDArray:
    """Return `pi` as int array [S] or float array [S, A], or say what is wrong with it."""
    pi = _check.plain("pi", pi, "one action a state, or probabilities")
    if pi.ndim == 2:
        pi = _check.array("pi", pi, "real", (mdp.S, mdp.A), "probabilities").astype(np.float64, copy=False)
        bad = np.flatnonzero((pi < 0).any(axis=1) | (np.abs(pi.sum(axis=1) - 1) > SUM))
        if bad.size:
            row = ", ".join(f"{x:g}" for x in pi[bad[0]])
            _check.fail("pi", "a distribution over actions in every state", f"[{row}] in state {bad[0]}")
        return pi
    advice = "" if pi.ndim != 1 or pi.size == mdp.S else "A policy over designed states is lifted by `pi[phi]`."
    if advice:
        _check.fail("pi", f"one action for each of the {mdp.S} states", f"{pi.size} actions", advice)
    pi = _check.array("pi", pi, "integer", (mdp.S,), "one action a state").astype(np.int64, copy=False)
    bad = np.flatnonzero((pi < 0) | (pi >= mdp.A))
    if bad.size:
        _check.fail("pi", f"actions from 0 to {mdp.A - 1}", f"{pi[bad[0]]} in state {bad[0]}")
    return pi


def under_policy(mdp: MDP, pi: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
    """Reduce the MDP to the Markov chain of a policy: successors [S, N], probabilities [S, N], rewards [S]."""
    pi = check_policy(mdp, pi)
    if pi.ndim == 1:
        s = np.arange(mdp.S)
        next_state, prob = mdp.next_state[s, pi], mdp.prob[s, pi]
        return next_state, prob, (prob * mdp.reward[s, pi]).sum(axis=1)
    prob = pi[:, :, None] * mdp.prob
    r = (prob * mdp.reward).sum(axis=(1, 2))
    return mdp.next_state.reshape(mdp.S, -1), prob.reshape(mdp.S, -1), r


def _check_states(next_state: NDArray, S: int) -> None:
    if next_state.min() < 0 or next_state.max() >= S:
        s, a, k = np.argwhere((next_state < 0) | (next_state >= S))[0]
        _check.fail("next_state", f"states from 0 to {S - 1}", f"{next_state[s, a, k]} at s={s}, a={a}, k={k}")


def _check_distributions(prob: NDArray) -> None:
    if prob.min() < 0:
        s, a, k = np.argwhere(prob < 0)[0]
        _check.fail("prob", "probabilities of at least 0", f"{prob[s, a, k]:g} at s={s}, a={a}, k={k}")
    total = prob.sum(axis=2)
    total -= 1
    bad = np.abs(total, out=total) > SUM
    if bad.any():
        s, a = np.argwhere(bad)[0]
        _check.fail("prob", "probabilities that sum to 1", f"the sum {prob[s, a].sum():.12g} at s={s}, a={a}")


def _check_ends(next_state: NDArray, prob: NDArray, reward: NDArray, terminal: NDArray) -> None:
    ends = np.flatnonzero(terminal)
    leaves = (next_state[ends] != ends[:, None, None]) & (prob[ends] > 0)
    if leaves.any():
        i, a, k = np.argwhere(leaves)[0]
        got = f"a way out to state {next_state[ends[i], a, k]} at s={ends[i]}, a={a}, k={k}"
        _check.fail("terminal", "states that lead only to themselves", got, "Let next_state[s] = s there.")
    paid = reward[ends] != 0
    if paid.any():
        i, a, k = np.argwhere(paid)[0]
        got = f"reward {reward[ends[i], a, k]:g} at s={ends[i]}, a={a}, k={k}"
        _check.fail("terminal", "states without reward", got, "Pay on the step that enters the terminal state.")


def _check_start(start: NDArray, terminal: NDArray) -> None:
    S = terminal.size
    if start.size == 0:
        _check.fail("start", "at least one state", "none")
    bad = start[(start < 0) | (start >= S)]
    if bad.size:
        _check.fail("start", f"states from 0 to {S - 1}", str(bad[0]))
    if terminal[start].any():
        _check.fail(
            "start", "states in which the episode is not over", f"the terminal state {start[terminal[start]][0]}"
        )


def _check_goal(goal: NDArray, terminal: NDArray) -> None:
    bad = np.flatnonzero(goal & ~terminal)
    if bad.size:
        _check.fail("goal", "flags of terminal states only", f"state {bad[0]}, which is not terminal")


def _frozen(value: NDArray, dtype: type) -> NDArray:
    """Return a read-only contiguous array: `value` itself if nobody can write into it, else a copy."""
    frozen: NDArray = np.ascontiguousarray(value, dtype=dtype)
    if frozen.flags.writeable:
        frozen = frozen.copy() if frozen is value else frozen
        frozen.flags.writeable = False
    return frozen
