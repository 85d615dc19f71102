"""Features of the state: the table that they make, the poses that they mix up, and what it is worth (chapter 14)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import maps, plot
from .._check import fail, instance, integer, items, show
from ..evaluation import evaluate
from ..learning import q_learning
from ..planning import solve
from ..plot._ground import draw_robot
from ..plot._look import BLUE
from ..task import Task
from ..world import GridWorld
from . import _scenario
from ._explorable import Explorable

MAPS = 20  # to learn on, and as many for the exam
EXAM = 1000  # the seed of its first map
VARIETIES = {"one": "this map", "many": f"{MAPS} random maps"}
VIEWS = ("pairs", "drive", "unseen")
TRY = ("features", "variety", "seed", "met", "mixed", "home", "away")
TIE = 1e-9


class FeaturePicker(Explorable):
    """Choose what the robot perceives, see which poses look alike, let it learn, and try its table on other maps.

    Parameters
    ----------
    task : Task
        The map, the robot and its reward; episodes begin everywhere. Its features are those of the beginning.
    variety : str
        "one": the robot learns on the task's map; "many": on 20 random ones, one after the other.
    trained : bool
        Let the robot learn as soon as the figure is opened.
    view : str
        What the map shows: "pairs" of poses that look alike, the learned "drive", or a drive on an "unseen" map.
    **learner
        ``episodes`` in all, ``alpha``, ``epsilon``, ``max_steps`` and ``seed``.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or the reward or the features are functions of the reader's own.

    Examples
    --------
    >>> import rlnav as rl
    >>> world = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
    >>> picker = rl.widgets.FeaturePicker(rl.Task(world, features=rl.designs.heading()))
    >>> picker.table
    {'rows': 8, 'met': 8, 'mixed': 8}
    """

    entry = "explorables/feature_picker"
    defaults = {  # noqa: RUF012
        "scenario": _scenario.DEFAULTS,
        "variety": "one",
        "trained": False,
        "view": "pairs",
        "turn": 0,
        "tried": [],
    }

    def __init__(
        self, task: Task, *, variety: str = "one", trained: bool = False, view: str = "pairs", **learner: Any
    ) -> None:
        if own := _scenario.own_designs(instance("task", task, Task)):
            fail("task", "of designs that a page knows", f"functions of your own ({', '.join(own)})")
        usual = {"episodes": 6000, "alpha": 0.1, "epsilon": 0.1}
        scenario = {**_scenario.scenario_of(task, **{**usual, **learner}), "starts": None}
        super().__init__({"scenario": scenario, "variety": variety, "trained": trained, "view": view})

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario that starts everywhere."""
        state = super().checked(state)
        scenario = {**_scenario.checked(state["scenario"]), "starts": None}
        _scenario.task_of(scenario)
        _scenario.one_of("variety", state["variety"], VARIETIES)
        _scenario.one_of("view", state["view"], VIEWS)
        if state["variety"] == "many" and scenario["features"] is None:
            fail("variety", "'one' for the whole pose", "'many'", "The poses of one map are not those of another.")
        instance("trained", state["trained"], bool)
        tried = [_checked_try(one) for one in items("tried", state["tried"], "what was tried")]
        return {**state, "scenario": scenario, "turn": integer("turn", state["turn"], 0), "tried": tried}

    @property
    def task(self) -> Task:
        """The task as the reader has changed it."""
        return _scenario.task_of(self.state["scenario"])

    @property
    def table(self) -> dict[str, int]:
        """How many rows the table has, how many are met on this map, and how many of these mix different best turns."""
        task = self.task
        mdp, phi = task.mdp(), task.phi()
        best = solve(mdp, tol=1e-12).Q
        common: dict[int, np.ndarray] = {}
        for s in np.flatnonzero(_reached(mdp) & ~mdp.terminal):
            good = best[s] >= best[s].max() - TIE * max(1, abs(best[s].max()))
            z = int(phi[s])
            common[z] = common[z] & good if z in common else good
        return {"rows": int(phi.max()), "met": len(common), "mixed": sum(not good.any() for good in common.values())}

    def learned(self) -> np.ndarray:
        """Learn in Python as the browser does, to the last bit; return the table."""
        scenario, rng = self.state["scenario"], np.random.default_rng(self.state["scenario"]["seed"])
        many = self.state["variety"] == "many"
        worlds = [maps.random(10, density=0.2, rng=i) for i in range(MAPS)] if many else [self.task.world]
        how = {name: scenario[name] for name in ("alpha", "epsilon", "max_steps")}
        Q = scenario["Q0"]
        for world in worlds:
            task = self._on(world)
            episodes = max(1, scenario["episodes"] // len(worlds))
            Q = q_learning(task.mdp(), task.phi(), episodes=episodes, **how, rng=rng, Q0=Q).Q
        return Q

    def exam(self, Q: np.ndarray) -> tuple[float, float]:
        """Score a table: success on this map, and its mean on the unseen ones."""
        unseen = [maps.random(10, density=0.2, rng=EXAM + i) for i in range(MAPS)]
        return self._success(Q, self.task.world), float(np.mean([self._success(Q, world) for world in unseen]))

    def _success(self, Q: np.ndarray, world: GridWorld) -> float:
        task = self._on(world)
        pi = Q.argmax(axis=1)[task.phi()]
        return evaluate(task.mdp(), pi, max_steps=self.state["scenario"]["max_steps"]).success

    def _on(self, world: GridWorld) -> Task:
        task = self.task
        return Task(world, task.robot, task.reward, task.features, task.gamma)

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        return "Map with an arrowhead for each pose of the fullest row of the table: to the robot they all look alike."

    def still(self) -> Any:
        """Draw the poses of the row that holds most of them."""
        task = self.task
        mdp, phi = task.mdp(), task.phi()
        table = self.table
        ax = plot.world(task)
        rows = np.bincount(phi[~mdp.terminal])
        for s in np.flatnonzero((phi == rows.argmax()) & ~mdp.terminal):
            draw_robot(ax, *_place(task, int(s)), task.poses[s].theta, BLUE, size=0.5)
        rows_met = f"{table['rows']:,} rows, {table['met']} of them are met on this map"
        return ax, f"{rows_met}, {table['mixed']} mix poses that need different turns. All arrowheads share one row."


def _place(task: Task, s: int) -> tuple[float, float]:
    """Where the wedge of a pose is."""
    pose = task.poses[s]
    angle = np.radians(pose.theta)
    return pose.x + 0.27 * np.cos(angle), pose.y + 0.27 * np.sin(angle)


def _reached(mdp: Any) -> np.ndarray:
    """Mark the states that the robot can come to, whatever it does."""
    reached = np.zeros(mdp.S, bool)
    reached[mdp.start] = True
    while True:
        wider = reached.copy()
        wider[np.unique(mdp.next_state[reached][mdp.prob[reached] > 0])] = True
        if (wider == reached).all():
            return reached
        reached = wider


def _checked_try(one: Any) -> dict[str, Any]:
    if not isinstance(one, Mapping) or set(one) != set(TRY):
        fail("tried", f"dicts with the keys {', '.join(TRY)}", show(one))
    return dict(one)
