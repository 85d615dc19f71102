"""Designs: what the robot is paid for (rewards) and what it perceives (state features).

A reward is a function of a `Transition`.  A feature is a named function of a pose with a fixed number of levels;
several of them make one table index by mixed radix, the same on every map.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from . import _check
from .robot import Pose, Robot
from .world import Cell, GridWorld


@dataclass(frozen=True, slots=True)
class Transition:
    """Hold what a reward designer sees of one step.

    Attributes
    ----------
    s : Pose
        Before the step.
    a : int
        The steering that was applied, in degrees.
    s_next : Pose
        After the step; the pose that the robot drove at if it crashed.
    crash, goal : bool
        How the episode ended, if it did.
    """

    s: Pose
    a: int
    s_next: Pose
    crash: bool
    goal: bool


Reward = Callable[[Transition], float]
Potential = Callable[[Pose], float]


# ---------------------------------------------------------------- rewards
@dataclass(frozen=True)
class Payment:
    """Pay for how a step ends: the reward of the book unless a chapter says otherwise.

    Parameters
    ----------
    goal, crash, step : float
        Reward of entering the goal, of a crash, and of every other step.
    turn : float
        Added to every step for each 90 degrees of turning.

    Examples
    --------
    >>> import rlnav as rl
    >>> t = rl.Transition(rl.Pose(0, 0, 0), 90, rl.Pose(1, 1, 90), crash=False, goal=False)
    >>> rl.designs.Payment(step=-1, turn=-0.5)(t)
    -1.5
    """

    goal: float = 10.0
    crash: float = -10.0
    step: float = -0.1
    turn: float = 0.0

    def __post_init__(self) -> None:
        for name in ("goal", "crash", "step", "turn"):
            object.__setattr__(self, name, _check.number(name, getattr(self, name)))

    def __call__(self, t: Transition) -> float:
        """Return the reward of a transition."""
        end = self.goal if t.goal else self.crash if t.crash else self.step
        return end + self.turn * abs(t.a) / 90


@dataclass(frozen=True)
class Progress:
    """Pay for every cell by which the robot comes closer, and charge for every cell by which it goes away.

    Parameters
    ----------
    goal : (int, int)
    weight : float
        Reward for one cell of distance.
    only_closer : bool
        Do not charge for going away: a classic mistake, because circling then pays for ever.
    """

    goal: Cell
    weight: float = 1.0
    only_closer: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "goal", _check.cell("goal", self.goal))
        object.__setattr__(self, "weight", _check.number("weight", self.weight))
        _check.instance("only_closer", self.only_closer, bool)

    def __call__(self, t: Transition) -> float:
        """Return the reward of a transition."""
        gain = distance(t.s, self.goal) - distance(t.s_next, self.goal)
        return self.weight * (max(gain, 0.0) if self.only_closer else gain)


@dataclass(frozen=True)
class Shaped:
    """Add potential-based shaping to a reward, eq. :eq:`eq-shaping`: r + gamma Phi(s') - Phi(s).

    The potential of an ended episode is zero, so that the optimal policy stays what it was.

    Parameters
    ----------
    reward : function of a Transition
    potential : function of a Pose
    gamma : float
        The discount factor of the task; with another one the guarantee is lost.

    References
    ----------
    Ng, Harada and Russell, Policy invariance under reward transformations, ICML 1999.
    """

    reward: Reward
    potential: Potential
    gamma: float

    def __post_init__(self) -> None:
        _check.function("reward", self.reward, "reward(transition)")
        _check.function("potential", self.potential, "potential(pose)")
        object.__setattr__(self, "gamma", _check.number("gamma", self.gamma, 0, 1))

    def __call__(self, t: Transition) -> float:
        """Return the reward of a transition."""
        after = 0.0 if t.crash or t.goal else self.potential(t.s_next)
        return self.reward(t) + self.gamma * after - self.potential(t.s)


@dataclass(frozen=True)
class Nearness:
    """Hold a potential for `Shaped` that grows towards the goal: Phi(s) = -weight times the straight distance.

    Parameters
    ----------
    goal : (int, int)
    weight : float
        Potential that one cell is worth.

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.designs.Nearness(goal=(3, 4), weight=2)(rl.Pose(0, 0, 0))
    -10.0
    """

    goal: Cell
    weight: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "goal", _check.cell("goal", self.goal))
        object.__setattr__(self, "weight", _check.number("weight", self.weight))

    def __call__(self, pose: Pose) -> float:
        """Return the potential of a pose."""
        return -self.weight * distance(pose, self.goal)


@dataclass(frozen=True)
class Total:
    """Pay the sum of several rewards.

    Examples
    --------
    >>> import rlnav as rl
    >>> reward = rl.designs.Total(rl.designs.Payment(), rl.designs.Progress(goal=(3, 0)))
    >>> round(reward(rl.Transition(rl.Pose(0, 0, 0), 0, rl.Pose(1, 0, 0), crash=False, goal=False)), 9)
    0.9
    """

    rewards: tuple[Reward, ...]

    def __init__(self, *rewards: Reward) -> None:
        for reward in rewards:
            _check.function("rewards", reward, "reward(transition)")
        object.__setattr__(self, "rewards", rewards)

    def __call__(self, t: Transition) -> float:
        """Return the reward of a transition."""
        return math.fsum(reward(t) for reward in self.rewards)


def distance(pose: Pose, goal: Cell) -> float:
    """Straight distance from a pose to a cell, in cells."""
    _check.instance("pose", pose, Pose)
    goal = _check.cell("goal", goal)
    return math.sqrt((goal[0] - pose.x) ** 2 + (goal[1] - pose.y) ** 2)


# ---------------------------------------------------------------- state features
@dataclass(frozen=True)
class Feature:
    """Name one thing that the robot perceives.

    Parameters
    ----------
    name : str
    levels : int, or function levels(world, robot) -> int
        How many values it can take.
    of : function of(pose, world, robot) -> int
        The value at a pose, in 0 ... levels - 1.
    made_by : tuple, optional
        For the features of this module: the function that made it and its argument, as ("goal_bearing", 8).

    Examples
    --------
    >>> import rlnav as rl
    >>> upper_half = rl.Feature("upper half", 2, lambda pose, world, robot: int(2 * pose.y >= world.height))
    >>> upper_half
    Feature('upper half')
    """

    name: str
    levels: int | Callable[[GridWorld, Robot], int]
    of: Callable[[Pose, GridWorld, Robot], int]
    made_by: tuple = ()

    def __post_init__(self) -> None:
        _check.instance("name", self.name, str)
        _check.function("of", self.of, "of(pose, world, robot)")
        if not callable(self.levels):
            object.__setattr__(self, "levels", _check.integer("levels", self.levels, 1))

    def __repr__(self) -> str:
        return f"Feature({self.name!r})"

    def size(self, world: GridWorld, robot: Robot) -> int:
        """Return the number of levels for this world and robot."""
        if callable(self.levels):
            name = f"levels of {self.name!r}"
            return _check.integer(name, _check.called(name, self.levels, world, robot), 1)
        return self.levels

    def level(self, pose: Pose, world: GridWorld, robot: Robot) -> int:
        """Return the level at a pose, checked."""
        level, size = _check.called(self.name, self.of, pose, world, robot), self.size(world, robot)
        return level if type(level) is int and 0 <= level < size else self._refuse(level, size, pose)

    def _refuse(self, level: object, size: int, pose: Pose) -> int:
        return _check.integer(f"{self.name} at {pose}", level, 0, size - 1)


def _sign(d: int) -> int:
    return (d > 0) - (d < 0)


def _bearing(pose: Pose, goal: Cell, sectors: int) -> int:
    """Sector of the direction to the goal seen from the robot: 0 is straight ahead, counter-clockwise."""
    ahead = math.degrees(math.atan2(goal[1] - pose.y, goal[0] - pose.x)) - pose.theta
    return math.floor(ahead / (360 / sectors) + 0.5) % sectors


def _crashes(pose: Pose, world: GridWorld, robot: Robot) -> int:
    bits = 0
    for i, a in enumerate(robot.steering):
        target = robot.move(pose, a)
        bits += world.crash(pose.x, pose.y, target.x, target.y) << i
    return bits


def cell() -> Feature:
    """Perceive the absolute cell, without the heading."""
    return Feature(
        "cell", lambda world, _: world.width * world.height, lambda p, world, _: p.y * world.width + p.x, ("cell",)
    )


def heading() -> Feature:
    """Perceive the heading, eight levels."""
    return Feature("heading", 8, lambda pose, world, robot: pose.theta // 45, ("heading",))


def goal_direction() -> Feature:
    """Perceive the signs of dx and dy to the goal: nine levels."""

    def of(pose: Pose, world: GridWorld, robot: Robot) -> int:
        return 3 * (_sign(world.goal[1] - pose.y) + 1) + _sign(world.goal[0] - pose.x) + 1

    return Feature("goal direction", 9, of, ("goal_direction",))


def goal_bearing(sectors: int = 8) -> Feature:
    """Perceive where the goal is as seen from the robot, in equal sectors around it; sector 0 is straight ahead."""
    n = _check.integer("sectors", sectors, 2, 360)
    return Feature("goal bearing", n, lambda p, world, _: _bearing(p, world.goal, n), ("goal_bearing", n))


def goal_distance(bins: tuple[float, ...] = (1.5, 3.0, 6.0)) -> Feature:
    """Perceive in which bin the straight distance to the goal lies; `bins` are the ascending limits, in cells."""
    limits = tuple(_check.number("bins", b, 0) for b in _check.items("bins", bins, "ascending distances"))
    if not limits or any(b <= a for a, b in pairwise(limits)):
        _check.fail("bins", "ascending distances", _check.show(bins))
    made_by = ("goal_distance", limits)
    return Feature(
        "goal distance", len(limits) + 1, lambda p, world, _: sum(distance(p, world.goal) > b for b in limits), made_by
    )


def moves_ahead() -> Feature:
    """Perceive which of the moves would crash: one bit an action."""
    return Feature("moves ahead", lambda _, robot: 2 ** len(robot.steering), _crashes, ("moves_ahead",))


def table_rows(features: tuple[Feature, ...], world: GridWorld, robot: Robot) -> int:
    """Count the situations that the features can tell apart on paper: the product of their levels."""
    return math.prod(feature.size(world, robot) for feature in features)
