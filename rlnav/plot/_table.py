"""A table of action values: a few rows, a column for each steering, the best marked."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle
from numpy.typing import ArrayLike, NDArray

from .. import _check
from ..mdp import TIE
from ..task import Task
from ._ground import arrow
from ._look import DIVERGING, INK, MUTED, SEQUENTIAL, SMALL, TEXT, axes, limits, minus, plain, readable_on

ROWS = 8  # shown by default
WIDE, HIGH = 0.72, 0.34  # inches of one cell


def table(
    task: Task,
    Q: ArrayLike,
    ax: Axes | None = None,
    *,
    rows: Sequence[int] | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    signed: bool = False,
) -> Axes:
    """Draw rows of a table of action values, each best action in a frame; equally good ones all have it.

    Parameters
    ----------
    task : Task
    Q : float array [Z, A] or [S, A]
        Action values of what the robot perceives, or of poses.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.
    rows : sequence of int, optional
        Which rows to show; by default those of the first eight start poses.
    vmin, vmax : float, optional
        Ends of the color scale, as in `values`.
    signed : bool
        Use the colors for positive and negative numbers, with white at zero.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If Q is no table of this task, or `rows` lie outside of it.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE))
    >>> ax = rl.plot.table(task, rl.solve(task.mdp()).Q)
    """
    _check.instance("task", task, Task)
    shape = (None, len(task.robot.steering))
    Q = _check.array("Q", Q, "real", shape, "a table with a column for each steering").astype(float)
    picked = _pick(task, len(Q), rows)
    names = (_names_of_poses if len(Q) == task.crashed + 1 else _names_of_features)(task, picked)
    scale = Normalize(*limits(Q[picked], vmin, vmax, signed))
    colors = ScalarMappable(scale, DIVERGING if signed else SEQUENTIAL).to_rgba(Q[picked])
    words = 0.3 + 0.08 * max(map(len, names))  # inches
    ax = axes(ax, len(task.robot.steering) * WIDE + words, len(picked) * HIGH + 1.0)
    for i, z in enumerate(picked):
        _draw_row(ax, i, Q[z], colors[i])
    _draw_frame(ax, task.robot.steering, names)
    return ax


def _pick(task: Task, n: int, rows: Sequence[int] | None) -> list[int]:
    """Return the rows to show of a table that has n of them."""
    phi = np.arange(n) if n == task.crashed + 1 else task.phi()
    if n != phi.max() + 1:
        sizes = " or ".join(map(str, sorted({task.crashed + 1, int(phi.max()) + 1})))
        _check.fail("Q", f"a table of {sizes} rows for this task", f"{n} rows")
    if rows is None:
        return list(dict.fromkeys(int(phi[task.index(pose)]) for pose in task.world.starts))[:ROWS]
    picked = [_check.integer("rows", z, 0, n - 1) for z in np.atleast_1d(rows).tolist()]
    return picked or _check.fail("rows", "at least one row", "none")


def _names_of_poses(task: Task, picked: list[int]) -> list[str]:
    poses = [task.pose(s) for s in picked]
    return ["crashed" if pose is None else f"({pose.x}, {pose.y})  {arrow(pose.theta)}" for pose in poses]


def _names_of_features(task: Task, picked: list[int]) -> list[str]:
    """Say what the robot perceives in each row: the levels whose mixed-radix number the row is."""
    if not isinstance(task.features, tuple):
        return [f"row {z}" for z in picked]
    sizes = [feature.size(task.world, task.robot) for feature in task.features]
    levels = [np.unravel_index(z, sizes) if z < np.prod(sizes) else None for z in picked]
    words = [feature.name for feature in task.features]
    return [
        "ended" if level is None else ", ".join(f"{word} {n}" for word, n in zip(words, level, strict=True))
        for level in levels
    ]


def _draw_row(ax: Axes, i: int, row: NDArray[np.float64], colors: NDArray) -> None:
    for a, (q, color) in enumerate(zip(row, colors, strict=True)):
        ink, best = readable_on(color), q >= row.max() - TIE
        ax.add_patch(Rectangle((a - 0.48, i - 0.46), 0.96, 0.92, facecolor=color, edgecolor="none"))
        look = {"ha": "center", "va": "center_baseline", "size": SMALL, "weight": "bold" if best else "normal"}
        ax.text(a, i, minus(f"{q:.2f}"), color=ink, **look)
        if best:
            ax.add_patch(Rectangle((a - 0.43, i - 0.36), 0.86, 0.72, fill=False, edgecolor=ink, linewidth=1.6))


def _draw_frame(ax: Axes, steering: tuple[int, ...], names: list[str]) -> None:
    """Name rows and columns."""
    plain(ax)
    ax.grid(False)
    ax.set(xlim=(-0.5, len(steering) - 0.5), ylim=(len(names) - 0.5, -0.5))
    ax.xaxis.tick_top()
    ax.set_xticks(range(len(steering)), [minus(f"{a:+d}°" if a else "0°") for a in steering])
    ax.set_yticks(range(len(names)), names)
    ax.tick_params(axis="y", labelcolor=INK)
    ax.set_xlabel("framed: the best action of the row", size=SMALL, color=MUTED, loc="left")
    ax.set_title("steering", size=TEXT, color=INK)
