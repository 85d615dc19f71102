"""A robot with hidden buttons in a hidden world, driven by hand (the first chapter, "Drive the robot yourself")."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from .. import maps, plot
from .._check import fail, instance, integer, items, show
from .._sampling import arrays, step
from ..planning import Solution, solve
from ..plot._ground import ground
from ..robot import Pose, Robot
from ..rollouts import Episode, rollout
from ..task import Task
from ..world import GridWorld
from . import _scenario
from ._explorable import Explorable

BUTTONS = "ABCDE"
LEVELS = {"free": (0.0, 0.0), "obstacles": (0.15, 0.0), "slip": (0.1, 0.2)}  # density of obstacles, slip
SEEN = ("map", "numbers")
SIDE = 7  # cells along one side
NEAR = 9.55  # a start from which the best score is higher is too near: the goal is less than six steps away
MOST_STEPS = 200
MOST_DRIVES = 200


class Hidden(NamedTuple):
    """What the reader is to find out: the task, the steering behind each button, and the bare names of the states."""

    task: Task
    turns: tuple[int, ...]  # turns[i] is the index of the action behind button i
    names: tuple[int, ...]  # names[s] is all that a reader who sees only numbers is told of state s
    luck: int  # the seed of the chance that the driver meets, one number for each press


class MysteryRobot(Explorable):
    """Drive a robot whose buttons, goal and obstacles are hidden; then see what was hidden, and the best drive.

    The score of a drive is the sum of its rewards: +10 for the goal, -10 for a crash, -0.1 for every other step.

    Parameters
    ----------
    seed : int
        The number of the mystery: with the same number and level everybody gets the same one.
    level : str
        "free", "obstacles", or "slip": obstacles, and one turn in five comes out a notch off.
    see : str
        "map", or "numbers": nothing but the bare name of the state.
    drives : sequence of str
        Buttons that were pressed already, one text for each drive, such as ("CAB", "DD").
    revealed : bool
        Whether what is hidden is shown.
    max_steps : int
        Step limit: a drive is truncated there.

    Raises
    ------
    TypeError, ValueError
        If an argument is out of its range, or a drive goes on after its end.

    Examples
    --------
    >>> import rlnav as rl
    >>> mystery = rl.widgets.MysteryRobot(seed=2, drives=["CA"])
    >>> mystery.buttons
    {'A': -45, 'B': -90, 'C': 0, 'D': 90, 'E': 45}
    >>> mystery.episodes
    [Episode(2 steps, truncated in state 353, rewards -0.2)]
    """

    entry = "explorables/mystery_robot"
    defaults = {  # noqa: RUF012
        "seed": 0,
        "level": "free",
        "see": "map",
        "drives": [],
        "revealed": False,
        "max_steps": 30,
    }

    def __init__(
        self,
        seed: int = 0,
        level: str = "free",
        *,
        see: str = "map",
        drives: Sequence[str] = (),
        revealed: bool = False,
        max_steps: int = 30,
    ) -> None:
        state = {"seed": seed, "level": level, "see": see, "revealed": revealed, "max_steps": max_steps}
        super().__init__({**state, "drives": drives})

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state, in which every drive is one that the robot can make."""
        state = super().checked(state)
        _scenario.one_of("level", state["level"], LEVELS)
        _scenario.one_of("see", state["see"], SEEN)
        state["seed"] = integer("seed", state["seed"], 0)
        state["max_steps"] = integer("max_steps", state["max_steps"], 1, MOST_STEPS)
        instance("revealed", state["revealed"], bool)
        drives = items("drives", state["drives"], "texts of the letters A to E")
        state["drives"] = [_letters(drive) for drive in drives]
        if len(drives) > MOST_DRIVES:
            fail("drives", f"at most {MOST_DRIVES} drives", str(len(drives)))
        replay(state)
        return state

    @property
    def hidden(self) -> Hidden:
        """What is hidden."""
        return make(self.state["level"], self.state["seed"])

    @property
    def task(self) -> Task:
        """The task that is hidden; nothing is discounted, so a value is a mean score."""
        return self.hidden.task

    @property
    def buttons(self) -> dict[str, int]:
        """The steering behind each button, in degrees."""
        steering = self.task.robot.steering
        return {button: steering[a] for button, a in zip(BUTTONS, self.hidden.turns, strict=True)}

    @property
    def episodes(self) -> list[Episode]:
        """The drives so far; the last one may still be under way."""
        return replay(self.state)

    @property
    def best(self) -> Solution:
        """The best policy, with its exact scores."""
        return best_of(self.state["level"], self.state["seed"])

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        if self.state["revealed"]:
            return "The hidden map with the goal, the best of the drives so far, and an optimal drive."
        return "A grid of seven by seven cells with question marks, but for the robot and the cells that it has seen."

    def still(self) -> Any:
        """Draw what the reader knows, or everything."""
        task, episodes = self.task, self.episodes
        driven = [episode for episode in episodes if episode.actions.size]
        if self.state["revealed"]:
            return _revealed(self, driven)
        ax = ground(GridWorld(SIDE, SIDE, task.world.goal), None, goal=_goal_seen(task, driven))
        for x, y in sorted({(x, y) for x in range(SIDE) for y in range(SIDE)} - _seen(task, episodes)):
            ax.text(x, y, "?", ha="center", va="center", color="#7b8794")
        last = episodes[-1] if episodes else _standing(task)
        plot.path(task, last, ax)
        score = f"{last.rewards.sum():.1f}".replace("-", "−")
        return ax, f"Drive {max(len(episodes), 1)}, step {last.actions.size}: score {score}."


# ---------------------------------------------------------------- what is hidden
@cache
def make(level: str, seed: int) -> Hidden:
    """Hide a goal, obstacles and the meaning of the buttons, by chance: rlnav/js/scenario/mystery.js does the same."""
    density, slip = LEVELS[level]
    chance = np.random.default_rng(len(LEVELS) * seed + list(LEVELS).index(level))  # each level has its own
    starts: list[Pose] = []
    while not starts:
        world = maps.random(SIDE, density=density, rng=chance)
        starts = fair_starts(Task(world, gamma=1.0))
    start = starts[int(chance.random() * len(starts))]
    hidden = GridWorld(SIDE, SIDE, world.goal, world.obstacles, (start,))
    task = Task(hidden, Robot(slip=slip), gamma=1.0)
    turns = shuffled(len(BUTTONS), chance)
    names = shuffled(len(task.poses) + 1, chance)
    return Hidden(task, turns, names, int(chance.random() * 2**32))


def fair_starts(task: Task) -> list[Pose]:
    """List poses from which the goal is not near, and can still be reached after any first press."""
    mdp = task.mdp()
    V = solve(mdp).V
    later = V[mdp.next_state[:, :, 0]].min(axis=1)  # a crashed robot is worth 0
    return [pose for pose, v, rest in zip(task.poses, V[:-1], later[:-1], strict=True) if 0 < v < NEAR and rest > 0]


def shuffled(n: int, chance: np.random.Generator) -> tuple[int, ...]:
    """Return 0 ... n - 1 in an order by chance (Fisher and Yates)."""
    order = list(range(n))
    for i in range(n - 1, 0, -1):
        j = int(chance.random() * (i + 1))
        order[i], order[j] = order[j], order[i]
    return tuple(order)


@cache
def best_of(level: str, seed: int) -> Solution:
    """Solve a mystery."""
    return solve(make(level, seed).task.mdp(), tol=1e-10)


# ---------------------------------------------------------------- what the reader has done
def replay(state: dict[str, Any]) -> list[Episode]:
    """Press the buttons of all drives again: the same numbers of chance, so the same drives."""
    hidden = make(state["level"], state["seed"])
    chance = np.random.default_rng(hidden.luck)
    return [_drive(hidden, chance, letters, state["max_steps"], i) for i, letters in enumerate(state["drives"], 1)]


def _drive(hidden: Hidden, chance: np.random.Generator, letters: str, max_steps: int, number: int) -> Episode:
    mdp = hidden.task.mdp()
    model = arrays(mdp)
    states = [int(mdp.start[0])]
    rewards: list[float] = []
    actions = [hidden.turns[BUTTONS.index(letter)] for letter in letters]
    for a in actions:
        if mdp.terminal[states[-1]] or len(rewards) == max_steps:
            expected = "drives of which each stops where the robot does"
            fail("drives", expected, f"{len(actions)} presses in drive {number}, which ended after {len(rewards)}")
        s_next, r, _ = step(model, states[-1], a, chance.random())
        states.append(int(s_next))
        rewards.append(float(r))
    over = bool(mdp.terminal[states[-1]])
    return Episode(np.array(states), np.array(actions, np.int64), np.array(rewards, np.float64), over)


def _letters(drive: Any) -> str:
    if not isinstance(drive, str) or not set(drive) <= set(BUTTONS):
        fail("drives", "texts of the letters A to E", show(drive))
    return drive


# ---------------------------------------------------------------- the still picture
def _standing(task: Task) -> Episode:
    """Return a drive that has not begun."""
    start = task.mdp().start[:1].astype(np.int64)
    return Episode(start, np.zeros(0, np.int64), np.zeros(0), terminated=False)


def _seen(task: Task, episodes: Sequence[Episode]) -> set[tuple[int, int]]:
    """Cells that the robot has stood on."""
    states = {int(s) for episode in [_standing(task), *episodes] for s in episode.states}
    return {(task.poses[s].x, task.poses[s].y) for s in states if s != task.crashed}


def _goal_seen(task: Task, episodes: Sequence[Episode]) -> bool:
    return task.world.goal in _seen(task, episodes)


def _revealed(mystery: MysteryRobot, driven: Sequence[Episode]) -> Any:
    """Draw the map with the best of the drives and an optimal one, as it is when nothing slips."""
    task, best = mystery.task, mystery.best
    sure = Task(task.world, Robot(), gamma=1.0).mdp()
    drives = {"optimal": rollout(sure, best.pi, rng=0)}
    if driven:
        drives = {"your best drive": max(driven, key=lambda episode: episode.rewards.sum()), **drives}
    mean = " on average" if task.robot.slip else ""
    sentence = f"The best score is {best.V[task.mdp().start[0]]:.2f}{mean}."
    return plot.path(task, drives), sentence
