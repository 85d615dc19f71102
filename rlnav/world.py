"""The grid that the robot drives on: obstacles, a goal, and where it may start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import _check
from .robot import HEADINGS, Pose

Cell = tuple[int, int]

ARROWS = {">": 0, "^": 90, "<": 180, "v": 270}
DRAWN = "'#' obstacle, '.' free, 'G' goal, 'S' start with any heading, '>', '^', '<', 'v' start with that heading"
LARGEST = 300  # cells along one side


@dataclass(frozen=True)
class GridWorld:
    """Hold a rectangular grid with obstacles and one goal.

    Parameters
    ----------
    width, height : int
        Number of cells along x and y.
    goal : (int, int)
        Cell (x, y) that ends the episode with success, whatever the heading.
    obstacles : iterable of (int, int)
        Cells that nobody may enter.
    starts : iterable of Pose
        Where an episode may begin, all equally likely.  By default: every pose on a free cell with a way to the goal.

    Raises
    ------
    TypeError, ValueError
        If a cell lies outside or is taken, or if there is no way from a start to the goal.

    Examples
    --------
    >>> import rlnav as rl
    >>> world = rl.GridWorld(3, 2, goal=(2, 1), obstacles=[(1, 1)], starts=[rl.Pose(0, 0, 0)])
    >>> print(world)
    .#G
    >..
    """

    width: int
    height: int
    goal: Cell
    obstacles: frozenset[Cell] = frozenset()
    starts: tuple[Pose, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "width", _check.integer("width", self.width, 1, LARGEST))
        object.__setattr__(self, "height", _check.integer("height", self.height, 1, LARGEST))
        object.__setattr__(self, "obstacles", frozenset(self._cells("obstacles", self.obstacles)))
        object.__setattr__(self, "goal", self._cells("goal", [self.goal])[0])
        if self.goal in self.obstacles:
            _check.fail("goal", "a free cell", f"{self.goal}, an obstacle")
        near = reachable(self.goal, self.width, self.height, self.obstacles)
        starts = _check.items("starts", self.starts, "poses")
        starts = starts or tuple(Pose(*cell, theta) for cell in near - {self.goal} for theta in HEADINGS)
        if not starts:
            _check.fail(
                "goal", "a cell that can be reached", f"{self.goal}, walled in", "Remove an obstacle beside it."
            )
        for pose in starts:
            self._check_start(pose, near)
        object.__setattr__(self, "starts", tuple(sorted(set(starts), key=lambda p: (p.y, p.x, p.theta))))

    @classmethod
    def from_ascii(cls, drawing: str) -> GridWorld:
        """Read a world from rows of text; the top row has the highest y.

        Parameters
        ----------
        drawing : str
            '#' obstacle, '.' free, 'G' goal, 'S' start with any heading, '>' '^' '<' 'v' start with that heading.
            Blank lines around it and indentation are ignored.

        Raises
        ------
        TypeError, ValueError
            If rows differ in length, a character is unknown, or there is not exactly one goal that can be reached.

        Examples
        --------
        >>> import rlnav as rl
        >>> rl.GridWorld.from_ascii('''
        ...     ..G
        ...     S#.
        ... ''').goal
        (2, 1)
        """
        rows = _rows(drawing)
        height = len(rows)
        at = {(x, height - 1 - i): c for i, row in enumerate(rows) for x, c in enumerate(row)}
        goals = [cell for cell, c in at.items() if c == "G"]
        if len(goals) != 1:
            got = f"{len(goals)} of them, at {goals}" if goals else "none"
            _check.fail("drawing", "a map with one goal 'G'", got)
        starts = [Pose(*cell, th) for cell, c in at.items() if c == "S" for th in HEADINGS]
        starts += [Pose(*cell, ARROWS[c]) for cell, c in at.items() if c in ARROWS]
        obstacles = frozenset(cell for cell, c in at.items() if c == "#")
        return cls(len(rows[0]), height, goals[0], obstacles, tuple(starts))

    @property
    def free(self) -> tuple[Cell, ...]:
        """Cells that are not obstacles, row by row from the bottom left."""
        return tuple((x, y) for y in range(self.height) for x in range(self.width) if (x, y) not in self.obstacles)

    def blocked(self, x: int, y: int) -> bool:
        """Whether the cell lies outside or is an obstacle."""
        for name, value in (("x", x), ("y", y)):
            _check.integer(name, value)
        return _blocked(x, y, self.width, self.height, self.obstacles)

    def crash(self, x: int, y: int, x_next: int, y_next: int) -> bool:
        """Whether the move between two neighboring cells hits something: its target, or a corner that it would cut."""
        for name, value in (("x", x), ("y", y), ("x_next", x_next), ("y_next", y_next)):
            _check.integer(name, value)
        return _crash(x, y, x_next, y_next, self.width, self.height, self.obstacles)

    def __str__(self) -> str:
        near = reachable(self.goal, self.width, self.height, self.obstacles)
        everywhere = len(self.starts) == len(HEADINGS) * (len(near) - 1)  # the default, which a drawing leaves out
        headings: dict[Cell, set[int]] = {}
        for pose in () if everywhere else self.starts:
            headings.setdefault((pose.x, pose.y), set()).add(pose.theta)
        arrows = {theta: c for c, theta in ARROWS.items()}

        def symbol(cell: Cell) -> str:
            if cell in headings:
                return arrows.get(min(headings[cell]), "S") if len(headings[cell]) == 1 else "S"
            return "G" if cell == self.goal else "#" if cell in self.obstacles else "."

        rows = ("".join(symbol((x, y)) for x in range(self.width)) for y in reversed(range(self.height)))
        return "\n".join(rows)

    def _cells(self, name: str, cells: Any) -> list[Cell]:
        expected = f"(x, y) inside the {self.width} x {self.height} grid"
        clean = []
        for cell in _check.items(name, cells, f"cells {expected}"):
            x, y = _check.cell(name, cell)
            if not (0 <= x < self.width and 0 <= y < self.height):
                _check.fail(name, expected, f"({x}, {y})")
            clean.append((x, y))
        return clean

    def _check_start(self, pose: Pose, near: set[Cell]) -> None:
        _check.instance("starts", pose, Pose)
        cell = (pose.x, pose.y)
        if self.blocked(*cell) or cell == self.goal:
            where = "the goal" if cell == self.goal else "an obstacle" if cell in self.obstacles else "outside the grid"
            _check.fail("starts", "free cells away from the goal", f"{cell}, {where}")
        if cell not in near:
            _check.fail("goal", f"reachable from the start {cell}", "no way between them", "Remove an obstacle.")


def reachable(cell: Cell, width: int, height: int, obstacles: frozenset[Cell]) -> set[Cell]:
    """Cells from which `cell` can be reached by moves to free neighbors, and itself."""
    reached, frontier = {cell}, [cell]
    while frontier:
        x, y = frontier.pop()
        for near in ((x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)):
            if near not in reached and not _crash(x, y, *near, width, height, obstacles):
                reached.add(near)
                frontier.append(near)
    return reached


def _blocked(x: int, y: int, width: int, height: int, obstacles: frozenset[Cell]) -> bool:
    return not (0 <= x < width and 0 <= y < height) or (x, y) in obstacles


def _crash(x: int, y: int, x_next: int, y_next: int, width: int, height: int, obstacles: frozenset[Cell]) -> bool:
    if _blocked(x_next, y_next, width, height, obstacles):
        return True
    diagonal = x != x_next and y != y_next
    corner = _blocked(x_next, y, width, height, obstacles) or _blocked(x, y_next, width, height, obstacles)
    return diagonal and corner


def _rows(drawing: str) -> list[str]:
    if not isinstance(drawing, str):
        _check.fail("drawing", "rows of text", f"{_check.show(drawing)} ({type(drawing).__name__})", kind=TypeError)
    rows = [row.strip() for row in drawing.strip().splitlines()]
    if not rows:
        _check.fail("drawing", f"rows of text ({DRAWN})", "an empty one")
    for i, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            _check.fail(
                "drawing", f"rows of {len(rows[0])} characters, as the first", f"{len(row)} in row {i}: {row!r}"
            )
        unknown = [c for c in row if c not in "#.GS" and c not in ARROWS]
        if unknown:
            _check.fail("drawing", f"made of {DRAWN}", f"{unknown[0]!r} in row {i}: {row!r}")
    return rows
