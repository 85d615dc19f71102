"""The live backup diagram: where the value of a pose comes from (chapter 5)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import ArrayLike, NDArray

from .. import plot
from .._check import instance, integer, items, number
from ..mdp import MDP, action_values, epsilon_greedy
from ..planning import solve
from ..prediction import evaluate_policy
from ..robot import Pose
from ..rollouts import Episode
from ..task import Task
from . import _scenario
from ._problem import TaskExplorable, turn_text

DIAGRAMS = ("v_pi", "q_pi", "v_star", "q_star")
POLICIES = {"random": "the random policy", "epsilon_greedy": "the epsilon-greedy policy", "own": "the given policy"}


class BackupDiagram(TaskExplorable):
    """Show from where the value of a pose is backed up, with its real numbers.

    Parameters
    ----------
    task : Task
    pose : Pose, optional
        The root of the diagram; by default the first start pose of the task.
    policy : int array [S] or float array [S, A], optional
        The policy of the diagrams of v_pi and q_pi; by default a uniformly random one.
    diagram : str
        "v_pi", "q_pi" (expectation), "v_star" or "q_star" (max).
    action : int, optional
        The action at the root of the diagrams of q; by default the one that turns least.
    epsilon : float
        Of the epsilon-greedy policy that the reader may choose.

    Raises
    ------
    TypeError, ValueError
        If `pose` is no pose of the task, `policy` no policy of it, or another argument out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"), rl.Robot(slip=0.1))
    >>> live = rl.widgets.BackupDiagram(task, rl.Pose(1, 0, 0), diagram="v_star")
    >>> live.state["pose"]
    [1, 0, 0]
    """

    entry = "explorables/backup_diagram"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "pose": None,
        "diagram": "v_pi",
        "action": 2,
        "policy": "random",
        "epsilon": 0.2,
    }

    def __init__(
        self,
        task: Task,
        pose: Pose | None = None,
        policy: ArrayLike | None = None,
        *,
        diagram: str = "v_pi",
        action: int | None = None,
        epsilon: float = 0.2,
    ) -> None:
        steering = instance("task", task, Task).robot.steering
        pose = task.world.starts[0] if pose is None else instance("pose", pose, Pose)
        state = {
            "pose": [pose.x, pose.y, pose.theta],
            "diagram": diagram,
            "action": min(range(len(steering)), key=lambda a: abs(steering[a])) if action is None else action,
            "policy": "random" if policy is None else "own",
            "epsilon": epsilon,
        }
        super().__init__(task, policy, state)

    @property
    def pose(self) -> Pose:
        """The pose at the root."""
        return Pose(*self.state["pose"])

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario and a pose on a free cell."""
        state = super().checked(state)
        task = _scenario.task_of(state["scenario"], self._own)
        pose = task.world.starts[0] if state["pose"] is None else Pose(*items("pose", state["pose"], "[x, y, theta]"))
        task.index(pose)
        _scenario.one_of("diagram", state["diagram"], DIAGRAMS)
        _scenario.one_of(
            "policy", state["policy"], [name for name in POLICIES if name != "own" or self._policy is not None]
        )
        return {
            **state,
            "pose": [pose.x, pose.y, pose.theta],
            "action": integer("action", state["action"], 0, len(task.robot.steering) - 1),
            "epsilon": number("epsilon", state["epsilon"], 0, 1),
        }

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        kind, pose = self.state["diagram"].replace("_", " "), self.pose
        place = f"({pose.x}, {pose.y}), heading {pose.theta} degrees"
        return f"Map with the robot at {place}, and the backup diagram of {kind}."

    def still(self) -> Any:
        """Draw the map with the pose, and its diagram with all numbers."""
        task, diagram = self.task, self.state["diagram"]
        mdp, root = task.mdp(), task.index(self.pose)
        pi = None if diagram.endswith("star") else self._probabilities(mdp)
        V = solve(mdp, tol=1e-10).V if pi is None else evaluate_policy(mdp, pi)
        tree = _Tree(task, mdp, action_values(mdp, V), V, pi)
        numbers = tree.of_action(root, self.state["action"]) if diagram.startswith("q") else tree.of_state(root)
        figure, (map_, below) = plt.subplots(2, 1, figsize=(8.4, 6.2), layout="constrained", height_ratios=(1.1, 1))
        plot.values(task, V, map_)
        standing = Episode(np.array([root]), np.array([], np.int64), np.array([]), bool(mdp.terminal[root]))
        plot.path(task, standing, map_)
        plot.backup_diagram(diagram, below, numbers=numbers)
        return figure, self._words(numbers[0])

    def _words(self, value: float) -> str:
        pose, scenario = self.pose, self.state["scenario"]
        whose = "the best policy" if self.state["diagram"].endswith("star") else POLICIES[self.state["policy"]]
        return (
            f"At ({pose.x}, {pose.y}), heading {pose.theta}°, under {whose}: {value:.4g}. ".replace("-", "−")
            + f"Discount {scenario['gamma']:g}, slip {scenario['slip']:g}."
        )

    def _probabilities(self, mdp: MDP) -> NDArray[np.float64]:
        if self.state["policy"] == "epsilon_greedy":
            return epsilon_greedy(solve(mdp, tol=1e-10).Q, self.state["epsilon"])
        return self._policy if self._policy is not None else np.full((mdp.S, mdp.A), 1 / mdp.A)


class _Tree:
    """Write the numbers of a diagram as `rl.plot.backup_diagram` takes them."""

    def __init__(self, task: Task, mdp: MDP, Q: NDArray, V: NDArray, pi: NDArray | None) -> None:
        self.task, self.mdp, self.Q, self.V, self.pi = task, mdp, Q, V, pi

    def of_state(self, s: int, deep: bool = True) -> tuple[float, list[Any]]:
        actions = [] if self.mdp.terminal[s] else reversed(range(self.mdp.A))  # left turns at the left
        return float(self.V[s]), [self._action(s, a, deep) for a in actions]

    def of_action(self, s: int, a: int, deep: bool = True) -> tuple[float, list[Any]]:
        return float(self.Q[s, a]), [self._state(p, r, to, deep) for to, r, p in self._successors(s, a)]

    def _action(self, s: int, a: int, deep: bool) -> tuple[Any, ...]:
        turn = turn_text(self.task.robot.steering[a])
        edge = turn if self.pi is None else f"{turn}\n{self.pi[s, a]:.3g}"
        return (edge, *self.of_action(s, a, False)) if deep else (edge, float(self.Q[s, a]))

    def _state(self, p: float, r: float, to: int, deep: bool) -> tuple[Any, ...]:
        edge = f"{p:.3g}\n{r:g}".replace("-", "−")
        return (edge, *self.of_state(to, False)) if deep else (edge, float(self.V[to]))

    def _successors(self, s: int, a: int) -> list[tuple[int, float, float]]:
        """List what may follow as (state, reward, probability), left turns first; equal ones count together."""
        turns = [turn for turn, _ in self.task.robot.outcomes(a)]
        chances: dict[tuple[int, float], float] = {}
        for k in sorted(range(len(turns)), key=lambda k: -turns[k]):
            follows = int(self.mdp.next_state[s, a, k]), float(self.mdp.reward[s, a, k])
            if (p := float(self.mdp.prob[s, a, k])) > 0:
                chances[follows] = chances.get(follows, 0.0) + p
        return [(to, r, p) for (to, r), p in chances.items()]
