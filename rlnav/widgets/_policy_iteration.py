"""Policy iteration by hand: sweeps of evaluation and improvements, in any order (chapter 7)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import ArrayLike, NDArray

from .. import plot
from .._check import fail, items, number, show
from ..mdp import TIE, action_values, greedy
from ..planning import solve
from ..prediction import evaluate_policy
from ..task import Task
from . import _scenario
from ._poses import check_heading
from ._problem import TaskExplorable
from ._value_wave import MOST_GAMMA

MOST_STEPS = 2000
SWEEP, IMPROVE = "s", "i"
AMOUNTS = (1, 3, 10, 30, None)  # sweeps between two improvements of a run; None: until the values settle
SHOWN = ("values", "errors", "changed")


class PolicyIteration(TaskExplorable):
    """Take policy iteration apart: sweep once, improve, run to the end, and go back.

    Parameters
    ----------
    task : Task
        The world, the robot and what it is paid for. The reader may change slip and discount.
    policy : int array [S], optional
        The first policy; by default the robot always drives as straight on as it can.
    moves : str
        The steps that have been taken: a letter "s" for each sweep, "i" for each improvement.
    sweeps : int, optional
        Sweeps between two improvements of a run: 1, 3, 10, 30, or None for as many as the values need to settle.
    tol : float
        Values have settled when a sweep changes none by more than this.
    heading : int, optional
        Show only the robot that looks this way, in degrees; by default all headings.
    show : str
        "values", "errors" (how far values are from those of the policy), or "changed": only the poses that the last
        improvement has changed.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or `policy` is not one action a state.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"), rl.Robot((-90, 0, 90)))
    >>> by_hand = rl.widgets.PolicyIteration(task, moves="ss")
    >>> print(by_hand.V[task.index(rl.Pose(1, 0, 0))].round(3))
    9.4
    """

    entry = "explorables/policy_iteration"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "tol": 0.001,
        "moves": "",
        "sweeps": 3,
        "heading": None,
        "show": "values",
        "tried": [],
    }

    def __init__(
        self,
        task: Task,
        policy: ArrayLike | None = None,
        *,
        moves: str = "",
        sweeps: int | None = 3,
        tol: float = 0.001,
        heading: int | None = None,
        show: str = "values",
    ) -> None:
        if policy is not None and np.ndim(policy) != 1:
            fail("policy", "one action a state", f"shape {np.shape(policy)}")
        state = {"moves": moves, "sweeps": sweeps, "tol": tol, "heading": heading, "show": show}
        super().__init__(task, policy, state)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario."""
        state = super().checked(state)
        number("gamma", state["scenario"]["gamma"], 0, MOST_GAMMA)
        moves = state["moves"]
        if not isinstance(moves, str) or set(moves) - {SWEEP, IMPROVE} or len(moves) > MOST_STEPS:
            fail("moves", f"at most {MOST_STEPS} letters 's' (sweep) and 'i' (improve)", show(moves))
        _scenario.one_of("show", state["show"], SHOWN)
        check_heading(state["heading"])
        for name, amounts in (("sweeps", [state["sweeps"]]), ("tried", items("tried", state["tried"], "numbers"))):
            if any(isinstance(n, bool) or n not in AMOUNTS for n in amounts):
                fail(name, "1, 3, 10, 30 or None", show(state[name]))
        return {**state, "tol": number("tol", state["tol"], 0, above=True), "tried": list(state["tried"])}

    @property
    def V(self) -> NDArray[np.float64]:
        """The values of all states after the steps that are shown."""
        return self._after()[0]

    @property
    def pi(self) -> NDArray[np.int64]:
        """The policy after the steps that are shown."""
        return self._after()[1]

    def _after(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Take the steps: values and policy."""
        mdp, s = self.task.mdp(), np.arange(self.task.crashed + 1)
        V, pi = np.zeros(mdp.S), self._first()
        for move in self.state["moves"]:
            Q = action_values(mdp, V)
            if move == SWEEP:
                V = Q[s, pi]
            else:
                better = Q.max(axis=1) - Q[s, pi] > TIE * max(1.0, float(np.abs(V).max()))
                pi = np.where(better, greedy(Q), pi)
        return V, pi

    def _first(self) -> NDArray[np.int64]:
        if self._policy is not None:
            return np.asarray(self._policy.argmax(axis=1))
        straightest = int(np.abs(self.task.robot.steering).argmin())
        return np.full(self.task.crashed + 1, straightest)

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        sweeps, improvements = (self.state["moves"].count(letter) for letter in (SWEEP, IMPROVE))
        done = f"{sweeps} sweeps of evaluation and {improvements} improvements"
        return f"Map with the value of every pose, and the turn that the policy takes there, after {done}."

    def still(self) -> Any:
        """Draw values and policy side by side."""
        mdp, heading = self.task.mdp(), self.state["heading"]
        V, pi = self._after()
        exact, star = evaluate_policy(mdp, pi), solve(mdp).V
        figure, axes = plt.subplots(1, 2, figsize=(8.6, 4.0), layout="constrained", width_ratios=(1.15, 1))
        plot.values(self.task, V, axes[0], heading=heading, vmin=min(mdp.reward.min(), 0), vmax=star.max())
        plot.policy(self.task, pi, axes[1], heading=heading)
        off = f"Values are off by up to {np.abs(V - exact).max():.2g} from those of the policy"
        return figure, f"{off}; the policy falls short of the best by up to {(star - exact).max():.2g}."
