"""The two halves of a scenario agree: the same defaults, the same checks, the same schedules, the same tables."""

import base64
import random

import numpy as np
import pytest

import browsing
import rlnav as rl
from rlnav.widgets import Simulator, _modules, _scenario

BAD = [
    {"map": ["..", "G"]},
    {"map": ["GG"]},
    {"map": []},
    {"map": 5},
    {"map": ["." * 31 + "G"]},
    {"starts": [[0, 0]]},
    {"starts": [[0, 0, 10]]},
    {"starts": [[7, 7, 0]]},
    {"starts": [[10, 0, 0]]},
    {"steering": []},
    {"slip": 2},
    {"gamma": -1},
    {"reward": {"gaol": 1}},
    {"reward": {"goal": "10"}},
    {"reward": 5},
    {"features": []},
    {"features": ["Feature"]},
    {"features": [["cell", 3]]},
    {"features": [["goal_bearing", 1]]},
    {"algorithm": "dqn"},
    {"alpha": 0},
    {"alpha_end": 0},
    {"epsilon": 0, "epsilon_schedule": "exponential"},
    {"alpha_schedule": "none"},
    {"episodes": 1_000_001},
    {"max_steps": 0},
    {"seed": -1},
    {"seed": 0.5},
    {"speed": 1},
]
GOOD = [
    {},
    {"map": ["...", "..G"], "starts": None},
    {"map": ["#G#", "###", "..."], "starts": None},
    {"starts": [[0, 0, 90], [0, 0, 90], [1, 0, -90]]},
    {"steering": [90, 0], "slip": 1, "gamma": 1},
    {"reward": {"turn": -1, "only_closer": True}},
    {"features": ["cell", ["goal_bearing", 4], "goal_distance"]},
    {"alpha": 1, "alpha_schedule": "harmonic", "epsilon": 0},
]


@pytest.fixture(scope="module")
def js(browser):
    """Run functions in a page that has the package's modules at /."""
    with browsing.served(_modules.HOME) as address, browsing.visit(browser, address) as here:
        yield here.page.evaluate
        assert here.complaints == []


IMPORTS = """
const {checkScenario, DEFAULTS} = await import('/scenario/scenario.js');
const {scheduleOf} = await import('/scenario/schedule.js');
const {unpackAll} = await import('/views/arrays.js');
const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
"""


def test_both_begin_with_the_same_scenario(js):
    assert js(f"async () => {{ {IMPORTS} return DEFAULTS; }}") == _scenario.DEFAULTS


@pytest.mark.parametrize("change", GOOD, ids=str)
def test_both_complete_a_scenario_alike(js, change):
    assert js(f"async raw => {{ {IMPORTS} return checkScenario(raw); }}", change) == _scenario.checked(change)


@pytest.mark.parametrize("change", BAD, ids=str)
def test_both_refuse_the_same(js, change):
    attempt = "try { return checkScenario(raw); } catch (error) { return error.message; }"
    message = js(f"async raw => {{ {IMPORTS} {attempt} }}", change)
    with pytest.raises((TypeError, ValueError)) as raised:
        _scenario.checked(change)
    assert isinstance(message, str)
    assert message.split(" must be ")[0] == str(raised.value).split(" must be ")[0]


def test_schedules_have_the_same_bits(js):
    rng = random.Random(0)
    cases = [
        [kind, rng.choice([1, 0.5, rng.uniform(1e-3, 1)]), rng.choice([1, 0.01, rng.uniform(1e-3, 1)]), episodes]
        for kind in ("constant", "linear", "harmonic", "exponential")
        for episodes in (1, 2, 3, 10, 500, 4999)
        for _ in range(8)
    ]
    got = js(f"async cases => {{ {IMPORTS} return cases.map(given => bits(scheduleOf(...given))); }}", cases)
    for case, text in zip(cases, got, strict=True):
        rates = _scenario.schedule(*case)
        assert base64.b64decode(text) == rates.tobytes(), case
        assert (rates > 0).all(), "a step size of 0 would be refused"
        assert (rates <= 1).all(), "a step size above 1 would be refused"


def own_reward(t):
    return 1.0 if t.goal else float(t.s_next.x == 1) / 3


@pytest.mark.parametrize("slip", [0.0, 0.1])
def test_tables_arrive_as_they_were_sent(js, slip):
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), rl.Robot(slip=slip), own_reward)
    tables = Simulator(task).tables
    read = """const {mdp, phi} = unpackAll(tables);
      const {MDP} = await import('/mdp.js');
      const model = new MDP(mdp); // it checks everything
      return [model.nextState, model.prob, model.reward, phi].map(bits);"""
    mdp = task.mdp()
    sent = [mdp.next_state.astype(np.int32), mdp.prob, mdp.reward, task.phi().astype(np.int32)]
    got = js(f"async tables => {{ {IMPORTS} {read} }}", tables)
    assert [base64.b64decode(text) for text in got] == [np.ascontiguousarray(array).tobytes() for array in sent]


@pytest.mark.parametrize(
    "packed", [{"dtype": "int8", "shape": [1], "data": "AA=="}, {"dtype": "uint8", "shape": [3], "data": "AAA="}]
)
def test_arrays_that_cannot_be_read_are_refused(js, packed):
    attempt = "try { return unpackAll(packed); } catch (error) { return error.message; }"
    assert "must be" in js(f"async packed => {{ {IMPORTS} {attempt} }}", packed)
