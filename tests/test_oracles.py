"""The same answer from independent sources: other algorithms, other programs, and the loops without a compiler."""

import importlib
import json
import pkgutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

import rlnav as rl
from rlnav import _compile, estimation, learning, montecarlo, planning

from . import models
from .strategies import mdps, policies

pytestmark = pytest.mark.usefixtures("no_hang")

LEARNERS = [rl.q_learning, rl.sarsa, rl.expected_sarsa, rl.double_q_learning, rl.monte_carlo]


# ---------------------------------------------------------------- planning
def optimal_by_linear_program(mdp):
    """The least V that no backup exceeds: Puterman, Markov Decision Processes, 1994, section 6.9."""
    rows = np.arange(mdp.S)[:, None, None]
    constraints = np.zeros((mdp.S, mdp.A, mdp.S))
    np.add.at(constraints, (rows, np.arange(mdp.A)[:, None], mdp.next_state), mdp.gamma * mdp.prob)
    constraints -= np.eye(mdp.S)[:, None]
    expected_reward = (mdp.prob * mdp.reward).sum(axis=2)
    result = linprog(np.ones(mdp.S), constraints.reshape(-1, mdp.S), -expected_reward.ravel(), bounds=(None, None))
    assert result.success
    return result.x


def values_by_linear_algebra(mdp, pi):
    """The solution of (I - gamma P) v = r; terminal states keep v = 0 also when gamma is 1."""
    pi = np.eye(mdp.A)[pi] if pi.ndim == 1 else pi
    P = np.zeros((mdp.S, mdp.S))
    np.add.at(P, (np.arange(mdp.S)[:, None, None], mdp.next_state), pi[:, :, None] * mdp.prob)
    P[mdp.terminal] = 0
    return np.linalg.solve(np.eye(mdp.S) - mdp.gamma * P, (pi[:, :, None] * mdp.prob * mdp.reward).sum(axis=(1, 2)))


@given(mdps())
def test_four_ways_to_the_optimal_values(mdp):
    V = optimal_by_linear_program(mdp)
    np.testing.assert_allclose(rl.value_iteration(mdp, tol=1e-11).V, V, atol=1e-7)
    np.testing.assert_allclose(rl.policy_iteration(mdp).V, V, atol=1e-7)
    np.testing.assert_allclose(rl.solve(mdp, tol=1e-11).V, V, atol=1e-7)


@given(mdps(gammas=st.just(1.0), ends=(1, 2), stray=True))
def test_four_ways_to_the_optimal_values_without_discount(mdp):
    live = ~mdp.terminal  # without a discount the linear program says nothing about the states in which nothing happens
    V = np.where(live, values_by_linear_algebra(mdp, rl.policy_iteration(mdp).pi), 0)
    np.testing.assert_allclose(rl.value_iteration(mdp, tol=1e-11).V, V, atol=1e-7)
    np.testing.assert_allclose(rl.policy_iteration(mdp).V, V, atol=1e-7)
    np.testing.assert_allclose(rl.solve(mdp, tol=1e-11).V, V, atol=1e-7)


@given(st.data())
def test_policy_values_solve_the_linear_system(data):
    mdp = data.draw(mdps())
    pi = data.draw(policies(mdp))
    np.testing.assert_allclose(rl.evaluate_policy(mdp, pi), values_by_linear_algebra(mdp, pi), rtol=1e-8, atol=1e-8)


@given(st.data())
def test_policy_values_solve_the_linear_system_without_discount(data):
    mdp = data.draw(mdps(gammas=st.just(1.0), ends=(1, 2), stray=True))
    pi = data.draw(policies(mdp))
    np.testing.assert_allclose(rl.evaluate_policy(mdp, pi), values_by_linear_algebra(mdp, pi), rtol=1e-7, atol=1e-7)


@given(st.data())
def test_look_ahead_is_the_sum_written_out(data):
    mdp = data.draw(mdps())
    V = np.linspace(-3, 5, mdp.S)
    Q = rl.action_values(mdp, V)
    for s, a in np.ndindex(mdp.S, mdp.A):
        p, r, s_next = mdp.prob[s, a], mdp.reward[s, a], mdp.next_state[s, a]
        assert Q[s, a] == pytest.approx(sum(p[k] * (r[k] + mdp.gamma * V[s_next[k]]) for k in range(mdp.K)))


def test_planners_agree_on_every_map_of_the_book():
    for name in rl.maps.NAMES:
        world = rl.GridWorld.from_ascii(getattr(rl.maps, name))
        for slip in (0.0, 0.2):
            mdp = rl.Task(world, rl.Robot(slip=slip)).mdp()
            V = rl.policy_iteration(mdp).V
            np.testing.assert_allclose(rl.value_iteration(mdp).V, V, atol=2e-7)
            np.testing.assert_allclose(rl.solve(mdp).V, V, atol=2e-7)


# ---------------------------------------------------------------- learning, from the written protocol alone
class Dice:
    """A stream of uniform numbers, and what they decide."""

    def __init__(self, seed):
        self.next = np.random.default_rng(seed).random

    def successor(self, mdp, s, a, luck):
        """Walk along the probabilities until they exceed `luck`."""
        for k in range(mdp.K):
            luck -= float(mdp.prob[s, a, k])
            if luck < 0:
                return int(mdp.next_state[s, a, k]), float(mdp.reward[s, a, k])
        raise AssertionError("the probabilities of these tests sum to one")

    def action(self, row, epsilon, explore, which):
        """Any action, or any of the best: `which` counts along them."""
        candidates = range(len(row)) if explore < epsilon else [a for a, q in enumerate(row) if q == max(row)]
        return candidates[int(which * len(candidates))]


def naive(target, mdp, phi, episodes, alpha, epsilon, max_steps, seed, Q0=0.0):
    """Temporal-difference control with lists: three numbers begin an episode, three more come with every step."""
    dice = Dice(seed)
    Q = [[Q0] * mdp.A for _ in range(max(phi) + 1)]
    for _ in range(episodes):
        s = int(mdp.start[int(dice.next() * len(mdp.start))])
        a = dice.action(Q[phi[s]], epsilon, dice.next(), dice.next())
        for _ in range(max_steps):
            explore, which, luck = dice.next(), dice.next(), dice.next()
            s_next, r = dice.successor(mdp, s, a, luck)
            a_next = dice.action(Q[phi[s_next]], epsilon, explore, which)
            value = 0.0 if mdp.terminal[s_next] else mdp.gamma * target(Q[phi[s_next]], a_next, epsilon)
            Q[phi[s]][a] += alpha * (r + value - Q[phi[s]][a])
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
    return np.array(Q)


def naive_double(mdp, phi, episodes, alpha, epsilon, max_steps, seed):
    """Double Q-learning with lists: a fourth number in each step chooses the table."""
    dice = Dice(seed)
    tables = [[[0.0] * mdp.A for _ in range(max(phi) + 1)] for _ in range(2)]

    def mean(z):
        return [0.5 * (x + y) for x, y in zip(tables[0][z], tables[1][z], strict=True)]

    for _ in range(episodes):
        s = int(mdp.start[int(dice.next() * len(mdp.start))])
        a = dice.action(mean(phi[s]), epsilon, dice.next(), dice.next())
        for _ in range(max_steps):
            explore, which, luck, coin = dice.next(), dice.next(), dice.next(), dice.next()
            s_next, r = dice.successor(mdp, s, a, luck)
            a_next = dice.action(mean(phi[s_next]), epsilon, explore, which)
            mine, other = tables if coin < 0.5 else reversed(tables)
            row = mine[phi[s_next]]
            value = 0.0 if mdp.terminal[s_next] else mdp.gamma * other[phi[s_next]][row.index(max(row))]
            mine[phi[s]][a] += alpha * (r + value - mine[phi[s]][a])
            s, a = s_next, a_next
            if mdp.terminal[s]:
                break
    return np.array([mean(z) for z in range(max(phi) + 1)])


def naive_monte_carlo(mdp, phi, episodes, alpha, epsilon, max_steps, seed):
    """Every-visit Monte Carlo with lists, the last visit first."""
    dice = Dice(seed)
    Q = [[0.0] * mdp.A for _ in range(max(phi) + 1)]
    for _ in range(episodes):
        s = int(mdp.start[int(dice.next() * len(mdp.start))])
        a = dice.action(Q[phi[s]], epsilon, dice.next(), dice.next())
        path = []
        for _ in range(max_steps):
            explore, which, luck = dice.next(), dice.next(), dice.next()
            s_next, r = dice.successor(mdp, s, a, luck)
            path.append((phi[s], a, r))
            s, a = s_next, dice.action(Q[phi[s_next]], epsilon, explore, which)
            if mdp.terminal[s]:
                break
        G = 0.0 if mdp.terminal[s] else Q[phi[s]][a]
        for z, a, r in reversed(path):
            G = r + mdp.gamma * G
            Q[z][a] += alpha * (G - Q[z][a])
    return np.array(Q)


def greedy_target(row, a_next, epsilon):
    return max(row)


def sarsa_target(row, a_next, epsilon):
    return row[a_next]


def mean_target(row, a_next, epsilon):
    total = 0.0
    for q in row:  # not sum(), which rounds less from Python 3.12 on
        total += q
    return (1 - epsilon) * max(row) + epsilon * total / len(row)


PAIRS = {
    rl.q_learning: lambda *args: naive(greedy_target, *args),
    rl.sarsa: lambda *args: naive(sarsa_target, *args),
    rl.expected_sarsa: lambda *args: naive(mean_target, *args),
    rl.double_q_learning: naive_double,
    rl.monte_carlo: naive_monte_carlo,
}


@pytest.mark.parametrize("slip", [0.0, 0.3])
@pytest.mark.parametrize("learner", LEARNERS, ids=lambda learner: learner.__name__)
def test_learners_do_to_the_last_bit_what_their_description_says(learner, slip):
    world = rl.GridWorld.from_ascii("..G\n.#.\nS..")
    task = rl.Task(world, rl.Robot(slip=slip), features=[rl.designs.goal_direction(), rl.designs.heading()])
    mdp = task.mdp()
    for seed, phi in ((0, task.phi()), (1, np.arange(mdp.S)), (2, task.phi())):
        run = learner(mdp, phi, episodes=200, alpha=0.3, epsilon=0.2, max_steps=15, rng=seed)
        table = PAIRS[learner](mdp, phi.tolist(), 200, 0.3, 0.2, 15, seed)
        np.testing.assert_array_equal(run.Q, table)
        assert np.count_nonzero(run.Q) > 50


@pytest.mark.parametrize("seed", range(3))
def test_a_rule_of_ones_own_gives_the_built_in_tables_to_the_last_bit(small_task, seed):
    mdp = small_task.mdp()
    keywords = {"episodes": 80, "alpha": 0.3, "epsilon": 0.2, "max_steps": 15, "rng": seed, "Q0": 0.5}
    for rule, learner in ((rl.q_learning_rule, rl.q_learning), (rl.sarsa_rule, rl.sarsa)):
        mine, theirs = rl.learn(mdp, rule, **keywords), learner(mdp, **keywords)
        for name in ("Q", "pi", "returns", "steps", "terminated", "success"):
            np.testing.assert_array_equal(getattr(mine, name), getattr(theirs, name))


# ---------------------------------------------------------------- compiled = plain = without numba
KERNELS = {
    learning: ("_q_learning", "_sarsa", "_expected_sarsa", "_double_q_learning"),
    montecarlo: ("_monte_carlo",),
    estimation: ("_td_prediction", "_mc_prediction"),
    planning: ("_greedy_sweep", "_policy_sweep", "_look_ahead"),
}
needs_numba = pytest.mark.skipif(_compile.njit is None, reason="without numba there is nothing to compare with")


def tables(learners):
    """What the learners learn in small tasks of several kinds, as exact hexadecimal numbers."""
    found = {}
    keywords = {"episodes": 40, "alpha": np.linspace(1, 0.1, 40), "max_steps": 30, "snapshots": 3}
    for slip in (0.0, 0.2):
        world = rl.GridWorld.from_ascii("..G.\n.#..\nS...")
        task = rl.Task(world, rl.Robot(slip=slip), features=[rl.designs.goal_bearing(), rl.designs.moves_ahead()])
        mdp = task.mdp()
        for design, phi in (("poses", None), ("features", task.phi())):
            for seed in (0, 1):
                for learner in learners:
                    run = learner(mdp, phi, **keywords, rng=seed)
                    key = f"{learner.__name__} slip={slip} {design} seed={seed}"
                    parts = (run.Q, run.returns, run.steps.astype(float), run.snapshots)
                    found[key] = [float(x).hex() for part in parts for x in part.ravel()]
        for predictor in (rl.td_prediction, rl.mc_prediction):
            run = predictor(mdp, np.full((mdp.S, mdp.A), 1 / mdp.A), **keywords, rng=0)
            parts = (run.V, run.returns, run.steps.astype(float), run.snapshots)
            found[f"{predictor.__name__} slip={slip}"] = [float(x).hex() for part in parts for x in part.ravel()]
        found[f"solve slip={slip}"] = [float(x).hex() for x in rl.solve(mdp).V]
    return found


@needs_numba
def test_compiled_and_plain_loops_give_the_same_bits(monkeypatch):
    compiled = tables(LEARNERS)
    for module, names in KERNELS.items():
        for name in names:
            monkeypatch.setattr(module, name, getattr(module, name).py_func)
    assert tables(LEARNERS) == compiled


@needs_numba
def test_a_process_without_numba_gives_the_same_bits():
    program = (
        "import sys, json; sys.modules['numba'] = None\n"
        "from tests.test_oracles import LEARNERS, tables\n"
        "from rlnav import _compile; assert _compile.njit is None\n"
        "print(json.dumps(tables(LEARNERS)))"
    )
    command, root = [sys.executable, "-W", "error", "-c", program], Path(__file__).parents[1]
    run = subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout) == tables(LEARNERS)


@needs_numba
def test_every_kernel_is_compared():
    for found in pkgutil.iter_modules(rl.__path__):
        module = importlib.import_module(f"rlnav.{found.name}")
        kernels = {name for name, value in vars(module).items() if hasattr(value, "py_func")}
        assert kernels == set(KERNELS.get(module, ())), module


def test_the_textbook_cliff_is_the_one_of_gymnasium():
    gymnasium = pytest.importorskip("gymnasium")
    ours, theirs = models.sutton_cliff(), rl.env.to_mdp(gymnasium.make("CliffWalking-v1"), 1.0)
    np.testing.assert_array_equal(ours.next_state, theirs.next_state)
    np.testing.assert_array_equal(ours.reward, theirs.reward)
