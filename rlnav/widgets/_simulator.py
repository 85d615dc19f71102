"""Watch a robot learn its task, with the settings of the learner in hand."""

from __future__ import annotations

from ipywidgets import SelectionSlider
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import plot
from .._check import fail, instance, show
from .._training import Training
from ..evaluation import evaluate
from ..learning import q_learning
from ..mdp import MDP, greedy
from ..planning import evaluate_policy, solve
from ..rollouts import rollout
from ..task import Task
from ._live import Live

ALT = "Map with the value of every pose under the greedy policy after {episodes} episodes, and the way of the robot."


def Simulator(task: Task, training: Training | None = None) -> Live:
    """Let Q-learning try a task, and show what its greedy policy is worth and where the robot drives.

    Parameters
    ----------
    task : Task
    training : Training, optional
        A run with snapshots: a slider goes through its tables, and nothing is learned anew.

    Returns
    -------
    Live
        With sliders for episodes, alpha, epsilon and the seed; for the episodes alone if there is a `training`.

    Raises
    ------
    TypeError, ValueError
        If `task` is not a Task, or `training` has no snapshots or belongs to another table.

    Examples
    --------
    >>> import rlnav as rl
    >>> task = rl.Task(rl.GridWorld.from_ascii(">.G"))
    >>> simulator = rl.widgets.Simulator(task)
    >>> simulator.controls["episodes"].value = 2000
    """
    instance("task", task, Task)
    mdp, phi = task.mdp(), task.phi()
    if training is not None:
        return _replay(task, mdp, phi, training)

    def learn(episodes: int = 3000, alpha: float = 0.2, epsilon: float = 0.2, seed: int = 0) -> tuple[Axes, str]:
        run = q_learning(mdp, phi, episodes=episodes, alpha=alpha, epsilon=epsilon, rng=seed)
        return _picture(task, mdp, run.pi[phi], seed)

    sliders = {"episodes": (100, 6000, 100), "alpha": (0.05, 1, 0.05), "epsilon": (0, 1, 0.05), "seed": (0, 20, 1)}
    return Live(learn, sliders, alt=ALT)


def _replay(task: Task, mdp: MDP, phi: NDArray, training: Training) -> Live:
    instance("training", training, Training)
    if not len(training.snapshots):
        fail("training", "a run with snapshots", show(training), "Train with snapshots=20, for example.")
    rows = int(phi.max()) + 1
    if training.Q.shape != (rows, mdp.A):
        fail("training", f"a run of this task, whose table is ({rows}, {mdp.A})", f"a table {training.Q.shape}")
    tables = dict(zip(training.snapshot_episodes.tolist(), training.snapshots, strict=True))

    def replay(episodes: int) -> tuple[Axes, str]:
        return _picture(task, mdp, greedy(tables[episodes])[phi], seed=0)

    return Live(replay, {"episodes": SelectionSlider(options=list(tables))}, alt=ALT)


def _picture(task: Task, mdp: MDP, pi: NDArray, seed: int) -> tuple[Axes, str]:
    """Draw a policy on the color scale of the best one, so that one setting can be compared with another."""
    best = solve(mdp).V
    ax = plot.values(task, evaluate_policy(mdp, pi), vmin=best.min(), vmax=best.max())
    plot.path(task, rollout(mdp, pi, rng=seed), ax)
    scores = evaluate(mdp, pi)
    return ax, f"Greedy policy: {scores}, gap {scores.gap:.3f}."
