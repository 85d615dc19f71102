"""rlnav: reinforcement learning by one running example, a small robot that learns to navigate a grid.

    import rlnav as rl

Left: this robot (Pose, Robot, GridWorld, Task, maps, designs).  Right: any finite MDP (MDP, planners, learners,
evaluation).  They meet in `Task`.  Every public name is loaded when it is first used, so that the import is quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import designs, env, maps, plot, widgets
    from ._source import source
    from ._training import Training
    from .designs import Feature, Transition
    from .estimation import Prediction, mc_prediction, td_prediction
    from .evaluation import Evaluation, evaluate
    from .learning import (
        double_q_learning,
        expected_sarsa,
        learn,
        q_learning,
        q_learning_rule,
        sarsa,
        sarsa_rule,
    )
    from .mdp import MDP, action_values, epsilon_greedy, greedy
    from .montecarlo import monte_carlo
    from .planning import Solution, policy_iteration, solve, value_iteration
    from .prediction import evaluate_policy
    from .robot import Pose, Robot
    from .rollouts import Episode, returns, rollout
    from .task import Task
    from .world import GridWorld

__version__ = "0.1.0"

_HOME = {
    "robot": ["Pose", "Robot"],
    "world": ["GridWorld"],
    "designs": ["Feature", "Transition"],
    "task": ["Task"],
    "mdp": ["MDP", "action_values", "greedy", "epsilon_greedy"],
    "prediction": ["evaluate_policy"],
    "estimation": ["td_prediction", "mc_prediction", "Prediction"],
    "planning": ["value_iteration", "policy_iteration", "solve", "Solution"],
    "learning": [
        "q_learning",
        "sarsa",
        "expected_sarsa",
        "double_q_learning",
        "learn",
        "q_learning_rule",
        "sarsa_rule",
    ],
    "_training": ["Training"],
    "_source": ["source"],
    "montecarlo": ["monte_carlo"],
    "rollouts": ["rollout", "returns", "Episode"],
    "evaluation": ["evaluate", "Evaluation"],
}
_MODULES = ["maps", "designs", "plot", "env", "widgets"]
_MODULE_OF = {name: module for module, names in _HOME.items() for name in names}

__all__ = [*_MODULE_OF, *_MODULES]


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return import_module(f".{name}", __name__)
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'rlnav' has no attribute {name!r}")
    value = getattr(import_module(f".{_MODULE_OF[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
