"""Policies on the map: for every pose a needle in the direction in which the robot drives."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray

from .. import _check
from ..mdp import SUM
from ..robot import Pose
from ..task import Task
from ._ground import check_heading, ground, shown_states, turned
from ._look import INK, MANY

SHADES = 5  # steps of opacity: all needles of one shade are one element of an SVG
FAINTEST = 0.15
CURVE = [Path.MOVETO, Path.CURVE4, Path.CURVE4, Path.CURVE4]
TIP = Path([(0.12, 0), (-0.1, 0.11), (-0.05, 0), (-0.1, -0.11), (0.12, 0)], closed=True)


def policy(
    task: Task, pi: ArrayLike, ax: Axes | None = None, *, heading: int | None = None, Q: ArrayLike | None = None
) -> Axes:
    """Draw what the robot does in every pose: needles that begin along its heading and bend as it steers.

    A needle begins on the side to which the robot looks, leads in the direction theta + a/2 in which it drives, and
    ends along its new heading theta + a, eq. :eq:`eq-kinematics`.  Needles of a stochastic policy are as opaque as
    their actions are likely.

    Parameters
    ----------
    task : Task
    pi : int array [S] or float array [S, A]
        An action for each state, or a distribution over actions.  `pi[phi]` lifts a policy of designed states.
    ax : matplotlib.axes.Axes, optional
        Where to draw, such as over a map of values (best with one heading); new axes by default.
    heading : int, optional
        Show only this heading, in degrees, with large needles.
    Q : float array [S, A], optional
        Action values.  A needle is then fainter the less its action gains over a blind one: Q(s, a) less the mean of
        Q(s, .), relative to the largest gain on the map.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError, ValueError
        If `pi` or Q do not have one row for each state, or actions that the robot lacks.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
    >>> best = rl.solve(task.mdp())
    >>> ax = rl.plot.policy(task, best.pi, rl.plot.values(task, best.V, heading=0, numbers=False), heading=0)
    """
    _check.instance("task", task, Task)
    heading = check_heading(heading)
    weight = _probabilities(task, pi)
    if Q is not None:
        weight *= _gain(task, Q)
    shade = np.ceil(SHADES * weight).astype(int)
    shown = shown_states(task, heading)
    ax = ground(task.world, ax)
    for step in range(1, SHADES + 1):
        where = [(task.poses[shown[i]], task.robot.steering[a]) for i, a in np.argwhere(shade[shown] == step)]
        if where:
            _draw_needles(ax, where, large=heading is not None, alpha=step / SHADES)
    return ax


def needle(theta: float, a: float, length: float) -> Path:
    """Bend a needle from heading theta to theta + a; its ends lie in the direction theta + a/2."""
    start, end = np.radians(theta), np.radians(theta + a)
    tip = length * _unit((start + end) / 2)
    bend = 0.4 * length
    return Path([(0, 0), bend * _unit(start), tip - bend * _unit(end), tip], CURVE)


def _unit(angle: float) -> NDArray[np.float64]:
    return np.array([np.cos(angle), np.sin(angle)])


@cache
def _large(theta: int, a: int) -> tuple[Path, Path]:
    """Return stem and tip of a needle whose middle is the origin."""
    stem = needle(theta, a, 0.6)
    middle = stem.vertices[-1] / 2
    return turned(stem, -middle[0], -middle[1]), turned(TIP, middle[0], middle[1], theta + a)


@cache
def _small(theta: int, a: int) -> tuple[Path]:
    """Return a needle that begins on a circle around the origin, on the side to which the robot looks."""
    x, y = 0.17 * _unit(np.radians(theta))
    return (turned(needle(theta, a, 0.25), x, y),)


def _draw_needles(ax: Axes, where: list[tuple[Pose, int]], large: bool, alpha: float) -> None:
    look: dict[str, Any] = {"facecolor": "none", "capstyle": "round", "alpha": alpha, "zorder": 4}
    look["rasterized"] = len(where) > MANY
    shape = _large if large else _small
    stems, *tips = (_at(where, parts) for parts in zip(*(shape(pose.theta, a) for pose, a in where), strict=True))
    if large:
        ax.add_patch(PathPatch(stems, edgecolor="white", linewidth=3.4, **look))  # to be seen on dark colors as well
    for tip in tips:
        ax.add_patch(PathPatch(tip, edgecolor="white", linewidth=0.9, **look | {"facecolor": INK}))
    ax.add_patch(PathPatch(stems, edgecolor=INK, linewidth=1.6 if large else 1.1, **look))


def _at(where: list[tuple[Pose, int]], glyphs: Sequence[Path]) -> Path:
    """Make one path of glyphs, each moved to its pose."""
    moved = [glyph.vertices + np.array([pose.x, pose.y]) for (pose, _), glyph in zip(where, glyphs, strict=True)]
    return Path(np.concatenate(moved), np.concatenate([glyph.codes for glyph in glyphs]))


def _probabilities(task: Task, pi: ArrayLike) -> NDArray[np.float64]:
    """Return the policy as a distribution over actions in every state."""
    S, A = task.crashed + 1, len(task.robot.steering)
    pi = _check.plain("pi", pi, "one action for each state, or probabilities [S, A]")
    if pi.ndim == 2:
        weight = _check.array("pi", pi, "real", (S, A), "one distribution over actions for each state").astype(float)
        bad = np.flatnonzero((weight < 0).any(axis=1) | (np.abs(weight.sum(axis=1) - 1) > SUM))
        if bad.size:
            row = ", ".join(f"{p:g}" for p in weight[bad[0]])
            _check.fail("pi", "a distribution over actions in every state", f"[{row}] in state {bad[0]}")
        return weight.clip(0, 1)
    actions = _check.array("pi", pi, "integer", (None,), "one action for each state, or probabilities [S, A]")
    if actions.size != S:
        advice = "A policy of designed states is lifted by `pi[phi]`."
        _check.fail("pi", f"one action for each of the {S} states", f"{actions.size} actions", advice)
    bad = np.flatnonzero((actions < 0) | (actions >= A))
    if bad.size:
        _check.fail("pi", f"actions from 0 to {A - 1}", f"{actions[bad[0]]} in state {bad[0]}")
    return np.eye(A)[actions]


def _gain(task: Task, Q: ArrayLike) -> NDArray[np.float64]:
    """How much each action gains over a blind choice, from FAINTEST to 1."""
    shape = (task.crashed + 1, len(task.robot.steering))
    Q = _check.array("Q", Q, "real", shape, "action values for each state")
    gain = Q - Q.mean(axis=1, keepdims=True)
    return np.clip(gain / max(gain.max(), 1e-300), FAINTEST, 1)
