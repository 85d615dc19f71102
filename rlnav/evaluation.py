"""How good is a policy? Exact answers, without sampling: no seeds, no error bars."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check
from .mdp import MDP, under_policy
from .planning import solve
from .prediction import evaluate_policy


@dataclass(frozen=True)
class Evaluation:
    """Hold the scores of a policy, as expectations over its start states and over chance.

    Attributes
    ----------
    success, crash, timeout : float
        Probabilities that an episode ends in a goal state, in another terminal state, or not within the step limit.
    steps : float
        Mean length of an episode, cut at the limit.
    value : float
        Mean value v_pi of the start states, without a limit.
    optimal : float
        The same for an optimal policy.
    """

    success: float
    crash: float
    timeout: float
    steps: float
    value: float
    optimal: float

    @property
    def gap(self) -> float:
        """How much value the policy leaves on the table."""
        return self.optimal - self.value

    def __str__(self) -> str:
        ends = f"success {self.success:.3f}, crash {self.crash:.3f}, time-out {self.timeout:.3f}"
        return f"{ends}, {self.steps:.2f} steps, value {self.value:.3f} of {self.optimal:.3f}"


def evaluate(mdp: MDP, pi: ArrayLike, *, max_steps: int = 200) -> Evaluation:
    """Score a policy exactly, by following the distribution over states from step to step.

    Parameters
    ----------
    mdp : MDP
    pi : int array [S] or float array [S, A]
        An action for each state, or a distribution over actions (`epsilon_greedy` makes one).
    max_steps : int
        Step limit of an episode.

    Returns
    -------
    Evaluation

    Raises
    ------
    TypeError, ValueError
        If `pi` is not a policy of `mdp`, or has no finite value at gamma = 1.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(">.G"), rl.Robot(steering=(-90, 0, 90), slip=0.2)).mdp()
    >>> print(rl.evaluate(mdp, rl.solve(mdp).pi))
    success 0.640, crash 0.360, time-out 0.000, 1.80 steps, value 2.480 of 2.480
    """
    _check.instance("mdp", mdp, MDP)
    max_steps = _check.integer("max_steps", max_steps, 1, _check.MOST_STEPS)
    value, optimal = evaluate_policy(mdp, pi), solve(mdp, tol=1e-10).V
    where, steps = _follow(mdp, *under_policy(mdp, pi)[:2], max_steps)
    return Evaluation(
        success=float(where[mdp.goal].sum()),
        crash=float(where[mdp.terminal & ~mdp.goal].sum()),
        timeout=float(where[~mdp.terminal].sum()),
        steps=steps,
        value=float(value[mdp.start].mean()),
        optimal=float(optimal[mdp.start].mean()),
    )


def _follow(mdp: MDP, next_state: NDArray, prob: NDArray, max_steps: int) -> tuple[NDArray, float]:
    """Return the distribution over states after `max_steps`, and the mean number of steps that were taken."""
    where: NDArray = np.bincount(mdp.start, minlength=mdp.S) / mdp.start.size
    going, steps = ~mdp.terminal, 0.0
    for _ in range(max_steps):
        under_way = float(where[going].sum())
        if under_way == 0:
            break
        steps += under_way
        where = np.bincount(next_state.ravel(), (where[:, None] * prob).ravel(), mdp.S)
    return where, steps
