"""The fan of a robot's moves, and all poses that it can reach in a few steps (chapter 13)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import plot
from .._check import fail, integer
from ..plot._ground import draw_robot
from ..plot._look import BLUE, SEQUENTIAL
from ..robot import Pose, Robot
from ..task import Task
from . import _scenario
from ._explorable import Explorable
from ._poses import listed, pose_of

MOST_STEPS = 12


class SteeringFan(Explorable):
    """See where a robot can be next, and within a few steps: its steering set is a design.

    Parameters
    ----------
    task : Task
        The world and the robot. The reader may change the steering set and the slip, draw walls, and move the robot.
    pose : Pose, optional
        Where the robot stands; by default where the first episode of the task may begin.
    steps : int
        How many steps the map looks ahead, from 0 to 12.
    told : int, optional
        A turn of the steering set, in degrees: the figure shows what may come of it if the robot slips.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the world is larger than 30 x 30 cells.

    Examples
    --------
    >>> import rlnav as rl
    >>> fan = rl.widgets.SteeringFan(rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES)), rl.Pose(3, 1, 90), steps=2)
    >>> print((fan.reach > 0).sum(), "poses in one or two steps")
    20 poses in one or two steps
    """

    entry = "explorables/steering_fan"
    defaults = {"scenario": _scenario.DEFAULTS, "pose": [2, 2, 0], "steps": 1, "told": None}  # noqa: RUF012

    def __init__(self, task: Task, pose: Pose | None = None, *, steps: int = 1, told: int | None = None) -> None:
        scenario = {**_scenario.scenario_of(task), "starts": None}
        pose = task.world.starts[0] if pose is None else pose
        super().__init__({"scenario": scenario, "pose": listed(pose), "steps": steps, "told": told})

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, in which the robot stands on a free cell."""
        state = super().checked(state)
        scenario = {**_scenario.checked(state["scenario"]), "starts": None}
        task = _scenario.task_of(scenario)
        pose = pose_of(state["pose"])
        if task.mdp().terminal[task.index(pose)]:
            fail("pose", "away from the goal", f"{pose}")
        if state["told"] is not None and integer("told", state["told"]) not in task.robot.steering:
            fail("told", f"one of the steerings {task.robot.steering}, or None", f"{state['told']}")
        steps = integer("steps", state["steps"], 0, MOST_STEPS)
        return {**state, "scenario": scenario, "pose": listed(pose), "steps": steps}

    @property
    def task(self) -> Task:
        """The task as the reader has changed it."""
        return _scenario.task_of(self.state["scenario"])

    @property
    def reach(self) -> NDArray[np.int64]:
        """The step in which each state is reached first, up to the number of steps that is shown; -1 elsewhere."""
        task = self.task
        sure = Task(task.world, Robot(task.robot.steering)).mdp()  # a slip is another turn of the same set
        steps = np.full(sure.S, -1)
        steps[task.index(Pose(*self.state["pose"]))] = 0
        for k in range(1, self.state["steps"] + 1):
            to = np.unique(sure.next_state[(steps == k - 1) & ~sure.terminal])
            steps[to[(steps[to] < 0) & (to != task.crashed)]] = k
        return steps

    @property
    def _horizon(self) -> str:
        k = self.state["steps"]
        return f"{k} step{'' if k == 1 else 's'}"

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        x, y, theta = self.state["pose"]
        where = f"from cell ({x}, {y}), heading {theta} degrees"
        return f"Map with an arrowhead for every pose that the robot can reach {where}, within {self._horizon}."

    def still(self) -> Any:
        """Draw an arrowhead for every pose that can be reached, the brighter the later."""
        task, reach = self.task, self.reach
        ax = plot.world(task)
        for s in np.flatnonzero(reach > 0):
            pose = task.poses[s]
            angle = np.radians(pose.theta)
            at = (pose.x + 0.28 * np.cos(angle), pose.y + 0.28 * np.sin(angle))
            draw_robot(ax, *at, pose.theta, SEQUENTIAL(reach[s] / MOST_STEPS), size=0.4)
        x, y, theta = self.state["pose"]
        draw_robot(ax, x, y, theta, BLUE)
        cells = len({(task.poses[s].x, task.poses[s].y) for s in np.flatnonzero(reach >= 0)})
        return ax, f"Within {self._horizon}: {(reach >= 0).sum()} poses on {cells} cells."
