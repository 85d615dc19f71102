"""The steering bandit: one pose, five turns, each pays with noise (chapter 9)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import NDArray

from .. import plot
from .._check import instance, integer, items, number
from ..mdp import MDP
from ..planning import solve
from ..robot import Pose, Robot
from ..rollouts import rollout
from ..task import Task
from . import _scenario
from ._poses import listed, pose_of
from ._problem import TaskExplorable, turn_text

ODDS = np.array([1, 4, 6, 4, 1]) / 16  # of the noise -2, -1, 0, 1 and 2 standard deviations
STRATEGIES = ("greedy", "epsilon", "softmax", "ucb")
RANGES = {"epsilon": (0, 1), "tau": (0.05, 10), "c": (0, 20), "Q0": (-20, 20)}
MOST_PULLS = 2000
BY_HAND = 200  # pulls


class SteeringBandit(TaskExplorable):
    """Find the best turn of one pose by trying: first by hand, then against strategies on the same luck.

    Turn a pays q_*(s, a) of the pose plus noise: the robot turns, and what the rest of the drive pays varies.

    Parameters
    ----------
    task : Task
    pose : Pose
        Where the robot stands. A new game takes it to another pose.
    noise : float
        Standard deviation of the noise.
    seed : int
        The luck of the game by hand; the robots of the comparison have the seeds 0, 1, 2 and so on.
    turns : sequence of int
        The actions that were chosen by hand so far.
    shown : bool
        Whether the truth is shown, and the strategies play.
    playing : sequence of str
        Which strategies play: "greedy", "epsilon", "softmax" and "ucb".
    pulls : int
        How often each robot of the comparison chooses.
    epsilon, tau, c, Q0 : float
        The parameters of epsilon-greedy, softmax and UCB, and the first guess of the greedy robot.
    alpha : float, optional
        Step size; by default 1 / N, the mean of all samples.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), rl.Robot(slip=0.1))
    >>> game = rl.widgets.SteeringBandit(task, rl.Pose(0, 6, 315))
    >>> game.values.round(2)
    array([3.57, 3.84, 2.49, 3.33, 4.78])
    >>> game.mdp()
    MDP(2 states, 5 actions, 5 successors, gamma=1)
    """

    entry = "explorables/steering_bandit"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "pose": None,
        "noise": 2.0,
        "turns": [],
        "shown": False,
        "playing": ["greedy", "epsilon", "ucb"],
        "pulls": 300,
        "epsilon": 0.1,
        "tau": 0.7,
        "c": 2.0,
        "Q0": 0.0,
        "alpha": None,
    }

    def __init__(
        self, task: Task, pose: Pose, *, noise: float = 2.0, seed: int = 0, turns: Any = (), **settings: Any
    ) -> None:
        place = instance("pose", pose, Pose)
        state = {"pose": [place.x, place.y, place.theta], "noise": noise, "turns": turns, **settings}
        super().__init__(task, None, state, seed=seed)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, and a pose at which there is something to choose."""
        state = super().checked(state)
        task = _scenario.task_of(state["scenario"], self._own)
        pose = pose_of(state["pose"])
        task.index(pose)
        state["pose"] = listed(pose)
        state["noise"] = number("noise", state["noise"], 0)
        A = len(task.robot.steering)
        turns = items("turns", state["turns"], f"at most {BY_HAND} actions")
        integer("turns", len(turns), 0, BY_HAND)
        state["turns"] = [integer("turns", a, 0, A - 1) for a in turns]
        state["shown"] = instance("shown", state["shown"], bool)
        playing = items("playing", state["playing"], "names of strategies")
        for name in playing:
            _scenario.one_of("playing", name, STRATEGIES)
        state["playing"] = [name for name in STRATEGIES if name in playing]
        for name, (low, high) in RANGES.items():
            state[name] = number(name, state[name], low, high)
        state["pulls"] = integer("pulls", state["pulls"], 10, MOST_PULLS)
        state["alpha"] = None if state["alpha"] is None else number("alpha", state["alpha"], 0, 1, above=True)
        return state

    @property
    def pose(self) -> Pose:
        """Where the robot stands."""
        return Pose(*self.state["pose"])

    @property
    def values(self) -> NDArray[np.float64]:
        """What each turn pays on average: q_*(s, a) of the pose."""
        return solve(self.task.mdp(), tol=1e-12).Q[self.task.index(self.pose)]

    def mdp(self) -> MDP:
        """Return the bandit as an MDP with one state, and an end behind every turn."""
        q = self.values
        pays = q[:, None] + self.state["noise"] * (np.arange(ODDS.size) - 2)
        shape = (2, q.size, ODDS.size)
        reward = np.stack([pays, np.zeros_like(pays)])
        return MDP(
            np.ones(shape, int), np.broadcast_to(ODDS, shape), reward, 1.0, np.array([False, True]), np.array([0])
        )

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        x, y, theta = self.state["pose"]
        n = len(self.task.robot.steering)
        return f"Map with the robot in cell ({x}, {y}), heading {theta} degrees, and the {n} ways that its turns lead."

    def still(self) -> Any:
        """Draw the pose and where each turn leads; what they pay is to be found out."""
        sure = replace(self.task, robot=Robot(self.task.robot.steering))
        mdp, start = sure.mdp(), sure.index(self.pose)
        ways = {
            turn_text(turn): rollout(mdp, np.full(mdp.S, a), start=start, max_steps=1, rng=0)
            for a, turn in enumerate(self.task.robot.steering)
        }
        figure, ax = plt.subplots(figsize=(5.6, 4.6), layout="constrained")
        plot.path(sure, ways, ax)
        known = f" True values: {', '.join(f'{q:.2f}' for q in self.values)}." if self.state["shown"] else ""
        noise = self.state["noise"]
        return figure, f"Each turn pays something else on average, and noise of standard deviation {noise:g}.{known}"
