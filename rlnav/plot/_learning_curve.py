"""Learning curves: how good the episodes were, one after the other, and how much that depends on the seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import _check
from .._training import Training
from ._chart import SIZE, finish, next_line
from ._look import MUTED, axes

WHAT = {"returns": "discounted return", "steps": "steps", "success": "share of successes"}
POINTS = 250  # on one curve: more cannot be told apart on a page


def learning_curve(
    runs: Any,
    ax: Axes | None = None,
    *,
    what: str = "returns",
    window: int | None = None,
    label: str | None = None,
    band: float = 0.9,
) -> Axes:
    """Draw how learning went: the mean over runs with different seeds, and a band that holds most of them.

    Each run is first smoothed: the point at episode e is the mean of the `window` episodes that end with e, never of
    later ones.  The band holds the central share `band` of the smoothed runs at each episode; it says how much seeds
    differ, and is not a confidence interval of the mean.  A single run is a thin line without a band.

    Parameters
    ----------
    runs : Training, sequence of Training, float array [runs, episodes] or [episodes], or dict of str to any of these
        The keys of a dict are the labels of its curves.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.
    what : {"returns", "steps", "success"}
        What is drawn of each `Training`; arrays are taken to hold it.
    window : int, optional
        Number of episodes in a moving mean; by default one in fifty.  The first points average over fewer.
    label : str, optional
        Name of the curve, if there is one.
    band : float
        Share of the runs that the band holds at each episode, in [0, 1]; 0 draws none.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If there is no run, or runs of one curve differ in length.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE)).mdp()
    >>> runs = [rl.q_learning(mdp, episodes=200, rng=seed) for seed in range(5)]
    >>> ax = rl.plot.learning_curve({"Q-learning": runs}, what="steps")
    """
    if what not in WHAT:
        _check.fail("what", f"one of {', '.join(map(repr, WHAT))}", _check.show(what))
    band = _check.number("band", band, 0, 1)
    groups = runs if isinstance(runs, Mapping) else {label or "": runs}
    if not groups:
        _check.fail("runs", "at least one run", "none")
    tables = {str(name): _table_of(group, what) for name, group in groups.items()}
    longest = max(table.shape[1] for table in tables.values())
    window = max(1, longest // 50) if window is None else _check.integer("window", window, 1)
    ax = axes(ax, *SIZE)
    for name, table in tables.items():
        _draw_curve(ax, table, window, name, band)
    smoothed = f"\n(mean of the last {window})" if window > 1 else ""
    ax.set(xlabel="episode", ylabel=WHAT[what] + smoothed)
    if what == "success":
        ax.set_ylim(-0.02, 1.02)
    finish(ax, notes=[_band_in_words(band)])
    return ax


def moving_mean(runs: NDArray, window: int) -> NDArray[np.float64]:
    """Average the last `window` columns up to each column; the first ones over as many as there are."""
    total = np.cumsum(runs, axis=1, dtype=float)
    before = np.zeros_like(total)
    before[:, window:] = total[:, :-window]
    return (total - before) / np.minimum(np.arange(1, runs.shape[1] + 1), window)


def _table_of(runs: Any, what: str) -> NDArray[np.float64]:
    """Return the runs of one curve as an array [runs, episodes]."""
    runs = [runs] if isinstance(runs, Training) else runs
    if isinstance(runs, Sequence) and any(isinstance(run, Training) for run in runs):
        runs = [getattr(_check.instance("runs", run, Training), what).astype(float) for run in runs]
        lengths = sorted({run.size for run in runs})
        if len(lengths) > 1:
            _check.fail("runs", "of the same number of episodes in one curve", " and ".join(map(str, lengths)))
    meaning = "Trainings, or numbers [runs, episodes]"
    runs = np.atleast_2d(_check.plain("runs", runs, meaning))
    table = _check.array("runs", runs * 1 if runs.dtype == bool else runs, "real", (None, None), meaning).astype(float)
    if table.size == 0:
        _check.fail("runs", "at least one run of one episode", f"shape {table.shape}")
    return table


def _draw_curve(ax: Axes, table: NDArray[np.float64], window: int, name: str, band: float) -> None:
    runs, episodes = table.shape
    stride = max(1, min(window, episodes // POINTS))  # never so long that an episode would be in no point
    at = np.arange(episodes)[::-stride][::-1]
    smooth = moving_mean(table, window)[:, at]
    line = next_line(ax)
    if runs == 1:
        ax.plot(at + 1, smooth[0], **line | {"linewidth": 1.2}, label=name or "_curve")
        return
    ax.plot(at + 1, smooth.mean(axis=0), **line, label=f"{name or 'mean'} ({runs} runs)")
    if band:
        edges = np.percentile(smooth, _percentiles(band), axis=0)
        ax.fill_between(at + 1, *edges, color=line["color"], alpha=0.18, linewidth=0)
        ax.fill_between([], [], color=MUTED, alpha=0.25, linewidth=0, label=_band_in_words(band))  # for the legend


def _percentiles(band: float) -> tuple[float, float]:
    return 50 * (1 - band), 50 * (1 + band)


def _band_in_words(band: float) -> str:
    return "percentiles {:.3g} to {:.3g} of the runs".format(*_percentiles(band))
