"""Step sizes and their two sums, and what they make of one noisy entry or of a whole table (chapter 12)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .._check import fail, integer, number
from ..learning import learn, q_learning_rule
from ..mdp import MDP
from ..planning import solve
from ..robot import Pose
from ..task import Task
from . import _scenario
from ._poses import listed, pose_of
from ._problem import TaskExplorable

KINDS = ("constant", "power", "linear", "halving")
WATCHED = {"entry": 1000, "table": 100}  # updates of each entry
SEEDS = {"entry": 8, "table": 4}
LONGEST = 1000  # updates until a schedule ends or halves
MOST_STATES = 1000
EXACT = 1e-12


class StepSizes(TaskExplorable):
    """Choose how step sizes shrink, and see both sums of Robbins and Monro beside what is learned with them.

    Parameters
    ----------
    task : Task
        The world in which a whole table is learned, by random steering.
    pose : Pose
        Together with `steering`, the one entry that is watched first: its targets use the exact values, so that the
        outcome of the step is all that is left to chance.
    steering : int
        In degrees.
    kind : str
        "constant": c; "power": c / n ** p; "linear": from c to 0 in `until` updates; "halving": c, halved after every
        `until` updates.
    c, p : float
        c in (0, 1], p in [0, 2].
    until : int
    watch : str
        "entry" or "table".
    shown : int
        Number of updates that are shown first; of the table, as many for each entry on average.
    seed : int
        Run i uses the seed ``seed + i``.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii("....G"), rl.Robot((-45, 0, 45), slip=0.2))
    >>> sizes = rl.widgets.StepSizes(task, rl.Pose(1, 0, 0), 0, kind="power", c=1, p=1)
    >>> sizes.step_sizes(4).round(3)
    array([1.   , 0.5  , 0.333, 0.25 ])
    """

    entry = "explorables/step_sizes"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "pose": [0, 0, 0],
        "steering": 0,
        "kind": "constant",
        "c": 0.5,
        "p": 1.0,
        "until": 200,
        "watch": "entry",
        "shown": 0,
    }

    def __init__(
        self,
        task: Task,
        pose: Pose,
        steering: int,
        *,
        kind: str = "constant",
        c: float = 0.5,
        p: float = 1.0,
        until: int = 200,
        watch: str = "entry",
        shown: int = 0,
        seed: int = 0,
    ) -> None:
        place = listed(pose)
        state = {"kind": kind, "c": c, "p": p, "until": until, "watch": watch, "shown": shown}
        super().__init__(task, None, {"pose": place, "steering": steering, **state}, seed=seed)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, an entry that there is, and settings in their ranges."""
        state = super().checked(state)
        task = _scenario.task_of(state["scenario"], self._own)
        if task.mdp().S > MOST_STATES:
            fail("task", f"a task of at most {MOST_STATES} states", str(task.mdp().S))
        pose = pose_of(state["pose"])
        task.index(pose)
        if state["steering"] not in task.robot.steering:
            options = ", ".join(map(str, task.robot.steering))
            fail("steering", f"one of {options}", str(state["steering"]))
        _scenario.one_of("kind", state["kind"], KINDS)
        _scenario.one_of("watch", state["watch"], WATCHED)
        return {
            **state,
            "pose": listed(pose),
            "c": number("c", state["c"], 0, 1, above=True),
            "p": number("p", state["p"], 0, 2),
            "until": integer("until", state["until"], 1, LONGEST),
            "shown": integer("shown", state["shown"], 0, WATCHED[state["watch"]]),
        }

    def step_sizes(self, n: int) -> NDArray[np.float64]:
        """Return the step sizes of the first n updates of an entry."""
        kind, c, p, until = (self.state[name] for name in ("kind", "c", "p", "until"))
        k = np.arange(1.0, n + 1)
        if kind == "constant":
            return np.full(n, c)
        if kind == "linear":
            return np.maximum(0, c * (1 - (k - 1) / until))
        return c / 2 ** ((k - 1) // until) if kind == "halving" else c / k**p

    def problem(self) -> tuple[MDP, float]:
        """Return the entry as a problem of its own, with one decision, and its exact value."""
        state, mdp = self.state, self.task.mdp()
        best = solve(mdp, tol=EXACT)
        s, a = self.task.index(Pose(*state["pose"])), self.task.robot.steering.index(state["steering"])
        targets = mdp.reward[s, a] + mdp.gamma * best.V[mdp.next_state[s, a]]
        end = np.eye(1, mdp.K)[0]
        prob = np.array([[mdp.prob[s, a]], [end]])
        reward = np.array([[targets], [np.zeros(mdp.K)]])
        following, flags = np.ones((2, 1, mdp.K), np.int32), np.array([False, True])
        return MDP(following, prob, reward, mdp.gamma, flags, np.array([0])), float(best.Q[s, a])

    def curves(self) -> tuple[NDArray[np.float64], float]:
        """Learn, and return [seeds, shown + 1] estimates of the entry, or mean errors of the table, and the truth."""
        watch, shown = self.state["watch"], self.state["shown"]
        if watch == "entry":
            model, truth = self.problem()
            every, measure = 1, lambda Q: float(Q[0, 0])
        else:
            model, truth = self.task.mdp(), 0.0
            live, exact = ~model.terminal, solve(model, tol=EXACT).Q
            every, measure = int(live.sum()) * model.A, lambda Q: float(np.abs(Q - exact)[live].mean())
        seeds = range(self.state["scenario"]["seed"], self.state["scenario"]["seed"] + SEEDS[watch])
        return np.array([self._curve(model, seed, every, shown, measure) for seed in seeds]), truth

    def _curve(self, model: MDP, seed: int, every: int, points: int, measure: Any) -> list[float]:
        found = [measure(np.zeros((model.S, model.A)))]
        if points == 0:
            return found
        N, sizes = np.zeros((model.S, model.A), int), self.step_sizes(every * points)
        left = every * points

        def rule(Q: NDArray, s: int, a: int, r: float, s_next: int, a_next: int, gamma: float, _: float) -> None:
            nonlocal left
            if left == 0:
                return
            N[s, a] += 1
            q_learning_rule(Q, s, a, r, s_next, a_next, gamma, sizes[N[s, a] - 1])
            left -= 1
            if left % every == 0:
                found.append(measure(Q))

        generator, Q = np.random.default_rng(seed), np.zeros((model.S, model.A))
        while left:
            Q = learn(model, rule, episodes=max(1, left // 8), epsilon=1.0, rng=generator, Q0=Q).Q
        return found

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        watched = "the estimate of one entry" if self.state["watch"] == "entry" else "the mean error of the table"
        return f"The sums of step sizes and of their squares, and {watched}, after {self.state['shown']} updates."

    def still(self) -> Any:
        """Draw both sums, and what is learned in all runs."""
        state = self.state
        shown = max(state["shown"], 1)
        sizes = self.step_sizes(shown)
        figure, (sums, learned) = plt.subplots(1, 2, figsize=(8.6, 3.2), layout="constrained")
        n = np.arange(1, shown + 1)
        sums.plot(n, sizes.cumsum(), "C0-", label="sum of α")
        sums.plot(n, (sizes**2).cumsum(), "C1--", label="sum of α²")
        sums.set(xlabel="updates", ylim=(0, None))
        sums.legend()
        values, truth = self.curves()
        _draw_runs(learned, values, truth, state["watch"])
        return figure, f"{state['shown']} updates with step sizes that are {self._in_words()}."

    def _in_words(self) -> str:
        kind, c, p, until = (self.state[name] for name in ("kind", "c", "p", "until"))
        return {
            "constant": f"constant, {c:g}",
            "power": f"{c:g} / n^{p:g}",
            "linear": f"linear, from {c:g} to 0 in {until} updates",
            "halving": f"{c:g}, halved after every {until} updates",
        }[kind]


def _draw_runs(ax: Axes, values: NDArray[np.float64], truth: float, watch: str) -> None:
    n = np.arange(values.shape[1])
    ax.fill_between(n, values.min(axis=0), values.max(axis=0), alpha=0.25, label=f"{len(values)} runs")
    ax.plot(n, values.mean(axis=0), "C0-", label="their mean")
    if watch == "entry":
        ax.axhline(truth, color="black", linewidth=1, label="exact")
    ax.set(xlabel="updates", ylabel="estimate" if watch == "entry" else "mean of |Q − q*|")
    ax.legend()
