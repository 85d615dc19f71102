"""Painting a policy: exact values and drives are Python's, and it is painted by mouse, touch and keys."""

import base64

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import PaintPolicy

from .pages import fits_into, in_lecture, kernel_sets
from .pages import state_now as state_of

ROOM = rl.GridWorld.from_ascii(".....\n...G.\n.#...\n.....\nS....")
TASK = rl.Task(ROOM, rl.Robot(slip=0.1))
START = rl.Pose(0, 0, 0)

PAINTED = """async ({scenario, policy, pose, n}) => {
  const {chancesOf, filled, statistics} = await import('/scenario/painted.js');
  const {taskOf} = await import('/scenario/model.js');
  const {evaluatePolicy} = await import('/prediction.js');
  const {returns, rollout} = await import('/rollouts.js');
  const {Pose} = await import('/robot.js');
  const bytes = list => Array.from(new Uint8Array(Float64Array.from(list).buffer));
  const bits = list => btoa(bytes(list).map(byte => String.fromCharCode(byte)).join(''));
  const task = taskOf(scenario);
  const mdp = task.mdp();
  const pi = chancesOf(policy, mdp);
  const start = task.index(new Pose(...pose));
  const drive = i => returns(rollout(mdp, pi, {start, maxSteps: 1000, rng: scenario.seed + i}).rewards, mdp.gamma)[0];
  const G = Array.from({length: n}, (_, i) => drive(i));
  return { V: bits(evaluatePolicy(mdp, pi)), G: bits(G), statistics: statistics(G),
           fills: ['straight', 'goal', 'random'].map(kind => filled(task, kind)) };
}"""


def numbers(text):
    return np.frombuffer(base64.b64decode(text), np.float64)


def words(here):
    return here.page.locator(".rl-answer")


def place_of(here, x, y, theta=None):
    """Where a cell, or the middle of a wedge in it, is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / 5
    dx, dy = (0, 0) if theta is None else (0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta)))
    return box["x"] + 22 + (x + dx + 0.5) * cell, box["y"] + 3 + (4 - y - dy + 0.5) * cell


@pytest.mark.parametrize("policy", ["straight", "goal", "random"])
@pytest.mark.parametrize("task", [TASK, rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), gamma=0.9)])
def test_values_and_drives_are_those_of_python(js, task, policy):
    pose = rl.Pose(1, 1, 45)
    paint = PaintPolicy(task, pose, policy, drives=40, seed=5)
    state = paint.state
    found = js(PAINTED, {**{k: state[k] for k in ("scenario", "policy", "pose")}, "n": 40})
    assert np.abs(numbers(found["V"]) - paint.V).max() <= 1e-12 * 10
    assert np.array_equal(numbers(found["G"]), paint.returns())
    assert found["fills"][("straight", "goal", "random").index(policy)] == state["policy"]
    G = paint.returns()
    assert found["statistics"]["mean"] == pytest.approx(G.mean(), abs=1e-12)
    assert found["statistics"]["se"] == pytest.approx(G.std(ddof=1) / np.sqrt(40), abs=1e-12)


def test_it_opens_with_an_exact_value_and_asks_for_a_drive(page_of):
    here = page_of(PaintPolicy(TASK, START))
    v = PaintPolicy(TASK, START).V[TASK.index(START)]
    expect(words(here)).to_have_text(
        f"From cell (0, 0), heading 0°, this policy has the exact value −{-v:.2f}. What will a single drive earn?"
    )
    expect(here.page.locator(".rl-dots circle.rl-dot")).to_have_count(1)  # the one in the key


def test_drives_fall_as_dots(page_of):
    here = page_of(PaintPolicy(TASK, START))
    here.page.get_by_role("button", name="Drive once").click()
    expect(words(here)).to_contain_text("one drive earned")
    here.page.get_by_role("button", name="100 drives").click()
    expect(here.page.locator(".rl-dots circle.rl-dot")).to_have_count(102)
    G = PaintPolicy(TASK, START, drives=101).returns()
    half = 1.96 * G.std(ddof=1) / np.sqrt(101)
    expect(words(here)).to_contain_text(f"101 drives earned −{-G.mean():.2f} on average")
    expect(words(here)).to_contain_text(f"−{half - G.mean():.2f} to −{-G.mean() - half:.2f}, holds")
    assert state_of(here.page)["drives"] == 101
    here.page.get_by_role("button", name="Clear").click()
    expect(words(here)).to_contain_text("What will a single drive earn?")


@pytest.mark.parametrize(
    ("slip", "says"),
    [(0.0, "the exact value −9.6: nothing is left"), (0.1, "and yet the exact value is −8.79")],
)
def test_drives_that_agree_are_taken_for_the_value_only_if_they_have_it(page_of, slip, says):
    here = page_of(PaintPolicy(rl.Task(ROOM, rl.Robot(slip=slip)), START, drives=3))
    expect(words(here)).to_contain_text("all 3 drives earned −9.6")
    expect(words(here)).to_contain_text(says)


def test_one_turn_that_is_painted_changes_what_it_is_worth(page_of):
    here = page_of(PaintPolicy(TASK, START, drives=50))
    here.page.get_by_role("radio", name="+45°").check()
    here.page.mouse.click(*place_of(here, 0, 0, 0))
    signs = state_of(here.page)["policy"]
    assert signs[TASK.index(START)] == "3"
    paint = PaintPolicy(TASK, START, signs, drives=50)
    v, G = paint.V[TASK.index(START)], paint.returns()
    assert v > 0 > PaintPolicy(TASK, START).V[TASK.index(START)]
    expect(words(here)).to_contain_text(f"50 drives earned {G.mean():.2f} on average")
    expect(words(here)).to_contain_text(f"the exact value {v:.2f}")


def test_a_stroke_paints_every_cell_that_it_crosses(page_of):
    here = page_of(PaintPolicy(TASK, START, "goal", heading=90))
    here.page.get_by_role("radio", name="random").check()
    here.page.mouse.move(*place_of(here, 0, 1))
    here.page.mouse.down()
    here.page.mouse.move(*place_of(here, 4, 1), steps=6)
    here.page.mouse.up()
    signs = state_of(here.page)["policy"]
    assert [signs[TASK.index(rl.Pose(x, 1, 90))] for x in range(5)] == ["r"] * 5
    assert signs.count("r") == 6  # and the crashed robot


@pytest.mark.parametrize("way", ["touch", "keys"])
def test_fingers_and_keys_paint_too(page_of, way):
    here = page_of(PaintPolicy(TASK, START, heading=0), width="telephone" if way == "touch" else "desk")
    here.page.get_by_role("radio", name="−45°").check()
    if way == "touch":
        here.page.touchscreen.tap(*place_of(here, 1, 0))
    else:
        here.page.get_by_label("Headings").focus()
        here.page.keyboard.press("Tab")
        for key in ("ArrowRight", "Enter"):
            here.page.keyboard.press(key)
    expect(here.page.locator(".rl-versus")).to_be_visible()
    assert state_of(here.page)["policy"][TASK.index(rl.Pose(1, 0, 0))] == "1"


def test_a_press_picks_where_the_drives_start(page_of):
    here = page_of(PaintPolicy(TASK, START, drives=10))
    here.page.mouse.click(*place_of(here, 0, 3, 0))
    expect(words(here)).to_contain_text("From cell (0, 3), heading 0°")
    here.page.mouse.click(*place_of(here, 1, 2, 0))  # an obstacle
    here.page.mouse.click(*place_of(here, 3, 3, 0))  # the goal
    assert state_of(here.page)["pose"] == [0, 3, 0]


@pytest.mark.parametrize(("name", "fill"), [("straight on", "straight"), ("to the goal", "goal"), ("random", "random")])
def test_a_whole_policy_is_one_press(page_of, name, fill):
    here = page_of(PaintPolicy(TASK, START, "goal" if fill != "goal" else "random"))
    here.page.get_by_role("button", name=name, exact=True).click()
    paint = PaintPolicy(TASK, START, fill)
    expect(words(here)).to_contain_text(f"−{-paint.V[TASK.index(START)]:.2f}")
    assert state_of(here.page)["policy"] == paint.state["policy"]


def test_policies_are_compared_and_may_have_no_order(page_of):
    here = page_of(PaintPolicy(TASK, START, "goal"))
    versus = here.page.locator(".rl-versus")
    expect(versus).to_have_text("Keep a policy to compare the next ones with it.")
    here.page.get_by_role("button", name="Keep this policy").click()
    expect(versus).to_contain_text("They are equally good.")
    here.page.get_by_role("button", name="straight on").click()
    live = ~TASK.mdp().terminal
    gain = (PaintPolicy(TASK, START, "straight").V - PaintPolicy(TASK, START, "goal").V)[live]
    better, worse = (gain > 1e-6).sum(), (gain < -1e-6).sum()
    expect(versus).to_contain_text(f"larger value in {better} poses, smaller in {worse}")
    assert min(better, worse) > 0
    expect(versus).to_contain_text("Neither policy is the better one.")
    difference = here.page.get_by_role("button", name="Difference")
    difference.click()
    expect(here.page.locator(".rl-legend")).to_contain_text("value less that of the kept policy")
    expect(difference).to_have_attribute("aria-pressed", "true")


def test_slip_and_discount_are_the_readers(page_of):
    here = page_of(PaintPolicy(TASK, START))
    for label, value in (("Slip", "0.3"), ("Discount γ", "0.8")):
        field = here.page.get_by_label(f"{label}, as a number")
        field.fill(value)
        field.press("Enter")
    task = rl.Task(ROOM, rl.Robot(slip=0.3), gamma=0.8)
    v = PaintPolicy(task, START).V[task.index(START)]
    expect(words(here)).to_contain_text(f"exact value −{-v:.2f}")


def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    paint = PaintPolicy(TASK, START)
    here = page_of(paint)
    first = words(here).inner_text()
    here.page.get_by_role("button", name="random", exact=True).click()
    here.page.get_by_role("button", name="100 drives").click()
    here.page.get_by_role("button", name="Start again").click()
    expect(words(here)).to_have_text(first)
    assert state_of(here.page) == paint.state


def test_the_space_bar_drives_in_a_lecture(page_of):
    here = page_of(PaintPolicy(TASK, START))
    with in_lecture(here.page):
        here.page.keyboard.press("Space")
        expect(words(here)).to_contain_text("one drive earned")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(PaintPolicy(TASK, START, drives=60, kept="straight"), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert fits_into(here.page, 360)


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(PaintPolicy(TASK, START))
    kernel_sets(here.page, {"drives": 30, "pose": [0, 4, 0]})
    expect(words(here)).to_contain_text("From cell (0, 4), heading 0°, 30 drives earned")
    kernel_sets(here.page, {"policy": "012"})
    here.page.get_by_role("alert").first.get_by_text("`policy` must be one sign for each of the").wait_for()
    expect(words(here)).to_contain_text("30 drives earned")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"policy": "012"}, "`policy` must be one sign for each of the 193 states"),
        ({"policy": "9" * 193}, "`policy` must be signs from 0 to 4, or r; got '9' in state 0"),
        ({"kept": ""}, "`kept` must be one sign for each"),
        ({"pose": rl.Pose(1, 2, 0)}, "`pose` must be on a free cell"),
        ({"pose": rl.Pose(3, 3, 0)}, "`pose` must be a pose from which the robot can drive"),
        ({"drives": 9999}, "`drives` must be an integer from 0 to 2000"),
        ({"heading": 30}, "`heading` must be one of"),
        ({"task": rl.Task(ROOM, gamma=1.0)}, r"`gamma` must be a number in \[0, 0.99\]"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        PaintPolicy(**{"task": TASK, "pose": START, **settings})


def test_on_paper_it_is_the_map_and_the_dots():
    paint = PaintPolicy(TASK, START, drives=30)
    assert f"30 drives, mean −{-paint.returns().mean():.2f}; exact value −8.79." in repr(paint)
    assert "the returns of 30 drives as dots" in paint.alt
    assert np.array_equal(paint.V, rl.evaluate_policy(TASK.mdp(), paint.pi))
