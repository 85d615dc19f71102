"""The map on which values, policies and paths are drawn."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from matplotlib.ticker import MultipleLocator
from matplotlib.transforms import Affine2D, ScaledTranslation

from .. import _check
from ..robot import HEADINGS
from ..task import Task
from ..world import GridWorld
from ._look import BLUE, FLOOR, INK, RULE, STAR, WALL, joined, plain

GROUND = "_ground"  # label of the floor: whoever draws next on these axes knows that the map is there
ROBOT = Path([(0.36, 0), (-0.26, 0.24), (-0.13, 0), (-0.26, -0.24), (0.36, 0)], closed=True)  # looking east
SQUARE = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]


def world(task: Task | GridWorld, ax: Axes | None = None) -> Axes:
    """Draw the map: obstacles, the goal as a star, and the robot wherever an episode may start.

    An arrowhead is a robot that starts with that heading; a disc has a spoke for each of several headings.  If episodes
    start on every cell, nothing is marked.

    Parameters
    ----------
    task : Task or GridWorld
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError
        If `task` is neither a task nor a world.

    Examples
    --------
    >>> import rlnav as rl
    >>> ax = rl.plot.world(rl.GridWorld.from_ascii(rl.maps.ROOMS))
    >>> ax.get_xlabel()
    'x (cells)'
    """
    place = task.world if isinstance(task, Task) else task
    if not isinstance(place, GridWorld):
        _check.fail("task", "a Task or a GridWorld", f"{_check.show(task)} ({type(task).__name__})", kind=TypeError)
    ax = ground(place, ax)
    headings: dict[tuple[int, int], list[int]] = defaultdict(list)
    for pose in place.starts:
        headings[pose.x, pose.y].append(pose.theta)
    if len(headings) < len(place.free) - 1:
        for (x, y), thetas in headings.items():
            if len(thetas) == 1:
                draw_robot(ax, x, y, thetas[0], BLUE)
            else:
                _draw_start(ax, x, y, thetas)
    return ax


def ground(place: GridWorld, ax: Axes | None, right: float = 0.1, *, goal: bool = True) -> Axes:
    """Return axes with the map on them, perhaps without its goal; new ones leave `right` inches free beside it."""
    if ax is None:
        cell = min(0.7, 5.0 / place.width, 3.9 / place.height)
        ax = _new_axes(place.width * cell, place.height * cell, left=0.6, bottom=0.55, right=right, top=0.32)
    _check.instance("ax", ax, Axes)
    if not any(patch.get_label() == GROUND for patch in ax.patches):
        _draw_floor(ax, place)
        if goal:
            _draw_goal(ax, place)
        _draw_frame(ax, place)
    return ax


def _new_axes(width: float, height: float, *, left: float, bottom: float, right: float, top: float) -> Axes:
    """Make axes and margins of these sizes in inches: a layout that is computed would cost as much as the drawing."""
    w, h = left + width + right, bottom + height + top
    figure = plt.figure(figsize=(w, h), layout="none", facecolor="none")
    return figure.add_axes((left / w, bottom / h, width / w, height / h), facecolor="none")


def turned(glyph: Path, x: float, y: float, theta: float = 0.0, size: float = 1.0) -> Path:
    """Return a glyph that was drawn around the origin, looking east, at a place and heading."""
    return Affine2D().scale(size).rotate_deg(theta).translate(x, y).transform_path(glyph)


def draw_robot(ax: Axes, x: float, y: float, theta: int, color: str, size: float = 1.0) -> None:
    """Draw the robot as an arrowhead that points where it looks."""
    draw_robots(ax, [(x, y, theta)], color, size)


def draw_robots(ax: Axes, where: Iterable[tuple[float, float, int]], color: str, size: float = 1.0) -> None:
    """Draw the robot at several places (x, y, theta), as one element."""
    shapes = Path.make_compound_path(*(turned(ROBOT, *place, size) for place in where))
    ax.add_patch(PathPatch(shapes, facecolor=color, edgecolor="white", linewidth=0.8, zorder=6))


def arrow(theta: int) -> str:
    """Return a heading in words for a label, such as `90° ↑`."""
    return f"{theta}° {'→↗↑↖←↙↓↘'[HEADINGS.index(theta)]}"


def _draw_floor(ax: Axes, place: GridWorld) -> None:
    w, h = place.width, place.height
    ax.add_patch(Rectangle((-0.5, -0.5), w, h, facecolor=FLOOR, edgecolor="none", zorder=0, label=GROUND))
    columns = [[(x - 0.5, -0.5), (x - 0.5, h - 0.5)] for x in range(1, w)]
    rows = [[(-0.5, y - 0.5), (w - 0.5, y - 0.5)] for y in range(1, h)]
    if columns or rows:
        ax.add_patch(PathPatch(joined([*columns, *rows]), facecolor="none", edgecolor=RULE, linewidth=0.8, zorder=0.5))
    if place.obstacles:
        cells = joined(([(x + dx, y + dy) for dx, dy in SQUARE] for x, y in sorted(place.obstacles)), closed=True)
        ax.add_patch(PathPatch(cells, facecolor=WALL, edgecolor="none", zorder=2))
    outline = Rectangle((-0.5, -0.5), w, h, fill=False, edgecolor=WALL, linewidth=2.5, joinstyle="round", zorder=2)
    outline.set_clip_on(False)
    ax.add_patch(outline)


def _draw_goal(ax: Axes, place: GridWorld) -> None:
    star = turned(Path.unit_regular_star(5, 0.45), *place.goal, size=0.4)
    ax.add_patch(PathPatch(star, facecolor=STAR, edgecolor=INK, linewidth=0.8, joinstyle="round", zorder=3))


def _draw_frame(ax: Axes, place: GridWorld) -> None:
    plain(ax)
    ax.grid(False)
    ax.set(xlabel="x (cells)", ylabel="y (cells)", aspect="equal")
    ax.set(xlim=(-0.5, place.width - 0.5), ylim=(-0.5, place.height - 0.5))
    # Names of axes at a fixed distance, beyond numbers of two digits: to find their places would be a fifth of all work
    for axis, middle, away in ((ax.xaxis, (0.5, 0), (0, -0.24)), (ax.yaxis, (0, 0.5), (-0.27, 0))):
        axis.set_label_coords(*middle, ax.transAxes + ScaledTranslation(*away, ax.figure.dpi_scale_trans))
    for axis, n in ((ax.xaxis, place.width), (ax.yaxis, place.height)):
        axis.set_major_locator(MultipleLocator(next(step for step in (1, 2, 5, 10, 20, 50) if n <= 15 * step)))


def _draw_start(ax: Axes, x: int, y: int, thetas: list[int]) -> None:
    angles = np.radians(thetas)
    spokes = [[(x + r * np.cos(t), y + r * np.sin(t)) for r in (0.2, 0.36)] for t in angles]
    ax.add_patch(PathPatch(joined(spokes), edgecolor=BLUE, linewidth=1.8, capstyle="round", zorder=6))
    ax.add_patch(PathPatch(turned(Path.unit_circle(), x, y, size=0.2), facecolor=BLUE, edgecolor="none", zorder=6))


def check_heading(heading: object) -> int | None:
    """Return None or a heading in 0 ... 315."""
    if heading is None:
        return None
    theta = _check.integer("heading", heading)
    if theta % 45:
        _check.fail("heading", "None for all of them, or a multiple of 45 degrees", str(theta))
    return theta % 360


def shown_states(task: Task, heading: int | None) -> list[int]:
    """List the states in which there is something to show: with this heading, and not at the goal."""
    return [
        s for s, p in enumerate(task.poses) if (p.x, p.y) != task.world.goal and (heading is None or p.theta == heading)
    ]
