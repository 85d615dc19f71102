"""Prediction from experience: the episodes of `rollout`, the updates of the two formulas, and where they lead."""

import numpy as np
import pytest

import rlnav as rl

from . import models

PREDICTORS = [rl.td_prediction, rl.mc_prediction]
every_predictor = pytest.mark.parametrize("predictor", PREDICTORS, ids=lambda predictor: predictor.__name__)
WALK = models.random_walk(5)
ONLY = np.zeros(7, int)  # the random walk has one action
TASK = rl.Task(rl.GridWorld.from_ascii("..G\n.#.\n..."), rl.Robot(slip=0.2))
# One state for ever, a reward of 1 a step: worth 10
LOOP = rl.MDP([[[0]]], [[[1.0]]], [[[1.0]]], 0.9, [False], 0)


def policies(mdp):
    """A policy that is sure, and one that throws dice with very unequal chances."""
    random = np.random.default_rng(5)
    chances = random.dirichlet(np.full(mdp.A, 0.3), mdp.S)
    chances[random.random(chances.shape) < 0.3] = 0
    chances[chances.sum(axis=1) == 0] = 1
    return [random.integers(0, mdp.A, mdp.S), chances / chances.sum(axis=1, keepdims=True)]


def episodes_of(mdp, pi, n, max_steps, seed):
    """The same episodes, played one by one with one generator."""
    generator = np.random.default_rng(seed)
    return [rl.rollout(mdp, pi, max_steps=max_steps, rng=generator) for _ in range(n)]


# ---------------------------------------------------------------- the formulas, written out
@pytest.mark.parametrize("which", [0, 1])
@pytest.mark.parametrize("max_steps", [4, 60])
def test_td_is_its_formula_along_the_episodes_of_rollout(which, max_steps):
    mdp = TASK.mdp()
    pi = policies(mdp)[which]
    run = rl.td_prediction(mdp, pi, episodes=150, alpha=0.3, max_steps=max_steps, rng=7)
    V = [0.0] * mdp.S
    for episode in episodes_of(mdp, pi, 150, max_steps, 7):
        for s, r, s_next in zip(episode.states, episode.rewards, episode.states[1:], strict=False):
            target = r if mdp.terminal[s_next] else r + mdp.gamma * V[s_next]
            V[s] += 0.3 * (target - V[s])
    np.testing.assert_array_equal(run.V, V)
    assert np.count_nonzero(run.V) > 10


@pytest.mark.parametrize("which", [0, 1])
@pytest.mark.parametrize("max_steps", [4, 60])
def test_monte_carlo_is_its_formula_along_the_episodes_of_rollout(which, max_steps):
    mdp = TASK.mdp()
    pi = policies(mdp)[which]
    run = rl.mc_prediction(mdp, pi, episodes=150, alpha=0.3, max_steps=max_steps, rng=7)
    V = [0.0] * mdp.S
    for episode in episodes_of(mdp, pi, 150, max_steps, 7):
        G = 0.0 if episode.terminated else V[episode.states[-1]]
        for s, r in zip(reversed(episode.states[:-1]), reversed(episode.rewards), strict=True):
            G = r + mdp.gamma * G
            V[s] += 0.3 * (G - V[s])
    np.testing.assert_array_equal(run.V, V)
    assert np.count_nonzero(run.V) > 10


@every_predictor
def test_the_log_is_that_of_the_episodes(predictor):
    mdp = TASK.mdp()
    pi = policies(mdp)[1]
    run = predictor(mdp, pi, episodes=80, max_steps=2, rng=3)
    played = episodes_of(mdp, pi, 80, 2, 3)
    assert run.steps.tolist() == [episode.actions.size for episode in played]
    assert run.terminated.tolist() == [episode.terminated for episode in played]
    np.testing.assert_allclose(run.returns, [rl.returns(episode.rewards, mdp.gamma)[0] for episode in played])
    assert 0 < run.terminated.sum() < 80


# ---------------------------------------------------------------- where they lead
@every_predictor
def test_with_shrinking_steps_the_values_of_the_policy_are_found(predictor):
    # Seed 0, a million episodes, step sizes 1 / (1 + e / 100); the largest error found was 0.15, values are -10 to 10
    mdp = TASK.mdp()
    n, chance = 1_000_000, np.full((mdp.S, mdp.A), 1 / mdp.A)
    run = predictor(mdp, chance, episodes=n, alpha=1 / (1 + np.arange(n) / 100), rng=0)
    assert np.abs(run.V - rl.evaluate_policy(mdp, chance)).max() < 0.3


def test_the_first_walk_teaches_td_one_value_only():
    # Sutton and Barto, 2nd ed., example 6.2 and exercise 6.3: from 0.5, a walk that ends on the left changes V(A) alone
    seed = next(seed for seed in range(99) if rl.rollout(WALK, ONLY, rng=seed).states[-1] == 0)
    run = rl.td_prediction(WALK, ONLY, episodes=1, alpha=0.1, V0=0.5, rng=seed)
    np.testing.assert_allclose(run.V, [0, 0.45, 0.5, 0.5, 0.5, 0.5, 0])


def test_td_is_better_than_monte_carlo_on_the_random_walk():
    # Sutton and Barto, 2nd ed., example 6.2, right: mean over 100 runs of the RMS error over the five states.  It is
    # 0.236 at first; after 100 walks TD is at its best with alpha = 0.05, and Monte Carlo comes near it with no step
    # size.
    truth = np.arange(1, 6) / 6

    def error(predictor, alpha):
        settings = {"episodes": 100, "alpha": alpha, "V0": 0.5, "snapshots": 100}
        tables = np.array([predictor(WALK, ONLY, **settings, rng=seed).snapshots for seed in range(100)])
        return np.sqrt(((tables[:, :, 1:6] - truth) ** 2).mean(axis=2)).mean(axis=0)

    assert np.sqrt(((0.5 - truth) ** 2).mean()) == pytest.approx(0.236, abs=5e-4)
    td = {alpha: error(rl.td_prediction, alpha) for alpha in (0.05, 0.1, 0.15)}
    mc = {alpha: error(rl.mc_prediction, alpha) for alpha in (0.01, 0.02, 0.03, 0.04)}
    assert min(td, key=lambda alpha: td[alpha][-1]) == 0.05
    assert td[0.05][-1] < min(curve[-1] for curve in mc.values()) - 0.02
    assert min(curve[20] for curve in td.values()) < min(curve[20] for curve in mc.values())


# ---------------------------------------------------------------- ends and cuts
@every_predictor
def test_running_out_of_steps_does_not_cut_the_future_off(predictor):
    run = predictor(LOOP, [0], episodes=20_000, max_steps=1, alpha=0.05, rng=0)
    assert run.V[0] == pytest.approx(10, abs=1e-3)  # 1 + 0.9 * 10; a cut future would leave 1
    assert not run.terminated.any()


@every_predictor
def test_a_terminal_state_is_worth_nothing_whatever_the_table_begins_with(predictor):
    run = predictor(WALK, ONLY, episodes=3000, alpha=0.02, V0=50.0, rng=0)
    assert run.V[[0, 6]].tolist() == [0, 0]
    np.testing.assert_allclose(run.V[1:6], np.arange(1, 6) / 6, atol=0.1)


@every_predictor
def test_the_last_step_is_learned_from(predictor):
    task = rl.Task(rl.GridWorld.from_ascii(">.G"), rl.Robot((-90, 0, 90)))
    run = predictor(task.mdp(), rl.solve(task.mdp()).pi, episodes=400, rng=0)
    assert run.V[task.index(rl.Pose(1, 0, 0))] == pytest.approx(10)


# ---------------------------------------------------------------- habits of all learners
@every_predictor
def test_a_constant_schedule_equals_the_number(predictor):
    one, many = (predictor(WALK, ONLY, episodes=40, alpha=a, rng=1) for a in (0.2, np.full(40, 0.2)))
    np.testing.assert_array_equal(one.V, many.V)


@every_predictor
def test_snapshots_are_the_tables_after_their_episodes(predictor):
    run = predictor(WALK, ONLY, episodes=30, snapshots=3, rng=2)
    assert run.snapshot_episodes.tolist() == [10, 20, 30]
    for n, V in zip(run.snapshot_episodes, run.snapshots, strict=True):
        np.testing.assert_array_equal(predictor(WALK, ONLY, episodes=n, rng=2).V, V)


@every_predictor
def test_a_run_can_go_on_from_its_table_and_changes_no_argument(predictor):
    generator, V0 = np.random.default_rng(4), np.full(7, 0.5)
    first = predictor(WALK, ONLY, episodes=10, V0=V0, rng=generator)
    second = predictor(WALK, ONLY, episodes=15, V0=first.V, rng=generator)
    whole = predictor(WALK, ONLY, episodes=25, V0=V0, rng=4)
    np.testing.assert_array_equal(second.V, whole.V)
    assert V0.tolist() == [0.5] * 7
    assert not np.shares_memory(first.V, second.V)
    assert repr(whole) == f"Prediction(25 episodes, {whole.steps.sum()} steps, 7 values)"
