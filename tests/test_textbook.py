"""Answers that are printed in textbooks."""

import numpy as np
import pytest

import rlnav as rl

from . import models
from .models import EAST, HIGH, LOW, NORTH, RECHARGE, SEARCH, SOUTH, WAIT, WEST

ONE_DECIMAL = {"atol": 0.05 + 1e-9, "rtol": 0}


def uniform(mdp):
    """The policy that chooses every action equally often."""
    return np.full((mdp.S, mdp.A), 1 / mdp.A)


def test_random_policy_on_the_gridworld_of_sutton_and_barto():
    # Sutton and Barto, 2nd ed., figure 3.2
    printed = [
        [3.3, 8.8, 4.4, 5.3, 1.5],
        [1.5, 3.0, 2.3, 1.9, 0.5],
        [0.1, 0.7, 0.7, 0.4, -0.4],
        [-1.0, -0.4, -0.4, -0.6, -1.2],
        [-1.9, -1.3, -1.2, -1.4, -2.0],
    ]
    mdp = models.sutton_gridworld()
    np.testing.assert_allclose(rl.evaluate_policy(mdp, uniform(mdp)).reshape(5, 5), printed, **ONE_DECIMAL)


@pytest.mark.parametrize("planner", [rl.value_iteration, rl.policy_iteration, rl.solve])
def test_optimal_values_on_the_gridworld_of_sutton_and_barto(planner):
    # Sutton and Barto, 2nd ed., figure 3.5, middle
    printed = [
        [22.0, 24.4, 22.0, 19.4, 17.5],
        [19.8, 22.0, 19.8, 17.8, 16.0],
        [17.8, 19.8, 17.8, 16.0, 14.4],
        [16.0, 17.8, 16.0, 14.4, 13.0],
        [14.4, 16.0, 14.4, 13.0, 11.7],
    ]
    np.testing.assert_allclose(planner(models.sutton_gridworld()).V.reshape(5, 5), printed, **ONE_DECIMAL)


def test_all_optimal_actions_on_the_gridworld_of_sutton_and_barto():
    # Sutton and Barto, 2nd ed., figure 3.5, right
    printed = [["E", "NESW", "W", "NESW", "W"], ["NE", "N", "NW", "W", "W"]] + 3 * [["NE", "N", "NW", "NW", "NW"]]
    Q = rl.solve(models.sutton_gridworld(), tol=1e-10).Q
    found = ["".join("NESW"[a] for a in np.flatnonzero(q > q.max() - 1e-6)) for q in Q]
    assert np.reshape(found, (5, 5)).tolist() == printed


@pytest.mark.parametrize(
    ("k", "printed"),
    [
        (1, [[0.0, -1.0, -1.0, -1.0], [-1.0, -1.0, -1.0, -1.0]]),
        (2, [[0.0, -1.7, -2.0, -2.0], [-1.7, -2.0, -2.0, -2.0]]),
        (3, [[0.0, -2.4, -2.9, -3.0], [-2.4, -2.9, -3.0, -2.9]]),
        (10, [[0.0, -6.1, -8.4, -9.0], [-6.1, -7.7, -8.4, -8.4]]),
    ],
)
def test_sweeps_of_iterative_policy_evaluation(k, printed):
    # Sutton and Barto, 2nd ed., figure 4.1, left; the lower half is the upper one turned by 180 degrees
    mdp = models.sutton_small_gridworld()
    V = np.zeros(mdp.S)
    for _ in range(k):
        V = rl.action_values(mdp, V).mean(axis=1)
    # the book cuts some of these numbers after one decimal (-1.75 is printed as -1.7), so allow one unit there
    np.testing.assert_allclose(V.reshape(4, 4), printed + [row[::-1] for row in printed[::-1]], atol=0.07)


def test_values_of_the_random_policy_on_the_small_gridworld():
    # Sutton and Barto, 2nd ed., figure 4.1, k = infinity
    mdp = models.sutton_small_gridworld()
    printed = [[0, -14, -20, -22], [-14, -18, -20, -20], [-20, -20, -18, -14], [-22, -20, -14, 0]]
    np.testing.assert_allclose(rl.evaluate_policy(mdp, uniform(mdp)).reshape(4, 4), printed, atol=1e-6)


def test_action_values_of_the_random_policy_on_the_small_gridworld():
    # Sutton and Barto, 2nd ed., exercise 4.1: q(11, down) = -1 and q(7, down) = -1 + v(11) = -15
    mdp = models.sutton_small_gridworld()
    Q = rl.action_values(mdp, rl.evaluate_policy(mdp, uniform(mdp)))
    assert Q[11, SOUTH] == pytest.approx(-1)
    assert Q[7, SOUTH] == pytest.approx(-15)


def test_improving_the_random_policy_once_is_enough_on_the_small_gridworld():
    # Sutton and Barto, 2nd ed., section 4.2: the greedy policy of the random policy's values is already optimal
    mdp = models.sutton_small_gridworld()
    improved = rl.greedy(rl.action_values(mdp, rl.evaluate_policy(mdp, uniform(mdp))))
    steps = [[0, 1, 2, 3], [1, 2, 3, 2], [2, 3, 2, 1], [3, 2, 1, 0]]
    np.testing.assert_allclose(-rl.evaluate_policy(mdp, improved).reshape(4, 4), steps, atol=1e-9)


@pytest.mark.parametrize(
    ("alpha", "beta", "r_search", "r_wait", "gamma", "expected"),
    [
        (0.9, 0.8, 3.0, 1.0, 0.9, (SEARCH, RECHARGE)),
        (0.9, 1.0, 3.0, 1.0, 0.5, (SEARCH, SEARCH)),
        (0.2, 0.1, 1.1, 1.0, 0.2, (SEARCH, WAIT)),
        (0.5, 0.5, 1.0, 2.0, 0.9, (WAIT, WAIT)),
    ],
)
def test_recycling_robot_has_the_values_of_its_best_policy(alpha, beta, r_search, r_wait, gamma, expected):
    # Sutton and Barto, 2nd ed., example 3.9: two linear equations for each of the six deterministic policies
    rows = {
        (HIGH, SEARCH): ([alpha, 1 - alpha], r_search),
        (HIGH, WAIT): ([1, 0], r_wait),
        (LOW, SEARCH): ([1 - beta, beta], beta * r_search - 3 * (1 - beta)),
        (LOW, WAIT): ([0, 1], r_wait),
        (LOW, RECHARGE): ([1, 0], 0.0),
    }
    values = {}
    for high in (SEARCH, WAIT):
        for low in (SEARCH, WAIT, RECHARGE):
            (a, b), r_high = rows[HIGH, high]
            (c, d), r_low = rows[LOW, low]
            determinant = (1 - gamma * a) * (1 - gamma * d) - gamma**2 * b * c  # Cramer's rule
            v_high = (r_high * (1 - gamma * d) + gamma * b * r_low) / determinant
            v_low = (r_low * (1 - gamma * a) + gamma * c * r_high) / determinant
            values[high, low] = (v_high, v_low)
    best = max(values, key=lambda policy: sum(values[policy]))
    assert best == expected  # so that the four cases cover different answers
    solution = rl.solve(models.recycling_robot(alpha, beta, r_search, r_wait, gamma), tol=1e-12)
    np.testing.assert_allclose(solution.V, values[best], rtol=1e-9)
    assert tuple(solution.pi) == best


def test_gambler_wins_by_bold_play():
    # Sutton and Barto, 2nd ed., example 4.3 and figure 4.3: with p = 0.4 staking all, or what is missing, is optimal.
    # From 50 one flip decides; from 25 two wins are needed; from 75 a win, or a loss and then a win.
    V = rl.solve(models.gambler(0.4), tol=1e-12).V
    assert V[50] == pytest.approx(0.4)
    assert V[25] == pytest.approx(0.4**2)
    assert V[75] == pytest.approx(0.4 + 0.6 * 0.4)


@pytest.mark.parametrize("p", [0.25, 0.4, 0.49])
def test_gambler_has_the_value_of_bold_play_from_every_capital(p):
    # The functional equation of bold play: L. Dubins and L. Savage, How to Gamble If You Must, 1965, chapter 5
    V = rl.solve(models.gambler(p), tol=1e-13).V
    capital = np.arange(1, 100)
    bold = np.where(capital <= 50, p * V[(2 * capital) % 101], p + (1 - p) * V[(2 * capital - 100) % 101])
    bold = np.where(capital == 50, p, bold)
    np.testing.assert_allclose(V[1:100], bold, atol=1e-9)


def test_gambler_with_a_better_coin_is_hardly_ever_ruined_by_timid_play():
    # Gambler's ruin: W. Feller, An Introduction to Probability Theory, 3rd ed., volume 1, section XIV.2
    mdp = models.gambler(0.55)
    ratio = 0.45 / 0.55
    ruin = (1 - ratio ** np.arange(100)) / (1 - ratio**100)
    np.testing.assert_allclose(rl.evaluate_policy(mdp, np.zeros(101, int))[:100], ruin, atol=1e-8)
    np.testing.assert_allclose(rl.solve(mdp, tol=1e-12).V[:100], ruin, atol=1e-8)


def test_random_walk_of_five_states():
    # Sutton and Barto, 2nd ed., example 6.2: true values 1/6 ... 5/6
    V = rl.evaluate_policy(models.random_walk(5), np.zeros(7, int))
    np.testing.assert_allclose(V[1:6], np.arange(1, 6) / 6, atol=1e-9)


def test_random_walk_of_nineteen_states():
    # Sutton and Barto, 2nd ed., example 7.1: -1 on the left, +1 on the right, true values -0.9 ... 0.9
    V = rl.evaluate_policy(models.random_walk(19, left=-1.0), np.zeros(21, int))
    np.testing.assert_allclose(V[1:20], np.arange(-9, 10) / 10, atol=1e-8)


def test_returns_are_computed_backwards():
    # Sutton and Barto, 2nd ed., exercise 3.8: gamma = 0.5 and rewards -1, 2, 6, 3, 2
    np.testing.assert_allclose(rl.returns([-1, 2, 6, 3, 2], gamma=0.5), [2, 6, 8, 4, 2])


def test_return_of_a_reward_that_never_stops():
    # Sutton and Barto, 2nd ed., exercise 3.9: gamma = 0.9, a reward of 2 and then 7 for ever; G_1 = 70, G_0 = 65
    G = rl.returns([2] + [7] * 500, gamma=0.9)
    assert G[:2] == pytest.approx([65, 70])


def test_shortest_way_along_the_cliff_takes_thirteen_steps():
    # Sutton and Barto, 2nd ed., example 6.6
    mdp = models.sutton_cliff()
    best = rl.solve(mdp)
    path = rl.rollout(mdp, best.pi, rng=0)
    assert best.V[36] == pytest.approx(-13)
    assert path.actions.tolist() == [NORTH] + [EAST] * 11 + [SOUTH]


def test_sarsa_takes_the_safe_way_and_q_learning_the_short_one():
    # Sutton and Barto, 2nd ed., example 6.6: epsilon 0.1; Q-learning falls more often while it learns.  Seeds 0 ... 9.
    mdp = models.sutton_cliff()
    keywords = {"episodes": 2000, "alpha": 0.1, "epsilon": 0.1}
    for seed in range(10):
        short, safe = rl.q_learning(mdp, **keywords, rng=seed), rl.sarsa(mdp, **keywords, rng=seed)
        short_path, safe_path = rl.rollout(mdp, short.pi, rng=0), rl.rollout(mdp, safe.pi, rng=0)
        assert short_path.rewards.sum() == -13
        assert safe_path.terminated
        assert safe_path.states.min() < 24  # it keeps a row of cells between itself and the cliff
        assert safe.returns[-500:].mean() > short.returns[-500:].mean() + 10


def test_way_through_the_wind_takes_fifteen_steps():
    # Sutton and Barto, 2nd ed., example 6.5
    assert rl.solve(models.windy_gridworld()).V[30] == pytest.approx(-15)


def test_double_q_learning_is_not_drawn_to_the_left():
    # Sutton and Barto, 2nd ed., figure 6.5: alpha 0.1, epsilon 0.1, 300 episodes; the least possible share of left is
    # epsilon / 2 = 5 %.  Q-learning goes left in most of the early episodes, Double Q-learning does not.
    # Seeds 0 ... 299: the standard error of each share is below 0.03.
    mdp = models.maximisation_bias()

    def share_of_left(learner):
        runs = [learner(mdp, episodes=300, alpha=0.1, epsilon=0.1, rng=seed) for seed in range(300)]
        return (np.array([run.steps for run in runs]) == 2).mean(axis=0)  # left takes two steps

    single, double = share_of_left(rl.q_learning), share_of_left(rl.double_q_learning)
    assert single[10:50].mean() > 0.8
    assert double[10:50].mean() < 0.5
    assert double[-50:].mean() < 0.1 < single[-50:].mean()


def test_utilities_of_the_world_of_russell_and_norvig():
    # Russell and Norvig, Artificial Intelligence, 3rd ed., figure 17.3: gamma 1, reward -0.04
    V = rl.solve(models.russell_norvig(), tol=1e-10).V.reshape(3, 4)
    np.testing.assert_allclose(V[0, :3], [0.812, 0.868, 0.918], atol=5e-4)
    np.testing.assert_allclose(V[1, [0, 2]], [0.762, 0.660], atol=5e-4)
    np.testing.assert_allclose(V[2], [0.705, 0.655, 0.611, 0.388], atol=5e-4)


def test_policy_of_the_world_of_russell_and_norvig():
    # Russell and Norvig, Artificial Intelligence, 3rd ed., figure 17.2 (a)
    pi = rl.policy_iteration(models.russell_norvig()).pi.reshape(3, 4)
    assert pi[0, :3].tolist() == [EAST, EAST, EAST]
    assert pi[1, [0, 2]].tolist() == [NORTH, NORTH]
    assert pi[2].tolist() == [NORTH, WEST, WEST, WEST]


def test_two_states_of_puterman():
    # Puterman, Markov Decision Processes, 1994, section 3.1 and example 6.2.1: at 0.95 the gamble is better
    solution = rl.solve(models.puterman(0.95), tol=1e-12)
    np.testing.assert_allclose(solution.V, [-60 / 7, -20], rtol=1e-9)
    assert solution.pi[0] == 0


@pytest.mark.parametrize("gamma", [0.0, 0.5, 0.9, 10 / 11 - 1e-3, 10 / 11 + 1e-3, 0.95, 0.999])
def test_two_states_of_puterman_at_any_discount(gamma):
    # Solved by hand: out at once is worth (10 - 11 g) / (1 - g), the gamble (5 - 5.5 g) / ((1 - g / 2) (1 - g)), and
    # they cross at g = 10/11.
    out = (10 - 11 * gamma) / (1 - gamma)
    gamble = (5 - 5.5 * gamma) / ((1 - gamma / 2) * (1 - gamma))
    for planner in (rl.value_iteration, rl.solve):
        solution = planner(models.puterman(gamma), tol=1e-12)
        np.testing.assert_allclose(solution.V, [max(out, gamble), -1 / (1 - gamma)], rtol=1e-9)
        assert solution.pi[0] == (gamma < 10 / 11)
    assert rl.policy_iteration(models.puterman(gamma)).pi[0] == (gamma < 10 / 11)
