"""Values of poses on the map: in every cell a ring of eight wedges, one for each heading."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.colors import Normalize
from matplotlib.path import Path
from matplotlib.transforms import AffineDeltaTransform
from numpy.typing import ArrayLike

from .. import _check
from ..robot import HEADINGS
from ..task import Task
from ._ground import SQUARE, arrow, check_heading, ground, shown_states
from ._look import DIVERGING, INK, MANY, MUTED, SEQUENTIAL, SMALL, TEXT, limits, minus, readable_on


def values(
    task: Task,
    V: ArrayLike,
    ax: Axes | None = None,
    *,
    heading: int | None = None,
    numbers: bool | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    signed: bool = False,
    label: str = "value",
    colorbar: bool = True,
) -> Axes:
    """Draw the value of every pose: a ring in each cell, whose wedges are the headings.

    Parameters
    ----------
    task : Task
    V : float array [S]
        One number for each state, such as values, changes of values or errors.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.
    heading : int, optional
        Show only this heading, in degrees: one color a cell.
    numbers : bool, optional
        Write the values into the cells; by default if one heading is shown and the map is at most ten cells wide.
    vmin, vmax : float, optional
        Ends of the color scale.  By default they hold all values but those far below the others (by more than three
        quartile distances), such as those of a robot that can only crash: these are black, and the color bar has an
        arrow for them.
    signed : bool
        Use the colors for positive and negative numbers, with white at zero.
    label : str
        What the numbers are, for the color bar.
    colorbar : bool
        Draw the color bar.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If V is not one finite number a state, or `heading` is not one of the robot's.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
    >>> ax = rl.plot.values(task, rl.solve(task.mdp()).V)
    >>> ax = rl.plot.values(task, rl.solve(task.mdp()).V, heading=90)
    """
    _check.instance("task", task, Task)
    V = _check.array("V", V, "real", (task.crashed + 1,), "one value for each state of the task").astype(float)
    heading = check_heading(heading)
    shown = shown_states(task, heading)
    scale = Normalize(*limits(V[shown], vmin, vmax, signed))
    ax = ground(task.world, ax, right=0.85 if colorbar else 0.1)
    cells = PathCollection(
        WEDGES if heading is None else [Path(SQUARE + SQUARE[:1], closed=True)],
        offsets=[(task.poses[s].x, task.poses[s].y) for s in shown],
        offset_transform=ax.transData,
        array=V[shown],
        cmap=DIVERGING if signed else SEQUENTIAL,
        norm=scale,
        linewidths=0,
        zorder=1,
    )
    cells.set_transform(AffineDeltaTransform(ax.transData))  # glyphs scale with the map, but are not moved by it
    cells.set_clip_on(False)  # each clipped wedge would need two more lines of SVG
    cells.set_rasterized(len(shown) > MANY)
    ax.add_collection(cells, autolim=False)
    if numbers if numbers is not None else heading is not None and task.world.width <= 10:
        _write_numbers(ax, cells)
    if colorbar:
        _draw_colorbar(ax, cells, label if heading is None else f"{label}, heading {arrow(heading)}")
    return ax


def _wedges(inner: float = 0.13, outer: float = 0.47, gap: float = 0.02) -> list[Path]:
    """Cut a ring into eight, one piece for each heading, with a narrow gap between them."""
    wedges = []
    for theta in HEADINGS:
        rim = []
        for radius, turn in ((outer, 1), (inner, -1)):
            half = np.pi / 8 - gap / 2 / radius
            angles = np.radians(theta) + turn * np.linspace(-half, half, 5)
            rim += [(radius * np.cos(t), radius * np.sin(t)) for t in angles]
        wedges.append(Path([*rim, rim[0]], closed=True))
    return wedges


WEDGES = _wedges()


def _write_numbers(ax: Axes, cells: PathCollection) -> None:
    colors = cells.to_rgba(cells.get_array())
    for (x, y), value, color in zip(cells.get_offsets(), cells.get_array(), colors, strict=True):
        text = f"{value:.1f}" if abs(value) < 9.95 else f"{value:.0f}"
        ax.text(
            x, y, minus(text), ha="center", va="center_baseline", size=SMALL - 1, color=readable_on(color), zorder=4
        )


def _draw_colorbar(ax: Axes, cells: PathCollection, label: str) -> None:
    V, norm = cells.get_array(), cells.norm
    beyond = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    side = ax.inset_axes((1.03, 0, 0.035, 1))
    bar = ax.figure.colorbar(
        cells, cax=side, extend=beyond[bool(V.min() < norm.vmin), bool(V.max() > norm.vmax)], extendfrac=0.04
    )
    bar.solids.set_rasterized(True)  # one small picture, without hairlines between its steps
    bar.outline.set_visible(False)
    side.tick_params(length=0, labelsize=SMALL, labelcolor=MUTED, pad=3)
    bar.set_label(label, size=TEXT, color=INK)
