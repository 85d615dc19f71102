"""The simulator as its users operate it: run, step back, drive, draw the world, show it to a class."""

import re
from itertools import pairwise

import numpy as np
import pytest
from playwright.sync_api import expect

import rlnav as rl
from accessibility import findings

from .arena import Arena
from .pages import settled

WIDTHS = pytest.mark.parametrize("width", ["desk", "telephone"])
TUNNEL = "######\n#>...G\n######"


@pytest.fixture
def opened(page_of):
    """Open a page with one simulator; return what operates it."""

    def opened(simulator=None, **where):
        here = page_of(rl.widgets.Simulator() if simulator is None else simulator, **where)
        return Arena(here.page.locator("body"))

    return opened


def progress(sim):
    return sim.element.locator(".rl-run-words")


def taken(sim):
    """Return how far the run has come, once it is drawn."""
    settled(sim.page)
    return progress(sim).text_content()


def result(sim):
    return sim.element.locator(".rl-result-words")


def comes(sim, condition):
    """Wait until the state that a kernel would know, a moment after the last change, is as it should be."""
    sim.page.wait_for_function(f"() => ({condition})(document.querySelector('.rlnav-explorable').model.get('state'))")


# ---------------------------------------------------------------- the first minute


@WIDTHS
def test_one_click_leads_a_newcomer_to_a_robot_that_reaches_the_goal(opened, width):
    sim = opened(width=width)
    expect(progress(sim)).to_have_text("Untrained, 1,000 episodes to go")
    assert sim.element.locator("details").count() >= 5
    assert sim.element.locator("details[open]").count() == 0
    sim.press("Train")
    result(sim).filter(has_text="The robot reaches the goal from every start").wait_for(timeout=30_000)
    updates = rl.widgets.Simulator().train().steps.sum()
    expect(progress(sim)).to_have_text(f"Episode 1,000 of 1,000, {updates:,} updates")


@WIDTHS
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_on_the_page_keeps_anyone_out(opened, width, scheme):
    sim = opened(width=width, scheme=scheme)
    assert findings(sim.page) == []
    for name in ("World", "Design", "Learner", "Compare", "Share"):
        sim.open(name)
    sim.press("Train")
    sim.press("Pause")
    assert findings(sim.page) == []
    assert sim.page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")


def test_a_narrow_telephone_scrolls_in_one_direction_only(opened):
    sim = opened(width="telephone")
    sim.page.set_viewport_size({"width": 360, "height": 740})
    for name in ("World", "Design", "Learner", "Compare", "Share"):
        sim.open(name)
    assert sim.page.evaluate("() => document.documentElement.scrollWidth") == 360


def test_the_run_bar_stays_in_view(opened):
    for width in ("desk", "telephone"):
        sim = opened(width=width)
        for name in ("World", "Design", "Learner"):
            sim.open(name)
        sim.element.locator("details").nth(2).scroll_into_view_if_needed()
        expect(sim.element.get_by_role("button", name="Train", exact=True)).to_be_in_viewport(ratio=1)


# ---------------------------------------------------------------- run


@WIDTHS
def test_steps_go_forth_and_back(opened, width):
    sim = opened(rl.widgets.Simulator(seed=4), width=width)
    back = sim.element.get_by_role("button", name="Back", exact=True)
    expect(back).to_have_attribute("aria-disabled", "true")
    for _ in range(3):
        sim.press("Update")
    expect(progress(sim)).to_have_text("Episode 1 of 1,000, 3 updates")
    sim.press("Back")
    expect(progress(sim)).to_have_text("Episode 1 of 1,000, 2 updates")
    sim.press("Back")
    sim.press("Back")
    expect(progress(sim)).to_have_text("Untrained, 1,000 episodes to go")
    expect(back).to_have_attribute("aria-disabled", "true")


def test_an_episode_is_as_long_as_python_says(opened):
    simulator = rl.widgets.Simulator(seed=4)
    sim = opened(simulator)
    sim.press("Episode")
    sim.press("Episode")
    expect(progress(sim)).to_have_text(re.compile(rf", {simulator.train().steps[:2].sum()} updates"))


def test_a_button_that_is_held_goes_on(opened):
    sim = opened()
    box = sim.element.get_by_role("button", name="Update", exact=True).bounding_box()
    sim.page.mouse.move(box["x"] + 9, box["y"] + 9)
    sim.page.mouse.down()
    expect(progress(sim)).to_have_text(re.compile(r", ([6-9]|\d\d+) updates"))
    sim.page.mouse.up()
    before = taken(sim)
    sim.page.evaluate("() => new Promise(resolve => setTimeout(resolve, 300))")
    assert taken(sim) == before


def test_pause_and_reset(opened):
    sim = opened(hash="#speed=100")
    sim.press("Train")
    sim.wait_for(r"Episode \d+ of 1,000, \d\d+ updates")
    sim.press("Pause")
    before = taken(sim)
    sim.page.evaluate("() => new Promise(resolve => setTimeout(resolve, 200))")
    assert taken(sim) == before
    sim.press("Reset")
    expect(progress(sim)).to_have_text("Untrained, 1,000 episodes to go")


def test_letters_run_the_simulator(opened):
    sim = opened(rl.widgets.Simulator(episodes=20))
    sim.map.focus()
    press = sim.page.keyboard.press
    for key in "nnb":
        press(key)
    expect(progress(sim)).to_have_text("Episode 1 of 20, 1 update")
    press("e")
    sim.wait_for("Episode 2 of 20")
    press("0")
    expect(progress(sim)).to_have_text("Untrained, 20 episodes to go")
    press("t")
    sim.wait_for("Episode 20 of 20")


def test_the_end_of_an_episode_is_told(opened):
    sim = opened()
    sim.press("Episode")
    expect(sim.element.locator("[aria-live=polite]")).to_have_text(re.compile(r"^Episode 1: .*\d+ steps?"))


def test_more_episodes_can_be_added(opened):
    sim = opened(rl.widgets.Simulator(episodes=10))
    sim.press("Train")
    sim.press("10 more episodes")
    updates = rl.widgets.Simulator(episodes=20).train().steps.sum()
    expect(progress(sim)).to_have_text(f"Episode 20 of 20, {updates} updates")


# ---------------------------------------------------------------- drive


@WIDTHS
def test_the_robot_is_driven_by_hand_and_learns_nothing_from_it(opened, width):
    sim = opened(rl.widgets.Simulator(rl.Task(rl.GridWorld.from_ascii(TUNNEL))), width=width)
    sim.press("Update")
    before = taken(sim)
    sim.press("Drive")
    ahead = sim.element.get_by_role("button", name="straight on")
    for _ in range(4):
        ahead.tap() if width == "telephone" else ahead.click()
    expect(sim.element.locator(".rl-drive-words")).to_have_text(re.compile("goal.*4 steps.*9.70", re.IGNORECASE))
    sim.press("Once more")
    sim.element.get_by_role("button", name="90° to the left").click()
    expect(sim.element.locator(".rl-drive-words")).to_have_text(re.compile("crash.*1 step,.*−10.00", re.IGNORECASE))
    sim.press("Stop driving")
    assert taken(sim) == before


def test_arrow_keys_drive(opened):
    sim = opened(rl.widgets.Simulator(rl.Task(rl.GridWorld.from_ascii(TUNNEL))))
    sim.press("Drive")
    for key in ("ArrowUp", "3", "ArrowUp", "ArrowUp"):
        sim.page.keyboard.press(key)
    expect(sim.element.locator(".rl-drive-words")).to_have_text(re.compile("goal", re.IGNORECASE))
    sim.page.keyboard.press("Escape")
    expect(sim.element.locator(".rl-drive")).to_be_hidden()


# ---------------------------------------------------------------- draw the world


def test_goal_and_start_are_dragged_by_mouse(opened):
    sim = opened()
    sim.drag((7, 7), (3, 8))
    sim.says("the goal at (3, 8)")
    sim.drag((2, 2), (5, 1))
    sim.says("The robot is at (5, 1)")
    comes(sim, "state => state.scenario.starts.every(([x, y]) => x === 5 && y === 1)")


def test_the_goal_is_dragged_by_a_finger_and_elsewhere_the_page_scrolls(opened):
    sim = opened(width="telephone")
    swipe(sim, (7, 7), (4, 4))
    sim.says("the goal at (4, 4)")
    assert sim.page.evaluate("() => scrollY") == 0
    swipe(sim, (1, 4), (1, 9))
    sim.page.wait_for_function("() => scrollY > 0")
    sim.says("the goal at (4, 4)")


def swipe(sim, *cells):
    """Put a finger on the first cell, move it over the others, and lift it."""
    browser = sim.page.context.new_cdp_session(sim.page)
    points = [sim.at(*cell) for cell in cells]
    touch = lambda kind, *points: browser.send(  # noqa: E731
        "Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]}
    )
    touch("touchStart", points[0])
    for (x0, y0), (x1, y1) in pairwise(points):
        for part in np.linspace(0.1, 1, 10):
            touch("touchMove", (x0 + part * (x1 - x0), y0 + part * (y1 - y0)))
    touch("touchEnd")


def test_a_drag_that_is_given_up_changes_nothing(opened):
    sim = opened()
    sim.page.mouse.move(*sim.at(7, 7))
    sim.page.mouse.down()
    sim.page.mouse.move(*sim.at(2, 8), steps=4)
    sim.map.press("Escape")
    sim.page.mouse.up()
    sim.says("the goal at (7, 7)")
    assert "map" not in sim.page.url


@WIDTHS
def test_walls_are_painted_over_every_cell_that_is_crossed(opened, width):
    sim = opened(width=width)
    sim.open("World").get_by_role("radio", name="Obstacle", exact=True).check()
    if width == "telephone":
        swipe(sim, (1, 5), (8, 5))
    else:
        sim.drag((1, 5), (8, 5))
    sim.says("8 of them obstacles")
    comes(sim, "state => state.scenario.map[4] === '.########.'")


def test_the_world_is_drawn_by_keyboard(opened):
    sim = opened()
    sim.map.focus()
    press = sim.page.keyboard.press
    for key in ["ArrowRight", "ArrowUp", "Space", "ArrowUp", "Enter", "ArrowUp", "Space", "Space"]:
        press(key)
    sim.says("2 of them obstacles")
    press("ArrowRight")
    press("g")
    sim.says("the goal at (2, 3)")
    press("ArrowDown")
    press("ArrowDown")
    press("s")
    press("r")
    sim.says("The robot is at (2, 1) and looks east")
    press("ArrowLeft")
    press("Delete")
    sim.says("1 of them obstacles")
    press("Control+z")
    sim.says("2 of them obstacles")
    press("a")
    comes(sim, "state => state.scenario.starts === null")
    comes(sim, "state => state.scenario.map.map(row => row[1]).join('') === '.......##.'")


def test_the_keys_are_told_on_a_page_of_their_own(opened):
    sim = opened()
    sim.map.focus()
    sim.page.keyboard.press("?")
    keys = sim.page.get_by_role("dialog", name="Keys")
    expect(keys).to_be_visible()
    expect(keys.get_by_role("button", name="Close")).to_be_focused()
    assert findings(sim.page) == []
    sim.page.keyboard.press("Escape")
    expect(keys).to_be_hidden()


def test_the_cursor_tells_what_is_known_of_a_pose(opened):
    sim = opened(hash="#speed=max")
    sim.press("Train")
    result(sim).filter(has_text="The robot reaches the goal").wait_for(timeout=30_000)
    sim.map.focus()
    for key in ["ArrowRight", "ArrowRight", "ArrowUp", "ArrowUp", "h"]:
        sim.page.keyboard.press(key)
    told = sim.element.locator("[aria-live=polite]")
    expect(told).to_have_text(re.compile(r"^\(2, 2\), heading north-east, 45°: value \d\.\d\d, best turn "))


# ---------------------------------------------------------------- lecture and link


def test_a_lecture_fills_the_screen_and_a_presenter_steps(opened):
    sim = opened()
    sim.press("Lecture view")
    expect(sim.element).to_have_class(re.compile("rl-lecture"))
    box = sim.element.bounding_box()
    assert (box["x"], box["y"], box["width"]) == (0, 0, sim.page.viewport_size["width"])
    press = sim.page.keyboard.press
    for key in ["Space", "ArrowRight", "PageDown", "ArrowLeft"]:
        press(key)
    expect(progress(sim)).to_have_text("Episode 1 of 1,000, 2 updates")
    press("Escape")
    expect(sim.element).not_to_have_class(re.compile("rl-lecture"))
    press("Space")
    assert "2 updates" in taken(sim)


def test_a_link_shows_one_idea_only(opened):
    sim = opened(hash="#map=maze&hide=world,design,learner,compare,share,drive,speed,metrics&lecture=1")
    expect(sim.element).to_have_class(re.compile("rl-lecture"))
    expect(sim.element.locator("details").filter(visible=True)).to_have_count(0)
    expect(sim.element.get_by_role("button", name="Drive")).to_be_hidden()
    expect(sim.element.get_by_label("Speed")).to_be_hidden()
    expect(sim.element.get_by_role("button", name="Train", exact=True)).to_be_visible()
    sim.says("11 by 10 cells")


def test_the_address_opens_what_its_sender_saw(opened):
    sim = opened()
    sim.drag((7, 7), (2, 8))
    sim.element.get_by_label("Color").select_option("visits")
    sim.page.wait_for_function("() => location.hash.includes('visits')")
    sim.page.reload()
    again = Arena(sim.page.locator("body"))
    again.says("the goal at (2, 8)")
    expect(again.element.get_by_label("Color")).to_have_value("visits")


def test_a_place_in_the_page_is_no_setting(opened):
    sim = opened(hash="#keys")
    sim.says("the goal at (7, 7)")
    assert sim.element.locator(".rl-message").count() == 0
    assert sim.page.url.endswith("#keys")


def test_a_link_within_the_page_changes_the_simulator(opened):
    sim = opened()
    sim.page.evaluate("() => { location.hash = '#map=cliff&seed=3'; }")
    sim.says("12 by 4 cells")
    comes(sim, "state => state.scenario.seed === 3")
