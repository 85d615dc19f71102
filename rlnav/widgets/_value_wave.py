"""Value iteration sweep by sweep: how the news of the goal travels (chapter 8)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import plot
from .._check import integer, number
from ..planning import solve, value_iteration
from ..plot._look import limits
from ..robot import Pose
from ..task import Task
from . import _scenario
from ._explorable import Explorable
from ._poses import check_heading, listed, pose_of
from ._problem import task_tables

MOST_GAMMA = 0.99  # with more, the promise of the residual says next to nothing
SHOWN = {"values": "value", "changes": "change in this sweep"}


class ValueWave(Explorable):
    """Watch value iteration, sweep by sweep and back: the news of the goal travels one move in every sweep.

    Parameters
    ----------
    task : Task
        The world, the robot and what it is paid for. The reader may change slip and discount, and draw walls.
    gamma : float, optional
        Discount in [0, 0.99]; by default that of the task.
    tol : float
        The sweeps stop when no value changes by more than this.
    sweep : int
        The sweep that is shown first.
    heading : int, optional
        Show only the robot that looks this way, in degrees; by default all headings.
    show : str
        "values", or "changes": how much each value has changed in the sweep.
    pose : Pose, optional
        The pose whose backup is shown with its numbers.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the world is larger than 30 x 30 cells.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"), rl.Robot((-90, 0, 90)))
    >>> wave = rl.widgets.ValueWave(task, sweep=2)
    >>> print(wave.V[task.index(rl.Pose(1, 0, 0))].round(3))
    9.4
    """

    entry = "explorables/value_wave"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "tol": 0.001,
        "sweep": 0,
        "heading": None,
        "show": "values",
        "pose": None,
    }

    def __init__(
        self,
        task: Task,
        gamma: float | None = None,
        *,
        tol: float = 0.001,
        sweep: int = 0,
        heading: int | None = None,
        show: str = "values",
        pose: Pose | None = None,
    ) -> None:
        task = task if gamma is None else replace(task, gamma=gamma)
        scenario = _scenario.scenario_of(task)
        self._own = _scenario.own_designs(task)
        state = {"tol": tol, "sweep": sweep, "heading": heading, "show": show, "pose": listed(pose)}
        super().__init__({"scenario": scenario, **state}, tables=task_tables(scenario, self._own, {}))

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, in which the goal can be reached."""
        state = super().checked(state)
        scenario = _scenario.checked(state["scenario"])
        number("gamma", scenario["gamma"], 0, MOST_GAMMA)
        task = self._task(scenario)
        check_heading(state["heading"])
        if state["pose"] is not None:
            pose = pose_of(state["pose"])
            task.index(pose)
            state["pose"] = listed(pose)
        _scenario.one_of("show", state["show"], SHOWN)
        tol = number("tol", state["tol"], 0, above=True)
        return {**state, "scenario": scenario, "tol": tol, "sweep": integer("sweep", state["sweep"], 0)}

    def _task(self, scenario: dict[str, Any]) -> Task:
        return _scenario.task_of({**scenario, "starts": None}, self._own)  # a planner starts nowhere

    @property
    def task(self) -> Task:
        """The task as the reader has changed it."""
        return self._task(self.state["scenario"])

    @property
    def V(self) -> NDArray[np.float64]:
        """The values of all states after the sweep that is shown."""
        return self._sweeps(self.state["sweep"])[0]

    def _sweeps(self, k: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the values after k sweeps, or after as many as there are, and the residuals on the way."""
        mdp = self.task.mdp()
        if k == 0:
            return np.zeros(mdp.S), np.zeros(0)
        found = value_iteration(mdp, tol=self.state["tol"], max_sweeps=k)
        return found.V, found.residuals

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        state = self.state
        robot = "" if state["heading"] is None else f" of the robot with heading {state['heading']} degrees"
        return f"Map of the {state['show']}{robot} in sweep {state['sweep']} of value iteration."

    def still(self) -> Any:
        """Draw the sweep that is shown, on a color scale for all sweeps."""
        state, mdp = self.state, self.task.mdp()
        V, residuals = self._sweeps(state["sweep"])
        low, high = scale_of(solve(mdp).V[~mdp.terminal])
        if state["show"] == "changes":
            V = np.abs(V - self._sweeps(max(residuals.size - 1, 0))[0])
            low, high = 0.0, float(np.abs(mdp.reward).max())
        label = SHOWN[state["show"]]
        ax = plot.values(self.task, V, heading=state["heading"], label=label, vmin=low, vmax=high)
        change = f"the largest change was {residuals[-1]:.2g}" if residuals.size else "every value is 0"
        return ax, f"Sweep {residuals.size}: {change}."


def scale_of(V: NDArray[np.float64]) -> tuple[float, float]:
    """Choose a color scale for all moments on the way to these values: it holds 0, where all begin."""
    low, high = limits(V, None, None, signed=False)
    return min(low, -0.2 * high), max(high, 0.0)
