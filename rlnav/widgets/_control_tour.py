"""A tour of the controls that the figures of the book have (the chapter "How to use this book")."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import plot
from .._check import fail, instance, integer, items, show
from ..robot import Pose
from ..rollouts import Episode
from ..task import Task
from ..world import GridWorld
from . import _scenario
from ._explorable import Explorable
from ._poses import listed, pose_of
from ._problem import turn_text

KINDS = ("step", "back", "play", "slider", "number", "menu", "box", "map", "again", "lecture")
MOST_STEPS = 16
MAP = """
.......
.....G.
.##....
.......
....#..
.......
.......
"""


class ControlTour(Explorable):
    """Try every kind of control once, on a robot that always turns in the same way; each is ticked off.

    Parameters
    ----------
    pose : Pose
        Where the robot begins.
    turn : int
        How far it turns in every step, in degrees.
    steps : int
        How many steps are shown first.
    trail : bool
        Whether the robot leaves a trail.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> tour = rl.widgets.ControlTour(rl.Pose(3, 5, 0), turn=0, steps=2)
    >>> tour.poses[-1]
    Pose(x=5, y=5, theta=0)
    """

    entry = "explorables/control_tour"
    defaults = {"pose": [1, 1, 90], "turn": -45, "steps": 2, "trail": True, "tried": []}  # noqa: RUF012

    def __init__(
        self,
        pose: Pose = Pose(1, 1, 90),  # noqa: B008 - it is frozen
        turn: int = -45,
        *,
        steps: int = 2,
        trail: bool = True,
    ) -> None:
        instance("pose", pose, Pose)
        super().__init__({"pose": listed(pose), "turn": turn, "steps": steps, "trail": trail})

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state, with a pose on which a drive can begin."""
        state = super().checked(state)
        pose, task = pose_of(state["pose"]), round_task()
        task.index(pose)
        if (pose.x, pose.y) == task.world.goal:
            fail("pose", "on a free cell away from the star", str(pose))
        state["pose"] = listed(pose)
        state["turn"] = integer("turn", state["turn"])
        if state["turn"] not in task.robot.steering:
            fail("turn", f"one of {', '.join(map(str, task.robot.steering))}", show(state["turn"]))
        state["steps"] = integer("steps", state["steps"], 0, MOST_STEPS)
        instance("trail", state["trail"], bool)
        state["tried"] = list(items("tried", state["tried"], "kinds of controls"))
        for kind in state["tried"]:
            _scenario.one_of("tried", kind, KINDS)
        return state

    @property
    def poses(self) -> list[Pose]:
        """The poses of the drive up to the step that is shown; a robot that crashes has none after that."""
        episode = self._drive()
        return [pose for pose in map(round_task().pose, map(int, episode.states)) if pose is not None]

    def _drive(self) -> Episode:
        """Drive with one and the same turn; rlnav/js/scenario/round.js does the same."""
        task, turn = round_task(), self.state["turn"]
        a = task.robot.steering.index(turn)
        mdp = task.mdp()
        states = [task.index(Pose(*self.state["pose"]))]
        while len(states) <= self.state["steps"] and not mdp.terminal[states[-1]]:
            states.append(int(mdp.next_state[states[-1], a, 0]))
        n = len(states) - 1
        return Episode(np.array(states), np.full(n, a), np.zeros(n), bool(mdp.terminal[states[-1]]))

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        return f"A small map with a star and a robot that turns by {self.state['turn']} degrees in every step."

    def still(self) -> Any:
        """Draw the drive so far."""
        episode = self._drive()
        steps = f"{episode.actions.size} step{'s' * (episode.actions.size != 1)}"
        return plot.path(round_task(), episode), f"{steps}, turning by {turn_text(self.state['turn'])} in each."


def round_task() -> Task:
    """Return the robot in its small world."""
    return Task(GridWorld.from_ascii(MAP))
