"""Learning control: a table Q[z, a] from experience alone, without the model.

Four algorithms, one loop.  They differ in the line that names the target; `learn` runs the same loop with a rule of
your own.  An episode draws three uniform numbers to begin (start, explore?, which action) and three in each step
(explore?, which action or which of the tied best, which successor), whatever happens, so that the same seed gives the
same run in every implementation.  The next action is drawn before the update, which SARSA needs and the others do not
mind.

A step into a terminal state has gamma = 0: nothing follows.  Running out of steps is not an end: gamma stays.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from ._compile import kernel
from ._sampling import Arrays, draw_action, draw_start, expected, first_best, largest, step
from ._training import Log, Training, record, train
from .mdp import MDP

Rule = Callable[[NDArray[np.float64], int, int, float, int, int, float, float], None]


def q_learning(
    mdp: MDP,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by Q-learning, eq. :eq:`eq-q-learning`: off-policy, towards the best next action.

    Parameters
    ----------
    mdp : MDP
        The world to act in; the learner sees only s, a, r, s'.
    phi : int array [S], optional
        State design: the row z = phi[s] of the table that the learner perceives. By default every state has its own.
    episodes : int
    alpha : float or float array [episodes]
        Step size in (0, 1].
    epsilon : float or float array [episodes]
        Chance in [0, 1] of a random action.
    max_steps : int
        Episodes are cut (truncated, not terminated) after so many steps.
    rng : None, int or numpy.random.Generator
        Where chance comes from; the same seed gives the same bits.
    Q0 : float or float array [Z, A]
        Initial table.
    snapshots : int
        Number of evenly spaced copies of the table to keep for playback.

    Returns
    -------
    Training

    Raises
    ------
    TypeError, ValueError
        For an argument outside its range.

    References
    ----------
    Watkins and Dayan, Q-learning, Machine Learning 8, 1992.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">.G"))
    >>> run = rl.q_learning(task.mdp(), episodes=200, rng=0)
    >>> rl.rollout(task.mdp(), run.pi, rng=0).actions
    array([2, 2])
    """
    return train(_q_learning, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


def sarsa(
    mdp: MDP,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by SARSA, eq. :eq:`eq-sarsa`: on-policy, towards the action that is really taken next.

    Parameters, result and errors are those of `q_learning`.

    References
    ----------
    Rummery and Niranjan, On-line Q-learning using connectionist systems, Cambridge University, 1994.
    """
    return train(_sarsa, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


def expected_sarsa(
    mdp: MDP,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by Expected SARSA, eq. :eq:`eq-expected-sarsa`: towards the mean over the next actions.

    Parameters, result and errors are those of `q_learning`.

    References
    ----------
    Van Seijen et al., A theoretical and empirical analysis of Expected Sarsa, ADPRL 2009.
    """
    return train(_expected_sarsa, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


def double_q_learning(
    mdp: MDP,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by Double Q-learning, eq. :eq:`eq-double-q`: one table chooses the best next action, the other values it.

    A fourth number in each step decides which table is updated.  The result is the mean of the two.  Parameters, result
    and errors are those of `q_learning`.

    References
    ----------
    Van Hasselt, Double Q-learning, NIPS 2010.
    """
    return train(_double_q_learning, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


def learn(
    mdp: MDP,
    rule: Rule,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by a rule of your own: a plain function that updates the table after each step.

    Parameters
    ----------
    mdp : MDP
    rule : function rule(Q, s, a, r, s_next, a_next, gamma, alpha)
        Changes Q[s, a] in place and returns nothing.  `s` and `s_next` are rows of the table, `a_next` is the action
        that will be taken next, and `gamma` is 0 if the episode is over.
    phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots
        As in `q_learning`.

    Returns
    -------
    Training

    Raises
    ------
    TypeError, ValueError
        If the rule raises, returns something or writes a value that is not finite.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
    >>> def rule(Q, s, a, r, s_next, a_next, gamma, alpha):
    ...     Q[s, a] += alpha * (r + gamma * Q[s_next].max() - Q[s, a])
    >>> mine, theirs = rl.learn(mdp, rule, episodes=50, rng=0), rl.q_learning(mdp, episodes=50, rng=0)
    >>> bool((mine.Q == theirs.Q).all())
    True
    """
    _check.function("rule", rule, "rule(Q, s, a, r, s_next, a_next, gamma, alpha)")

    def loop(mdp: Arrays, phi: NDArray, Q: NDArray, alpha: NDArray, epsilon: NDArray, max_steps, rng, log: Log) -> None:
        _with_rule(rule, mdp, phi, Q, alpha, epsilon, max_steps, rng, log)

    return train(loop, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


def q_learning_rule(Q, s, a, r, s_next, a_next, gamma, alpha):
    """Update Q by eq. :eq:`eq-q-learning`."""
    Q[s, a] += alpha * (r + gamma * Q[s_next].max() - Q[s, a])


def sarsa_rule(Q, s, a, r, s_next, a_next, gamma, alpha):
    """Update Q by eq. :eq:`eq-sarsa`."""
    Q[s, a] += alpha * (r + gamma * Q[s_next, a_next] - Q[s, a])


# ---------------------------------------------------------------- the boxes: one complete loop each
@kernel
def _q_learning(mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            explore, which, luck = rng.random(), rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, a, luck)
            z, z_next = phi[s], phi[s_next]
            a_next = draw_action(Q, z_next, epsilon[e], explore, which)
            Q[z, a] += alpha[e] * (r + gamma * largest(Q, z_next) - Q[z, a])
            G, discount = G + discount * r, discount * mdp.gamma
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
        record(log, e, Q, G, t, s)


@kernel
def _sarsa(mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            explore, which, luck = rng.random(), rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, a, luck)
            z, z_next = phi[s], phi[s_next]
            a_next = draw_action(Q, z_next, epsilon[e], explore, which)
            Q[z, a] += alpha[e] * (r + gamma * Q[z_next, a_next] - Q[z, a])
            G, discount = G + discount * r, discount * mdp.gamma
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
        record(log, e, Q, G, t, s)


@kernel
def _expected_sarsa(mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            explore, which, luck = rng.random(), rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, a, luck)
            z, z_next = phi[s], phi[s_next]
            a_next = draw_action(Q, z_next, epsilon[e], explore, which)
            Q[z, a] += alpha[e] * (r + gamma * expected(Q, z_next, epsilon[e]) - Q[z, a])
            G, discount = G + discount * r, discount * mdp.gamma
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
        record(log, e, Q, G, t, s)


@kernel
def _double_q_learning(mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    A, B = Q.copy(), Q.copy()  # Q is their mean, and what the robot acts on
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            explore, which, luck, coin = rng.random(), rng.random(), rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, a, luck)
            z, z_next = phi[s], phi[s_next]
            a_next = draw_action(Q, z_next, epsilon[e], explore, which)
            if coin < 0.5:
                A[z, a] += alpha[e] * (r + gamma * B[z_next, first_best(A, z_next)] - A[z, a])
            else:
                B[z, a] += alpha[e] * (r + gamma * A[z_next, first_best(B, z_next)] - B[z, a])
            Q[z, a] = 0.5 * (A[z, a] + B[z, a])
            G, discount = G + discount * r, discount * mdp.gamma
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
        record(log, e, Q, G, t, s)


def _with_rule(rule, mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        G, discount = 0.0, 1.0
        for t in range(1, max_steps + 1):
            explore, which, luck = rng.random(), rng.random(), rng.random()
            s_next, r, gamma = step(mdp, s, a, luck)
            z, z_next = phi[s], phi[s_next]
            a_next = draw_action(Q, z_next, epsilon[e], explore, which)
            _obey(rule, Q, int(z), a, float(r), int(z_next), a_next, gamma, float(alpha[e]))
            G, discount = G + discount * r, discount * mdp.gamma
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
        record(log, e, Q, G, t, s)
    for z in np.flatnonzero(~np.isfinite(Q).all(axis=1)):
        _refuse_row(Q, int(z))


def _obey(rule: Rule, Q: NDArray, z: int, a: int, *rest: float) -> None:
    out = _check.called("rule", rule, Q, z, a, *rest)
    if out is not None:
        advice = "It changes the table in place: Q[s, a] += alpha * (target - Q[s, a])."
        _check.fail("rule", "a function that returns nothing", _check.show(out), advice, TypeError)
    if not np.isfinite(Q[z]).all():
        _refuse_row(Q, z)


def _refuse_row(Q: NDArray, z: int) -> None:
    _check.fail("rule", "a function that keeps Q finite", f"{_check.show(Q[z])} in row {z}")
