"""Random small problems for the tests with Hypothesis."""

import numpy as np
from hypothesis import strategies as st

import rlnav as rl

SEEDS = st.integers(0, 2**32 - 1)
DISCOUNTS = st.sampled_from([0.0, 0.3, 0.5, 0.9, 0.97])


@st.composite
def mdps(draw, gammas=DISCOUNTS, ends=(0, 2), stray=False):
    """Draw an MDP of 1 to 8 states; `ends` bounds the number of terminal ones.

    With `stray` every action enters a terminal state with a chance of at least 0.05, so that every policy ends.
    """
    n_ends = draw(st.integers(*ends))
    S, A, K = draw(st.integers(n_ends + 1, 8)), draw(st.integers(1, 4)), draw(st.integers(1, 4))
    gamma, random = draw(gammas), np.random.default_rng(draw(SEEDS))
    next_state, prob = random.integers(0, S, (S, A, K)), random.random((S, A, K)) ** 3 + 1e-3
    reward = random.integers(-8, 9, (S, A, K)) / 2
    prob *= random.random((S, A, K)) > 0.2  # some successors are impossible
    if stray:
        next_state[:, :, 0] = S - 1
        prob[:, :, 0] = np.maximum(prob[:, :, 0], 0.2)
    prob[:, :, 0] += prob.sum(axis=2) == 0
    terminal = np.arange(S) >= S - n_ends
    next_state[terminal], reward[terminal] = np.arange(S)[terminal, None, None], 0.0
    start = random.choice(S - n_ends, size=draw(st.integers(1, 3)))
    return rl.MDP(next_state, prob / prob.sum(axis=2, keepdims=True), reward, gamma, terminal, start)


@st.composite
def values(draw, mdp):
    """Draw one value a state."""
    return 10 * np.random.default_rng(draw(SEEDS)).standard_normal(mdp.S)


@st.composite
def policies(draw, mdp):
    """Draw an action a state, or a distribution over actions a state."""
    random = np.random.default_rng(draw(SEEDS))
    if draw(st.booleans()):
        return random.integers(0, mdp.A, mdp.S)
    return random.dirichlet(np.ones(mdp.A), mdp.S)


@st.composite
def worlds(draw, most=5):
    """Draw a world of up to `most` cells along each side."""
    width, height = draw(st.integers(2, most)), draw(st.integers(2, most))
    return rl.maps.random(width, height, density=draw(st.sampled_from([0.0, 0.2, 0.4])), rng=draw(SEEDS))


STEERINGS = st.sampled_from([(-90, -45, 0, 45, 90), (-45, 0, 45), (0, 90), (-180, -90, 0, 90, 180), (45,)])
SLIPS = st.sampled_from([0.0, 0.1, 0.5, 1.0])
