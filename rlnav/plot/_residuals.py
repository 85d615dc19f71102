"""Residuals: by how much the values still changed, sweep by sweep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullLocator
from numpy.typing import ArrayLike, NDArray

from .. import _check
from ..planning import Solution
from ._chart import SIZE, finish, next_line
from ._look import MUTED, axes

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
STILL = "no change at all"


def residuals(
    solutions: Solution | ArrayLike | Mapping[str, Any], ax: Axes | None = None, *, bound: float | None = None
) -> Axes:
    """Draw the largest change of a value in each sweep, on a logarithmic axis.

    Changes of exactly zero, which such an axis has no place for, are marked at its foot.

    Parameters
    ----------
    solutions : Solution, float array [sweeps], or dict of str to either
        The keys of a dict are the labels of its curves.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.
    bound : float, optional
        The discount factor gamma: also draw the contraction's promise for each curve, gamma^(k-1) times the change of
        the first sweep.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If there is nothing to draw, or a change is negative.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES)).mdp()
    >>> ax = rl.plot.residuals(rl.value_iteration(mdp), bound=mdp.gamma)
    """
    bound = None if bound is None else _check.number("bound", bound, 0, 1)
    named = solutions if isinstance(solutions, Mapping) else {"": solutions}
    if not named:
        _check.fail("solutions", "at least one Solution", "none")
    changes = {str(name): _changes(solution) for name, solution in named.items()}
    ax = axes(ax, *SIZE)
    for name, change in changes.items():
        _draw_changes(ax, change, name)
        if bound and change[0]:
            _draw_promise(ax, change, bound)
    ax.set(xlabel="sweep", ylabel="largest change of a value")
    _fit_decades(ax)
    finish(ax, notes=[STILL, _promise_in_words(bound or 0)])
    return ax


def _changes(solution: Any) -> NDArray[np.float64]:
    """Return the largest change of each sweep."""
    change = solution.residuals if isinstance(solution, Solution) else solution
    change = _check.array("solutions", change, "real", (None,), "a Solution, or one number a sweep").astype(float)
    if change.size == 0:
        _check.fail("solutions", "of at least one sweep", "none")
    if change.min() < 0:
        _check.fail("solutions", "changes of at least 0", f"{change.min():g} in sweep {change.argmin() + 1}")
    return change


def _draw_changes(ax: Axes, change: NDArray[np.float64], name: str) -> None:
    line = next_line(ax)
    sweep, seen = np.arange(1, change.size + 1), change > 0
    ax.plot(sweep[seen], change[seen], **line, label=name or "largest change")
    if not seen.all():
        foot = {"transform": ax.get_xaxis_transform(), "clip_on": False, "zorder": 4}
        still = sweep[~seen]
        ax.scatter(still, np.zeros(still.size), s=36, marker="v", color=line["color"], label=STILL, **foot)


def _draw_promise(ax: Axes, change: NDArray[np.float64], gamma: float) -> None:
    promise = change[0] * gamma ** np.arange(change.size)
    words = _promise_in_words(gamma)
    ax.plot(np.arange(1, change.size + 1), promise, "--", color=MUTED, linewidth=1.2, zorder=4, label=words)


def _promise_in_words(gamma: float) -> str:
    return f"γᵏ⁻¹ of the first, γ = {gamma:g}"


def _power_of_ten(value: float, _: int) -> str:
    return "10" + str(round(np.log10(value))).translate(SUPERSCRIPT)


def _fit_decades(ax: Axes) -> None:
    """Begin the axis at a power of ten, and mark only these."""
    drawn = np.concatenate([np.asarray(line.get_ydata()) for line in ax.lines])
    low, high = (drawn[drawn > 0].min(), drawn.max()) if drawn.any() else (0.1, 1.0)
    ax.set_ylim(10 ** np.floor(np.log10(low)), 1.2 * high)
    ax.set_yscale("log")
    ax.yaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(FuncFormatter(_power_of_ten))  # plain text is drawn much faster than mathematics
    ax.xaxis.set_major_locator(MaxNLocator(7, integer=True, min_n_ticks=1))
