"""How every figure looks: colors, sizes, and the axes to draw on.

Figures are drawn for a white ground, which `to_svg` puts below them; a dark page dims it a little.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.path import Path
from numpy.typing import NDArray

from .. import _check

# Okabe and Ito's colors for categories, in an order that keeps neighbors apart also in grey.
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
LINES = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (3, 1, 1, 1, 1, 1)))
BLUE, VERMILION = COLORS[:2]

INK = "#1f2933"  # words that matter
MUTED = "#52606d"  # words that help: ticks, notes
RULE = "#d5dbe1"  # lines of a grid
WALL = "#56616d"  # obstacles, and what surrounds the grid
FLOOR = "#ffffff"
STAR = "#e69f00"  # the goal

FAR_OUT = 3.0  # quartile distances: Tukey's word for values so far away that they belong to another story
MANY = 1500  # glyphs on one map; more are stored as a picture, because an SVG would take megabytes for them
TEXT, SMALL = 10.0, 9.0  # points

# 64 steps look smooth, and keep the color bar of an SVG small.  Viridis begins at a violet that walls cannot be taken
# for; what lies below the range is nearly black.
VIRIDIS = mpl.colormaps["viridis"](np.linspace(0.08, 1, 64))
SEQUENTIAL = ListedColormap(VIRIDIS, name="rlnav-sequential").with_extremes(under="#17111f")
DIVERGING = LinearSegmentedColormap.from_list(
    "rlnav-diverging", ["#8a3800", VERMILION, "#f2b48c", "#eeeeee", "#8fc1e3", BLUE, "#00416b"], N=65
)


def axes(ax: Axes | None, width: float, height: float) -> Axes:
    """Return `ax`, or new axes in a figure of this size in inches."""
    if ax is None:
        _, ax = plt.subplots(figsize=(width, height), layout="constrained", facecolor="none")
        ax.set_facecolor("none")
    return _check.instance("ax", ax, Axes)


def plain(ax: Axes) -> None:
    """Take away all that is not data: frame, tick marks, black."""
    ax.spines[:].set_visible(False)
    ax.tick_params(which="both", length=0, labelsize=SMALL, labelcolor=MUTED, pad=4)
    for axis in (ax.xaxis, ax.yaxis):
        axis.label.set(color=INK, size=TEXT)


def joined(lines: Iterable[Sequence[tuple[float, float]]], *, closed: bool = False) -> Path:
    """Make one path of many lines: a single element of an SVG instead of hundreds."""
    return Path.make_compound_path(*(Path([*line, line[0]] if closed else line, closed=closed) for line in lines))


def readable_on(color: tuple[float, float, float, float]) -> str:
    """Black or white, whichever is easier to read on a color."""
    red, green, blue = ((c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for c in color[:3])
    return "white" if 0.2126 * red + 0.7152 * green + 0.0722 * blue < 0.18 else "black"


def minus(text: str) -> str:
    """Write a number with a true minus sign, and nothing as minus nothing."""
    return (text.lstrip("-") if not text.strip("-0.°") else text).replace("-", "−")


def limits(V: NDArray[np.float64], vmin: float | None, vmax: float | None, signed: bool) -> tuple[float, float]:
    """Choose the ends of the color scale where they are not given; zero is in the middle of a signed one."""
    given = [_check.number(name, end) for name, end in (("vmin", vmin), ("vmax", vmax)) if end is not None]
    if signed:
        reach = float(np.abs(given or V).max()) or 1.0
        return -reach, reach
    lower, upper = np.percentile(V, [25, 75])
    near = lower - FAR_OUT * (upper - lower) <= V if upper > lower else V.min() <= V
    low = float(V[near].min()) if vmin is None else float(vmin)
    high = float(V.max()) if vmax is None else float(vmax)
    if low > high:
        _check.fail("vmin", "at most `vmax`", f"a scale from {low:g} to {high:g}")
    return (low, high) if low < high else (low - 0.5, high + 0.5)
