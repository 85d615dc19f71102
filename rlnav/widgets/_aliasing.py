"""Is what the robot perceives enough? One observation and its futures, with and without the past (chapter 3)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import plot
from .._check import fail, integer
from ..plot._ground import arrow, draw_robot
from ..plot._look import COLORS, INK, SMALL, plain
from ..robot import Pose
from ..task import Task
from . import _scenario
from ._poses import listed, pose_of
from ._problem import TaskExplorable, turn_text

PERCEPTIONS = ("cell", "heading", "pose")
MOST_DRIVES = 5000
SAME = 1e-9  # forecasts that differ by less are equal
ROWS_ON_PAPER = 8
Forecast = dict[Any, float]


class Aliasing(TaskExplorable):
    """Hide the heading, or the cell, and ask whether it helps to know what the robot perceived before.

    The robot begins in any pose and steers at random. It perceives something, then something else, and turns.

    Parameters
    ----------
    task : Task
        The reader may change its slip.
    pose : Pose
        Where the robot really is; what it perceives of that is another matter.
    turn : int
        The steering, in degrees.
    perceive : str
        "cell", "heading" or "pose".
    drives : int
        Two-step drives that are tried first, at most 5000.
    seed : int
        Where their chance comes from.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the robot cannot be at `pose`.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
    >>> round(rl.widgets.Aliasing(task, rl.Pose(8, 7, 0)).helps, 3)
    0.414
    >>> rl.widgets.Aliasing(task, rl.Pose(8, 7, 0), perceive="pose").helps
    0.0
    """

    entry = "explorables/aliasing"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "perceive": "cell",
        "pose": [0, 0, 0],
        "turn": 0,
        "drives": 0,
        "before": None,
    }

    def __init__(
        self,
        task: Task,
        pose: Pose,
        turn: int = 0,
        *,
        perceive: str = "cell",
        drives: int = 0,
        seed: int = 0,
    ) -> None:
        state = {"perceive": perceive, "pose": listed(pose), "turn": turn, "drives": drives}
        super().__init__(task, None, state, seed=seed)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, and a pose from which the robot can drive."""
        state = super().checked(state)
        _scenario.one_of("perceive", state["perceive"], PERCEPTIONS)
        pose, task = pose_of(state["pose"]), _scenario.task_of(state["scenario"], self._own)
        if task.mdp().terminal[task.index(pose)]:
            fail("pose", "a pose from which the robot can drive", f"{pose}, the goal")
        if state["turn"] not in task.robot.steering:
            fail("turn", f"one of the steerings {task.robot.steering}", f"{state['turn']} degrees")
        if state["before"] is not None:
            integer("before", state["before"], 0)
        drives = integer("drives", state["drives"], 0, MOST_DRIVES)
        return {**state, "pose": listed(pose), "drives": drives}

    @property
    def helps(self) -> float:
        """How far the past moves the forecast: the largest change that it makes in the chance of any event."""
        all_, rows = self.forecasts()
        return float(max((_apart(row, all_) for _, row in rows.values()), default=0.0))

    def forecasts(self) -> tuple[Forecast, dict[Any, tuple[float, Forecast]]]:
        """Forecast the next observation: without a past, and for each earlier observation its chance and forecast."""
        task, mdp = self.task, self.task.mdp()
        seen = self._observations(task)
        s = task.index(Pose(*self.state["pose"]))
        a = task.robot.steering.index(self.state["turn"])
        live = np.flatnonzero(~mdp.terminal)
        weight = np.zeros((mdp.S, mdp.S))  # of a first step, from one state to another
        np.add.at(weight, (live[:, None, None], mdp.next_state[live]), mdp.prob[live] / (live.size * mdp.A))
        alike = np.array([seen[other] == seen[s] and not mdp.terminal[other] for other in range(mdp.S)])
        weight[:, ~alike] = 0
        rows: dict[Any, tuple[float, NDArray]] = {}
        for before in live[weight[live].sum(axis=1) > 0]:
            chance, now = rows.get(seen[before], (0.0, np.zeros(mdp.S)))
            rows[seen[before]] = (chance + weight[before].sum(), now + weight[before])
        whole = weight.sum(axis=0) if rows else alike.astype(float)
        ahead = {name: (chance, _ahead(mdp, a, now, seen)) for name, (chance, now) in rows.items()}
        return _ahead(mdp, a, whole, seen), ahead

    def _observations(self, task: Task) -> list[Any]:
        """Name what the robot perceives in each state."""

        def name(pose: Pose) -> str:
            if (pose.x, pose.y) == task.world.goal:
                return "goal"
            cell, heading = f"({pose.x}, {pose.y})", arrow(pose.theta)
            whole = f"{cell} {heading.split()[1]}"
            return {"cell": cell, "heading": heading, "pose": whole}[self.state["perceive"]]

        return [*map(name, task.poses), "crash"]

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        x, y, _ = self.state["pose"]
        what = {"cell": f"only the cell ({x}, {y})", "heading": "only its heading", "pose": "cell and heading"}
        return (
            f"Left, a map with the robot in cell ({x}, {y}) and where it may be after a turn of {self.state['turn']} "
            f"degrees. Right, bars: the forecast of a robot that perceives {what[self.state['perceive']]}, "
            "without and with what it perceived before."
        )

    def still(self) -> Any:
        """Draw the poses that look alike in the picked cell, and the forecasts as bars."""
        figure, (map_, bars) = plt.subplots(1, 2, figsize=(9.4, 4.4), layout="constrained", width_ratios=(1, 1.1))
        self._draw_futures(map_)
        all_, rows = self.forecasts()
        _draw_bars(bars, all_, rows)
        much = self.helps
        words = (
            "The past adds nothing here." if much <= SAME else f"The past moves a chance by up to {100 * much:.0f} %."
        )
        return figure, f"Turn {turn_text(self.state['turn'])}. {words}"

    def _draw_futures(self, ax: Axes) -> None:
        task, (x, y, theta) = self.task, self.state["pose"]
        plot.world(task.world, ax)
        for heading in range(0, 360, 45) if self.state["perceive"] == "cell" else (theta,):
            t = task.transition(Pose(x, y, heading), self.state["turn"])
            dx, dy = np.cos(np.radians(heading)), np.sin(np.radians(heading))
            draw_robot(ax, x + 0.3 * dx, y + 0.3 * dy, heading, COLORS[0], size=0.45)
            part = 0.55 if t.crash else 0.92
            end = (x + part * (t.s_next.x - x), y + part * (t.s_next.y - y))
            look = {"arrowstyle": "-[,widthB=0.3" if t.crash else "-|>", "color": INK, "linewidth": 1.2}
            ax.annotate("", end, (x + 0.4 * dx, y + 0.4 * dy), arrowprops=look)


def _ahead(mdp: Any, a: int, now: NDArray, seen: list[Any]) -> Forecast:
    """Forecast the next observation from weights of the present state."""
    found: Forecast = {}
    for s in np.flatnonzero(now):
        for s_next, p in zip(mdp.next_state[s, a], mdp.prob[s, a], strict=True):
            if p > 0:
                found[seen[s_next]] = found.get(seen[s_next], 0.0) + p * now[s] / now.sum()
    return found


def _apart(p: Forecast, q: Forecast) -> float:
    return sum(abs(p.get(o, 0.0) - q.get(o, 0.0)) for o in p.keys() | q.keys()) / 2


def _draw_bars(ax: Axes, all_: Forecast, rows: dict[Any, tuple[float, Forecast]]) -> None:
    """One bar a forecast, in parts with their names."""
    order = sorted(all_, key=lambda o: -round(all_[o], 9))
    likely = sorted(rows.items(), key=lambda item: -round(item[1][0], 9))[:ROWS_ON_PAPER]
    lines = [("not known", all_), *((f"from {name}", row) for name, (_, row) in likely)]
    for i, (_, row) in enumerate(lines):
        left = 0.0
        for k, o in enumerate(order):
            if (p := row.get(o, 0.0)) > 0:
                ax.barh(-i, p, left=left, color=COLORS[k % len(COLORS)], alpha=0.35, edgecolor="white", height=0.8)
                if p > 0.1:
                    ax.text(left + p / 2, -i, o, ha="center", va="center", fontsize=SMALL - 1.5, color=INK)
                left += p
    plain(ax)
    ax.set(xlim=(0, 1), xlabel="chance of the next observation", yticks=[-i for i in range(len(lines))])
    ax.set_yticklabels([name for name, _ in lines])
