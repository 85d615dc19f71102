"""Whatever the simulator is given: a plain message, the last good state stays, and nothing is lost."""

import json
import re
from urllib.parse import quote

import pytest
from playwright.sync_api import expect

import rlnav as rl

from .arena import Arena
from .pages import settled, state_now

RUN = ".rl-run-words"
DAMAGED = [
    "#map=%%%&alpha=0.5",
    "#alpha=banana&slip=7&episodes=-3",
    "#algorithm=magic&alpha=0.5",
    "#__proto__=1&constructor=2&alpha=0.5",
    "#map=....!G&starts=9,9,9",
    "#gamma=NaN&Q0=Infinity&steering=1,2,3",
    "#" + quote("alpha=0.5&reward={", safe="=&") + "x" * 5000,
]
STRANGE = {  # settings, and what the message has to name
    "nothing": ("", "settings"),
    "cut off": ('{"rlnav": 1, "scenario": {"alpha": 0.', "settings"),
    "no object": ("[1, 2, 3]", "settings"),
    "of a later version": ('{"rlnav": 99, "scenario": {"alpha": 0.5}, "view": {}}', "version 99"),
    "of another program": ('{"color": "red"}', "version"),
    "too long": ("x" * 1_100_000, "settings"),
    "two goals": ({"map": ["G...", "....", "....", "...G"]}, "map"),
    "no goal": ({"map": ["....", "....", "....", "...."]}, "map"),
    "uneven rows": ({"map": ["....", "..", "....", "...G"]}, "map"),
    "a start in a wall": ({"map": ["#...", "....", "....", "...G"], "starts": [[0, 3, 0]]}, "starts"),
    "numbers out of range": ({"alpha": 7}, "alpha"),
    "another type": ({"episodes": "many"}, "episodes"),
    "an unknown key": ({"colour": 1}, "colour"),
}


def boxes(page):
    """The messages that can be seen."""
    return [text for text in page.locator(".rl-message, .rl-fault").all_inner_texts() if text.strip()]


def learns(page):
    """Train, as a user would, and see that it learns."""
    page.get_by_role("button", name="Train", exact=True).first.click()
    expect(page.locator(RUN).first).to_have_text(re.compile(r"Episode \d+ of"))


def paste(page, text):
    """Open a text as settings."""
    for summary in ("Share", "Open settings"):
        page.locator("summary", has_text=re.compile(f"^{summary}")).click()
    page.get_by_label("Or paste them here").fill(text)
    page.get_by_role("button", name="Take over").click()


@pytest.fixture
def simulator(page_of):
    """Open a page with the simulator; the keywords are settings."""
    return lambda hash="", **settings: page_of(rl.widgets.Simulator(**settings), hash=hash)


@pytest.mark.parametrize("address", DAMAGED)
def test_a_damaged_address_is_told_and_the_rest_of_it_used(simulator, address):
    page = simulator(address).page
    assert boxes(page), "the page says what it could not read"
    assert all(len(text) < 400 and "undefined" not in text for text in boxes(page))
    Arena(page.locator("body")).open("Learner")
    expect(page.get_by_label("Step size α, as a number")).to_have_value("0.5" if "alpha=0.5" in address else "0.2")
    learns(page)


@pytest.mark.parametrize("kind", STRANGE)
def test_settings_that_cannot_be_are_refused_and_the_run_goes_on(simulator, kind):
    page = simulator(seed=5).page
    learns(page)
    page.get_by_role("button", name="Pause", exact=True).click()
    settled(page)
    before, words = state_now(page), page.locator(RUN).text_content()
    settings, named = STRANGE[kind]
    paste(page, settings if isinstance(settings, str) else json.dumps({"rlnav": 1, "scenario": settings, "view": {}}))
    expect(page.locator(".rl-fault, .rl-message").filter(has_text=named)).to_be_visible()
    assert state_now(page) == before
    settled(page)
    assert page.locator(RUN).text_content() == words
    page.get_by_role("button", name="Go on", exact=True).click()
    expect(page.locator(RUN)).not_to_have_text(words)


@pytest.mark.parametrize(
    ("label", "typed", "key", "kept"),
    [
        ("Step size α, as a number", "7", "alpha", 0.2),
        ("Step size α, as a number", "0", "alpha", 0.2),
        ("Exploration ε, as a number", "-1", "epsilon", 0.2),
        ("Exploration ε, as a number", "abc", "epsilon", 0.2),
        ("Episodes", "1e99", "episodes", 1000),
        ("Episodes", "2.5", "episodes", 1000),
        ("Step limit", "", "max_steps", 200),
        ("Seed", "-3", "seed", 0),
        ("Initial Q", "Infinity", "Q0", 0),
    ],
)
def test_a_number_out_of_range_is_refused_beside_its_field(simulator, label, typed, key, kept):
    page = simulator().page
    page.locator("summary", has_text=re.compile("^Learner")).click()
    field = page.get_by_label(label, exact=True)
    field.fill(typed)
    field.press("Enter")
    expect(field).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".rl-fault").filter(has_text="is kept")).to_be_visible()
    assert state_now(page)["scenario"][key] == kept
    field.blur()
    assert float(field.input_value()) == kept
    learns(page)


def test_a_goal_that_would_be_painted_over_stays(simulator):
    page = simulator().page
    sim = Arena(page.locator("body"))
    sim.open("World").get_by_role("radio", name="Obstacle").check()
    sim.drag((5, 7), (8, 7))
    expect(page.locator(".rl-message").filter(has_text="goal")).to_be_visible()
    sim.says("the goal at (7, 7)")
    assert state_now(page)["scenario"]["map"][2] == ".....##G#."
    learns(page)


def test_a_goal_that_is_walled_in_is_told_and_can_be_mended(simulator):
    page = simulator().page
    sim = Arena(page.locator("body"))
    sim.open("World").get_by_role("radio", name="Obstacle").check()
    sim.drag((6, 6), (8, 6), (8, 8), (6, 8), (6, 7))
    train = page.get_by_role("button", name="Train", exact=True)
    expect(train).to_have_attribute("aria-disabled", "true")
    expect(page.get_by_role("alert").filter(has_text="goal").filter(visible=True).first).to_be_visible()
    sim.element.get_by_role("radio", name="Erase").check()
    sim.drag((6, 7), (6, 7))
    expect(train).to_have_attribute("aria-disabled", "false")
    learns(page)


def test_a_page_that_was_frozen_in_mid_training_goes_on_to_the_same_end(simulator):
    """A telephone freezes a page that nobody looks at: no timer fires until it is looked at again."""
    page = simulator(episodes=400, seed=3, view={"speed": "2000"}).page
    learns(page)
    browser = page.context.new_cdp_session(page)
    browser.send("Page.setWebLifecycleState", {"state": "frozen"})
    total = rl.widgets.Simulator(episodes=400, seed=3).train().steps.sum()  # meanwhile
    browser.send("Page.setWebLifecycleState", {"state": "active"})
    expect(page.locator(RUN)).to_have_text(f"Episode 400 of 400, {total:,} updates", timeout=30_000)


def test_only_the_first_of_two_simulators_has_the_address(page_of):
    page = page_of(rl.widgets.Simulator(seed=1), rl.widgets.Simulator(seed=2), hash="#seed=9").page
    sims = [Arena(page.locator("body"), n) for n in (0, 1)]
    for sim in sims:
        sim.press("Train")
    for sim in sims:
        sim.wait_for("Episode 1,000 of 1,000")  # a page that is busy would hear of the drag only later
    sims[1].drag((7, 7), (2, 8))
    sims[1].says("the goal at (2, 8)")
    sims[0].says("the goal at (7, 7)")
    sims[0].drag((7, 7), (4, 4))
    page.wait_for_function("() => location.hash.includes('map=')")
    assert "seed=9" in page.url
    sims[1].says("the goal at (2, 8)")
