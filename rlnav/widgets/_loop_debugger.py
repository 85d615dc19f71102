"""The loop of agent and environment, one moment at a time (chapter 1)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import ArrayLike

from .. import plot
from .._check import integer, items
from ..planning import solve
from ..rollouts import Episode, rollout
from ..task import Task
from . import _scenario
from ._problem import TaskExplorable, turn_text

CHOOSERS = {"random": "chance", "optimal": "the best policy", "own": "the given policy", "you": "you"}
RULE = "#d5dbe1"  # as the lines of a grid in rl.plot
STEPS_ON_PAPER = 6  # lines of the log in the still picture


class LoopDebugger(TaskExplorable):
    """Take one step of the agent-environment loop apart: who does what, and which reward belongs to which step.

    Parameters
    ----------
    task : Task
    policy : int array [S] or float array [S, A], optional
        Who chooses at the beginning; by default chance. The reader may change it, and choose the actions herself.
    seed : int
        The episode is that of ``rollout(mdp, policy, max_steps=max_steps, rng=seed)``.
    max_steps : int
        Step limit: the episode is truncated there.

    Raises
    ------
    TypeError, ValueError
        If `policy` is not a policy of the task, or another argument is out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"))
    >>> debugger = rl.widgets.LoopDebugger(task, seed=3, max_steps=10)
    >>> debugger.state["chooser"]
    'random'
    """

    entry = "explorables/loop_debugger"
    defaults = {"scenario": _scenario.DEFAULTS, "chooser": "random", "actions": [], "position": 0}  # noqa: RUF012

    def __init__(self, task: Task, policy: ArrayLike | None = None, seed: int = 0, *, max_steps: int = 20) -> None:
        chooser = "random" if policy is None else "own"
        super().__init__(task, policy, {"chooser": chooser}, seed=seed, max_steps=max_steps)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario."""
        state = super().checked(state)
        choosers = [name for name in CHOOSERS if name != "own" or self._policy is not None]
        _scenario.one_of("chooser", state["chooser"], choosers)
        actions = [integer("actions", a, 0) for a in items("actions", state["actions"], "indices of actions")]
        return {**state, "actions": actions, "position": integer("position", state["position"], 0)}

    def episode(self) -> Episode:
        """Play the whole episode in Python; a reader who chooses herself is replaced by chance."""
        mdp, scenario = self.task.mdp(), self.state["scenario"]
        pi = np.full((mdp.S, mdp.A), 1 / mdp.A)
        if self.state["chooser"] == "optimal":
            pi = solve(mdp).pi
        elif self._policy is not None and self.state["chooser"] == "own":
            pi = self._policy
        return rollout(mdp, pi, max_steps=scenario["max_steps"], rng=scenario["seed"])

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        return f"Map with the robot's way, and the log of its first steps; {CHOOSERS[self.state['chooser']]} chose."

    def still(self) -> Any:
        """Draw the way of an episode, and its log beside it."""
        task, episode = self.task, self.episode()
        steps = min(episode.actions.size, STEPS_ON_PAPER)
        figure, (map_, log) = plt.subplots(1, 2, figsize=(8.6, 3.6), layout="constrained", width_ratios=(1, 1.25))
        plot.path(task, episode, map_)
        rows = [_line(task, episode, t) for t in range(steps)]
        log.axis("off")
        names = ["$t$", "$S_t$", "$A_t$", "$R_{t+1}$", "$S_{t+1}$"]
        table = log.table(rows, colLabels=names, loc="center", cellLoc="left", colLoc="left", edges="horizontal")
        table.auto_set_font_size(False)
        table.set_fontsize(9)
        table.scale(1, 1.5)
        for cell in table.get_celld().values():
            cell.set_edgecolor(RULE)
        end = "terminated" if episode.terminated else "truncated"
        return figure, f"{episode.actions.size} steps, {end}. The log shows the first {steps}."


def _line(task: Task, episode: Episode, t: int) -> list[str]:
    states = [_pose(task, s) for s in episode.states[t : t + 2]]
    turn = turn_text(task.robot.steering[episode.actions[t]])
    return [str(t), states[0], turn, f"{episode.rewards[t]:g}".replace("-", "−"), states[1]]


def _pose(task: Task, s: int) -> str:
    pose = task.pose(int(s))
    return "crashed" if pose is None else f"({pose.x}, {pose.y}), {pose.theta}°"
