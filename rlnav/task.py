"""A navigation task: this robot in that world, with a reward and features by design, as an MDP."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _check
from .designs import Feature, Payment, Reward, Transition, table_rows
from .mdp import MDP
from .robot import HEADINGS, Pose, Robot
from .world import GridWorld

MOST_ROWS = 10_000_000


@dataclass(frozen=True)
class Task:
    """Put a robot into a world and say what it is paid for and what it perceives.

    The states of its MDP are the poses on free cells, cell by cell from the bottom left, eight headings each, and one
    last state, "crashed".  Poses on the goal are terminal too.

    Parameters
    ----------
    world : GridWorld
    robot : Robot
    reward : function reward(transition) -> float
        By default +10 for the goal, -10 for a crash, -0.1 for every other step.
    features : Feature, sequence of Features, or function features(pose) -> int, optional
        What the learner perceives.  By default the whole pose: one row of the table for each state.
    gamma : float
        Discount factor in [0, 1].

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii("S.G"), rl.Robot())
    >>> task.mdp()
    MDP(25 states, 5 actions, 1 successor, gamma=0.95)
    >>> task.pose(8)
    Pose(x=1, y=0, theta=0)
    """

    world: GridWorld
    robot: Robot = Robot()
    reward: Reward = Payment()
    features: Any = None
    gamma: float = 0.95

    def __post_init__(self) -> None:
        _check.instance("world", self.world, GridWorld)
        _check.instance("robot", self.robot, Robot)
        _check.function("reward", self.reward, "reward(transition)")
        object.__setattr__(self, "features", _features(self.features))
        object.__setattr__(self, "gamma", _check.number("gamma", self.gamma, 0, 1))

    @cached_property
    def poses(self) -> tuple[Pose, ...]:
        """The pose of every state but the last, which is the crash."""
        return tuple(Pose(x, y, theta) for x, y in self.world.free for theta in HEADINGS)

    @cached_property
    def _index(self) -> dict[Pose, int]:
        return {pose: s for s, pose in enumerate(self.poses)}

    @property
    def crashed(self) -> int:
        """The state of a robot that has crashed."""
        return len(self.poses)

    def pose(self, s: int) -> Pose | None:
        """Return the pose of state `s`, or None for the crashed robot, which has none."""
        s = _check.integer("s", s, 0, self.crashed)
        return None if s == self.crashed else self.poses[s]

    def index(self, pose: Pose) -> int:
        """Return the state of a pose on a free cell."""
        _check.instance("pose", pose, Pose)
        if pose not in self._index:
            _check.fail("pose", "on a free cell", f"{pose}", "The cell is an obstacle or outside the grid.")
        return self._index[pose]

    def transition(self, pose: Pose, a: int) -> Transition:
        """Return what happens when the steering of `a` degrees is applied at a pose."""
        target = self.robot.move(pose, a)
        crash = self.world.crash(pose.x, pose.y, target.x, target.y)
        return Transition(pose, a, target, crash, not crash and (target.x, target.y) == self.world.goal)

    def mdp(self) -> MDP:
        """Build the exact model over poses, eq. :eq:`eq-dynamics`.

        Returns
        -------
        MDP
            With one successor for each action, or three if the robot slips.

        Raises
        ------
        ValueError
            If the reward function raises, or returns something else than a finite number.
        """
        to, gain = self._applied()
        column = {a: i for i, a in enumerate(self.robot.steering)}
        outcomes = [self.robot.outcomes(a) for a in range(len(self.robot.steering))]
        applied = np.array([[column[a] for a, _ in row] for row in outcomes])
        chance = np.array([[p for _, p in row] for row in outcomes])
        terminal = np.array([(pose.x, pose.y) == self.world.goal for pose in self.poses] + [True])
        start = np.array([self._index[pose] for pose in self.world.starts])
        goal = terminal.copy()
        goal[self.crashed] = False
        prob = np.broadcast_to(chance, (len(to), *chance.shape))
        return MDP(to[:, applied], prob, gain[:, applied], self.gamma, terminal, start, goal)

    def phi(self) -> NDArray[np.int64]:
        """Tabulate what the learner perceives in each state: z = phi[s].

        Returns
        -------
        phi : int array [S]
            The row of the table.  With features the last row stands for every ended episode, so that a table has the
            same shape on every map.

        Raises
        ------
        ValueError
            If a feature raises or leaves its levels.
        """
        if self.features is None:
            return np.arange(self.crashed + 1)
        if isinstance(self.features, tuple):
            over = table_rows(self.features, self.world, self.robot)
            if over > MOST_ROWS:
                _check.fail("features", f"a table of at most {MOST_ROWS:,} rows", f"{over:,}", "Perceive less.")
            rows = [self._row(pose) for pose in self.poses]
        else:
            rows = [self._own_row(pose) for pose in self.poses]
            over = max(rows) + 1
        ended = [(pose.x, pose.y) == self.world.goal for pose in self.poses]
        return np.array([over if end else z for z, end in zip(rows, ended, strict=True)] + [over])

    def _row(self, pose: Pose) -> int:
        """Mixed-radix number of the features' levels."""
        z = 0
        for feature in self.features:
            z = z * feature.size(self.world, self.robot) + feature.level(pose, self.world, self.robot)
        return z

    def _own_row(self, pose: Pose) -> int:
        z = _check.called("features", self.features, pose)
        return _check.integer(f"features at {pose}", z, 0, MOST_ROWS)

    def _applied(self) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Next state and reward of each steering that is applied, [S, A]."""
        to = np.full((self.crashed + 1, len(self.robot.steering)), self.crashed, np.int32)
        gain = np.zeros(to.shape)
        for s, pose in enumerate(self.poses):
            if (pose.x, pose.y) == self.world.goal:
                to[s] = s
                continue
            for i, a in enumerate(self.robot.steering):
                t = self.transition(pose, a)
                to[s, i] = self.crashed if t.crash else self._index[t.s_next]
                gain[s, i] = self._pay(t)
        return to, gain

    def _pay(self, t: Transition) -> float:
        r = _check.called("reward", self.reward, t)
        return r if type(r) is float and math.isfinite(r) else _check.number(f"reward at {t}", r)


def _features(features: object) -> object:
    if features is None or isinstance(features, Feature):
        return None if features is None else (features,)
    if not callable(features):
        features = _check.items("features", features, "features(pose), a Feature or a list of Features")
        for feature in features:
            _check.instance("features", feature, Feature)
        if not features:
            _check.fail("features", "at least one Feature, or None for the whole pose", "none")
    return features
