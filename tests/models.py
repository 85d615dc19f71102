"""Textbook problems as MDPs. All are built by one function, from transitions written as in the books."""

from collections.abc import Callable, Iterable

import numpy as np

import rlnav as rl

Outcomes = Callable[[int, int], Iterable[tuple[float, int, float]]]  # outcomes(s, a) -> (p, s', r), ...


def model(S: int, A: int, outcomes: Outcomes, gamma: float, terminal: Iterable[int] = (), start=0) -> rl.MDP:
    """Build the MDP in which action a in state s has these outcomes; terminal states need none."""
    ends = set(terminal)
    rows = [[[(1.0, s, 0.0)] if s in ends else list(outcomes(s, a)) for a in range(A)] for s in range(S)]
    K = max(len(row) for state in rows for row in state)
    padded = np.array([[row + [(0.0, s, 0.0)] * (K - len(row)) for row in state] for s, state in enumerate(rows)])
    flags = np.isin(np.arange(S), list(ends))
    return rl.MDP(padded[..., 1].astype(int), padded[..., 0], padded[..., 2], gamma, flags, start)


NORTH, EAST, SOUTH, WEST = range(4)
STEPS = {NORTH: (-1, 0), EAST: (0, 1), SOUTH: (1, 0), WEST: (0, -1)}  # (row, column); row 0 is the top row


def moved(s: int, a: int, rows: int, columns: int) -> int:
    """The cell that a move leads to; a move off the grid leaves the robot where it is."""
    row, column = s // columns + STEPS[a][0], s % columns + STEPS[a][1]
    return row * columns + column if 0 <= row < rows and 0 <= column < columns else s


def sutton_gridworld() -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 3.5: from A to A' for 10, from B to B' for 5, -1 for running into the edge."""

    def outcomes(s, a):
        if s in (1, 3):
            return [(1.0, 21, 10.0) if s == 1 else (1.0, 13, 5.0)]
        s_next = moved(s, a, 5, 5)
        return [(1.0, s_next, -1.0 if s_next == s else 0.0)]

    return model(25, 4, outcomes, 0.9, start=np.arange(25))


def sutton_small_gridworld() -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 4.1: 4 x 4 cells, two corners are terminal, -1 a step, undiscounted."""
    return model(16, 4, lambda s, a: [(1.0, moved(s, a, 4, 4), -1.0)], 1.0, terminal=(0, 15), start=np.arange(1, 15))


def random_walk(n: int, left: float = 0.0, right: float = 1.0) -> rl.MDP:
    """Sutton and Barto, 2nd ed., examples 6.2 and 7.1: n states in a row, one step to either side by chance."""

    def outcomes(s, _):
        return [(0.5, s - 1, left if s == 1 else 0.0), (0.5, s + 1, right if s == n else 0.0)]

    return model(n + 2, 1, outcomes, 1.0, terminal=(0, n + 1), start=(n + 1) // 2)


def gambler(p_heads: float) -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 4.3: stake a + 1 of the capital s on a coin, the aim is 100."""

    def outcomes(s, a):
        stake = min(a + 1, s, 100 - s)
        return [(p_heads, s + stake, float(s + stake == 100)), (1 - p_heads, s - stake, 0.0)]

    return model(101, 50, outcomes, 1.0, terminal=(0, 100), start=50)


HIGH, LOW = 0, 1
SEARCH, WAIT, RECHARGE = 0, 1, 2


def recycling_robot(alpha: float, beta: float, r_search: float, r_wait: float, gamma: float) -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 3.3; with a high battery there is no recharging, so action 2 waits there."""

    def outcomes(s, a):
        if a == SEARCH and s == HIGH:
            return [(alpha, HIGH, r_search), (1 - alpha, LOW, r_search)]
        if a == SEARCH:
            return [(beta, LOW, r_search), (1 - beta, HIGH, -3.0)]
        return [(1.0, HIGH, 0.0)] if (s, a) == (LOW, RECHARGE) else [(1.0, s, r_wait)]

    return model(2, 3, outcomes, gamma, start=HIGH)


def sutton_cliff() -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 6.6: 4 x 12 cells; the cliff costs 100 and leads back to the start."""

    def outcomes(s, a):
        s_next = moved(s, a, 4, 12)
        return [(1.0, 36, -100.0)] if 36 < s_next < 47 else [(1.0, s_next, -1.0)]

    return model(48, 4, outcomes, 1.0, terminal=(47,), start=36)


def windy_gridworld() -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 6.5: 7 x 10 cells, the wind of the column that is left blows upwards."""
    wind = (0, 0, 0, 1, 1, 1, 2, 2, 1, 0)

    def outcomes(s, a):
        row = s // 10 + STEPS[a][0] - wind[s % 10]
        column = s % 10 + STEPS[a][1]
        return [(1.0, 10 * min(max(row, 0), 6) + min(max(column, 0), 9), -1.0)]

    return model(70, 4, outcomes, 1.0, terminal=(37,), start=30)


def maximisation_bias() -> rl.MDP:
    """Sutton and Barto, 2nd ed., example 6.7, except that the rewards of B are -0.1 - 1 or -0.1 + 1, equally likely.

    They have the mean and standard deviation of the book's normal distribution.  Actions 0 ... 4 in A lead to B
    ("left"), 5 ... 9 end the episode.
    """

    def outcomes(s, a):
        if s == 0:
            return [(1.0, 1, 0.0)] if a < 5 else [(1.0, 2, 0.0)]
        return [(0.5, 2, -1.1), (0.5, 2, 0.9)]

    return model(3, 10, outcomes, 1.0, terminal=(2,), start=0)


def russell_norvig() -> rl.MDP:
    """Russell and Norvig, 3rd ed., section 17.1: 3 x 4 cells, a wall, exits for +1 and -1, 0.1 to stray to each side.

    Their reward of -0.04 belongs to the state that is left: it is paid on every step, the exits' on entering them.
    """
    wall, exits = 5, {3: 1.0, 7: -1.0}

    def outcomes(s, a):
        for turn, p in ((0, 0.8), (1, 0.1), (3, 0.1)):
            s_next = moved(s, (a + turn) % 4, 3, 4)
            s_next = s if s_next == wall else s_next
            yield p, s_next, -0.04 + exits.get(s_next, 0.0)

    return model(12, 4, outcomes, 1.0, terminal=(3, 7, wall), start=8)


def puterman(gamma: float) -> rl.MDP:
    """Puterman, Markov Decision Processes, section 3.1: a gamble for 5 or a way out for 10, then costs for ever."""

    def outcomes(s, a):
        if s == 1:
            return [(1.0, 1, -1.0)]
        return [(0.5, 0, 5.0), (0.5, 1, 5.0)] if a == 0 else [(1.0, 1, 10.0)]

    return model(2, 2, outcomes, gamma, start=0)
