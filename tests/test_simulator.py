"""The simulator's Python half: a scenario says all about a run, and what no scenario can say goes as tables."""

import base64
import copy
import json
import math
import re

import matplotlib as mpl
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import pyplot as plt

import rlnav as rl
from rlnav import designs
from rlnav.widgets import Simulator, _scenario

mpl.use("agg")

WORLDS = [
    rl.GridWorld.from_ascii(drawing)
    for drawing in (rl.maps.FREE_SPACE, rl.maps.OBSTACLES, rl.maps.CORRIDOR, "..G\n.#.\n..v", "####\n#.G#\n####\n#..#")
]
ARRAYS = ("next_state", "prob", "reward", "terminal", "start", "goal")


@pytest.fixture(autouse=True)
def no_figure_stays_open():
    plt.close("all")
    yield
    assert plt.get_fignums() == []


@pytest.fixture(scope="module")
def task():
    return rl.Task(rl.GridWorld.from_ascii(">...\n..#.\n...G"), rl.Robot(slip=0.1))


def unpacked(packed):
    once = np.frombuffer(base64.b64decode(packed["data"]), np.dtype(packed["dtype"]).newbyteorder("<"))
    return np.resize(once, packed["shape"])


def own_reward(t):
    return 1.0 if t.goal else float(t.s_next.x == 1)


# ---------------------------------------------------------------- a task as a scenario
numbers = st.floats(-100, 100)
payments = st.builds(designs.Payment, numbers, numbers, numbers, numbers)
recipes = st.sampled_from(["cell", "heading", "goal_direction", ["goal_bearing", 5], ["goal_distance", [1, 2.5]]])


@st.composite
def tasks(draw):
    world = draw(st.sampled_from(WORLDS))
    gamma = draw(st.floats(0, 1))
    reward = draw(payments)
    if draw(st.booleans()):
        reward = designs.Total(reward, designs.Progress(world.goal, draw(numbers), draw(st.booleans())))
    if draw(st.booleans()):
        reward = designs.Shaped(reward, designs.Nearness(world.goal, draw(numbers)), gamma)
    named = draw(st.none() | st.lists(recipes, min_size=1, max_size=2))
    steering = draw(st.sets(st.sampled_from(range(-180, 181, 45)), min_size=1, max_size=5))
    return rl.Task(world, rl.Robot(steering, draw(st.floats(0, 1))), reward, _scenario._make_features(named), gamma)


@given(tasks())
def test_a_task_comes_back_from_its_scenario_bit_for_bit(task):
    scenario = json.loads(json.dumps(_scenario.scenario_of(task)))  # as it comes back from the browser
    assert _scenario.checked(scenario) == scenario
    again = _scenario.task_of(scenario)
    one, other = task.mdp(), again.mdp()
    assert all((getattr(one, name) == getattr(other, name)).all() for name in ARRAYS)
    assert one.gamma == other.gamma
    assert (task.phi() == again.phi()).all()
    assert _scenario.own_designs(task) == {}


GOAL = (3, 0)
OWN = {
    "a function": own_reward,
    "a potential of one's own": designs.Shaped(designs.Payment(), lambda pose: float(pose.x), 0.95),
    "shaping with another discount": designs.Shaped(designs.Payment(), designs.Nearness(GOAL), 0.9),
    "shaping towards another cell": designs.Shaped(designs.Payment(), designs.Nearness((0, 0)), 0.95),
    "progress towards another cell": designs.Progress((0, 0)),
    "two payments": designs.Total(designs.Payment(), designs.Payment()),
    "a sum with a function": designs.Total(designs.Payment(), own_reward),
    "a payment that was changed": type("Mine", (designs.Payment,), {"__call__": lambda self, t: 1.0})(),
}


@pytest.mark.parametrize("reward", OWN.values(), ids=OWN)
def test_any_other_reward_stays_in_python(reward, task):
    task = rl.Task(task.world, reward=reward)
    assert _scenario.own_designs(task) == {"reward": reward}
    scenario = _scenario.scenario_of(task)
    assert scenario["reward"] == _scenario.REWARDS
    assert (_scenario.task_of(scenario, {"reward": reward}).mdp().reward == task.mdp().reward).all()


@pytest.mark.parametrize("reward", [designs.Progress(GOAL), designs.Total(designs.Progress(GOAL), designs.Payment())])
def test_the_order_of_the_librarys_designs_does_not_matter(reward, task):
    task = rl.Task(task.world, reward=reward)
    again = _scenario.task_of(_scenario.scenario_of(task))
    assert (again.mdp().reward == task.mdp().reward).all()


@pytest.mark.parametrize(
    "features", [lambda pose: pose.theta // 45, [designs.heading(), rl.Feature("one", 1, lambda *_: 0)]]
)
def test_any_other_features_stay_in_python(features, task):
    task = rl.Task(task.world, features=features)
    assert _scenario.own_designs(task) == {"features": task.features}
    again = _scenario.task_of(_scenario.scenario_of(task), _scenario.own_designs(task))
    assert (again.phi() == task.phi()).all()


# ---------------------------------------------------------------- runs
def test_it_opens_on_task_1_with_an_untrained_robot():
    simulator = Simulator()
    assert simulator.scenario == _scenario.DEFAULTS
    assert simulator.task.world == rl.GridWorld.from_ascii(rl.maps.FREE_SPACE)
    assert simulator.tables is None
    assert simulator.training is None


@pytest.mark.parametrize("name", _scenario.ALGORITHMS)
def test_a_run_is_that_of_the_library(task, name):
    simulator = Simulator(task, algorithm=name, episodes=40, alpha=0.5, epsilon=0.3, max_steps=30, Q0=1, seed=7)
    shared = {"episodes": 40, "alpha": 0.5, "epsilon": 0.3, "max_steps": 30, "Q0": 1.0, "rng": 7}
    run = getattr(rl, name)(task.mdp(), task.phi(), **shared)
    assert (simulator.train().Q == run.Q).all()


def test_a_run_follows_its_schedules(task):
    simulator = Simulator(task, episodes=5, alpha=0.5, alpha_schedule="linear", alpha_end=0.1)
    run = rl.q_learning(task.mdp(), episodes=5, alpha=[0.5, 0.4, 0.3, 0.2, 0.1], epsilon=0.2, rng=0)
    assert np.allclose(simulator.train().Q, run.Q, atol=1e-12)
    for kind in ("linear", "harmonic", "exponential"):
        rates = _scenario.schedule(kind, 0.5, 0.1, 100)
        assert rates.shape == (100,)
        assert rates[0] == 0.5
        assert math.isclose(rates[-1], 0.1, rel_tol=1e-9)
        assert (np.diff(rates) < 0).all()
        assert _scenario.schedule(kind, 0.5, 0.1, 1).tolist() == [0.5]
        assert (_scenario.schedule(kind, 0.1, 0.1, 9) == 0.1).all()
    assert (_scenario.schedule("constant", 0.5, 0.1, 3) == 0.5).all()


def test_what_the_browser_changes_is_the_task():
    simulator = Simulator()
    drawn = copy.deepcopy(simulator.state)
    drawn["scenario"] |= {"map": ["..#.", "...G"], "starts": [[0, 0, 90]], "slip": 0.2, "steering": [-45, 0, 45]}
    simulator.set_state({"state": drawn})
    assert str(simulator.task.world) == "..#.\n^..G"
    assert simulator.task.robot == rl.Robot((-45, 0, 45), 0.2)


def test_the_kernel_keeps_the_last_good_state():
    simulator = Simulator(episodes=9)
    for bad in ({}, {"episodes": 0}, {"alpha": "0.5"}, {"unknown": 1}):
        with pytest.raises((TypeError, ValueError)):
            simulator.state = {**simulator.state, "scenario": {**simulator.scenario, **bad} if bad else 5}
        with pytest.raises((TypeError, ValueError)):
            simulator.set_state({"state": {**simulator.state, "scenario": {**simulator.scenario, **bad} if bad else 5}})
        assert simulator.scenario["episodes"] == 9


# ---------------------------------------------------------------- what only Python can compute
def model_of(tables):
    mdp = tables["mdp"]
    names = {"next_state": "nextState"}
    arrays = [unpacked(mdp[names.get(name, name)]) for name in ARRAYS[:3]]
    rest = [unpacked(mdp[name]) for name in ("terminal", "start", "goal")]
    return rl.MDP(*arrays, mdp["gamma"], rest[0].astype(bool), rest[1], rest[2].astype(bool))


@pytest.mark.parametrize("slip", [0.0, 0.1])
def test_an_own_reward_and_own_features_go_as_tables(task, slip):
    own = rl.Task(task.world, rl.Robot(slip=slip), own_reward, lambda pose: pose.theta // 45)
    simulator = Simulator(own)
    assert simulator.tables["own"] == ["features", "reward"]
    sent, mdp = model_of(simulator.tables), own.mdp()
    assert all((getattr(sent, name) == getattr(mdp, name)).all() for name in ARRAYS)
    assert (unpacked(simulator.tables["phi"]) == own.phi()).all()
    settings = {name: _scenario.LEARNER[name] for name in ("episodes", "alpha", "epsilon")}
    assert (simulator.train().Q == rl.q_learning(mdp, own.phi(), **settings, rng=0).Q).all()
    assert Simulator(task).tables is None


def test_tables_follow_the_world_and_nothing_else(task):
    simulator = Simulator(rl.Task(task.world, reward=own_reward))
    before = simulator.tables
    simulator.scenario = simulator.scenario | {"alpha": 0.7}
    assert simulator.tables is before
    simulator.scenario = simulator.scenario | {"map": ["....", "....", "...G"], "starts": None, "slip": 0.3}
    assert simulator.tables["task"]["map"] == ["....", "....", "...G"]
    sent, mdp = model_of(simulator.tables), simulator.task.mdp()
    assert all((getattr(sent, name) == getattr(mdp, name)).all() for name in ARRAYS)
    drawn = simulator.scenario | {"map": ["....", "..##", "..#G"]}
    simulator.set_state({"state": {**simulator.state, "scenario": drawn}})  # as it comes from the browser
    assert "mdp" not in simulator.tables
    assert simulator.tables["error"].startswith("`goal` must be a cell that can be reached")
    assert "walled in" in repr(simulator)


def test_a_training_goes_as_snapshots(task):
    def rule(Q, s, a, r, s_next, a_next, gamma, alpha):
        Q[s, a] += alpha * (r - Q[s, a])

    run = rl.learn(task.mdp(), rule, episodes=900, rng=0, snapshots=3)
    played = Simulator(task, run).training
    assert played["episodes"] == [300, 600, 900]
    assert np.allclose(unpacked(played["snapshots"]), run.snapshots, rtol=1e-7)
    assert np.allclose(unpacked(played["returns"]), run.returns, rtol=1e-6)
    assert (unpacked(played["steps"]) == run.steps).all()
    assert (unpacked(played["success"]) == run.success).all()
    scores = rl.evaluate(task.mdp(), run.pi[task.phi()])
    assert f"Greedy policy after 900 episodes: {scores}, gap {scores.gap:.3f}." in repr(Simulator(task, run))


# ---------------------------------------------------------------- on paper, and in a notebook
def test_paper_shows_what_the_run_is_worth(task):
    simulator = Simulator(task, episodes=300, seed=3)
    scores = rl.evaluate(task.mdp(), simulator.train().pi[task.phi()])
    lines = repr(simulator).splitlines()
    assert lines[0] == "Simulator"
    assert "  scenario.episodes = 300" in lines
    assert "  scenario.seed = 3" in lines
    assert f"Greedy policy after 300 episodes of Q-learning: {scores}, gap {scores.gap:.3f}." in lines
    assert re.fullmatch("figure [0-9a-f]{12}", lines[-1])


def test_the_same_settings_give_the_same_bytes_and_others_others(task):
    one, same, other = Simulator(task, episodes=50), Simulator(task, episodes=50), Simulator(task, episodes=50, seed=1)
    assert repr(one) == repr(same) != repr(other)
    assert one.html() == same.html() != other.html()
    bundle, _ = one._repr_mimebundle_()
    assert bundle["text/html"] == one.html()
    assert bundle["text/plain"] == repr(one)
    assert "application/vnd.jupyter.widget-view+json" in bundle


def test_the_page_gets_the_state_and_the_picture(task):
    html = Simulator(task, episodes=50, view={"note": "it's <b>&"}).html()
    assert html.startswith('<div class="rlnav-explorable" data-entry="simulator/app" data-state=\'{"scenario":')
    assert '"note":"it&#39;s &lt;b&gt;&amp;"' in html
    assert 'alt="Map with the value of every pose under the greedy policy after 50 episodes of Q-learning' in html
    assert "data-tables" not in html


def bad_scenario(**change):
    return lambda task: setattr(simulator := Simulator(task), "scenario", {**simulator.scenario, **change})


def trained(world, **options):
    return rl.q_learning(rl.Task(world).mdp(), episodes=10, rng=0, **options)


BAD = {
    "`task` must be a Task; got 'map'": lambda task: Simulator("map"),
    "`task` must be a task in a world of at most 30 x 30 cells; got 31 x 1": lambda task: Simulator(
        rl.Task(rl.GridWorld(31, 1, goal=(0, 0)))
    ),
    "`training` must be a Training; got 'run'": lambda task: Simulator(task, "run"),
    "`training` must be a run with snapshots": lambda task: Simulator(task, trained(task.world)),
    "`training` must be a run of this task, whose table is": lambda task: Simulator(
        task, trained(WORLDS[0], snapshots=2)
    ),
    "`settings` must be among algorithm, alpha": lambda task: Simulator(task, gamma=0.9),
    "`algorithm` must be one of 'q_learning', 'sarsa'": lambda task: Simulator(task, algorithm="dqn"),
    "`alpha` must be a number in (0, 1]; got 0": lambda task: Simulator(task, alpha=0),
    "`epsilon_end` must be a number in [0, 1]; got 2": lambda task: Simulator(task, epsilon_end=2),
    "`alpha_schedule` must be one of 'constant'": lambda task: Simulator(task, alpha_schedule=["linear"]),
    "`seed` must be an integer of at least 0; got -1": lambda task: Simulator(task, seed=-1),
    "`view` must be a Mapping; got 5": lambda task: Simulator(task, view=5),
    "`scenario` must be a dict with the keys map, starts": bad_scenario(speed=1),
    "`map` must be rows of '.', '#' and one 'G', all of one length": bad_scenario(map=["..", "G"]),
    "`map` must be a map with one goal 'G'; got 2 of them": bad_scenario(map=["GG"]),
    "`map` must be 1 to 30 rows; got 0": bad_scenario(map=[]),
    "`starts` must be poses [x, y, theta]; got [0, 0]": bad_scenario(starts=[[0, 0]]),
    "`starts` must be free cells away from the goal; got (2, 1), an obstacle": bad_scenario(starts=[[2, 1, 0]]),
    "`starts` must be free cells away from the goal; got (4, 0), outside": bad_scenario(starts=[[4, 0, 0]]),
    "`alpha_end` must be a number in (0, 1]; got 0": bad_scenario(alpha_end=0),
    "`epsilon` must be above 0 with a schedule that is harmonic": bad_scenario(epsilon_schedule="harmonic", epsilon=0),
    "`episodes` must be an integer from 1 to 1000000": bad_scenario(episodes=1_000_001),
    "`theta` must be a multiple of 45 degrees; got 10": bad_scenario(starts=[[0, 0, 10]]),
    "`reward` must be a dict with the keys goal, crash": bad_scenario(reward={"gaol": 1}),
    "`only_closer` must be a bool; got 1": bad_scenario(reward={"only_closer": 1}),
    "`features` must be one of 'cell', 'heading'": bad_scenario(features=["Feature"]),
    "`features` must be 'cell' without an argument": bad_scenario(features=[["cell", 3]]),
    "`features` must be at least one feature": bad_scenario(features=[]),
    "`steering` must be a set of different multiples": bad_scenario(steering=[]),
    "`state` must be a dict; got 5": lambda task: setattr(Simulator(task), "state", 5),
    "`state` must be a dict with the keys scenario, view; got the key 'scene'": lambda task: setattr(
        Simulator(task), "state", {"scene": 1}
    ),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_input_gets_one_error_that_says_what_to_do(task, message):
    with pytest.raises((TypeError, ValueError)) as raised:
        BAD[message](task)
    assert message in str(raised.value)
