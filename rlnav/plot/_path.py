"""Episodes on the map: where the robot drove, how it looked, and how it ended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke

from .. import _check
from ..robot import Pose
from ..rollouts import Episode
from ..task import Task
from ._ground import draw_robots, ground, turned
from ._look import COLORS, INK, LINES, SMALL, joined

APART = 0.09  # cells between two paths on the same way
DISC = turned(Path.unit_circle(), 0, 0, size=0.24)
BOX = joined([[(-0.23, -0.23), (0.23, -0.23), (0.23, 0.23), (-0.23, 0.23)]], closed=True)
CROSS = joined([[(-0.16, -0.16), (0.16, 0.16)], [(-0.16, 0.16), (0.16, -0.16)]])


def path(
    task: Task,
    episodes: Episode | Sequence[Episode] | Mapping[str, Episode],
    ax: Axes | None = None,
    *,
    label: str | None = None,
) -> Axes:
    """Draw the way of the robot: an arrowhead at every pose, a disc at the start, and a cross where it crashed.

    An episode that ran out of time ends with a square.  Further paths on the same axes get the next color and dashes.

    Parameters
    ----------
    task : Task
    episodes : Episode, sequence of Episode, or dict of str to Episode
        What `rollout` returns; the keys of a dict are the labels.
    ax : matplotlib.axes.Axes, optional
        Where to draw, such as over a map of values; new axes by default.
    label : str, optional
        Name of a single episode in the legend.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If there is no episode, or one that visits states which the task does not have.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
    >>> mdp = task.mdp()
    >>> ax = rl.plot.path(task, rl.rollout(mdp, rl.solve(mdp).pi, rng=0), label="optimal")
    """
    _check.instance("task", task, Task)
    named = _named(task, episodes, label)
    ax = ground(task.world, ax)
    first = len(ax.lines)  # paths are the only lines on a map
    for k, (name, episode) in enumerate(named, first):
        _draw_path(ax, task, episode, k, name, shift=APART * ((k + 1) // 2) * (-1) ** k)
    if any(name for name, _ in named):
        above = {"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0), "borderaxespad": 0.25}
        legend = ax.legend(**above, ncols=3, frameon=False, fontsize=SMALL, labelcolor=INK, handlelength=2.6)
        for line in legend.get_lines():
            line.set_path_effects([])
    return ax


def _named(task: Task, episodes: Any, label: str | None) -> list[tuple[str, Episode]]:
    """Return pairs of a label, which may be empty, and an episode of this task."""
    if not isinstance(episodes, Mapping | Sequence):
        episodes = {label or "": episodes}
    elif label is not None:
        _check.fail("label", "given with a single episode", _check.show(label), "Use a dict: its keys are the labels.")
    named = list(episodes.items()) if isinstance(episodes, Mapping) else [("", episode) for episode in episodes]
    if not named:
        _check.fail("episodes", "at least one Episode", "none")
    for _, episode in named:
        _check.instance("episodes", episode, Episode)
        if episode.states.max() > task.crashed or episode.states.min() < 0:
            got = f"an episode through state {episode.states.max()}"
            _check.fail("episodes", f"in the {task.crashed + 1} states of the task", got, "Was it another task's?")
    return named


def _draw_path(ax: Axes, task: Task, episode: Episode, k: int, name: str, shift: float) -> None:
    color = COLORS[k % len(COLORS)]
    poses = [pose for s in episode.states if (pose := task.pose(int(s))) is not None]
    way = [(pose.x + shift, pose.y + shift) for pose in poses]
    crash = [(x + shift, y + shift) for x, y in _crash_site(task, episode, poses)]
    ax.plot(
        *zip(*way, *crash, strict=True),
        color=color,
        label=name or "_path",
        linestyle=LINES[k % len(LINES)],
        linewidth=2,
        path_effects=[withStroke(linewidth=4, foreground="white")],
        scalex=False,
        scaley=False,
        zorder=5,
    )
    _draw_mark(ax, turned(DISC, *way[0]), "white", color)
    if episode.truncated:
        _draw_mark(ax, turned(BOX, *way[-1]), "white", color)
    draw_robots(ax, ((x, y, pose.theta) for pose, (x, y) in zip(poses, way, strict=True)), color, size=0.6)
    for x, y in crash:
        _draw_mark(ax, turned(CROSS, x, y), "none", "white", linewidth=5)
        _draw_mark(ax, turned(CROSS, x, y), "none", color, linewidth=2.5)


def _crash_site(task: Task, episode: Episode, poses: list[Pose]) -> list[tuple[float, float]]:
    """Return where the robot hit something: on the edge of its last cell, towards the cell that it drove at."""
    if episode.states[-1] != task.crashed or not poses:
        return []
    meant = task.robot.steering[episode.actions[-1]]
    tried = sorted(task.robot.steering, key=lambda a: abs(a - meant))  # a slip ends beside what was meant
    hit = next((t for a in tried if (t := task.transition(poses[-1], a)).crash), None)
    if hit is None:
        _check.fail("episodes", "drives in the world of the task", f"a crash at {poses[-1]}", "Was it another task's?")
    return [((hit.s.x + hit.s_next.x) / 2, (hit.s.y + hit.s_next.y) / 2)]


def _draw_mark(ax: Axes, shape: Path, face: str, edge: str, linewidth: float = 1.8) -> None:
    mark = PathPatch(shape, facecolor=face, edgecolor=edge, linewidth=linewidth, capstyle="round", zorder=5.5)
    mark.set_clip_on(False)
    ax.add_patch(mark)
