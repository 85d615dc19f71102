"""Figures of the book.  Each function draws a result on the axes it is given, or on new ones, and returns them.

Nothing is computed here that an algorithm should compute, nothing is shown on the screen, and no setting of matplotlib
is touched before `style` is called.
"""

from ._backup import backup_diagram
from ._ground import world
from ._learning_curve import learning_curve
from ._look import COLORS, DIVERGING, SEQUENTIAL
from ._path import path
from ._policy import policy
from ._residuals import residuals
from ._style import style, to_svg
from ._table import table
from ._values import values

__all__ = [
    "COLORS",
    "DIVERGING",
    "SEQUENTIAL",
    "backup_diagram",
    "learning_curve",
    "path",
    "policy",
    "residuals",
    "style",
    "table",
    "to_svg",
    "values",
    "world",
]
