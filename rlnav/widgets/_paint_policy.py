"""Paint a policy, and find out what it is worth: by driving, and exactly (chapter 4)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import plot
from .._check import fail, integer, number, show
from ..designs import distance
from ..plot._look import COLORS, INK, plain
from ..prediction import evaluate_policy
from ..robot import Pose
from ..rollouts import returns, rollout
from ..task import Task
from . import _scenario
from ._poses import check_heading, listed, pose_of
from ._problem import TaskExplorable

FILLS = ("straight", "goal", "random")
ANY = "r"  # the sign of a state in which every turn is as likely
MOST_GAMMA = 0.99  # with more, drives in circles take too long to count
MOST_DRIVES = 2000
MAX_STEPS = 1000  # of one drive; what comes later counts less than 0.0001
Z95 = 1.96  # standard errors to each side that hold 95 % of a normal distribution


class PaintPolicy(TaskExplorable):
    """Paint a policy on the map; drives fall as dots on an axis, beside the exact value of the pose they start from.

    Parameters
    ----------
    task : Task
        The reader may change its slip and discount.
    pose : Pose
        Where the drives start.
    policy : str
        "straight", "goal" (towards it as the crow flies), "random", or one sign for each state: the number of an
        action, or "r" for any of them.
    kept : str, optional
        Another policy, in the same form, to compare with.
    drives : int
        Drives that are made first, at most 2000.
    seed : int
        Drive i is ``rollout(mdp, pi, start=s, max_steps=1000, rng=seed + i)``.
    heading : int, optional
        Show only the robot that looks this way, in degrees; by default all headings.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the robot cannot be at `pose`.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"))
    >>> paint = rl.widgets.PaintPolicy(task, rl.Pose(0, 0, 0), "straight", drives=3)
    >>> print(paint.V[0].round(3), paint.returns().round(3))
    8.83 [8.83 8.83 8.83]
    """

    entry = "explorables/paint_policy"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "policy": "",
        "kept": None,
        "pose": [0, 0, 0],
        "drives": 0,
        "heading": None,
        "brush": "start",
    }

    def __init__(
        self,
        task: Task,
        pose: Pose,
        policy: str = "goal",
        *,
        kept: str | None = None,
        drives: int = 0,
        seed: int = 0,
        heading: int | None = None,
    ) -> None:
        signs = {"policy": _filled(task, policy), "kept": None if kept is None else _filled(task, kept)}
        super().__init__(task, None, {**signs, "pose": listed(pose), "drives": drives, "heading": heading}, seed=seed)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, policies of the task, and a pose to start from."""
        state = super().checked(state)
        number("gamma", state["scenario"]["gamma"], 0, MOST_GAMMA)
        task = _scenario.task_of(state["scenario"], self._own)
        for name in ("policy", "kept"):
            if name == "policy" or state[name] is not None:
                _chances(name, state[name], task)
        pose = pose_of(state["pose"])
        if task.index(pose) >= 0 and (pose.x, pose.y) == task.world.goal:
            fail("pose", "a pose from which the robot can drive", f"{pose}, the goal")
        check_heading(state["heading"])
        brushes = ("start", *FILLS, *map(str, range(len(task.robot.steering))))
        _scenario.one_of("brush", state["brush"], brushes)
        drives = integer("drives", state["drives"], 0, MOST_DRIVES)
        return {**state, "pose": listed(pose), "drives": drives}

    @property
    def pi(self) -> NDArray[np.float64]:
        """The painted policy, as probabilities [S, A]."""
        return _chances("policy", self.state["policy"], self.task)

    @property
    def V(self) -> NDArray[np.float64]:
        """The exact values of the painted policy."""
        return evaluate_policy(self.task.mdp(), self.pi)

    def returns(self) -> NDArray[np.float64]:
        """Drive in Python: the return of every drive that is shown."""
        mdp, pi, seed = self.task.mdp(), self.pi, self.state["scenario"]["seed"]
        start = self.task.index(Pose(*self.state["pose"]))
        drives = (rollout(mdp, pi, start=start, max_steps=MAX_STEPS, rng=seed + i) for i in range(self.state["drives"]))
        return np.array([returns(drive.rewards, mdp.gamma)[0] for drive in drives])

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        x, y, theta = self.state["pose"]
        drives = self.state["drives"]
        dots = f"the returns of {drives} drives as dots and" if drives else "no drives yet, and"
        return (
            "Left, a map with the exact value of every pose and the painted turns. Right, an axis with "
            f"{dots} the exact value of the pose at ({x}, {y}) with heading {theta} degrees."
        )

    def still(self) -> Any:
        """Draw values and turns, and the dots beside the exact value."""
        task, heading, mdp = self.task, self.state["heading"], self.task.mdp()
        figure, (map_, axis) = plt.subplots(1, 2, figsize=(9.4, 4.2), layout="constrained", width_ratios=(1.15, 1))
        low, high = float(mdp.reward.min()), float(mdp.reward.max())
        plot.values(task, self.V, map_, heading=heading, vmin=low, vmax=high)
        plot.policy(task, self.pi, map_, heading=heading)
        G, v = self.returns(), self.V[task.index(Pose(*self.state["pose"]))]
        _draw_dots(axis, G, v, low, high)
        mean = f"{G.size} drives, mean {G.mean():.2f}; " if G.size else ""
        return figure, f"{mean}exact value {v:.2f}.".replace("-", "−")


def _filled(task: Task, policy: str) -> str:
    """Return a policy as one sign a state."""
    if not isinstance(policy, str):
        fail("policy", f"one of {', '.join(FILLS)}, or one sign a state", show(policy), kind=TypeError)
    if policy not in FILLS:
        return policy
    return "".join(_sign(task, pose, policy) for pose in task.poses) + ANY


def _sign(task: Task, pose: Pose, fill: str) -> str:
    """Return the sign of one pose; of turns that are equally good the smallest, and of two of them the right one."""
    if fill == "random":
        return ANY
    robot, goal = task.robot, task.world.goal

    def cost(a: int) -> tuple[float, int]:
        return (distance(robot.move(pose, a), goal) if fill == "goal" else 0.0), abs(a)

    return str(robot.steering.index(min(robot.steering, key=cost)))


def _chances(name: str, signs: Any, task: Task) -> NDArray[np.float64]:
    """Return the probabilities [S, A] of a policy that is painted."""
    S, A = task.crashed + 1, len(task.robot.steering)
    if not isinstance(signs, str) or len(signs) != S:
        fail(name, f"one sign for each of the {S} states", show(signs))
    rows = {str(a): np.eye(A)[a] for a in range(A)} | {ANY: np.full(A, 1 / A)}
    for s, sign in enumerate(signs):
        if sign not in rows:
            fail(name, f"signs from 0 to {A - 1}, or {ANY}", f"{sign!r} in state {s}")
    return np.array([rows[sign] for sign in signs])


def _draw_dots(ax: Axes, G: NDArray, v: float, low: float, high: float) -> None:
    """Heap the returns up as dots, with the exact value as a line and the interval of the mean below."""
    width = (high - low) / 40
    heights: dict[int, int] = {}
    for g in G:
        place = math.floor((g - low) / width)
        heights[place] = heights.get(place, 0) + 1
        ax.plot(low + (place + 0.5) * width, heights[place], "o", color=COLORS[0], markersize=3)
    ax.axvline(v, color=INK, linewidth=1.4)
    if G.size > 1:
        half = Z95 * G.std(ddof=1) / math.sqrt(G.size)
        ax.errorbar(G.mean(), 0, xerr=half, fmt="D", color=COLORS[1], capsize=4, markersize=5)
    plain(ax)
    ax.set(xlim=(low - width, high + width), xlabel="return of a drive", ylabel="drives", ylim=(-1, None))
