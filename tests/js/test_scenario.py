"""Scenarios in the browser and in Python: the same data, the same tasks, and code that gives the same run."""

import copy
import json
import math

import matplotlib
import numpy as np
import pytest

import rlnav as rl
from rlnav.widgets import _scenario, _schedule

from . import scenarios
from .scenarios import any_scenario, same

HEADINGS = range(0, 360, 45)


@pytest.fixture(scope="module")
def sc(engine):
    """The engine's page with the modules of scenario/ as `sc`."""
    engine.page.evaluate(scenarios.LOAD, scenarios.MODULES)
    return engine


def refused(sc, call, argument=None):
    """The message of the error that a call raises, "" if it raises none."""
    return sc(f"x => {{ try {{ {call}; return ''; }} catch (error) {{ return error.message; }} }}", argument)


# ---------------------------------------------------------------- the same data
def test_defaults_are_those_of_python(sc):
    assert same(sc("() => sc.DEFAULTS"), _scenario.DEFAULTS)
    assert same(sc("() => sc.checkScenario({})"), _scenario.checked({}))
    assert sc("() => Object.keys(sc.ALGORITHMS)") == list(_scenario.ALGORITHMS)
    assert sc("() => [sc.MOST_EPISODES, sc.MOST_STEPS]") == [_scenario.MOST_EPISODES, _scenario.MOST_STEPS]


def test_a_checked_scenario_is_complete_and_frozen(sc):
    for i in range(60):
        raw = any_scenario(i)
        assert same(sc("raw => sc.checkScenario(raw)", raw), raw)
    assert sc(
        """() => {
          const scenario = sc.checkScenario({ features: ['cell', ['goal_distance', [1, 2]]] });
          const frozen = x => Object(x) !== x || (Object.isFrozen(x) && Object.values(x).every(frozen));
          return [scenario, sc.PRESETS, sc.DEFAULTS].every(frozen) && sc.checkScenario(scenario) === scenario;
        }"""
    )


BAD = [
    {"alpha": 0},
    {"alpha": 1.01},
    {"alpha": "0.1"},
    {"alpha": None},
    {"epsilon": -0.1},
    {"alpha_end": 0},
    {"epsilon_end": 2},
    {"alpha_schedule": "cosine"},
    {"epsilon_schedule": ["linear"]},
    {"epsilon": 0, "epsilon_schedule": "harmonic"},
    {"epsilon_end": 0, "epsilon_schedule": "exponential"},
    {"episodes": 0},
    {"episodes": 1_000_001},
    {"max_steps": 10_001},
    {"max_steps": 3.5},
    {"seed": -1},
    {"Q0": None},
    {"Q0": 1e101},
    {"gamma": 1.5},
    {"slip": -1},
    {"steering": []},
    {"steering": [10]},
    {"steering": [0, 0]},
    {"algorithm": "dqn"},
    {"algorithm": ["sarsa"]},
    {"features": []},
    {"features": ["smell"]},
    {"features": ["__proto__"]},
    {"features": [["goal_bearing", 1]]},
    {"features": [["goal_bearing", 8, 9]]},
    {"features": [["heading", 8]]},
    {"features": [["goal_distance", [2, 1]]]},
    {"features": "cell"},
    {"reward": {"goal": "much"}},
    {"reward": {"bonus": 1}},
    {"reward": {"only_closer": 1}},
    {"reward": []},
    {"map": []},
    {"map": ["..", "."]},
    {"map": ["..x", "..G"]},
    {"map": ["...", "..."]},
    {"map": ["G..", "..G"]},
    {"map": ["." * 31 + "G"]},
    {"map": "..G"},
    {"map": [3]},
    {"starts": [[7, 7, 0]]},
    {"starts": [[10, 0, 0]]},
    {"starts": [[0, 0, 30]]},
    {"starts": [[0, 0]]},
    {"starts": [0]},
    {"starts": 3},
    {"colour": 1},
]


@pytest.mark.parametrize("patch", BAD, ids=json.dumps)
def test_both_sides_refuse_the_same_and_name_it(sc, patch):
    message = refused(sc, "sc.checkScenario(x)", patch)
    with pytest.raises((TypeError, ValueError)) as error:
        _scenario.checked({**{"starts": None}, **patch} if "map" in patch else patch)
    assert message
    key = next(iter(patch))
    named = [message.split("`")[1], str(error.value).split("`")[1]]
    inner = {
        "starts": {"theta"},
        "features": {"sectors", "bins"},
        "reward": {"only_closer", "goal"},
        "colour": {"scenario"},
    }
    assert set(named) <= {*patch, *inner.get(key, ())}, (message, error.value)


# ---------------------------------------------------------------- the same bits
def test_schedules_are_the_same_bits(sc, floats):
    random = np.random.default_rng(4)
    cases = []
    for kind in _schedule.SCHEDULES:
        for _ in range(60):
            start, end = (float(x) for x in 10.0 ** random.uniform(-6, 0, 2))
            cases.append([kind, start, end, int(random.integers(1, 3000))])
        cases += [[kind, 0.2, 0.2, 500], [kind, 1.0, 0.01, 100_000], [kind, 0.01, 1.0, 7], [kind, 0.3, 0.1, 2]]
    cases.append(["linear", 1.0, 0.0, 500])
    theirs = sc("cases => cases.map(([...given]) => bits(sc.scheduleOf(...given)))", cases)
    for case, rates in zip(cases, theirs, strict=True):
        assert floats(rates).tobytes() == _schedule.schedule(*case).tobytes(), case
        first, last = floats(rates)[[0, -1]]
        assert first == case[1]
        assert case[0] == "constant" or case[3] == 1 or math.isclose(last, case[2], rel_tol=1e-9, abs_tol=0)
        assert (floats(rates) <= 1).all(), case


def test_worlds_and_models_are_the_same_bits(sc, floats):
    arrays = sc(
        """all => all.map(raw => {
          const { task, mdp, phi } = sc.modelOf(raw);
          const numbers = [mdp.prob, mdp.reward, mdp.nextState, mdp.terminal, mdp.goal, mdp.start, phi];
          return [String(task.world), mdp.S, mdp.A, mdp.K, ...numbers.map(array => bits(Float64Array.from(array)))];
        })""",
        [any_scenario(i) for i in range(120)],
    )
    for i, (drawing, S, A, K, *numbers) in enumerate(arrays):
        task = _scenario.task_of(any_scenario(i))
        mdp = task.mdp()
        assert drawing == str(task.world)
        assert mdp.next_state.shape == (S, A, K)
        ours = [mdp.prob, mdp.reward, mdp.next_state, mdp.terminal, mdp.goal, mdp.start, task.phi()]
        for mine, array in zip(ours, numbers, strict=True):
            assert (floats(array) + 0.0).tobytes() == (mine.ravel().astype(float) + 0.0).tobytes(), i


def test_the_size_of_a_table_is_known_before_it_is_made(sc):
    sizes = sc("all => all.map(raw => sc.tableSizeOf(raw))", [any_scenario(i) for i in range(80)])
    for i, size in enumerate(sizes):
        task = _scenario.task_of(any_scenario(i))
        assert size == {
            "rows": int(task.phi().max()) + 1,
            "actions": len(task.robot.steering),
            "poseRows": task.mdp().S,
        }


def test_planners_agree_to_twelve_digits(sc, floats):
    cases = [any_scenario(i) for i in range(60)]
    theirs = sc("all => all.map(raw => bits(rl.solve(sc.modelOf(raw).mdp, { tol: 1e-13, maxSweeps: 3000 }).V))", cases)
    for case, values in zip(cases, theirs, strict=True):
        V = rl.solve(_scenario.task_of(case).mdp(), tol=1e-13, max_sweeps=3000).V
        np.testing.assert_allclose(floats(values), V, rtol=1e-12, atol=1e-12)


# ---------------------------------------------------------------- copy as Python
def executed(code):
    names = {}
    exec(compile(code, "copied", "exec"), names)
    return names


@pytest.mark.parametrize("part", range(4))
def test_copied_python_gives_the_same_table_to_the_last_bit(sc, floats, part):
    cases = [any_scenario(i) for i in range(40 * part, 40 * (part + 1))]
    runs = sc(
        """all => all.map(raw => {
          const session = new sc.Session(raw);
          session.run();
          const { Q, returns, steps } = session.learner;
          const { mdp, phi } = session;
          return [sc.asPython(raw), ...[Q, returns, steps, mdp.reward, phi].map(a => bits(Float64Array.from(a)))];
        })""",
        cases,
    )
    for case, (code, *arrays) in zip(cases, runs, strict=True):
        assert max(map(len, code.splitlines())) <= 100, code
        head, _ = code.split("\nprint(")
        names = executed(head)
        Q, returns, steps, reward, phi = (floats(array) for array in arrays)
        run = names["run"]
        assert (run.Q.ravel() + 0.0).tobytes() == (Q + 0.0).tobytes(), code
        assert (run.returns + 0.0).tobytes() == (returns + 0.0).tobytes(), code
        assert run.steps.tolist() == steps.tolist()
        assert (names["mdp"].reward.ravel() + 0.0).tobytes() == (reward + 0.0).tobytes(), code
        assert names["task"].phi().tolist() == phi.tolist()
        again = _scenario.train(case, _scenario.task_of(case))
        assert again.Q.tobytes() == run.Q.tobytes()


@pytest.mark.parametrize("i", [0, 1, 2, 3, 5, 8, 13, 21])
def test_copied_python_runs_to_its_end_and_draws(sc, capsys, i):
    matplotlib.use("agg")
    names = executed(sc("raw => sc.asPython(raw)", any_scenario(i)))
    assert capsys.readouterr().out.strip()
    assert names["ax"].lines or names["ax"].collections or names["ax"].patches
    matplotlib.pyplot.close("all")


def test_copied_python_is_short(sc):
    assert sc("() => sc.asPython({})") == (
        "import rlnav as rl\n"
        "\n"
        "world = rl.GridWorld.from_ascii(rl.maps.FREE_SPACE)\n"
        "task = rl.Task(world)\n"
        "mdp = task.mdp()\n"
        "\n"
        f"run = rl.q_learning(mdp, episodes={_scenario.DEFAULTS['episodes']}, alpha=0.2, epsilon=0.2, rng=0)\n"
        "\n"
        "print(rl.evaluate(mdp, run.pi))\n"
        "ax = rl.plot.values(task, run.Q.max(axis=1))\n"
        "rl.plot.path(task, rl.rollout(mdp, run.pi, rng=0), ax)\n"
    )


def test_copied_python_leaves_own_functions_to_their_owner(sc):
    code = sc("() => sc.asPython({ features: null }, ['reward', 'features'])")
    own = "reward, features = (lambda t: 1.0 if t.goal else 0.0), (lambda pose: pose.x)"
    run = executed("\n".join([own, code.split("print(")[0]]))
    assert run["mdp"].reward.max() == 1
    assert run["run"].Q.shape == (11, 5)


# ---------------------------------------------------------------- the address and JSON
def test_any_state_comes_back_from_its_address_and_from_json(sc):
    views = [
        {},
        {"color": "visits", "lecture": True},
        {"hide": ["world", "alpha_end"], "panels": {"curve": "steps & more"}},
    ]
    for i in range(80):
        state = {"scenario": any_scenario(i), "view": views[i % len(views)]}
        found = sc(
            """state => {
              const address = sc.toAddress(state), { state: back, messages } = sc.fromAddress(address);
              const text = sc.toText(state);
              const whole = sc.toText(sc.fromText(text)) === text;
              return { address, messages, back, again: sc.toAddress(back), whole };
            }""",
            state,
        )
        assert found["messages"] == []
        assert same(found["back"]["scenario"], state["scenario"])
        assert {key: found["back"]["view"][key] for key in state["view"]} == state["view"]
        assert found["again"] == found["address"]
        assert found["whole"]
        assert found["address"].isascii()
        assert not set(found["address"]) & set(' "<>`\n')


def test_an_address_says_only_what_is_not_the_default(sc):
    assert sc("() => sc.toAddress({ scenario: {}, view: {} })") == ""
    maze = "{ ...sc.PRESETS.maze, algorithm: 'sarsa', alpha: 0.5 }"
    address = sc(f"() => sc.toAddress({{ scenario: {maze}, view: {{ lecture: true }} }})")
    assert address == "#map=maze&algorithm=sarsa&alpha=0.5&lecture=1"
    for name in rl.maps.NAMES:
        address = f"#map={name.lower()}"
        drawing = sc("address => String(sc.worldOf(sc.fromAddress(address).state.scenario))", address)
        assert drawing == str(rl.GridWorld.from_ascii(getattr(rl.maps, name)))


def test_what_an_address_says_wrongly_is_told_and_the_rest_is_used(sc):
    address = "#map=obstacles&alpha=7&epsilon=0.5&wings=2&hide=design&color=pink&seed=1e3&%"
    found = sc("text => sc.fromAddress(text)", address)
    assert found["state"]["scenario"]["epsilon"] == 0.5
    assert found["state"]["scenario"]["seed"] == 1000
    assert found["state"]["scenario"]["alpha"] == _scenario.DEFAULTS["alpha"]
    assert found["state"]["view"]["hide"] == ["design"]
    assert "#" in "".join(found["state"]["scenario"]["map"])
    for word in ("alpha", "wings", "color"):
        assert any(word in message for message in found["messages"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "whole JSON"),
        ('{"rlnav": 1, "scenario": {"al', "whole JSON"),
        ("[]", "JSON object"),
        ("null", "JSON object"),
        ("3", "JSON object"),
        ("{}", "version"),
        ('{"rlnav": 2, "scenario": {}}', "version 2"),
        ('{"rlnav": 1, "scenario": []}', "scenario"),
        ('{"rlnav": 1, "scenario": null}', "scenario"),
        ('{"rlnav": 1, "view": 3}', "view"),
        ('{"rlnav": 1, "scenario": {"alpha": "x"}}', "alpha"),
        ('{"rlnav": 1, "scenario": {"__proto__": {"a": 1}}}', "__proto__"),
        ('{"rlnav": 1, "__proto__": {"scenario": {}}}', "__proto__"),
        ('{"rlnav": 1, "extra": 1}', "extra"),
        (" " * 1_000_001, "characters"),
        ("[" * 100_000, "whole JSON"),
    ],
    ids=range(16),
)
def test_damaged_json_gets_one_plain_message(sc, text, words):
    message = refused(sc, "sc.fromText(x)", text)
    assert words in message
    assert len(message) < 500


def test_no_text_breaks_the_reader_of_addresses(sc):
    """Mutated addresses and noise: the state can always be checked and written again, and nothing is polluted."""
    random = np.random.default_rng(5)
    words = ["__proto__", "constructor", "map=", "starts="]
    letters = [*'#&=%,:_.-+0123456789oxGeEaN{}[]"\\ \n\u00e9\ud7ff\U0001f916', *words]
    addresses = sc(
        "all => all.map(scenario => sc.toAddress({ scenario, view: { hide: ['world'], color: 'error' } }))",
        [any_scenario(i) for i in range(40)],
    )
    texts = []
    for i in range(1500):
        text = list(addresses[i % len(addresses)]) if i % 3 else []
        for _ in range(int(random.integers(1, 30))):
            at = int(random.integers(len(text) + 1))
            if random.random() < 0.5:
                text[at : at + int(random.integers(1, 6))] = []
            else:
                text.insert(at, letters[random.integers(len(letters))])
        texts.append("".join(text))
    texts += ["#map=" + "30o_" * 40, "#map=" + "9" * 10_000, "#" + "&" * 19_000, "#" + "a=1&" * 30_000]
    texts += ["#panels=" + "[" * 15_000, "#panels=" + "[" * 9_000 + "]" * 9_000, "#hide=\ud800", "#="]
    texts += ["#__proto__=1&__proto__.x=1", "#constructor=1"]
    faults = sc(
        """texts => texts.flatMap(text => {
          try {
            const { state, messages } = sc.fromAddress(text);
            const again = sc.fromAddress(sc.toAddress(state));
            const whole = again.messages.length === 0 && sc.toText(again.state) === sc.toText(state);
            const fine = sc.checkScenario(state.scenario) === state.scenario && sc.checkView(state.view);
            const clean = Object.keys(Object.prototype).length === 0 && {}.x === undefined;
            const form = /^`[^`]*` must be .*; got .*\\.|more parts|too long/s;
            const short = messages.every(message => form.test(message) && message.length < 500);
            return whole && fine && clean && short && messages.length <= 5 ? [] : [[text, messages]];
          } catch (error) {
            return [[text, String(error)]];
          }
        })""",
        texts,
    )
    assert faults == []


def test_mutated_json_is_a_state_or_a_message(sc):
    random = np.random.default_rng(6)
    values = [None, True, -1, 1e308, "", "x", [], {}, [[]], [None], {"__proto__": 1}, 0.5, 12345678901234567890]
    texts = []
    for i in range(600):
        whole = {"rlnav": 1, "scenario": copy.deepcopy(any_scenario(i % 30)), "view": {"hide": ["world"], "speed": "4"}}
        place = whole[("scenario", "view")[int(random.integers(2))]]
        key = list(place)[int(random.integers(len(place)))]
        value = values[int(random.integers(len(values)))]
        if isinstance(place[key], list) and place[key] and random.random() < 0.5:
            place[key][int(random.integers(len(place[key])))] = value
        else:
            place[key] = value
        texts.append(json.dumps(whole))
    faults = sc(
        """texts => texts.filter(text => {
          try {
            const state = sc.fromText(text);
            return sc.fromText(sc.toText(state)).scenario.seed !== state.scenario.seed;
          } catch (error) {
            return !/^`.*` must be /.test(error.message);
          }
        })""",
        texts,
    )
    assert faults == []


# ---------------------------------------------------------------- drawing
def test_drawing_changes_one_thing_and_leaves_the_old_scenario(sc):
    before, wall, free, goal, start, anywhere, turned = sc(
        """() => {
          const before = sc.checkScenario({});
          const wall = sc.paint(before, 4, 0, true);
          return [before, wall, sc.paint(wall, 4, 0, false), sc.moveGoal(before, 0, 9),
            sc.moveStart(before, { x: 5, y: 5, theta: null }), sc.moveStart(before, null),
            sc.moveStart(before, { x: 5, y: 5, theta: 90 })];
        }"""
    )
    assert same(before, _scenario.DEFAULTS)
    assert wall["map"][9][4] == "#"
    assert sum(row.count("#") for row in wall["map"]) == 1
    assert free == before
    assert goal["map"][0] == "G........."
    assert sum(row.count("G") for row in goal["map"]) == 1
    assert start["starts"] == [[5, 5, theta] for theta in HEADINGS]
    assert anywhere["starts"] is None
    assert turned["starts"] == [[5, 5, 90]]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        ("sc.paint(x, 7, 7, true)", "Move the goal first"),
        ("sc.paint(x, 2, 2, true)", "Move the start first"),
        ("sc.paint(x, 10, 0, true)", "inside the 10 x 10 grid"),
        ("sc.moveGoal(x, 2, 2)", "Move the start first"),
        ("sc.moveGoal(x, 10, 2)", "inside the 10 x 10 grid"),
        ("sc.moveGoal(sc.paint(x, 0, 0, true), 0, 0)", "Erase the obstacle first"),
        ("sc.moveStart(x, { x: 7, y: 7 })", "the goal"),
        ("sc.moveStart(sc.paint(x, 0, 0, true), { x: 0, y: 0 })", "an obstacle"),
        ("sc.moveStart(x, { x: -1, y: 0 })", "outside the grid"),
        ("sc.resize(x, 3, 8)", "from 4 to 30"),
        ("sc.resize(x, 8, 31)", "from 4 to 30"),
        ("sc.randomMap({ density: 0.9 })", "density"),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_advice(sc, call, words):
    assert words in refused(sc, call.replace("x,", "sc.checkScenario({}),", 1).replace("(x", "(sc.checkScenario({})"))


def test_resizing_keeps_places_and_loses_neither_goal_nor_start(sc):
    for i in range(60):
        width, height = (int(n) for n in np.random.default_rng(i).integers(4, 31, 2))
        before = any_scenario(i)
        after = sc("([raw, w, h]) => sc.resize(sc.checkScenario(raw), w, h)", [before, width, height])
        assert [len(after["map"]), len(after["map"][0])] == [height, width]
        assert same(_scenario.checked(after), after)
        wide, high = min(width, len(before["map"][0])), min(height, len(before["map"]))
        moved = 0
        for y in range(high):
            old, new = before["map"][-1 - y][:wide], after["map"][-1 - y][:wide]
            moved += sum(a != b for a, b in zip(old, new, strict=True))
        lost = 1 + len({tuple(pose[:2]) for pose in before["starts"] or []})
        assert moved <= lost
        assert (after["starts"] is None) == (before["starts"] is None) or before["starts"]


def test_random_maps_are_those_of_python(sc):
    for seed in range(30):
        size = {"width": 4 + seed, "height": 30 - seed, "density": seed / 50} if seed < 27 else {}
        given = {**size, "seed": seed}
        drawn = sc("given => String(sc.worldOf(sc.randomMap(given)))", given)
        width, height = given.get("width", 10), given.get("height", 10)
        assert drawn == str(rl.maps.random(width, height, density=given.get("density", 0.2), rng=seed))


def test_a_scenario_that_cannot_run_says_why(sc):
    why = lambda raw, tables=None: sc("([raw, tables]) => sc.whyNot(raw, tables)", [raw, tables])  # noqa: E731
    assert why({}) == ""
    walled_in = {"map": ["...#G", "...##", "....."], "starts": None}
    assert "No free cell leads to the goal" in why(walled_in)
    cut_off = {"map": [".#..G", ".#...", ".#..."], "starts": [[4, 0, 0], [0, 0, 0]]}
    assert "no way from the start at (0, 0)" in why(cut_off)
    huge = {"features": ["cell", "heading", ["goal_bearing", 360], "moves_ahead"]}
    assert "Let the robot perceive less" in why(huge)
    for i in range(60):
        assert why(any_scenario(i)) == ""
    tables = {"own": ["reward"], "task": _scenario.task_part(_scenario.DEFAULTS)}
    assert why({}, tables) == ""
    assert "computed in Python" in why({"slip": 0.1}, tables)
    assert why({}, {**tables, "error": "reward must be finite"}) == "reward must be finite"
