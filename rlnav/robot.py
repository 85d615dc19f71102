"""The robot: a cell, a heading, and a steering that turns it while it drives one cell ahead."""

from __future__ import annotations

import math
from dataclasses import dataclass

from . import _check

HEADINGS = tuple(range(0, 360, 45))
FARTHEST = 1_000_000  # cells from the origin


@dataclass(frozen=True, slots=True)
class Pose:
    """Hold where the robot is and where it looks.

    Parameters
    ----------
    x, y : int
        Cell; x grows to the right, y grows upwards.
    theta : int
        Heading in degrees, counter-clockwise from east, a multiple of 45; it is kept in 0 ... 315.

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.Pose(2, 3, -90)
    Pose(x=2, y=3, theta=270)
    """

    x: int
    y: int
    theta: int

    def __post_init__(self) -> None:
        theta = _check.integer("theta", self.theta)
        if theta % 45:
            _check.fail("theta", "a multiple of 45 degrees", str(theta))
        object.__setattr__(self, "x", _check.integer("x", self.x, -FARTHEST, FARTHEST))
        object.__setattr__(self, "y", _check.integer("y", self.y, -FARTHEST, FARTHEST))
        object.__setattr__(self, "theta", theta % 360)


@dataclass(frozen=True)
class Robot:
    """Describe a robot that drives one cell a step and can only choose how it turns, eq. :eq:`eq-kinematics`.

    Parameters
    ----------
    steering : sequence of int
        The turns it can choose, in degrees: different multiples of 45 from -180 to 180.  They are kept in ascending
        order; action a of every table is steering[a].
    slip : float
        Chance in [0, 1] that the steering comes out one notch off, half of it to each side.  At the ends of the
        steering set there is no further notch, and the robot turns as it was told.

    Raises
    ------
    TypeError, ValueError
        If the set is empty, repeats a turn or holds something else than multiples of 45.

    Examples
    --------
    >>> import rlnav as rl
    >>> robot = rl.Robot()
    >>> robot.move(rl.Pose(0, 0, 0), 90)
    Pose(x=1, y=1, theta=90)
    """

    steering: tuple[int, ...] = (-90, -45, 0, 45, 90)
    slip: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "steering", _steering_set(self.steering))
        object.__setattr__(self, "slip", _check.number("slip", self.slip, 0, 1))

    def move(self, pose: Pose, a: int) -> Pose:
        """Drive one cell while turning by `a` degrees, and snap to the grid, eq. :eq:`eq-kinematics`.

        Parameters
        ----------
        pose : Pose
        a : int
            A turn of the steering set, in degrees.

        Returns
        -------
        Pose
            One of the eight neighboring cells, whether it is free or not.
        """
        _check.instance("pose", pose, Pose)
        if _check.integer("a", a) not in self.steering:
            _check.fail("a", f"one of the steerings {self.steering}", f"{a} degrees")
        direction = math.radians(pose.theta + a / 2)
        x = math.floor(pose.x + math.cos(direction) + 0.5)  # not round(), which takes halves to even numbers
        y = math.floor(pose.y + math.sin(direction) + 0.5)
        return Pose(x, y, pose.theta + a)

    def outcomes(self, a: int) -> tuple[tuple[int, float], ...]:
        """List what may come of action `a`: pairs of the steering that is applied and its probability.

        Parameters
        ----------
        a : int
            Index of the action.

        Returns
        -------
        tuple of (int, float)
            Steering in degrees and probability: as told, one notch lower, one notch higher.

        Examples
        --------
        >>> import rlnav as rl
        >>> rl.Robot(slip=0.2).outcomes(0)
        ((-90, 0.8), (-90, 0.1), (-45, 0.1))
        """
        last = len(self.steering) - 1
        a = _check.integer("a", a, 0, last)
        if self.slip == 0:
            return ((self.steering[a], 1.0),)
        notches = (a, max(a - 1, 0), min(a + 1, last))
        chances = (1 - self.slip, self.slip / 2, self.slip / 2)
        return tuple((self.steering[b], p) for b, p in zip(notches, chances, strict=True))


def _steering_set(steering: object) -> tuple[int, ...]:
    expected = "a set of different multiples of 45 degrees from -180 to 180, such as (-45, 0, 45)"
    turns = tuple(_check.integer("steering", a) for a in _check.items("steering", steering, expected))
    if not turns:
        _check.fail("steering", expected, "an empty set")
    for i, a in enumerate(turns):
        if a % 45 or abs(a) > 180:
            _check.fail("steering", expected, f"{a} at place {i}")
        if a in turns[:i]:
            _check.fail("steering", expected, f"{a} twice")
    return tuple(sorted(turns))
