"""Two ways, their rewards on a time line, and their returns built backwards (chapter 2)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from .._check import fail, instance, integer, items, number, show
from ..plot._look import COLORS, minus
from ..rollouts import Episode, returns
from ..task import Task
from . import _scenario
from ._explorable import Explorable

MOST_REWARD = 12  # either way: what the bars have room for
LONGEST_WAY = 16  # steps that stand side by side
WAY = ("name", "rewards", "poses", "crashed")


class ReturnLine(Explorable):
    """Compare two ways by their returns, eq. :eq:`eq-return`: rewards that can be dragged, and a discount.

    Parameters
    ----------
    ways : dict of str to Episode or sequence of float
        Two of them, by names that read well after "the", such as "short way": an episode of `task`, or rewards alone.
    gamma : float
        Discount in [0, 1] at the beginning.
    task : Task, optional
        Whose episodes the ways are; then a map shows them.
    known : int, optional
        The earliest time whose return is shown as built; by default none is.
    curves : bool
        Whether the worth of both ways is drawn for all discounts.

    Raises
    ------
    TypeError, ValueError
        If there are not two ways, one of them is longer than 16 steps, or a reward is beyond 12.

    Examples
    --------
    >>> import rlnav as rl
    >>> line = rl.widgets.ReturnLine({"short way": [0, 4], "long way": [0, 0, 10]}, gamma=0.5)
    >>> line.G("long way")
    array([ 2.5,  5. , 10. ])
    """

    entry = "explorables/return_line"
    defaults = {"map": None, "ways": [], "gamma": 0.9, "known": LONGEST_WAY, "curves": False}  # noqa: RUF012

    def __init__(
        self,
        ways: Mapping[str, Any],
        gamma: float = 0.9,
        *,
        task: Task | None = None,
        known: int | None = None,
        curves: bool = False,
    ) -> None:
        instance("ways", ways, Mapping)
        drawn = None if task is None else _scenario.scenario_of(task)["map"]
        made = [_way(name, way, task) for name, way in ways.items()]
        known = LONGEST_WAY if known is None else known
        super().__init__({"map": drawn, "ways": made, "gamma": gamma, "known": known, "curves": curves})

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state in its complete form."""
        state = super().checked(state)
        given = items("ways", state["ways"], "two ways")
        if len(given) != 2:
            fail("ways", "two ways", f"{len(given)} of them")
        rows = state["map"] and _scenario.checked({"map": state["map"], "starts": None})["map"]
        ways = [_checked_way(way, rows) for way in given]
        if ways[0]["name"] == ways[1]["name"]:
            fail("ways", "ways with two names", f"{show(ways[0]['name'])} twice")
        last = max(len(way["rewards"]) for way in ways)
        known = min(integer("known", state["known"], 0), last)
        gamma = number("gamma", state["gamma"], 0, 1)
        curves = instance("curves", state["curves"], bool)
        return {"map": rows, "ways": ways, "gamma": gamma, "known": known, "curves": curves}

    def G(self, name: str) -> Any:
        """Return the returns of a way from every step, with the rewards and the discount that the reader has set."""
        rewards = {way["name"]: way["rewards"] for way in self.state["ways"]}
        _scenario.one_of("name", name, rewards)
        return returns(rewards[name], self.state["gamma"])

    @property
    def alt(self) -> str:
        """What the still picture shows."""
        lengths = " and ".join(f"the {way['name']} with {len(way['rewards'])} steps" for way in self.state["ways"])
        return f"Rewards on a time line, as outlines, and what counts of them at the beginning, filled: {lengths}."

    def still(self) -> Any:
        """Draw every reward, and what counts of it at the beginning."""
        state, worth = self.state, []
        figure, axes = plt.subplots(2, figsize=(7.2, 4.2), layout="constrained", sharex=True)
        for k, (way, ax) in enumerate(zip(state["ways"], axes, strict=True)):
            _draw(ax, way, state["gamma"], COLORS[k])
            worth.append(f"the {way['name']} {self.G(way['name'])[0]:.3f}".replace("-", "−"))
        axes[-1].set(xlabel="time t + 1 at which the reward comes (steps)")
        axes[-1].set_xticks(np.arange(1, max(len(way["rewards"]) for way in state["ways"]) + 1))
        return figure, f"Worth at the beginning, with a discount of {state['gamma']:g}: {', '.join(worth)}."


def _way(name: str, way: Any, task: Task | None) -> dict[str, Any]:
    """Write a way as plain data."""
    if not isinstance(way, Episode):
        if task is not None:
            fail("ways", "episodes, for a map is to show them", show(way), "Leave `task` out to compare rewards.")
        return {"name": name, "rewards": list(way), "poses": None, "crashed": False}
    data = {"name": name, "rewards": way.rewards.tolist()}
    if task is None:
        return {**data, "poses": None, "crashed": False}
    poses = [pose for s in way.states if (pose := task.pose(int(s)))]
    crashed = len(poses) < way.states.size
    if crashed:
        poses.append(task.robot.move(poses[-1], task.robot.steering[way.actions[-1]]))
    return {**data, "poses": [[pose.x, pose.y, pose.theta] for pose in poses], "crashed": crashed}


def _checked_way(way: Any, rows: list[str] | None) -> dict[str, Any]:
    way = dict(instance("ways", way, Mapping))
    if set(way) != set(WAY):
        fail("ways", f"dicts with the keys {', '.join(WAY)}", f"the keys {', '.join(map(str, way))}")
    instance("name", way["name"], str)
    rewards = items("rewards", way["rewards"], "numbers")
    if not 0 < len(rewards) <= LONGEST_WAY:
        fail("rewards", f"1 to {LONGEST_WAY} numbers", f"{len(rewards)} of them")
    way["rewards"] = [number("rewards", r, -MOST_REWARD, MOST_REWARD) for r in rewards]
    if rows is None:
        return {**way, "poses": None, "crashed": False}
    poses = [list(items("poses", pose, "[x, y, theta]")) for pose in items("poses", way["poses"], "poses")]
    if len(poses) != len(rewards) + 1:
        fail("poses", f"one more than the {len(rewards)} rewards", f"{len(poses)} of them")
    return {**way, "poses": poses, "crashed": bool(way["crashed"])}


def _draw(ax: Axes, way: Mapping[str, Any], gamma: float, color: str) -> None:
    R = np.array(way["rewards"])
    at, counts = np.arange(1, R.size + 1), gamma ** np.arange(R.size) * R
    ax.bar(at, R, 0.6, fill=False, edgecolor=color, linestyle="--")
    ax.bar(at, counts, 0.6, color=color)
    for x, r in zip(at, R, strict=True):
        ax.annotate(minus(f"{r:g}"), (x, max(r, 0)), (0, 3), textcoords="offset points", ha="center", fontsize=9)
    ax.axhline(0, color="black", linewidth=0.8)
    ax.set(title=f"the {way['name']}", ylabel="reward")
    ax.margins(y=0.2)
