"""Two roads that merge: what Monte Carlo and TD(0) make of the same recorded drives (chapter 10)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from .. import plot
from .._check import fail, instance, integer, items, number
from ..estimation import mc_prediction, td_prediction
from ..mdp import MDP
from ..prediction import evaluate_policy
from ..rollouts import Episode, returns, rollout
from ..task import Task
from . import _scenario
from ._problem import TaskExplorable

MOST_DRIVES = 60


class MergingPaths(TaskExplorable):
    """Play recorded drives one by one, and watch what Monte Carlo and TD(0) learn from them, side by side.

    Parameters
    ----------
    task : Task
        A world with two or more start poses, the roads. The policy should come to each cell with one heading only,
        because the maps show one value a cell.
    policy : int array [S] or float array [S, A]
        Who drives.
    drives : sequence of int
        The road of each recorded drive: 0 for the first start pose, 1 for the second. Drive i is
        ``rollout(mdp, policy, start=mdp.start[drives[i]], rng=seed + i)``. The reader may add more.
    shown : int
        How many of them are learned from at first.
    alpha : float
        Step size in (0, 1].
    batch : bool
        Whether all drives so far are learned from again and again, until nothing changes, instead of each of them once.
    seed : int

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the task is not as described above.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">.G.<"), rl.Robot((-90, 0, 90)))
    >>> roads = rl.widgets.MergingPaths(task, rl.solve(task.mdp()).pi, drives=[0, 1], shown=1, alpha=0.5)
    >>> float(roads.V_mc[task.index(rl.Pose(1, 0, 0))])
    5.0
    """

    entry = "explorables/merging_paths"
    defaults = {"scenario": _scenario.DEFAULTS, "drives": [], "shown": 0, "alpha": 0.5, "batch": False}  # noqa: RUF012

    def __init__(
        self,
        task: Task,
        policy: ArrayLike,
        *,
        drives: Sequence[int],
        shown: int = 0,
        alpha: float = 0.5,
        batch: bool = False,
        seed: int = 0,
    ) -> None:
        if policy is None:
            fail("policy", "one action a state, or probabilities", "None", kind=TypeError)
        state = {"drives": drives, "shown": shown, "alpha": alpha, "batch": batch}
        super().__init__(task, policy, state, seed=seed)
        _check_roads(self.task, self._probabilities)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, and drives on roads that there are."""
        state = super().checked(state)
        roads = _scenario.task_of(state["scenario"], self._own).mdp().start.size
        given = items("drives", state["drives"], "numbers of roads")
        drives = [integer("drives", road, 0, roads - 1) for road in given]
        if len(drives) > MOST_DRIVES:
            fail("drives", f"at most {MOST_DRIVES} drives", str(len(drives)))
        shown = integer("shown", state["shown"], 0, len(drives))
        alpha = number("alpha", state["alpha"], 0, 1, above=True)
        batch = instance("batch", state["batch"], bool)
        return {**state, "drives": drives, "shown": shown, "alpha": alpha, "batch": batch}

    @property
    def _probabilities(self) -> NDArray[np.float64]:
        assert self._policy is not None  # it is an argument that has no default
        return self._policy

    def episodes(self) -> list[Episode]:
        """Play the drives that are learned from."""
        state, mdp = self.state, self.task.mdp()
        seed, max_steps = (state["scenario"][name] for name in ("seed", "max_steps"))
        starts = mdp.start[state["drives"][: state["shown"]]]
        settings = {"max_steps": max_steps}
        return [rollout(mdp, self._probabilities, start=s, **settings, rng=seed + i) for i, s in enumerate(starts)]

    @property
    def V_mc(self) -> NDArray[np.float64]:
        """The values of all states that Monte Carlo has learned."""
        return self._values(mc_prediction, _mean_returns)

    @property
    def V_td(self) -> NDArray[np.float64]:
        """The values of all states that TD(0) has learned."""
        return self._values(td_prediction, _values_in_what_was_seen)

    def _values(self, predict: Any, rest: Any) -> NDArray[np.float64]:
        state, mdp = self.state, self.task.mdp()
        V: NDArray[np.float64] = np.zeros(mdp.S)
        if state["batch"]:
            return rest(mdp, self.episodes()) if state["shown"] else V
        seed, max_steps = (state["scenario"][name] for name in ("seed", "max_steps"))
        settings = {"episodes": 1, "alpha": state["alpha"], "max_steps": max_steps}
        for i, road in enumerate(state["drives"][: state["shown"]]):
            here = replace(mdp, start=mdp.start[[road]])
            V = predict(here, self._probabilities, **settings, V0=V, rng=seed + i).V
        return V

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        how = "learned from again and again" if self.state["batch"] else "learned from once"
        drives = f"{self.state['shown']} drives, each {how}"
        return f"Map of the roads, and for each road the values of its poses after {drives}: Monte Carlo, TD and exact."

    def still(self) -> Any:
        """Draw the roads, and the values along each of them."""
        task, mdp, episodes = self.task, self.task.mdp(), self.episodes()
        count = mdp.start.size
        figure, axes = plt.subplots(1, 1 + count, figsize=(2.6 + 2.4 * count, 3.2), layout="constrained", squeeze=False)
        if episodes:
            plot.path(task, episodes[-1], axes[0, 0])
        else:
            plot.world(task, axes[0, 0])
        tables = {"Monte Carlo": (self.V_mc, "C0o--"), "TD(0)": (self.V_td, "C1s-.")}
        tables["exact"] = (evaluate_policy(mdp, self._probabilities), "k-")
        likely = np.asarray(self._probabilities.argmax(axis=1))
        for road, ax in enumerate(axes[0, 1:]):
            way = rollout(mdp, likely, start=int(mdp.start[road]), max_steps=30, rng=0).states[:-1]
            _draw_road(ax, [(name, V[way], line) for name, (V, line) in tables.items()])
            pose = task.pose(int(mdp.start[road]))
            ax.set_title(f"from ({pose.x}, {pose.y})" if pose else "")
        axes[0, 1].set_ylabel("value")
        axes[0, -1].legend(loc="lower right", fontsize=8)
        how = "again and again" if self.state["batch"] else "once"
        return figure, f"{len(episodes)} of {len(self.state['drives'])} recorded drives, learned from {how}."


def _draw_road(ax: Axes, lines: list[tuple[str, NDArray[np.float64], str]]) -> None:
    for name, V, line in lines:
        ax.plot(V, line, label=name, markersize=4, linewidth=1.3)
    ax.set(xlabel="steps from the start", ylim=(-10.5, 10.5))


def _mean_returns(mdp: MDP, episodes: list[Episode]) -> NDArray[np.float64]:
    """Monte Carlo at rest: the mean of all returns that followed a state."""
    total, count = np.zeros(mdp.S), np.zeros(mdp.S)
    for episode in episodes:
        np.add.at(total, episode.states[:-1], returns(episode.rewards, mdp.gamma))
        np.add.at(count, episode.states[:-1], 1)
    return np.divide(total, count, out=np.zeros(mdp.S), where=count > 0)


def _values_in_what_was_seen(mdp: MDP, episodes: list[Episode]) -> NDArray[np.float64]:
    """TD(0) at rest: the values in the model in which the shares of what was seen are the probabilities."""
    seen: list[dict[tuple[int, float], int]] = [{} for _ in range(mdp.S)]
    for episode in episodes:
        for s, r, s_next in zip(episode.states[:-1], episode.rewards, episode.states[1:], strict=True):
            key = int(s_next), float(r)
            seen[s][key] = seen[s].get(key, 0) + 1
    K = max(max(map(len, seen)), 1)
    next_state = np.repeat(np.arange(mdp.S, dtype=np.int32), K).reshape(mdp.S, 1, K)
    prob, reward = np.zeros((mdp.S, 1, K)), np.zeros((mdp.S, 1, K))
    prob[:, 0, 0] = 1  # where nothing was seen, nothing follows
    for s, row in enumerate(seen):
        for k, ((s_next, r), n) in enumerate(row.items()):
            next_state[s, 0, k], prob[s, 0, k], reward[s, 0, k] = s_next, n / sum(row.values()), r
    terminal = np.array([not row for row in seen])
    model = MDP(next_state, prob, reward, mdp.gamma, terminal, episodes[0].states[:1])
    return evaluate_policy(model, np.zeros(mdp.S, int))


def _check_roads(task: Task, policy: NDArray[np.float64]) -> None:
    """Refuse a task without two roads, or a policy that comes to a cell with two headings."""
    mdp = task.mdp()
    if mdp.start.size < 2:
        fail("task", "a task with at least two start poses", f"{mdp.start.size}")
    chance = (policy[:, :, None] * mdp.prob).reshape(mdp.S, -1) > 0
    following = mdp.next_state.reshape(mdp.S, -1)
    found, new = set(mdp.start.tolist()), set(mdp.start.tolist())
    while new:
        new = {int(s) for old in new for s in following[old][chance[old]] if not mdp.terminal[s]} - found
        found |= new
    headings: dict[tuple[int, int], int] = {}
    for pose in (task.pose(s) for s in sorted(found)):
        if pose and headings.setdefault((pose.x, pose.y), pose.theta) != pose.theta:
            advice = "The maps show one value a cell."
            got = f"headings {headings[pose.x, pose.y]} and {pose.theta} in cell ({pose.x}, {pose.y})"
            fail("policy", "one that comes to each cell with one heading", got, advice)
