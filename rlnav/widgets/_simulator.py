"""The simulator: draw a world, design what the robot perceives and is paid for, and watch it learn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import plot
from .._check import fail, instance, show
from .._training import Training
from ..evaluation import evaluate
from ..mdp import greedy
from ..planning import evaluate_policy, solve
from ..rollouts import rollout
from ..task import Task
from . import _scenario
from ._explorable import Explorable

NAMES = {
    "q_learning": "Q-learning",
    "sarsa": "SARSA",
    "expected_sarsa": "Expected SARSA",
    "double_q_learning": "Double Q-learning",
    "monte_carlo": "Monte Carlo control",
}


class Simulator(Explorable):
    """Let a robot learn a task before your eyes, in a notebook or in a built page.

    Parameters
    ----------
    task : Task, optional
        What the robot has to do; by default the book's first task. A reward or features that are functions of your own
        stay in Python, which computes the model anew whenever the world is changed in the browser.
    training : Training, optional
        A run with snapshots of this task, by any algorithm or rule of your own: the simulator plays its tables.
    view : dict, optional
        What is shown and how, such as ``{"lecture": True}``.
    **settings
        Of the learner: algorithm, alpha, alpha_schedule, alpha_end, epsilon, epsilon_schedule, epsilon_end, episodes,
        max_steps, Q0, seed.

    Raises
    ------
    TypeError, ValueError
        If a setting is unknown or out of its range, the world is larger than 30 x 30 cells, or `training` has no
        snapshots or belongs to another table.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">..G"))
    >>> simulator = rl.widgets.Simulator(task, algorithm="sarsa", alpha=0.5, episodes=50)
    >>> simulator.train()
    Training(50 episodes, ...)
    >>> print(simulator.task.world)
    >..G
    >>> simulator.scenario = simulator.scenario | {"slip": 0.1}
    >>> simulator.task.robot
    Robot(steering=(-90, -45, 0, 45, 90), slip=0.1)
    """

    entry = "simulator/app"
    defaults = {"scenario": _scenario.DEFAULTS, "view": {}}  # noqa: RUF012

    def __init__(
        self,
        task: Task | None = None,
        training: Training | None = None,
        *,
        view: Mapping[str, Any] | None = None,
        **settings: Any,
    ) -> None:
        task = _scenario.task_of(_scenario.DEFAULTS) if task is None else instance("task", task, Task)
        for name in settings:
            if name not in _scenario.LEARNER:
                fail("settings", f"among {', '.join(_scenario.LEARNER)}", repr(name), kind=TypeError)
        self._own = _scenario.own_designs(task)
        self._run = training
        played = None if training is None else _scenario.playback(_check_training(task, training))
        scenario = _scenario.scenario_of(task, **settings)
        tables = _scenario.tables_of(scenario, self._own) if self._own else None
        state = {"scenario": scenario, "view": {} if view is None else view}
        super().__init__(state, tables=tables, training=played)
        if self._own:
            self.observe(self._compute_tables, names="state")

    @property
    def scenario(self) -> dict[str, Any]:
        """What a run is made of, as it stands now; assign a changed copy to change it."""
        return self.state["scenario"]

    @scenario.setter
    def scenario(self, scenario: Mapping[str, Any]) -> None:
        self.state = {**self.state, "scenario": scenario}

    @property
    def task(self) -> Task:
        """The task as the reader has drawn and designed it."""
        return _scenario.task_of(self.scenario, self._own)

    def train(self) -> Training:
        """Run the learner in Python: the run of the browser, to the last bit."""
        return _scenario.train(self.scenario, self.task)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario."""
        state = super().checked(state)
        view = instance("view", state["view"], Mapping)
        return {"scenario": _scenario.checked(state["scenario"]), "view": dict(view)}

    def _compute_tables(self, change: Any) -> None:
        """Follow the browser with what only Python can compute."""
        before, now = (_scenario.task_part(state["scenario"]) for state in (change.old, change.new))
        if before != now:
            self.tables = _scenario.tables_of(change.new["scenario"], self._own)

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        return f"Map with the value of every pose under the greedy policy after {self._course()}, and the robot's way."

    def _course(self) -> str:
        if self._run is not None:
            return f"{self._run.snapshot_episodes[-1]:,} episodes"
        return f"{self.scenario['episodes']:,} episodes of {NAMES[self.scenario['algorithm']]}"

    def still(self) -> Any:
        """Draw what the greedy policy is worth when the run is over, on the color scale of the best one."""
        try:
            task = self.task
        except ValueError as reason:  # a reader who is drawing has walled in the goal
            return "\n".join([*self.scenario["map"], str(reason)])
        mdp, Q = task.mdp(), self._learned(task)
        pi, best = greedy(Q)[task.phi()], solve(mdp).V
        ax = plot.values(task, evaluate_policy(mdp, pi), vmin=best.min(), vmax=best.max())
        limit = self.scenario["max_steps"]
        plot.path(task, rollout(mdp, pi, max_steps=limit, rng=0), ax)
        scores = evaluate(mdp, pi, max_steps=limit)
        return ax, f"Greedy policy after {self._course()}: {scores}, gap {scores.gap:.3f}."

    def _learned(self, task: Task) -> NDArray[np.float64]:
        if self._run is not None and self._run.Q.shape == (task.phi().max() + 1, len(task.robot.steering)):
            return self._run.snapshots[-1]
        return self.train().Q


def _check_training(task: Task, training: Training) -> Training:
    instance("training", training, Training)
    if not len(training.snapshots):
        fail("training", "a run with snapshots", show(training), "Train with snapshots=20, for example.")
    shape = (int(task.phi().max()) + 1, len(task.robot.steering))
    if training.Q.shape != shape:
        fail("training", f"a run of this task, whose table is {shape}", f"a table {training.Q.shape}")
    return training
