"""Maps of the book, as drawings for `GridWorld.from_ascii`, and random ones."""

from __future__ import annotations

import numpy as np

from . import _check
from .world import LARGEST, Cell, GridWorld, reachable

FREE_SPACE = """
..........
..........
.......G..
..........
..........
..........
..........
..S.......
..........
..........
"""

OBSTACLES = """
..........
.......#G.
..##...#..
...#...#..
...#......
.....##...
.##...#...
..........
.S...#....
..........
"""

ROOMS = """
.....#.....
.....#..G..
...........
.....#.....
.....#.....
#.####.....
.....###.##
.....#.....
.S...#.....
...........
.....#.....
"""

CORRIDOR = """
############
#..........#
#.########.#
#.########.#
#^########G#
############
"""

MAZE = """
.......#...
.####..#.#.
.#..#....#.
.#..#.####.
.#.##......
.#......##.
.########..
.........#.
.#######.#G
^..........
"""

CLIFF = """
............
............
............
^##########G
"""

NAMES = ("FREE_SPACE", "OBSTACLES", "ROOMS", "CORRIDOR", "MAZE", "CLIFF")


def random(width: int, height: int | None = None, *, density: float = 0.2, rng: object = None) -> GridWorld:
    """Draw a world whose cells are obstacles with a given chance, and put the goal into its largest open region.

    Parameters
    ----------
    width, height : int
        Number of cells along x and y; a square if only `width` is given.
    density : float
        Chance in [0, 0.8] that a cell is an obstacle.
    rng : None, int or numpy.random.Generator
        Where chance comes from.

    Returns
    -------
    GridWorld
        It starts from every pose with a way to the goal.

    Examples
    --------
    >>> import rlnav as rl
    >>> print(rl.maps.random(8, 3, density=0.3, rng=1))
    #.##.#.G
    .#......
    ..#.....
    """
    width = _check.integer("width", width, 2, LARGEST)
    height = width if height is None else _check.integer("height", height, 2, LARGEST)
    density = _check.number("density", density, 0, 0.8)
    generator = _check.generator(rng)
    region: list[Cell] = []
    while len(region) < 2:
        luck = generator.random((height, width))
        obstacles = frozenset((int(x), int(y)) for y, x in np.argwhere(luck < density))
        region = _largest_region(width, height, obstacles)
    goal = region[int(generator.random() * len(region))]
    return GridWorld(width, height, goal, obstacles)


def _largest_region(width: int, height: int, obstacles: frozenset[Cell]) -> list[Cell]:
    left = {(x, y) for x in range(width) for y in range(height)} - obstacles
    largest: set[Cell] = set()
    while left:
        region = reachable(next(iter(left)), width, height, obstacles)
        left -= region
        largest = max(largest, region, key=lambda cells: (len(cells), min(cells, default=(0, 0))))
    return sorted(largest)
