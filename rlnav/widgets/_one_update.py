"""One update of the table with its numbers, and a time machine for all of them (chapter 11)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib import pyplot as plt
from numpy.typing import NDArray

from .. import plot
from .._check import instance, integer
from .._sampling import expected
from ..learning import Rule, learn, q_learning_rule, sarsa_rule
from ..mdp import epsilon_greedy
from ..planning import solve
from ..task import Task
from . import _scenario
from ._explorable import Explorable
from ._value_wave import scale_of

MOST_UPDATES = 500_000  # that the browser keeps
NAMES = {"q_learning": "Q-learning", "sarsa": "SARSA", "expected_sarsa": "Expected SARSA"}


class Update(NamedTuple):
    """What one update has read and written; both rows are those before it."""

    z: int
    a: int
    r: float
    z_next: int
    a_next: int
    gamma: float
    row: NDArray[np.float64]
    next_row: NDArray[np.float64]
    before: float
    after: float


class OneUpdate(Explorable):
    """Take single updates of a learner apart: the formula with its numbers, forward, back, and as a riddle.

    Parameters
    ----------
    task : Task
        What the robot learns.
    algorithm : str
        "q_learning", "sarsa" or "expected_sarsa" to begin with; the reader may change it.
    alpha, epsilon : float
        Step size and exploration rate.
    Q0 : float
        What all entries of the table are at first.
    episodes, max_steps, seed : int
        As in ``rl.q_learning(..., rng=seed)``: it is the same run, to the last bit.
    update : int
        The update that is shown first, counted from 1; 0 is the moment before all of them.
    guess : bool
        Whether the reader is asked for the new entry before it is shown.
    end_has_value : bool
        A common bug: the rule forgets that nothing follows the end of an episode.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the world is larger than 30 x 30 cells.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"), rl.Robot((-90, 0, 90)))
    >>> inspector = rl.widgets.OneUpdate(task, alpha=0.5, seed=3, update=1)
    >>> inspector.last.r, inspector.last.after
    (-10.0, -5.0)
    """

    entry = "explorables/one_update"
    defaults = {"scenario": _scenario.DEFAULTS, "update": 0, "guess": False, "end_has_value": False}  # noqa: RUF012

    def __init__(
        self,
        task: Task,
        *,
        algorithm: str = "q_learning",
        alpha: float = 0.5,
        epsilon: float = 0.1,
        Q0: float = 0.0,
        episodes: int = 1000,
        max_steps: int = 200,
        seed: int = 0,
        update: int = 0,
        guess: bool = False,
        end_has_value: bool = False,
    ) -> None:
        rates = {"alpha": alpha, "epsilon": epsilon}
        run = {"Q0": Q0, "episodes": episodes, "max_steps": max_steps, "seed": seed}
        scenario = _scenario.scenario_of(task, algorithm=algorithm, **rates, **run)
        self._own = _scenario.own_designs(task)
        tables = _scenario.tables_of(scenario, self._own) if self._own else None
        state = {"update": update, "guess": guess, "end_has_value": end_has_value}
        super().__init__({"scenario": scenario, **state}, tables=tables)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, which can run."""
        state = super().checked(state)
        scenario = _scenario.checked(state["scenario"])
        _scenario.one_of("algorithm", scenario["algorithm"], NAMES)
        for name in ("alpha_schedule", "epsilon_schedule"):
            _scenario.one_of(name, scenario[name], ["constant"])
        _scenario.task_of(scenario, self._own)
        for name in ("guess", "end_has_value"):
            instance(name, state[name], bool)
        return {**state, "scenario": scenario, "update": integer("update", state["update"], 0, MOST_UPDATES)}

    @property
    def task(self) -> Task:
        """The task that is learned."""
        return _scenario.task_of(self.state["scenario"], self._own)

    @property
    def last(self) -> Update | None:
        """The update that is shown, or the last one of a run that has fewer; None before the first."""
        return self._learn()[1]

    @property
    def Q(self) -> NDArray[np.float64]:
        """The table after the update that is shown."""
        return self._learn()[0]

    def _learn(self) -> tuple[NDArray[np.float64], Update | None]:
        """Learn again, and take notes at the update that is shown."""
        state, scenario, task = self.state, self.state["scenario"], self.task
        mdp, phi, rule = task.mdp(), task.phi(), self._rule()
        left: int = state["update"]
        table: NDArray[np.float64] | None = None
        note: Update | None = None

        def take_notes(
            Q: NDArray, z: int, a: int, r: float, z_next: int, a_next: int, gamma: float, alpha: float
        ) -> None:
            nonlocal left, table, note
            gamma = mdp.gamma if state["end_has_value"] else gamma
            row, next_row, before = Q[z].copy(), Q[z_next].copy(), float(Q[z, a])
            rule(Q, z, a, r, z_next, a_next, gamma, alpha)
            left -= 1
            if left >= 0:
                note = Update(z, a, r, z_next, a_next, gamma, row, next_row, before, float(Q[z, a]))
            if left == 0:
                table = Q.copy()

        settings = {name: scenario[name] for name in ("alpha", "epsilon", "max_steps", "Q0")}
        episodes = min(scenario["episodes"], state["update"])  # each has an update at least
        if episodes == 0:
            return np.full((int(phi.max()) + 1, mdp.A), float(scenario["Q0"])), None
        run = learn(mdp, take_notes, phi, episodes=episodes, **settings, rng=scenario["seed"])
        return run.Q if table is None else table, note

    def _rule(self) -> Rule:
        """Return the rule of the algorithm: they differ in what they make of the next row."""
        scenario = self.state["scenario"]
        if scenario["algorithm"] == "q_learning":
            return q_learning_rule
        if scenario["algorithm"] == "sarsa":
            return sarsa_rule

        def rule(Q: NDArray, z: int, a: int, r: float, z_next: int, a_next: int, gamma: float, alpha: float) -> None:
            Q[z, a] += alpha * (r + gamma * expected(Q, z_next, scenario["epsilon"]) - Q[z, a])

        return rule

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        name = NAMES[self.state["scenario"]["algorithm"]]
        diagram = f"the backup diagram of update {self.state['update']} of {name}"
        return f"Map with the largest entry of each row of the table, and {diagram}."

    def still(self) -> Any:
        """Draw what is learned so far, and the diagram of the update with its numbers."""
        scenario, task = self.state["scenario"], self.task
        Q, update = self._learn()
        figure, (map_, diagram) = plt.subplots(1, 2, figsize=(9.0, 3.9), layout="constrained", width_ratios=(1, 1.15))
        mdp = task.mdp()
        low, high = scale_of(solve(mdp).V[~mdp.terminal])
        plot.values(task, Q.max(axis=1)[task.phi()], map_, vmin=low, vmax=high, label="largest entry")
        plot.backup_diagram(scenario["algorithm"], diagram, numbers=update and self._tree(update))
        if update is None:
            return figure, "Before the first update."
        change = (
            f"{update.before:.3f} + {scenario['alpha']:g} [{update.r:g} + {update.gamma:g} * {self._next(update):.3f}"
        )
        return figure, f"Update {self.state['update']:,}: {change} - {update.before:.3f}] = {update.after:.3f}."

    def _next(self, update: Update) -> float:
        """Return what the algorithm makes of the next row."""
        kinds = {
            "q_learning": lambda: update.next_row.max(),
            "sarsa": lambda: update.next_row[update.a_next],
            "expected_sarsa": lambda: expected(update.next_row[None], 0, self.state["scenario"]["epsilon"]),
        }
        return float(kinds[self.state["scenario"]["algorithm"]]())

    def _tree(self, update: Update) -> tuple[Any, ...]:
        """Write the update as the numbers of a backup diagram."""
        scenario, row = self.state["scenario"], update.next_row
        leaves: list[Any] = [(None, q) for q in row]
        if scenario["algorithm"] == "sarsa":
            leaves = [(None, row[update.a_next])]
        elif scenario["algorithm"] == "expected_sarsa":
            leaves = list(zip(epsilon_greedy(row[None], scenario["epsilon"])[0], row, strict=True))
        return update.before, [(update.r, None, leaves)]
