"""A reward to be mixed, and at once the drive that it asks for (chapter 15)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import plot
from .._check import fail, instance, number
from ..designs import Reward
from ..mdp import MDP
from ..planning import evaluate_policy, solve
from ..robot import Pose
from ..rollouts import Episode, rollout
from ..task import Task
from . import _scenario
from ._explorable import Explorable
from ._poses import listed, pose_of

MOST_GAMMA = 0.99  # at 1, what a circle pays has no end
EXACT = 1e-12
SHADE = 0.45  # of full color: the drive has to stand out


class RewardMixer(Explorable):
    """Mix a reward and see at once what it asks for: the best drive by this reward, and what the task says to it.

    Parameters
    ----------
    task : Task
        What the robot ought to do: its reward is the judge. The robot must not slip, so that a policy is one drive
        from each pose.
    reward : function of a Transition, optional
        The mixture to begin with, made of ``rl.designs``; by default the reward of the task.
    pose : Pose, optional
        Where the drive begins; by default the first start of the task.
    **learner
        For "Let it learn": alpha, epsilon, episodes, max_steps, seed, as in ``rl.q_learning(..., rng=seed)``.

    Raises
    ------
    TypeError, ValueError
        If the robot slips, gamma is above 0.99, a reward is a function of the reader's own, or the world is larger
        than 30 x 30 cells.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE))
    >>> closer = rl.designs.Progress(task.world.goal, only_closer=True)
    >>> mixer = rl.widgets.RewardMixer(task, closer)
    >>> mixer.end, mixer.loop
    ('circle', 12)
    >>> rl.widgets.RewardMixer(task).end
    'goal'
    """

    entry = "explorables/reward_mixer"
    defaults = {"scenario": _scenario.DEFAULTS, "task_reward": _scenario.REWARDS, "pose": None}  # noqa: RUF012

    def __init__(self, task: Task, reward: Reward | None = None, *, pose: Pose | None = None, **learner: Any) -> None:
        instance("task", task, Task)
        mixed = task if reward is None else replace(task, reward=reward)
        for name, one in (("task", task), ("reward", mixed)):
            if own := _scenario.own_designs(one):
                expected = "made of the designs of rl.designs, which the sliders can show"
                fail(name, expected, f"a function of your own for the {' and the '.join(own)}")
        self._known: tuple[Any, Any] = (None, None)
        for setting in learner:
            if setting not in _scenario.LEARNER:
                fail("learner", f"settings among {', '.join(_scenario.LEARNER)}", repr(setting), kind=TypeError)
        state = {
            "scenario": _scenario.scenario_of(mixed, **learner),
            "task_reward": _scenario.scenario_of(task)["reward"],
            "pose": listed(pose),
        }
        super().__init__(state)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario and a start from which there is something to drive."""
        state = super().checked(state)
        scenario = _scenario.checked(state["scenario"])
        number("gamma", scenario["gamma"], 0, MOST_GAMMA)
        if scenario["slip"]:
            fail("slip", "0", f"{scenario['slip']}", "With slips a policy is not one drive but many.")
        reward = _scenario.checked({"reward": state["task_reward"]})["reward"]
        task = _scenario.task_of(scenario)
        if state["pose"] is not None:
            pose = pose_of(state["pose"])
            if task.mdp().terminal[task.index(pose)]:
                fail("pose", "a pose away from the goal", f"{pose}")
            state["pose"] = listed(pose)
        return {**state, "scenario": scenario, "task_reward": reward}

    # ------------------------------------------------------------ what a reward asks for
    @property
    def task(self) -> Task:
        """The task with the reward that is mixed."""
        return _scenario.task_of(self.state["scenario"])

    @property
    def judge(self) -> Task:
        """The task with its own reward."""
        return _scenario.task_of({**self.state["scenario"], "reward": self.state["task_reward"]})

    @property
    def drive(self) -> Episode:
        """The best drive by the reward that is mixed, until it ends or comes back to a pose."""
        return self._planned["drive"]

    @property
    def end(self) -> str:
        """How that drive ends: "goal", "crash" or "circle"."""
        return self._planned["end"]

    @property
    def loop(self) -> int:
        """Steps of one round, or 0 if it does not circle."""
        return self._planned["loop"]

    @property
    def worth(self) -> NDArray[np.float64]:
        """What two drives are worth: [by the mixed reward, by the task] x [drive of the mixed one, of the task]."""
        return self._planned["worth"]

    @property
    def fates(self) -> NDArray[np.int64]:
        """Where the best policy by the mixed reward leads from every state: 1 goal, -1 crash, 0 circles."""
        return self._planned["fates"]

    @property
    def _planned(self) -> dict[str, Any]:
        if self._known[0] is not self.state:
            self._known = (self.state, self._plan())
        return self._known[1]

    def _plan(self) -> dict[str, Any]:
        task, mdps = self.task, [self.task.mdp(), self.judge.mdp()]
        pose = self.state["pose"]
        s = task.index(task.world.starts[0] if pose is None else Pose(*pose))
        policies = [solve(mdp, tol=EXACT).pi for mdp in mdps]
        worth = np.array([[evaluate_policy(mdp, pi)[s] for pi in policies] for mdp in mdps])
        whole = rollout(mdps[0], policies[0], start=s, max_steps=mdps[0].S, rng=0)
        drive, loop = _until_it_repeats(whole)
        last = drive.states[-1]
        end = "circle" if loop else "goal" if mdps[0].goal[last] else "crash"
        fates = fates_of(mdps[0], policies[0])
        return {"drive": drive, "loop": loop, "end": end, "worth": worth, "fates": fates}

    # ------------------------------------------------------------ on paper
    @property
    def alt(self) -> str:
        """What the still picture shows."""
        return (
            "Map with the best drive by this reward. Each wedge is a pose: blue if the robot arrives from there, "
            "orange if it crashes, pale if it circles for ever."
        )

    def still(self) -> Any:
        """Draw where the best policy leads from every pose, and one drive."""
        task = self.task
        ax = plot.values(task, SHADE * self.fates, signed=True, vmin=-1, vmax=1, colorbar=False)
        plot.path(task, self.drive, ax)
        (here, _), (real, best) = self.worth
        values = (
            f"Worth {here:.2f} by this reward and {real:.2f} by the task, where the best drive is worth {best:.2f}."
        )
        return ax, f"{self._fate()} {values}"

    def _fate(self) -> str:
        steps = self.drive.actions.size
        if self.end == "circle":
            paid = self.drive.rewards[-self.loop :].sum()
            return f"It circles for ever: each round of {self.loop} steps pays {paid:+.2f}."
        return f"It {'arrives' if self.end == 'goal' else 'crashes'} after {steps} step{'s' * (steps != 1)}."


def fates_of(mdp: MDP, pi: NDArray[np.int64]) -> NDArray[np.int64]:
    """Tell for every state where a policy leads that leaves nothing to chance: 1 goal, -1 another end, 0 neither."""
    s = np.arange(mdp.S)
    after = mdp.next_state[s, pi, 0]
    for _ in range(mdp.S.bit_length()):
        after = after[after]  # twice as many steps
    return np.where(mdp.goal[after], 1, np.where(mdp.terminal[after], -1, 0))


def _until_it_repeats(whole: Episode) -> tuple[Episode, int]:
    """Cut a drive where it comes back to a state; return it with the number of steps since it was there first."""
    seen: dict[int, int] = {}
    for t, s in enumerate(whole.states.tolist()):
        if s in seen:
            cut = Episode(whole.states[: t + 1], whole.actions[:t], whole.rewards[:t], terminated=False)
            return cut, t - seen[s]
        seen[s] = t
    return whole, 0
