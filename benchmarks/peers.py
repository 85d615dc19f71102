"""What people would use instead: QuantEcon to plan, and the loop of Gymnasium's tutorial to learn."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec

import numpy as np

import rlnav as rl


def planners(mdp: rl.MDP, r: np.ndarray, error: float) -> dict[str, Callable[[], np.ndarray]]:
    """Return name: solve() -> V for the peers that are installed, already set up, with V within `error`."""
    if not find_spec("quantecon"):
        return {}
    from quantecon.markov import DiscreteDP
    from scipy.sparse import csr_matrix

    S, A, K = mdp.prob.shape
    rows = np.arange(0, S * A * K + 1, K)
    P = csr_matrix((mdp.prob.ravel(), mdp.next_state.ravel(), rows), shape=(S * A, S), copy=True)
    P.sum_duplicates()
    model = DiscreteDP(r.ravel(), P, mdp.gamma, np.repeat(np.arange(S), A), np.tile(np.arange(A), S))

    def solve(method: str) -> np.ndarray:
        return model.solve(method=method, epsilon=error, max_iter=10**6, k=20).v

    names = ("value_iteration", "modified_policy_iteration")
    return {f"QuantEcon, {name.replace('_', ' ')}": partial(solve, name) for name in names}


def tutorial(
    mdp: rl.MDP, slip: float, *, episodes: int, alpha: float, epsilon: float, max_steps: int, rng: int
) -> tuple[np.ndarray, int]:
    """Learn as Gymnasium's tutorial "Training an agent" does; return (Q, steps).

    The environment is as lean as Python allows: two tables as lists, no wrappers.
    """
    import gymnasium

    class Robot(gymnasium.Env):
        action_space = gymnasium.spaces.Discrete(mdp.A)
        tables = mdp.next_state[:, :, 0].tolist(), mdp.reward[:, :, 0].tolist()
        ends, starts = mdp.terminal.tolist(), mdp.start.tolist()

        def reset(self, *, seed=None, options=None):
            super().reset(seed=seed)
            self.s, self.t = self.starts[self.np_random.integers(len(self.starts))], 0
            return self.s, {}

        def step(self, action):
            luck, applied = self.np_random.random(), action
            if luck < slip:
                applied = max(action - 1, 0) if luck < slip / 2 else min(action + 1, mdp.A - 1)
            reward = self.tables[1][self.s][applied]
            self.s, self.t = self.tables[0][self.s][applied], self.t + 1
            return self.s, reward, self.ends[self.s], self.t >= max_steps, {}

    env, generator, steps = Robot(), np.random.default_rng(rng), 0
    Q: dict[int, np.ndarray] = defaultdict(lambda: np.zeros(mdp.A))
    env.action_space.seed(rng)
    for e in range(episodes):
        s, _ = env.reset(seed=None if e else rng)
        done = False
        while not done:
            explore = generator.random() < epsilon
            a = int(env.action_space.sample()) if explore else int(np.argmax(Q[s]))
            s_next, r, terminated, truncated, _ = env.step(a)
            Q[s][a] += alpha * (r + mdp.gamma * (not terminated) * np.max(Q[s_next]) - Q[s][a])
            done, s, steps = terminated or truncated, s_next, steps + 1
    return np.array([Q[s] for s in range(mdp.S)]), steps
