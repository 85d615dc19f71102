"""The bridge to Gymnasium: our robot as an environment, and a Gymnasium toy-text table as an MDP.

Importing this module registers "rlnav/GridRobot-v0"; `gymnasium.make("rlnav.env:rlnav/GridRobot-v0")` does both.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _check, maps
from ._sampling import arrays, draw_start, step
from .mdp import MDP, SUM
from .task import Task
from .world import GridWorld

try:
    import gymnasium as gym
except ImportError as missing:
    raise ImportError("`rlnav.env` needs Gymnasium. Install it with: pip install 'rlnav[env]'") from missing

ID = "rlnav/GridRobot-v0"
ARROWS = "→↗↑↖←↙↓↘"  # the headings 0, 45, ... 315 degrees


class GridRobotEnv(gym.Env[Any, Any]):
    """Let the robot of a task be driven through Gymnasium's interface; its chances are exactly those of `task.mdp()`.

    The observation is the state s, or what the robot perceives of it, z = phi[s], if the task has features.  Action a
    is the turn `task.robot.steering[a]`.  Goal and crash terminate an episode.  The environment itself truncates it
    after `max_steps` steps, without a wrapper: one limit, whether it was made here or by `gymnasium.make`.

    Each reset and each step draws one number from `np_random`.  `info` holds "state" (s, whatever is observed), "pose"
    (after a crash: the pose from which the robot drove into something), "crash" and "goal".

    Parameters
    ----------
    task : Task, optional
        By default the map `rl.maps.OBSTACLES` with the book's robot and reward.
    max_steps : int
        Step limit of an episode.
    render_mode : "ansi", optional
        Let `render()` return the map as text, with the robot as an arrow, or as X after a crash.

    Raises
    ------
    TypeError, ValueError
        For an argument or an action outside its range.
    gymnasium.error.ResetNeeded
        If a step is taken while no episode is under way.

    References
    ----------
    Towers et al., Gymnasium: A standard interface for reinforcement learning environments, arXiv 2407.17032, 2024.

    Examples
    --------
    >>> import rlnav as rl
    >>> env = rl.env.GridRobotEnv(rl.Task(rl.GridWorld.from_ascii(">.G")), render_mode="ansi")
    >>> observation, info = env.reset(seed=0)
    >>> env.step(2)
    (8, -0.1, False, False, {'state': 8, 'pose': Pose(x=1, y=0, theta=0), 'crash': False, 'goal': False})
    >>> print(env.render())
    .→G
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi"], "render_fps": 4}  # noqa: RUF012 (the form Gymnasium wants)

    def __init__(self, task: Task | None = None, *, max_steps: int = 200, render_mode: str | None = None) -> None:
        task = Task(GridWorld.from_ascii(maps.OBSTACLES)) if task is None else task
        self.task: Task = _check.instance("task", task, Task)
        self.max_steps = _check.integer("max_steps", max_steps, 1)
        if render_mode is not None and not (isinstance(render_mode, str) and render_mode == "ansi"):
            _check.fail("render_mode", "None or 'ansi'", _check.show(render_mode), "Figures are made by `rl.plot`.")
        self.render_mode = render_mode
        mdp = self.task.mdp()
        self._model, self._goal, self._phi = arrays(mdp), mdp.goal, self.task.phi()
        self.observation_space = gym.spaces.Discrete(int(self._phi.max()) + 1)
        self.action_space = gym.spaces.Discrete(mdp.A)
        self._s, self._pose, self._t, self._over = 0, self.task.poses[0], 0, True

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[int, dict[str, Any]]:
        """Begin an episode at one of the start poses of the task, by chance; `options` are not used."""
        super().reset(seed=seed)
        self._enter(int(draw_start(self._model, self.np_random.random())))
        self._t, self._over = 0, False
        return self._perceive()

    def step(self, action: int) -> tuple[int, float, bool, bool, dict[str, Any]]:
        """Take one step; return (observation, reward, terminated, truncated, info)."""
        a = _check.integer("action", action, 0, len(self.task.robot.steering) - 1)
        if self._over:
            raise gym.error.ResetNeeded("No episode is under way. Call `reset()` before `step()`.")
        s, r, _ = step(self._model, self._s, a, self.np_random.random())
        self._enter(int(s))
        self._t += 1
        terminated = bool(self._model.terminal[s])
        truncated = not terminated and self._t >= self.max_steps
        self._over = terminated or truncated
        observation, info = self._perceive()
        return observation, float(r), terminated, truncated, info

    def render(self) -> str | None:
        """Return the map as text, or None without a render mode."""
        if self.render_mode is None:
            return None
        world, (x, y) = self.task.world, (self._pose.x, self._pose.y)
        robot = "X" if self._s == self.task.crashed else ARROWS[self._pose.theta // 45]
        signs = dict.fromkeys(world.free, ".") | {world.goal: "G", (x, y): robot}
        rows = ([signs.get((x, y), "#") for x in range(world.width)] for y in reversed(range(world.height)))
        return "\n".join("".join(row) for row in rows)

    def _enter(self, s: int) -> None:
        self._s, self._pose = s, self.task.pose(s) or self._pose

    def _perceive(self) -> tuple[int, dict[str, Any]]:
        crash, goal = self._s == self.task.crashed, bool(self._goal[self._s])
        return int(self._phi[self._s]), {"state": self._s, "pose": self._pose, "crash": crash, "goal": goal}


if ID not in gym.registry:  # a reload must not register it twice
    gym.register(ID, entry_point="rlnav.env:GridRobotEnv")


# ---------------------------------------------------------------- a toy-text table as an MDP
class _Outcome(NamedTuple):
    """One entry of a toy-text table: what may come of action a in state s."""

    s: int
    a: int
    p: float
    s_next: int
    r: float
    over: bool


def to_mdp(env: Any, gamma: float, *, start: ArrayLike | None = None) -> MDP:
    """Turn a toy-text table of Gymnasium, P[s][a] = [(p, s', r, terminated), ...], into an MDP.

    The table marks steps that end the episode; our MDP marks states in which it is over.  A state that only ending
    steps enter becomes terminal.  One that is also entered, or started from, while the episode goes on keeps its number
    and gets a terminal twin at the end of the table, for the steps that end (Taxi has four such states).  So the values
    of all states that are not terminal are exactly those of the environment.  Goals are the terminal states whose
    entering pays the largest reward that any ending step pays.

    Parameters
    ----------
    env : Gymnasium environment with a table `P`, or the table itself
        Such as FrozenLake, CliffWalking and Taxi; wrappers are looked through.
    gamma : float
        Discount factor in [0, 1].
    start : int or int array [N], optional
        States in which an episode may start, all equally likely.  By default those of the environment's
        `initial_state_distrib`; for a bare table every state that no ending step enters.

    Returns
    -------
    MDP

    Raises
    ------
    TypeError, ValueError
        If there is no such table, an entry of it is wrong (with its place), or start states are not equally likely.

    Examples
    --------
    >>> import gymnasium, rlnav as rl
    >>> lake = rl.env.to_mdp(gymnasium.make("FrozenLake-v1"), gamma=1.0)
    >>> round(float(rl.solve(lake).V[0]), 4)
    0.8235
    """
    P = getattr(getattr(env, "unwrapped", env), "P", env)
    S, A = _size(P)
    outcomes = [outcome for s in range(S) for a in range(A) for outcome in _outcomes(P, s, a, S)]
    ended = {o.s_next for o in outcomes if o.over}
    starts = _starts(env, start, S, ended)
    twins = sorted(ended & ({o.s_next for o in outcomes if not o.over} | set(starts.tolist())))
    twin = {s: S + i for i, s in enumerate(twins)}
    terminal = np.zeros(S + len(twins), bool)
    terminal[[twin.get(s, s) for s in ended]] = True
    goal, best = np.zeros_like(terminal), max((o.r for o in outcomes if o.over and not terminal[o.s]), default=0.0)
    chances: dict[tuple[int, int], dict[tuple[int, float], float]] = {}
    for o in outcomes:
        if not terminal[o.s]:
            s_next = twin.get(o.s_next, o.s_next) if o.over else o.s_next
            goal[s_next] |= o.over and o.r == best
            row = chances.setdefault((o.s, o.a), {})
            row[s_next, o.r] = row.get((s_next, o.r), 0.0) + o.p
    return MDP(*_successors(chances, terminal.size, A), gamma, terminal, starts, goal)


def _size(P: Any) -> tuple[int, int]:
    """Numbers of states and actions of a table."""
    expected = "an environment with a table `P`, or P[s][a] = [(p, s', r, terminated), ...]"
    try:
        actions = [len(P[s]) for s in range(len(P))]
    except (TypeError, KeyError, IndexError):
        _check.fail("env", expected, f"{_check.show(P)} ({type(P).__name__})", kind=TypeError)
    if not actions or min(actions) == 0:
        _check.fail("env", expected, "a table without states or actions")
    if min(actions) != max(actions):
        s = next(s for s, n in enumerate(actions) if n != actions[0])
        _check.fail("env", f"a table with the same actions in every state: {actions[0]}", f"{actions[s]} in state {s}")
    return len(actions), actions[0]


def _outcomes(P: Any, s: int, a: int, S: int) -> Iterator[_Outcome]:
    """Check the outcomes of one state and action; leave out those without probability."""
    place, total = f"env.P[{s}][{a}]", 0.0
    try:
        row = [(p, s_next, r, over) for p, s_next, r, over in P[s][a]]
    except (TypeError, ValueError, KeyError, IndexError) as error:
        _check.fail(place, "a list of (p, s', r, terminated)", f"{type(error).__name__}: {error}")
    for p, s_next, r, over in row:
        p = _check.number(f"p of {place}", p, 0, 1)
        s_next = _check.integer(f"s' of {place}", s_next, 0, S - 1)
        r = _check.number(f"r of {place}", r)
        if not isinstance(over, (bool, np.bool_)):
            _check.fail(f"terminated of {place}", "True or False", _check.show(over), kind=TypeError)
        total += p
        if p > 0:
            yield _Outcome(s, a, p, s_next, r, bool(over))
    if abs(total - 1) > SUM:
        _check.fail(place, "outcomes whose probabilities sum to 1", f"the sum {total:.12g}")


def _starts(env: Any, start: ArrayLike | None, S: int, ended: set[int]) -> NDArray[np.int64]:
    """Start states: as given, or as the environment draws them, or all in which an episode can be under way."""
    if start is not None:
        return _check.states("start", start)
    chance = getattr(getattr(env, "unwrapped", env), "initial_state_distrib", None)
    if chance is None:
        return np.array([s for s in range(S) if s not in ended], np.int64)
    chance = _check.array("env.initial_state_distrib", chance, "real", (S,), "one probability a state")
    starts = np.flatnonzero(chance)
    if np.ptp(chance[starts]) > SUM:
        got = f"chances from {chance[starts].min():g} to {chance[starts].max():g}"
        _check.fail("env", "an environment whose start states are equally likely", got, "Choose them by `start`.")
    return starts


def _successors(chances: dict, S: int, A: int) -> tuple[NDArray, NDArray, NDArray]:
    """Successor arrays [S, A, K]; where `chances` is silent the state stays as it is."""
    K = max(map(len, chances.values()), default=1)
    next_state = np.broadcast_to(np.arange(S)[:, None, None], (S, A, K)).copy()
    prob, reward = np.zeros((S, A, K)), np.zeros((S, A, K))
    prob[:, :, 0] = 1.0
    for (s, a), row in chances.items():
        n = len(row)
        prob[s, a, :n] = list(row.values())
        next_state[s, a, :n], reward[s, a, :n] = zip(*row, strict=True)
    return next_state, prob, reward
