"""Settings for a notebook, and figures as SVG text that is the same, to the byte, every time they are drawn."""

from __future__ import annotations

import io
import re
import sys
from functools import partial
from typing import Any

import matplotlib as mpl
from cycler import cycler
from matplotlib.figure import Figure

from .. import _check
from ._look import COLORS, INK, MUTED, RULE, SMALL, TEXT

DPI = 150  # of what is stored as a picture: color bars, and very large maps
SALT = "rlnav"  # names inside an SVG are hashes: salted, they are the same in every run
COORDINATES = re.compile(r' (?:d|x|y)="[^"]*"')
BEYOND_HUNDREDTHS = re.compile(r"(\.\d\d)\d+")

GROUND = 'style="background: white"'  # dark notebooks too show the figure as it was drawn

SETTINGS: dict[str, Any] = {
    "axes.axisbelow": True,
    "axes.edgecolor": MUTED,
    "axes.facecolor": "none",
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.labelsize": TEXT,
    "axes.prop_cycle": cycler(color=COLORS),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": TEXT,
    "figure.constrained_layout.use": True,
    "figure.facecolor": "none",
    "figure.figsize": (5.2, 3.2),
    "font.size": TEXT,
    "grid.color": RULE,
    "grid.linewidth": 0.8,
    "legend.fontsize": SMALL,
    "legend.frameon": False,
    "savefig.facecolor": "none",
    "svg.fonttype": "path",
    "svg.hashsalt": SALT,
    "text.color": INK,
    "xtick.color": MUTED,
    "xtick.labelsize": SMALL,
    "ytick.color": MUTED,
    "ytick.labelsize": SMALL,
}


def style() -> None:
    """Set matplotlib up for the book: its look, and in a notebook SVG figures that are the same in every run.

    Call it once, in the first cell.  It changes `matplotlib.rcParams` of this process, as a style sheet does.

    Examples
    --------
    >>> import matplotlib as mpl, rlnav as rl
    >>> with mpl.rc_context():
    ...     rl.plot.style()
    ...     mpl.rcParams["figure.facecolor"]
    'none'
    """
    if "IPython" in sys.modules:
        _svg_in_notebooks()
    mpl.rcParams.update(SETTINGS)


def to_svg(figure: Figure, bbox_inches: str | None = None) -> str:
    """Draw a figure as one `<svg>` element without date, version or random names.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    bbox_inches : {"tight", None}
        Cut the empty margin off, or keep the size that the figure was given.

    Returns
    -------
    str
        With coordinates to a hundredth of a point: smaller, and the same where rounding differs in the last digit.

    Examples
    --------
    >>> import rlnav as rl
    >>> ax = rl.plot.world(rl.GridWorld.from_ascii(">.G"))
    >>> rl.plot.to_svg(ax.figure) == rl.plot.to_svg(ax.figure)
    True
    """
    _check.instance("figure", figure, Figure)
    text = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": SALT}):
        figure.savefig(text, format="svg", dpi=DPI, bbox_inches=bbox_inches, metadata={"Date": None, "Creator": None})
    svg = text.getvalue().replace("<svg ", f"<svg {GROUND} ", 1)
    return COORDINATES.sub(lambda found: BEYOND_HUNDREDTHS.sub(r"\1", found[0]), svg[svg.index("<svg") :])


def _svg_in_notebooks() -> None:
    """Let `to_svg` show every figure of this notebook, if this is one."""
    from IPython import get_ipython

    shell = get_ipython()
    if shell is None:
        return
    import matplotlib_inline.backend_inline  # noqa: F401  sets its own formats when it is loaded: it has to be first

    formatters = shell.display_formatter.formatters
    for formatter in formatters.values():
        formatter.pop(Figure, None)
    formatters["image/svg+xml"].for_type(Figure, partial(to_svg, bbox_inches="tight"))
