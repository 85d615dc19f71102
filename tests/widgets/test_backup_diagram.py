"""The live backup diagram: its numbers are the library's, and a reader can walk through them and be asked for one."""

import re
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import BackupDiagram, _scenario

from .pages import state_of as state_told

MODULES = Path(rl.__file__).parent / "js"

WORLD = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
TASK = rl.Task(WORLD, rl.Robot(slip=0.2))
LANE = rl.Task(rl.GridWorld.from_ascii(">...G"))
HERE = rl.Pose(2, 4, 45)

TREES = """async cases => {
  const {backedUp, backupTree, policyOf, ruleOf, valuesOf} = await import('/scenario/backup.js');
  const {taskOf} = await import('/scenario/model.js');
  return cases.map(({scenario, state, s, a}) => {
    const mdp = taskOf(scenario).mdp();
    const pi = state.max ? null : policyOf(mdp, state);
    const {V, Q} = valuesOf(mdp, pi);
    const told = node => ({...node, rule: ruleOf(node), made: node.children.length ? backedUp(node, mdp.gamma) : null,
                           children: node.children.map(told)});
    return {V: Array.from(V), Q: Array.from(Q), tree: told(backupTree({mdp, pi, V, Q}, s, a))};
  });
}"""
JUDGED = """async ({node, answers, gamma}) => {
  const {judge} = await import('/scenario/backup.js');
  return answers.map(answer => judge(node, answer, gamma));
}"""


@pytest.fixture(scope="module")
def js(browser):
    """Run functions in a page that has the package's modules at /."""
    with browsing.served(MODULES) as address, browsing.visit(browser, address) as here:
        yield here.page.evaluate
        assert here.complaints == []


def state_of(here):
    """The state, told at once as by a page that is left."""
    here.page.evaluate("dispatchEvent(new Event('pagehide'))")
    return state_told(here.page)


def node(here, *way):
    """The node that is reached by these branches: an action's index, then the number of a successor."""
    return here.page.locator(f'[data-id="{"-".join(map(str, (0, *way)))}"]')


def middle(locator):
    locator.scroll_into_view_if_needed()
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def formula(here):
    return [line.replace("\xa0", " ") for line in here.page.locator(".rl-formula").all_inner_texts()]


def numbers(text):
    return [float(number.replace("−", "-")) for number in re.findall(r"−?\d+(?:\.\d+)?", text)]


def value_told(locator):
    """The value of a node as a screen reader tells it."""
    return numbers(locator.get_attribute("aria-label").split("value")[1])[0]


def three_digits(value):
    return float(f"{value:.{2 if abs(value) < 1 else 3}g}")


def choose(here, name):
    here.page.get_by_role("radio", name=name, exact=True).check()


def fill(here, label, value):
    slider = here.page.get_by_label(label, exact=True).first
    slider.evaluate(
        "(input, v) => { input.value = v; input.dispatchEvent(new Event('input', {bubbles: true})); }", value
    )


def cell_on_page(here, x, y, theta=None, n=10):
    """Where a cell, or the middle of a wedge in it, is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / n
    dx, dy = (0, 0) if theta is None else (0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta)))
    return box["x"] + 22 + (x + dx + 0.5) * cell, box["y"] + 3 + (n - 1 - y - dy + 0.5) * cell


# ---------------------------------------------------------------- the numbers are the library's
def values_in_python(task, policy, epsilon):
    mdp = task.mdp()
    best = rl.solve(mdp, tol=1e-12)
    if policy is None:
        return best.V, best.Q
    random = np.full((mdp.S, mdp.A), 1 / mdp.A)
    V = rl.evaluate_policy(mdp, random if policy == "random" else rl.epsilon_greedy(best.Q, epsilon))
    return V, rl.action_values(mdp, V)


def test_all_values_are_those_of_python_and_every_node_is_made_of_its_children(js):
    cases, wanted = [], []
    random = np.random.default_rng(1)
    for number in range(24):
        world = rl.maps.random(5, density=0.2, rng=number)
        task = rl.Task(world, rl.Robot(slip=[0.0, 0.1, 0.5, 1.0][number % 4]), gamma=[0.5, 0.95, 0.999][number % 3])
        policy = [None, "random", "epsilon_greedy"][number // 2 % 3]
        state = {"max": policy is None, "policy": policy, "epsilon": 0.3}
        s = int(random.integers(len(task.poses)))
        a = None if number % 2 else int(random.integers(5))
        cases.append({"scenario": _scenario.scenario_of(task), "state": state, "s": s, "a": a})
        wanted.append(values_in_python(task, policy, 0.3))
    rules = set()
    for (V, Q), found, case in zip(wanted, js(TREES, cases), cases, strict=True):
        np.testing.assert_allclose(found["V"], V, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(found["Q"], Q.ravel(), rtol=1e-9, atol=1e-9)
        root = found["tree"]
        assert root["value"] == pytest.approx(V[case["s"]] if case["a"] is None else Q[case["s"], case["a"]])
        for part in parts(root):
            if part["made"] is not None:
                rules.add(part["rule"])
                assert part["made"] == pytest.approx(part["value"], rel=1e-8, abs=1e-8)
                if part["rule"] == "ahead":
                    assert sum(child["probability"] for child in part["children"]) == pytest.approx(1)
    assert rules == {"max", "mean", "ahead"}


def parts(tree):
    yield tree
    for child in tree["children"]:
        yield from parts(child)


@pytest.mark.parametrize("diagram", ["v_pi", "q_pi", "v_star", "q_star"])
def test_the_page_tells_the_numbers_of_python(page_of, diagram):
    here = page_of(BackupDiagram(TASK, HERE, diagram=diagram, action=3))
    V, Q = values_in_python(TASK, None if diagram.endswith("star") else "random", 0)
    s = TASK.index(HERE)
    if diagram.startswith("v"):
        assert value_told(node(here)) == three_digits(V[s])
        assert [value_told(node(here, a)) for a in range(5)] == [three_digits(q) for q in Q[s]]
    else:
        assert value_told(node(here)) == three_digits(Q[s, 3])
        successors = [TASK.mdp().next_state[s, 3, k] for k in range(3)]
        told = {value_told(node(here, k)) for k in range(node(here).page.locator("[aria-level='2']").count())}
        assert told == {three_digits(V[s_next]) for s_next in successors}
    assert numbers(formula(here)[-1])[-1] == pytest.approx(V[s] if diagram[0] == "v" else Q[s, 3], abs=6e-4)


def test_a_given_policy_and_a_reward_of_the_readers_own(page_of):
    own = rl.Task(WORLD, rl.Robot(slip=0.1), reward=lambda t: 5.0 * t.goal - abs(t.a) / 90 - 3 * t.crash)
    pi = np.random.default_rng(2).dirichlet(np.ones(5), own.mdp().S)
    here = page_of(BackupDiagram(own, HERE, policy=pi))
    assert value_told(node(here)) == three_digits(rl.evaluate_policy(own.mdp(), pi)[own.index(HERE)])
    fill(here, "Slip", 0.5)
    slippery = rl.Task(WORLD, rl.Robot(slip=0.5), reward=own.reward).mdp()
    assert value_told(node(here)) == three_digits(rl.evaluate_policy(slippery, pi)[own.index(HERE)])
    choose(here, "v*(s)")
    assert value_told(node(here)) == three_digits(rl.solve(slippery).V[own.index(HERE)])


@pytest.mark.parametrize(("label", "value"), [("Discount γ", 0.5), ("Slip", 0.6)])
def test_discount_and_slip_change_the_numbers(page_of, label, value):
    widget = BackupDiagram(TASK, HERE, diagram="v_star")
    here = page_of(widget)
    fill(here, label, value)
    widget.state = state_of(here)
    assert {"Discount γ": widget.task.gamma, "Slip": widget.task.robot.slip}[label] == value
    assert value_told(node(here)) == three_digits(rl.solve(widget.task.mdp()).V[TASK.index(HERE)])


def test_epsilon_leads_from_the_best_policy_to_chance(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    s, chance = TASK.index(HERE), value_told(node(here))
    choose(here, "ε-greedy")
    fill(here, "ε", 0)
    assert value_told(node(here)) == three_digits(rl.solve(TASK.mdp()).V[s])
    fill(here, "ε", 1)
    assert value_told(node(here)) == chance


def test_what_cannot_be_computed_is_told_and_the_last_good_state_stays(page_of):
    open_field = rl.Task(rl.GridWorld.from_ascii("....\n....\n....\n...G"), gamma=0.9)
    circling = np.full(open_field.mdp().S, 0)  # always right: round and round
    here = page_of(BackupDiagram(open_field, rl.Pose(1, 2, 0), policy=circling))
    before = value_told(node(here))
    fill(here, "Discount γ", 1)
    expect(here.page.get_by_role("alert")).to_contain_text("a policy that ends when gamma = 1")
    assert value_told(node(here)) == before
    assert state_of(here)["scenario"]["gamma"] == 0.9
    fill(here, "Discount γ", 0.5)
    expect(here.page.get_by_role("alert")).to_be_empty()


# ---------------------------------------------------------------- picking and walking
def test_pointing_at_a_node_fills_its_formula(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    Q = values_in_python(TASK, "random", 0)[1][TASK.index(HERE)]
    assert formula(here)[0] == "vπ(s) = Σa π(a | s) qπ(s, a)"
    assert numbers(formula(here)[1])[1:-1:2] == pytest.approx(Q[::-1], abs=6e-4)  # left turns first, as drawn
    here.page.mouse.move(*middle(node(here, 3)))
    assert formula(here)[0] == "qπ(s, a) = Σs′, r p(s′, r | s, a) [ r + γ vπ(s′) ]"
    terms = numbers(formula(here)[1])
    assert terms[-1] == pytest.approx(Q[3], abs=6e-4)
    assert sum(p * (r + g * v) for p, r, g, v in np.reshape(terms[:-1], (-1, 4))) == pytest.approx(Q[3], abs=2e-3)
    choose(here, "v*(s)")
    assert formula(here)[0] == "v*(s) = maxa q*(s, a)"


def test_a_leaf_tells_its_share(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    here.page.mouse.move(*middle(node(here, 3, 0)))
    p, r, gamma, v, share = numbers(formula(here)[1])
    assert (p, gamma) == (0.8, 0.95)
    assert share == pytest.approx(p * (r + gamma * v), abs=1e-3)
    expect(here.page.locator(".rl-answer")).to_contain_text("With probability 0.8, as it was steered.")


def test_a_crash_is_told_as_an_end(page_of):
    here = page_of(BackupDiagram(LANE, rl.Pose(1, 0, 90), diagram="v_star"))
    here.page.mouse.move(*middle(node(here, 2, 0)))
    expect(here.page.locator(".rl-answer")).to_contain_text("A crash ends the episode: nothing follows")
    go = here.page.get_by_role("button", name="Go to this pose")
    assert go.get_attribute("title") == "The episode is over there."
    here.page.mouse.click(*middle(node(here, 2, 0)))
    assert state_of(here)["pose"] == [1, 0, 90]


@pytest.mark.parametrize("way", ["click", "button", "touch", "keys"])
def test_a_reader_walks_to_a_successor_and_back(page_of, way):
    here = page_of(BackupDiagram(TASK, HERE), width="telephone" if way in ("touch", "button") else "desk")
    page, leaf = here.page, node(here, 3, 0)
    there = TASK.pose(TASK.mdp().next_state[TASK.index(HERE), 3, 0])
    if way == "click":
        page.mouse.move(*middle(leaf))
        page.mouse.click(*middle(leaf))
    elif way == "touch":
        page.touchscreen.tap(*middle(leaf))
        assert state_of(here)["pose"] == [2, 4, 45]  # the first tap only picks
        page.touchscreen.tap(*middle(leaf))
    elif way == "button":
        page.touchscreen.tap(*middle(leaf))
        page.get_by_role("button", name="Go to this pose").tap()
    else:
        node(here).focus()
        for key in ("ArrowDown", "Home", "ArrowDown"):
            page.keyboard.press(key)
        while page.evaluate("document.activeElement.dataset.id") != "0-3":
            page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowDown")
        while page.evaluate("document.activeElement.dataset.id") != "0-3-0":
            page.keyboard.press("ArrowRight")
        page.keyboard.press("Enter")
        assert page.evaluate("document.activeElement.dataset.id") == "0"
    assert state_of(here)["pose"] == [there.x, there.y, there.theta]
    assert value_told(node(here)) == three_digits(values_in_python(TASK, "random", 0)[0][TASK.index(there)])
    page.get_by_role("button", name="Back", exact=True).click()
    assert state_of(here)["pose"] == [2, 4, 45]


def test_a_press_on_the_map_picks_cell_and_heading(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    here.page.mouse.click(*cell_on_page(here, 8, 3, 135))
    assert state_of(here)["pose"] == [8, 3, 135]
    here.page.mouse.click(*cell_on_page(here, 3, 7, 0))  # an obstacle
    assert state_of(here)["pose"] == [8, 3, 135]
    here.page.get_by_role("button", name="Turn left").click()
    assert state_of(here)["pose"] == [8, 3, 180]
    here.page.get_by_role("button", name="Turn right").click()
    assert state_of(here)["pose"] == [8, 3, 135]


def test_the_map_is_worked_by_keys(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    here.page.get_by_role("application").focus()
    for key in ("ArrowDown", "ArrowRight", "Enter", "l", "l", "r"):
        here.page.keyboard.press(key)
    assert state_of(here)["pose"] == [3, 3, 90]


def test_a_place_on_the_map_lights_up(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    picture = "() => document.querySelector('.rl-grid canvas').toDataURL()"
    before = here.page.evaluate(picture)
    here.page.mouse.move(*middle(node(here, 3, 0)))
    assert here.page.evaluate(picture) != before


# ---------------------------------------------------------------- the exercise
STATE = {"id": "0", "kind": "state", "value": 2.0}
ACTION = {"id": "0", "kind": "action", "value": 0.8 * (1 + 0.5 * 4) + 0.2 * (-3 + 0.5 * 6)}
MEAN = STATE | {"value": 3.4, "children": [{"value": v, "probability": p} for v, p in ((1, 0.5), (5, 0.3), (7, 0.2))]}
MAX = STATE | {"value": 7, "children": [{"value": v, "probability": None} for v in (1, 5, 7)]}
AHEAD = ACTION | {
    "children": [
        {"value": 4, "probability": 0.8, "reward": 1},
        {"value": 6, "probability": 0.2, "reward": -3},
    ]
}


@pytest.mark.parametrize(
    ("node", "answer", "words"),
    [
        (MEAN, 3.41, "Right."),
        (MEAN, 7, "That is the maximum."),
        (MEAN, 4.33, "That is the plain mean."),
        (MEAN, 13, "That is the plain sum."),
        (MEAN, 1, "That is the smallest."),
        (MEAN, 5.5, "Not yet: it is less than that."),
        (MEAN, -20, "Not yet: it is more than that."),
        (MAX, 7, "Right."),
        (MAX, 4.33, "That is the mean."),
        (MAX, 1, "That is the smallest."),
        (AHEAD, 2.4, "Right."),
        (AHEAD, 0.8 * 5 + 0.2 * 3, "The discount is missing"),
        (AHEAD, 0.5 * (0.8 * 4 + 0.2 * 6), "The reward of the step is missing"),
        (AHEAD, 0.8 * 4 + 0.2 * 6, "Reward and discount are missing"),
        (AHEAD, 0.8 - 0.6, "That is the reward alone."),
        (AHEAD, 0.5 * (0.8 * 5 + 0.2 * 3), "The reward is discounted as well."),
        (AHEAD, 3, "Only the likeliest successor is in it."),
        (AHEAD, 1.5, "That is the plain mean."),
    ],
)
def test_a_wrong_answer_tells_which_step_went_wrong(js, node, answer, words):
    (judged,) = js(JUDGED, {"node": node, "answers": [answer], "gamma": 0.5})
    assert judged["words"].startswith(words)
    assert judged["right"] == (words == "Right.")


def ask(here):
    if not here.page.locator(".rl-group[open]").count():
        here.page.get_by_text("Fill in the missing number").click()
    here.page.get_by_role("button", name="Hide a number").or_(
        here.page.get_by_role("button", name="Another one")
    ).click()


def answer(here, text):
    here.page.get_by_label("The number at the question mark").fill(text)
    here.page.keyboard.press("Enter")
    return here.page.locator(".rl-fill-words").inner_text()


def test_a_missing_number_is_found(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    V, Q = values_in_python(TASK, "random", 0)
    v, q = V[TASK.index(HERE)], Q[TASK.index(HERE)]
    ask(here)
    assert "?" in node(here).get_attribute("aria-label")
    figure = here.page.locator(".rl-backup")
    secret = f"{v:.2f}".replace("-", "−")
    assert secret not in figure.inner_text()
    assert formula(here) == ["vπ(s) = Σa π(a | s) qπ(s, a)"]
    assert answer(here, "").startswith("Type a number")
    assert answer(here, str(q.max())).startswith("That is the maximum.")
    assert answer(here, f"{v:.2f}".replace(".", ",")).startswith("Right: it is")
    assert value_told(node(here)) == three_digits(v)
    assert here.page.evaluate("document.activeElement.textContent") == "Another one"


def test_the_second_number_is_that_of_an_action_and_the_root_does_not_tell_it(page_of):
    here = page_of(BackupDiagram(TASK, HERE, diagram="v_star"))
    ask(here)
    ask(here)
    asked = [a for a in range(5) if "?" in node(here, a).get_attribute("aria-label")]
    assert len(asked) == 1
    assert "value" not in node(here).get_attribute("aria-label")
    q = rl.solve(TASK.mdp()).Q[TASK.index(HERE), asked[0]]
    here.page.mouse.move(*middle(node(here, asked[0])))
    assert len(formula(here)) == 1
    assert answer(here, "1000").startswith("Not yet: it is less")
    here.page.get_by_role("button", name="Show it").click()
    assert numbers(here.page.locator(".rl-fill-words").inner_text())[0] == pytest.approx(q, abs=6e-4)


def test_a_change_of_the_diagram_ends_the_question(page_of):
    here = page_of(BackupDiagram(TASK, HERE))
    ask(here)
    here.page.get_by_role("button", name="Turn left").click()
    assert "?" not in node(here).get_attribute("aria-label")
    assert not here.page.get_by_label("The number at the question mark").is_visible()


# ---------------------------------------------------------------- for everyone
def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    widget = BackupDiagram(TASK, HERE)
    here = page_of(widget)
    choose(here, "q*(s, a)")
    fill(here, "Slip", 0.9)
    here.page.get_by_role("button", name="Turn left").click()
    here.page.get_by_role("button", name="Start again").click()
    assert state_of(here) == widget.state
    assert value_told(node(here)) == three_digits(values_in_python(TASK, "random", 0)[0][TASK.index(HERE)])


@pytest.mark.parametrize("width", ["desk", "telephone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_stands_in_anyones_way(page_of, width, scheme):
    here = page_of(BackupDiagram(TASK, HERE), width=width, scheme=scheme)
    ask(here)
    answer(here, "77")
    here.page.mouse.move(*middle(node(here, 3)))
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    here.page.get_by_role("button", name="Lecture view").click()
    expect(here.page.locator(".rl-lecture")).to_have_count(1)
    assert findings(here.page) == []


def test_it_fits_into_360_pixels(page_of):
    here = page_of(BackupDiagram(TASK, HERE, diagram="q_pi"), width="telephone")
    here.page.set_viewport_size({"width": 360, "height": 740})
    ask(here)
    assert here.page.evaluate("document.documentElement.scrollWidth") <= 360


# ---------------------------------------------------------------- Python
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"diagram": "v"}, "`diagram` must be one of"),
        ({"policy": "own"}, "`policy` must be one of 'random', 'epsilon_greedy'"),
        ({"action": 5}, "`action` must be an integer from 0 to 4"),
        ({"epsilon": 2}, "`epsilon` must be a number in [0, 1]"),
        ({"pose": [3, 7, 0]}, "`pose` must be on a free cell"),
        ({"pose": 3}, "`pose` must be [x, y, theta]"),
        ({"scenario": {}}, "a scenario with the same map"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    widget = BackupDiagram(TASK, HERE)
    before = widget.state
    with pytest.raises((TypeError, ValueError)) as refused:
        widget.state = {**before, **change}
    assert message in str(refused.value)
    assert widget.state == before


def test_arguments_are_checked():
    with pytest.raises(TypeError, match="`task` must be a Task"):
        BackupDiagram(WORLD)
    with pytest.raises(TypeError, match="`pose` must be a Pose"):
        BackupDiagram(TASK, (1, 1, 0))
    with pytest.raises(ValueError, match="`pose` must be on a free cell"):
        BackupDiagram(TASK, rl.Pose(3, 7, 0))


@pytest.mark.parametrize("diagram", ["v_pi", "q_pi", "v_star", "q_star"])
def test_on_paper_it_has_the_same_number(diagram):
    widget = BackupDiagram(TASK, HERE, diagram=diagram)
    V, Q = values_in_python(TASK, None if diagram.endswith("star") else "random", 0)
    worth = V[TASK.index(HERE)] if diagram[0] == "v" else Q[TASK.index(HERE), 2]
    assert f": {worth:.4g}.".replace("-", "−") in repr(widget)
    assert repr(BackupDiagram(TASK, HERE, diagram=diagram)) == repr(widget)
