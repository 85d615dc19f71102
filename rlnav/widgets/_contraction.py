"""Two guesses that are backed up together, and a ruler between them: the contraction (chapter 6)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import ArrayLike, NDArray

from .. import plot
from .._check import fail, integer, items, show
from ..mdp import MDP, action_values
from ..planning import solve
from ..prediction import evaluate_policy
from ..robot import Pose
from ..task import Task
from . import _scenario
from ._poses import listed, pose_of
from ._problem import TaskExplorable

REACH = 20.0  # how high and how low a guess may be
AGREED = 1e-9  # as good as equal
MOST_BACKUPS = 300
GUESSES = ("zeros", "high", "low", "random", "answer")
BACKUPS = ("max", "mean")


class Contraction(TaskExplorable):
    """Back up two guesses together, and measure how fast they come to agree.

    Parameters
    ----------
    task : Task
    policy : int array [S] or float array [S, A], optional
        The policy of the mean backup; by default a uniformly random one.
    guesses : (str, str)
        What V and W begin with: "zeros", "high" (20 everywhere), "low" (-20), "random" (uniform in between) or "answer"
        (the fixed point itself, so that the difference is the error of the other one).
    backup : str
        "max", eq. :eq:`eq-bellman-optimality-v`, or "mean", eq. :eq:`eq-bellman-v`.
    backups : int
        How many are done when the figure opens.
    seed : int
        Of the random guesses.
    pose : Pose, optional
        The pose whose backup is shown with its numbers; by default the one at which the guesses differ most.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> pair = rl.widgets.Contraction(rl.Task(rl.GridWorld.from_ascii(">..G")), backups=1)
    >>> pair.distances.round(2)
    array([40. , 28.9])
    """

    entry = "explorables/contraction"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "guesses": ["high", "low"],
        "backup": "max",
        "backups": 0,
        "seed": 0,
        "pose": None,
    }

    def __init__(
        self,
        task: Task,
        policy: ArrayLike | None = None,
        *,
        guesses: tuple[str, str] = ("high", "low"),
        backup: str = "max",
        backups: int = 0,
        seed: int = 0,
        pose: Pose | None = None,
    ) -> None:
        state = {"guesses": guesses, "backup": backup, "backups": backups, "seed": seed, "pose": listed(pose)}
        super().__init__(task, policy, state)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario and two guesses."""
        state = super().checked(state)
        guesses = list(items("guesses", state["guesses"], "two guesses, of V and of W"))
        if len(guesses) != 2:
            fail("guesses", "two guesses, of V and of W", show(state["guesses"]))
        for guess in guesses:
            _scenario.one_of("guesses", guess, GUESSES)
        _scenario.one_of("backup", state["backup"], BACKUPS)
        if state["pose"] is not None:
            pose = pose_of(state["pose"])
            _scenario.task_of(state["scenario"], self._own).index(pose)
            state["pose"] = listed(pose)
        numbers = {name: integer(name, state[name], 0) for name in ("backups", "seed")}
        return {**state, **numbers, "guesses": guesses}

    @property
    def distances(self) -> NDArray[np.float64]:
        """The largest difference of the two tables, before the first backup and after each one."""
        return np.array([np.abs(V - W).max() for V, W in self._pairs()])

    def _pairs(self) -> list[tuple[NDArray, NDArray]]:
        """Return both tables, before the first backup and after each one up to that which is shown."""
        state, mdp = self.state, self.task.mdp()
        pi = None if state["backup"] == "max" else self._probabilities(mdp)
        V, W = (_guess(name, mdp, pi, state["seed"] + i) for i, name in enumerate(state["guesses"]))
        pairs = [(V, W)]
        while len(pairs) <= min(state["backups"], MOST_BACKUPS) and np.abs(V - W).max() > AGREED:
            V, W = (_backed_up(mdp, pi, values) for values in (V, W))
            pairs.append((V, W))
        return pairs

    def _probabilities(self, mdp: MDP) -> NDArray[np.float64]:
        return self._policy if self._policy is not None else np.full((mdp.S, mdp.A), 1 / mdp.A)

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        state = self.state
        return f"Two maps of values, {' and '.join(state['guesses'])} at first, after {state['backups']} backups."

    def still(self) -> Any:
        """Draw both tables on one scale of colors."""
        pairs, mdp = self._pairs(), self.task.mdp()
        live = np.array([pairs[0], pairs[-1]])[:, :, ~mdp.terminal]
        look = {"vmin": live.min(), "vmax": live.max(), "colorbar": False}
        figure, axes = plt.subplots(1, 2, figsize=(8.4, 4.4), layout="constrained")
        for name, V, ax in zip("VW", pairs[-1], axes, strict=True):
            plot.values(self.task, V, ax, **look)
            ax.set(title=f"${name}_{{{len(pairs) - 1}}}$", xlabel="", ylabel="")
        return figure, self._words(pairs)

    def _words(self, pairs: list[tuple[NDArray, NDArray]]) -> str:
        first, now = (np.abs(V - W).max() for V, W in (pairs[0], pairs[-1]))
        k, gamma = len(pairs) - 1, self.state["scenario"]["gamma"]
        times = "1 backup" if k == 1 else f"{k} backups"
        return f"After {times} V and W differ by {now:.4g} at most; promised were {first * gamma**k:.4g} or less."


def _guess(name: str, mdp: MDP, pi: NDArray | None, seed: int) -> NDArray[np.float64]:
    """Make a guess; ended episodes are worth 0 in each."""
    if name == "answer":
        return solve(mdp, tol=1e-10).V if pi is None else evaluate_policy(mdp, pi)
    luck = np.random.default_rng(seed).random(mdp.S)
    guess = {"zeros": 0 * luck, "high": REACH + 0 * luck, "low": 0 * luck - REACH, "random": REACH * (2 * luck - 1)}
    return np.where(mdp.terminal, 0.0, guess[name])


def _backed_up(mdp: MDP, pi: NDArray | None, V: NDArray) -> NDArray[np.float64]:
    """Apply the right side of a Bellman equation to all states."""
    Q = action_values(mdp, V)
    return Q.max(axis=1) if pi is None else (pi * Q).sum(axis=1)
