"""Explorables of one task, and what they send beside a scenario: a reader's own reward and policy, as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._check import fail, instance
from ..mdp import MDP, check_policy
from ..task import Task
from . import _scenario
from ._arrays import pack
from ._explorable import Explorable

FIXED = ("map", "starts", "steering", "reward", "features")  # what makes it this task


class TaskExplorable(Explorable):
    """An explorable of one task, perhaps with a policy; the reader may change its slip and its discount."""

    def __init__(self, task: Task, policy: ArrayLike | None, state: Mapping[str, Any], **learner: Any) -> None:
        self._own = _scenario.own_designs(instance("task", task, Task))
        scenario = _scenario.scenario_of(task, **learner)
        self._fixed = {name: scenario[name] for name in FIXED}
        self._policy, sent = policy_tables(task.mdp(), policy)
        super().__init__({"scenario": scenario, **state}, tables=task_tables(scenario, self._own, sent))

    @property
    def task(self) -> Task:
        """The task as it stands, with the slip and the discount that the reader has set."""
        return _scenario.task_of(self.state["scenario"], self._own)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state with a complete scenario, which must be of the same task."""
        state = super().checked(state)
        scenario = _scenario.checked(state["scenario"])
        for name in FIXED:
            if scenario[name] != self._fixed[name]:
                advice = f"For another task make another {type(self).__name__}."
                fail("state", f"a scenario with the same {name}", "another one", advice)
        return {**state, "scenario": scenario}


def policy_tables(mdp: MDP, policy: ArrayLike | None) -> tuple[NDArray | None, dict[str, Any]]:
    """Check a policy; return it as probabilities [S, A], and these packed."""
    if policy is None:
        return None, {}
    pi = check_policy(mdp, policy)
    chances = pi if pi.ndim == 2 else np.eye(mdp.A)[pi]
    return chances, {"policy": pack(chances, "float64")}


def task_tables(scenario: Mapping[str, Any], own: Mapping[str, Any], sent: dict[str, Any]) -> dict[str, Any] | None:
    """Gather what the browser cannot compute from the scenario, or None."""
    model = _scenario.tables_of(scenario, own) if "reward" in own else {}
    return {**model, **sent} or None


def turn_text(a: int) -> str:
    """Write a steering: +45°, 0°, −90°."""
    return f"{a:+d}°".replace("-", "−") if a else "0°"
