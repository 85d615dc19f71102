"""Backup diagrams: from where the value of a state or an action is backed up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from .. import _check
from ..mdp import TIE
from ._look import BLUE, INK, MUTED, SMALL, TEXT, axes, minus

STATE_FIRST = ("$s$", "$a$", r"$s^\prime$")  # what the levels are, from the root down
ACTION_FIRST = ("$s, a$", r"$s^\prime$", r"$a^\prime$")
PI, PI_NEXT, P = r"$\pi(a\,|\,s)$", r"$\pi(a^\prime|\,s^\prime)$", r"$p,\ r$"
BEST, SAMPLE = "max", "$r$"


@dataclass(frozen=True)
class Kind:
    """Describe a diagram: what the root is worth, its levels, what leads from each to the next and how often."""

    worth: str
    levels: tuple[str, str, str]
    edges: tuple[str, str]
    branches: tuple[int, int]


KINDS = {
    "v_pi": Kind(r"$v_\pi(s)$", STATE_FIRST, (PI, P), (3, 2)),
    "q_pi": Kind(r"$q_\pi(s,a)$", ACTION_FIRST, (P, PI_NEXT), (3, 2)),
    "v_star": Kind(r"$v_*(s)$", STATE_FIRST, (BEST, P), (3, 2)),
    "q_star": Kind(r"$q_*(s,a)$", ACTION_FIRST, (P, BEST), (3, 2)),
    "td": Kind(r"$V(s)$", STATE_FIRST, ("", SAMPLE), (1, 1)),
    "q_learning": Kind(r"$Q(s,a)$", ACTION_FIRST, (SAMPLE, BEST), (1, 3)),
    "sarsa": Kind(r"$Q(s,a)$", ACTION_FIRST, (SAMPLE, ""), (1, 1)),
    "expected_sarsa": Kind(r"$Q(s,a)$", ACTION_FIRST, (SAMPLE, PI_NEXT), (1, 3)),
}
HIGH, RADIUS = 0.95, 0.11  # inches: between levels, of a state
MARGIN = 0.85  # inches at the left, for the words


@dataclass
class Node:
    """Hold one circle or dot of a diagram, what is written beside it, and the branches below."""

    level: int
    value: Any = None
    edge: Any = None  # what is written beside the line from its parent
    below: list[Node] = field(default_factory=list)
    x: float = 0.0

    @property
    def y(self) -> float:
        return -HIGH * self.level

    def __iter__(self) -> Iterator[Node]:
        yield self
        for node in self.below:
            yield from node


def backup_diagram(kind: str, ax: Axes | None = None, *, numbers: Sequence[Any] | None = None) -> Axes:
    """Draw the backup diagram of an equation or a learning rule: states are circles, actions are dots.

    An arc with "max" spans the branches of which only the best counts; without it, all count by their probability.

    Parameters
    ----------
    kind : str
        "v_pi" or "q_pi" (expectation, eqs. :eq:`eq-bellman-v` and :eq:`eq-bellman-q`), "v_star" or "q_star"
        (optimality, eqs. :eq:`eq-bellman-optimality-v` and :eq:`eq-bellman-optimality-q`), or a rule that backs up one
        sampled step: "td" (eq. :eq:`eq-td`), "q_learning", "sarsa", "expected_sarsa".
    ax : matplotlib.axes.Axes, optional
        Where to draw; new axes by default.
    numbers : tree, optional
        What to write: (value, branches) for the root, where each branch is (edge, value) or (edge, value, branches).
        Values and edges are numbers, texts or None.  Its shape replaces that of the textbook; a tree of one level shows
        half of the equation.  Below "max", the branch with the largest value is drawn in color.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        If there is no such diagram, or `numbers` is no tree of two levels.

    Examples
    --------
    >>> import rlnav as rl
    >>> ax = rl.plot.backup_diagram("v_star", numbers=(3, [("left", 1, []), ("right", 3, [(0.5, 2), (0.5, 4)])]))
    """
    if kind not in KINDS:
        _check.fail("kind", f"one of {', '.join(map(repr, KINDS))}", _check.show(kind))
    shape = KINDS[kind]
    root = _tree(_textbook(*shape.branches) if numbers is None else numbers)
    text = max(len(line) for node in root for line in _text(node.edge).split("\n"))  # the longest beside a branch
    width = _place(root, 0.6 + 0.045 * text)
    left = MARGIN + 0.07 * text
    depth = max(node.level for node in root)
    ax = axes(ax, left + width + 0.7, depth * HIGH + 0.75)
    ax.set(xlim=(-left, width + 0.7), ylim=(-depth * HIGH - 0.45, 0.3), aspect="equal")
    ax.axis("off")
    states = 0 if shape.levels is STATE_FIRST else 1
    for node in root:
        _draw_branches(ax, node, best=node.level < 2 and shape.edges[node.level] == BEST)
        _draw_node(ax, node, is_state=node.level % 2 == states)
    _draw_words(ax, root, shape, -left + 0.45, depth)
    return ax


def _textbook(first: int, second: int) -> Sequence[Any]:
    """Return a tree without numbers."""
    return (None, [(None, None, [(None, None)] * second)] * first)


def _tree(numbers: Any) -> Node:
    """Build the tree, or say what is wrong with the numbers."""
    form = "(value, branches) with branches (edge, value) or (edge, value, branches), two levels deep"

    def grow(level: int, branch: Any) -> Node:
        if not isinstance(branch, tuple | list) or len(branch) not in (2, 3):
            _check.fail("numbers", form, _check.show(branch))
        edge, value, below = (*branch, ()) if len(branch) == 2 else branch
        if not isinstance(below, tuple | list) or (below and level == 2):
            _check.fail("numbers", form, _check.show(branch))
        return Node(level, value, edge, [grow(level + 1, b) for b in below])

    is_tree = isinstance(numbers, tuple | list) and len(numbers) == 2 and isinstance(numbers[1], tuple | list)
    if not is_tree or not numbers[1]:
        _check.fail("numbers", form, _check.show(numbers))
    return grow(0, (None, *numbers))


def _place(root: Node, apart: float) -> float:
    """Put the leaves side by side, and every parent above the middle of its branches; return the width."""
    leaves = [node for node in root if not node.below]
    for i, leaf in enumerate(leaves):
        leaf.x = apart * i
    for node in reversed(list(root)):
        if node.below:
            node.x = (node.below[0].x + node.below[-1].x) / 2
    return apart * (len(leaves) - 1)


def _draw_branches(ax: Axes, node: Node, best: bool) -> None:
    highest = max((float(b.value) for b in node.below if isinstance(b.value, Real)), default=0.0)
    for branch in node.below:
        wins = best and isinstance(branch.value, Real) and float(branch.value) >= highest - TIE
        color, width = (BLUE, 2.6) if wins else (INK, 1.2)
        ax.plot([node.x, branch.x], [node.y, branch.y], color=color, linewidth=width, zorder=2 + wins)
        if branch.edge is not None:
            right = branch.x >= node.x
            x, y = 0.42 * node.x + 0.58 * branch.x, 0.42 * node.y + 0.58 * branch.y
            side = {"ha": "left" if right else "right", "va": "bottom", "size": SMALL, "color": MUTED}
            ax.text(x + (0.05 if right else -0.05), y, _text(branch.edge), **side)
    if best and len(node.below) > 1:
        first, last = (
            np.arctan2(branch.y - node.y, branch.x - node.x) for branch in node.below[:: len(node.below) - 1]
        )
        angles = np.linspace(first, last, 25)
        ax.plot(node.x + 0.33 * np.cos(angles), node.y + 0.33 * np.sin(angles), color=INK, linewidth=1.6, zorder=4)


def _draw_node(ax: Axes, node: Node, is_state: bool) -> None:
    radius, face = (RADIUS, "white") if is_state else (0.6 * RADIUS, INK)
    ax.add_patch(Circle((node.x, node.y), radius, facecolor=face, edgecolor=INK, linewidth=1.4, zorder=5))
    if node.value is None or node.level == 0:
        return
    if node.below:
        ax.text(node.x + 0.17, node.y, _text(node.value), ha="left", va="center", size=TEXT, color=INK)
    else:
        ax.text(node.x, node.y - 0.16, _text(node.value), ha="center", va="top", size=TEXT, color=INK)


def _draw_words(ax: Axes, root: Node, shape: Kind, x: float, depth: int) -> None:
    """Write what the root is worth beside it, and at the left what levels and lines are, as deep as the tree goes."""
    worth = shape.worth if root.value is None else f"{shape.worth} = {_text(root.value)}"
    ax.text(root.x + 0.2, root.y, worth, ha="left", va="center", size=TEXT + 1, color=INK)
    for level, name in enumerate(shape.levels[: depth + 1]):
        ax.text(x, -HIGH * level, name, ha="right", va="center", size=TEXT, color=INK)
    for level, name in enumerate(shape.edges[:depth]):
        ax.text(x, -HIGH * (level + 0.5), name, ha="right", va="center", size=SMALL, color=MUTED)


def _text(value: Any) -> str:
    return "" if value is None else minus(f"{value:.4g}") if isinstance(value, Real) else str(value)
