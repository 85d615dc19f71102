"""What curves have in common: their colors and dashes, the grid below and the legend above."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

from ._look import COLORS, INK, LINES, MUTED, RULE, SMALL, plain

SIZE = (5.2, 3.2)  # inches


def next_line(ax: Axes) -> dict[str, Any]:
    """Return the color and dashes of the next curve on these axes."""
    k = sum(line.get_color() != MUTED for line in ax.lines)
    return {"color": COLORS[k % len(COLORS)], "linestyle": LINES[k % len(LINES)], "linewidth": 2.0, "zorder": 3}


def finish(ax: Axes, notes: list[str]) -> None:
    """Draw grid and legend: every label once, first those of curves, then `notes` on them."""
    plain(ax)
    ax.grid(True, axis="y", color=RULE, linewidth=0.8)
    ax.set_axisbelow(True)
    ax.spines["bottom"].set(visible=True, color=MUTED, linewidth=0.8)
    handles, labels = ax.get_legend_handles_labels()
    handle = dict(zip(labels, handles, strict=True))
    if handle:
        ordered = sorted(handle, key=notes.__contains__)
        look = {"frameon": False, "fontsize": SMALL, "labelcolor": INK, "handlelength": 2.4, "borderaxespad": 0.2}
        ax.legend(
            [handle[label] for label in ordered], ordered, loc="lower left", bbox_to_anchor=(-0.01, 1), ncols=2, **look
        )
