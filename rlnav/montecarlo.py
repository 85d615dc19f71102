"""Monte Carlo control: wait for the return of the whole episode, then learn from it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ._compile import kernel
from ._sampling import draw_action, draw_start, step
from ._training import Training, record, train
from .mdp import MDP


def monte_carlo(
    mdp: MDP,
    phi: ArrayLike | None = None,
    *,
    episodes: int,
    alpha: float | ArrayLike = 0.1,
    epsilon: float | ArrayLike = 0.1,
    max_steps: int = 200,
    rng: object = None,
    Q0: float | ArrayLike = 0.0,
    snapshots: int = 0,
) -> Training:
    """Learn by on-policy Monte Carlo control, eq. :eq:`eq-monte-carlo`: every visit, towards the return that followed.

    An episode that ran out of steps has no return yet: the value of the last state and action stands for the rest.
    Parameters, result and errors are those of `q_learning`.

    References
    ----------
    Sutton and Barto, Reinforcement Learning, 2nd ed., MIT Press, 2018, section 5.4.

    Examples
    --------
    >>> import rlnav as rl
    >>> mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
    >>> run = rl.monte_carlo(mdp, episodes=300, rng=0)
    >>> rl.rollout(mdp, run.pi, rng=0).actions
    array([2, 2])
    """
    return train(_monte_carlo, mdp, phi, episodes, alpha, epsilon, max_steps, rng, Q0, snapshots)


@kernel
def _monte_carlo(mdp, phi, Q, alpha, epsilon, max_steps, rng, log):
    path = np.zeros((max_steps, 2), np.uint32)
    rewards = np.zeros(max_steps)
    for e in range(alpha.size):
        s = draw_start(mdp, rng.random())
        a = draw_action(Q, phi[s], epsilon[e], rng.random(), rng.random())
        for t in range(1, max_steps + 1):
            explore, which, luck = rng.random(), rng.random(), rng.random()
            path[t - 1, 0], path[t - 1, 1] = phi[s], a
            s, rewards[t - 1], _ = step(mdp, s, a, luck)
            a = draw_action(Q, phi[s], epsilon[e], explore, which)
            if mdp.terminal[s]:
                break
        G, G_played = 0.0 if mdp.terminal[s] else Q[phi[s], a], 0.0
        for i in range(t - 1, -1, -1):
            z, a = path[i, 0], path[i, 1]
            G = rewards[i] + mdp.gamma * G
            G_played = rewards[i] + mdp.gamma * G_played
            Q[z, a] += alpha[e] * (G - Q[z, a])
        record(log, e, Q, G_played, t, s)
