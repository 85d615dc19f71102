"""Two guesses and a ruler: every backup is the library's, and a reader sees why the guesses come to agree."""

import base64
import re

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import Contraction, _scenario

from .pages import fits_into, kernel_sets, state_now

WORLD = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
TASK = rl.Task(WORLD, rl.Robot(slip=0.2))
HERE = rl.Pose(8, 6, 90)
REACH = 20

PAIRS = """async ({scenario, guesses, own, k}) => {
  const {guessOf, Pair} = await import('/scenario/contraction.js');
  const {taskOf} = await import('/scenario/model.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  const mdp = taskOf(scenario).mdp();
  const pi = own && Float64Array.from(own.flat());
  const [V, W] = guesses.map((name, i) => guessOf(name, mdp, pi, 3 + i));
  const pair = new Pair(mdp, pi, V, W);
  const last = pair.run(k);
  return { V: bits(pair.V[last]), W: bits(pair.W[last]), distances: pair.distances, bounds: pair.bounds, last };
}"""


def backed_up(mdp, pi, V):
    Q = rl.action_values(mdp, V)
    return Q.max(axis=1) if pi is None else (pi * Q).sum(axis=1)


def guess(name, mdp, pi, seed):
    if name == "answer":
        return rl.solve(mdp, tol=1e-12).V if pi is None else rl.evaluate_policy(mdp, pi)
    luck = np.random.default_rng(seed).random(mdp.S)
    values = {"zeros": 0, "high": REACH, "low": -REACH, "random": REACH * (2 * luck - 1)}[name]
    return np.where(mdp.terminal, 0.0, values)


def words(here):
    return here.page.locator(".rl-answer")


def exact(locator):
    """Read the numbers that stand behind what is written."""
    return [float(number) for number in locator.locator("data").evaluate_all("all => all.map(one => one.value)")]


def ruler(here):
    return exact(here.page.locator(".rl-ruler"))


def state_of(here):
    return state_now(here.page)


def press(here, name):
    here.page.get_by_role("button", name=name, exact=True).click()


def fill(here, label, value):
    field = here.page.get_by_label(f"{label}, as a number")
    field.fill(str(value))
    field.press("Enter")


def place_of(here, x, y, theta, which=0):
    """Where the middle of a wedge is on the page."""
    canvas = here.page.get_by_role("application").nth(which)
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 6) / 10
    dx, dy = 0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta))
    return box["x"] + 3 + (x + dx + 0.5) * cell, box["y"] + 3 + (9 - y - dy + 0.5) * cell


# ---------------------------------------------------------------- numbers
@pytest.mark.parametrize("guesses", [("high", "low"), ("random", "zeros"), ("answer", "random")])
@pytest.mark.parametrize("mixed", [False, True])
def test_every_backup_is_that_of_python(js, guesses, mixed):
    mdp = TASK.mdp()
    pi = np.random.default_rng(1).dirichlet(np.ones(mdp.A), mdp.S) if mixed else None
    question = {"scenario": _scenario.scenario_of(TASK), "guesses": guesses, "own": pi.tolist() if mixed else None}
    V, W = (guess(name, mdp, pi, 3 + i) for i, name in enumerate(guesses))
    first = np.abs(V - W).max()
    for k in range(12):
        if k in (0, 1, 4, 11):
            found = js(PAIRS, {**question, "k": k})
            for name, values in (("V", V), ("W", W)):
                assert np.frombuffer(base64.b64decode(found[name])) == pytest.approx(values, abs=2e-9)
            assert found["distances"][k] == pytest.approx(np.abs(V - W).max(), abs=2e-9)
            assert found["bounds"][k] == pytest.approx(first * mdp.gamma**k, abs=1e-9)
        V, W = backed_up(mdp, pi, V), backed_up(mdp, pi, W)


def test_no_guess_ever_breaks_the_promise(js):
    for slip, gamma in ((0.0, 0.99), (0.3, 0.7)):
        task = rl.Task(WORLD, rl.Robot(slip=slip), gamma=gamma)
        scenario = _scenario.scenario_of(task)
        for guesses in (("high", "low"), ("random", "answer")):
            found = js(PAIRS, {"scenario": scenario, "guesses": guesses, "own": None, "k": 300})
            d = np.array(found["distances"])
            assert (d[1:] <= gamma * d[:-1] + 1e-9).all()
            assert d[-1] <= 1e-9 or found["last"] == 300


def test_the_ruler_and_the_table_show_the_numbers_of_python(page_of):
    widget = Contraction(TASK, backups=4, pose=HERE)
    here = page_of(widget)
    mdp, s = TASK.mdp(), TASK.index(HERE)
    assert ruler(here) == pytest.approx([40, 40 * 0.95**4, widget.distances[4]], abs=1e-12)
    V, W = (guess(name, mdp, None, 0) for name in ("high", "low"))
    for _ in range(3):
        V, W = backed_up(mdp, None, V), backed_up(mdp, None, W)
    v, w = rl.action_values(mdp, V)[s], rl.action_values(mdp, W)[s]
    rows = here.page.locator(".rl-numbers-scroll tbody tr")
    for i, a in enumerate(reversed(range(mdp.A))):  # left turns first
        assert exact(rows.nth(i)) == pytest.approx([v[a], w[a], abs(v[a] - w[a])], abs=1e-12)
    assert exact(rows.nth(mdp.A)) == pytest.approx([v.max(), w.max(), abs(v.max() - w.max())], abs=1e-12)


def test_the_mean_is_that_of_the_given_policy_or_of_chance(page_of):
    mdp = TASK.mdp()
    pi = np.random.default_rng(2).integers(mdp.A, size=mdp.S)
    for policy, chances in ((pi, np.eye(mdp.A)[pi]), (None, np.full((mdp.S, mdp.A), 0.2))):
        here = page_of(Contraction(TASK, policy, backups=3, pose=HERE))
        here.page.get_by_role("radio", name="mean of π").check()
        V, W = (guess(name, mdp, None, 0) for name in ("high", "low"))
        for _ in range(3):
            V, W = backed_up(mdp, chances, V), backed_up(mdp, chances, W)
        expect(here.page.locator(".rl-result")).to_contain_text("mean")
        s = TASK.index(HERE)
        assert exact(here.page.locator(".rl-result")) == pytest.approx([V[s], W[s], abs(V[s] - W[s])], abs=1e-9)
        assert ruler(here)[2] == pytest.approx(np.abs(V - W).max(), abs=1e-9)


def test_beside_the_answer_the_ruler_measures_the_error(page_of):
    here = page_of(Contraction(TASK, guesses=("zeros", "answer")))
    star = rl.solve(TASK.mdp(), tol=1e-12).V
    for k in (1, 2, 3):
        press(here, "One backup")
        expect(words(here)).to_contain_text(f"Backup {k}:")
        error = np.abs(rl.value_iteration(TASK.mdp(), max_sweeps=k).V - star).max()
        assert ruler(here)[2] == pytest.approx(error, abs=1e-8)


# ---------------------------------------------------------------- operated
def test_backups_go_forward_and_back(page_of):
    here = page_of(Contraction(TASK))
    expect(words(here)).to_have_text("Two guesses, 40 apart at most. What does one backup make of them?")
    assert here.page.get_by_role("button", name="Back", exact=True).get_attribute("aria-disabled") == "true"
    press(here, "One backup")
    expect(words(here)).to_contain_text("Backup 1: 38 apart at most, 0.95 times what it was; just what γ promises.")
    press(here, "One backup")
    press(here, "One backup")
    expect(words(here)).to_contain_text("γ promises 0.95 or less")
    press(here, "Back")
    expect(words(here)).to_contain_text("Backup 2: ")
    assert state_of(here)["backups"] == 2


def test_it_plays_until_the_guesses_agree(page_of):
    task = rl.Task(rl.GridWorld.from_ascii("....\n....\n...G"), gamma=0.5)
    here = page_of(Contraction(task))
    last = Contraction(task, backups=300).distances.size - 1
    press(here, "Play")
    here.page.get_by_role("button", name="Pause").wait_for()
    expect(words(here)).to_contain_text(f"Backup {last}: V and W agree in every pose.", timeout=20_000)
    here.page.get_by_role("button", name="Play").wait_for()  # it has paused itself
    assert here.page.get_by_role("button", name="One backup").get_attribute("aria-disabled") == "true"


def test_another_guess_begins_at_the_beginning(page_of):
    here = page_of(Contraction(TASK, backups=5))
    here.page.get_by_label("W begins with").select_option("the answer itself")
    expect(words(here)).to_contain_text("Two guesses, 30 apart at most.")
    assert state_of(here)["guesses"] == ["high", "answer"]
    here.page.get_by_label("V begins with").select_option("the answer itself")
    expect(words(here)).to_contain_text("V and W are the same guess")


@pytest.mark.parametrize(("label", "value"), [("Discount γ", 0.5), ("Slip", 0.6)])
def test_discount_and_slip_change_the_backups_and_start_again_undoes_it(page_of, label, value):
    widget = Contraction(TASK, backups=6)
    here = page_of(widget)
    before = ruler(here)
    fill(here, label, value)
    expect(here.page.get_by_label(f"{label}, as a number")).to_have_value(str(value))
    widget.state = state_of(here)
    assert ruler(here)[2] == pytest.approx(widget.distances[-1], abs=1e-10)
    press(here, "Start again")
    expect(here.page.locator(".rl-ruler")).to_contain_text("40")
    assert ruler(here) == before
    assert state_of(here) == Contraction(TASK, backups=6).state


def test_a_pointer_shows_a_pose_and_a_press_keeps_it(page_of):
    here = page_of(Contraction(TASK, backups=4))
    caption = here.page.locator(".rl-numbers-scroll caption")
    expect(caption).to_contain_text("where V and W differ most")
    here.page.mouse.move(*place_of(here, 9, 7, 135, which=1))
    expect(caption).to_have_text("Backup 4 at (9, 7) ↖")
    here.page.mouse.down()
    here.page.mouse.up()
    here.page.mouse.move(5, 5)
    expect(caption).to_have_text("Backup 4 at (9, 7) ↖")
    assert state_of(here)["pose"] == [9, 7, 135]
    here.page.mouse.click(*place_of(here, 9, 7, 135))
    here.page.mouse.move(5, 5)
    expect(caption).to_contain_text("where V and W differ most")


def test_a_finger_picks_a_pose(page_of):
    here = page_of(Contraction(TASK, backups=4), width="telephone")
    here.page.touchscreen.tap(*place_of(here, 4, 4, 180))
    expect(here.page.locator(".rl-numbers-scroll caption")).to_contain_text("at (4, 4)")
    here.page.get_by_role("button", name="One backup").tap()
    expect(words(here)).to_contain_text("Backup 5:")


def test_the_keyboard_is_enough(page_of):
    here = page_of(Contraction(TASK))
    page = here.page
    page.get_by_role("button", name="One backup").focus()
    page.keyboard.press("Enter")
    expect(words(here)).to_contain_text("Backup 1:")
    page.get_by_role("application").first.focus()
    for key in ("ArrowUp", "ArrowRight", "r", "Enter"):
        page.keyboard.press(key)
    expect(page.locator(".rl-numbers-scroll caption")).to_have_text("Backup 1 at (1, 1) ↖")
    assert state_of(here)["pose"] == [1, 1, 135]


def test_the_lecture_view_fills_the_screen_and_the_space_bar_backs_up(page_of):
    here = page_of(Contraction(TASK))
    press(here, "Lecture view")
    here.page.keyboard.press("Space")
    expect(words(here)).to_contain_text("Backup 1:")
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


def test_what_cannot_be_computed_is_told_and_the_last_good_state_stays(page_of):
    open_field = rl.Task(rl.GridWorld.from_ascii("....\n....\n....\n...G"), gamma=0.9)
    circling = np.zeros(open_field.mdp().S, int)  # always right: round and round
    here = page_of(Contraction(open_field, circling, backup="mean", backups=2))
    fill(here, "Discount γ", 1)
    expect(here.page.get_by_role("alert").first).to_contain_text("a policy that ends when gamma = 1")
    assert state_of(here)["scenario"]["gamma"] == 0.9
    fill(here, "Discount γ", 0.5)
    expect(here.page.get_by_role("alert").first).to_be_empty()
    assert ruler(here)[1] == pytest.approx(10)


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(Contraction(TASK, backups=4))
    kernel_sets(here.page, {"backups": 2, "backup": "mean", "pose": [8, 6, 90]})
    expect(here.page.locator(".rl-numbers-scroll caption")).to_have_text("Backup 2 at (8, 6) ↑")
    kernel_sets(here.page, {"scenario": {"map": ["#G#", "###"], "slip": 2}})
    expect(here.page.get_by_role("alert").first).to_contain_text("must be")
    press(here, "One backup")
    expect(words(here)).to_contain_text("Backup 3:")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(Contraction(TASK, backups=3), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_it_fits_into_360_pixels(page_of):
    here = page_of(Contraction(TASK, backup="mean", backups=3), width="telephone")
    assert fits_into(here.page, 360)


# ---------------------------------------------------------------- Python
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"guesses": ["high"]}, "`guesses` must be two guesses"),
        ({"guesses": ["high", "middle"]}, "`guesses` must be one of"),
        ({"backup": "sum"}, "`backup` must be one of 'max', 'mean'"),
        ({"backups": -1}, "`backups` must be an integer of at least 0"),
        ({"seed": 0.5}, "`seed` must be an integer"),
        ({"pose": [3, 7, 0]}, "`pose` must be on a free cell"),
        ({"scenario": {}}, "a scenario with the same map"),
        ({"sweep": 3}, "`state` must be a dict with the keys"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    widget = Contraction(TASK)
    before = widget.state
    with pytest.raises((TypeError, ValueError)) as refused:
        widget.state = {**before, **change}
    assert message in str(refused.value)
    assert widget.state == before


def test_on_paper_it_has_the_same_numbers():
    widget = Contraction(TASK, backups=4)
    d = widget.distances
    assert f"After 4 backups V and W differ by {d[4]:.4g} at most; promised were {40 * 0.95**4:.4g} or less." in repr(
        widget
    )
    assert re.search('alt="[^"]*(high and low at first)', widget.html())
    assert repr(Contraction(TASK, backups=4)) == repr(widget)
