"""Two ways on a time line: every return is the library's, built backwards, and who drags a reward sees what it does."""

import re
from dataclasses import replace

import numpy as np
import pytest
from playwright.sync_api import expect

import rlnav as rl
from accessibility import findings
from rlnav.widgets import ReturnLine

from .pages import kernel_sets, settled, state_now

MAP = """
........
...#....
>..#...G
...#....
...#....
"""
SHORT, LONG = [-0.1, -0.1, 4.0], [-0.1] * 6 + [10.0]


def reward(t):
    charger = t.crash and (t.s_next.x, t.s_next.y) == (3, 2)
    return 4.0 if charger else 10.0 if t.goal else -10.0 if t.crash else -0.1


TASK = rl.Task(rl.GridWorld.from_ascii(MAP), reward=reward)
MDP = TASK.mdp()
WAYS = {
    "short way": rl.rollout(MDP, rl.solve(replace(MDP, gamma=0.7)).pi, rng=0),
    "long way": rl.rollout(MDP, rl.solve(MDP).pi, rng=0),
}
NUMBERS = """async cases => {
  const {seen, ties} = await import('/scenario/return_line.js');
  return cases.map(({ways, gamma, known}) => ({
    seen: ways.map(way => { const {G, from, shares} = seen(way, gamma, known); return {G: [...G], from, shares}; }),
    ties: ties(ways),
  }));
}"""


def line(**changes):
    return ReturnLine(WAYS, 0.9, task=TASK, **changes)


def build(here):
    return here.page.locator(".rl-return-bar .rl-primary")


def words(here):
    settled(here.page)
    return here.page.locator(".rl-answer").inner_text()


def shown(here, way):
    """The returns that are built of one way, to the last bit."""
    settled(here.page)
    values = here.page.locator(f".rl-lane-{way} data").evaluate_all("all => all.map(one => one.value)")
    return [float(value) for value in values if value]


def bar(here, way, name):
    return here.page.locator(f".rl-lane-{way}").get_by_role("slider", name=f"Reward {name}")


# ---------------------------------------------------------------- the numbers are the library's
def test_returns_and_ties_are_those_of_python(js):
    random = np.random.default_rng(0)
    cases = []
    for _ in range(40):
        ways = [{"name": "", "rewards": random.normal(0, 3, random.integers(1, 13)).tolist()} for _ in range(2)]
        cases.append({"ways": ways, "gamma": float(random.random()), "known": int(random.integers(0, 13))})
    for case, found in zip(cases, js(NUMBERS, cases), strict=True):
        for way, numbers in zip(case["ways"], found["seen"], strict=True):
            G = rl.returns(way["rewards"], case["gamma"])
            assert numbers["G"] == G.tolist()
            counted = [share for share in numbers["shares"] if share is not None]
            assert len(counted) == G.size - numbers["from"]
            assert not counted or sum(counted) == pytest.approx(G[numbers["from"]], abs=1e-12)
        assert found["ties"] == pytest.approx(roots(*case["ways"]), abs=1e-9)


def roots(one, other):
    """Where two polynomials meet between 0 and 1, by another road."""
    size = max(len(one["rewards"]), len(other["rewards"]))
    gap = np.subtract(*(np.pad(way["rewards"], (0, size - len(way["rewards"]))) for way in (one, other)))
    found = np.roots(gap[::-1])
    return sorted(r.real for r in found if abs(r.imag) < 1e-9 and 0 <= r.real <= 1)


def test_ways_that_never_differ_do_not_tie_anywhere_in_particular(js):
    ways = [{"name": "", "rewards": [1, 2, 3]}] * 2
    assert js(NUMBERS, [{"ways": ways, "gamma": 0.5, "known": 0}])[0]["ties"] == []


# ---------------------------------------------------------------- backwards
def test_the_returns_are_built_from_the_end(page_of):
    here = page_of(line())
    assert words(here).startswith("Nothing is added up yet. Begin at the end, where nothing follows: G₆ = R₇.")
    truth = [rl.returns(way.rewards, 0.9).tolist() for way in WAYS.values()]
    for t in range(6, -1, -1):
        expect(build(here)).to_have_text(f"Build G{'₀₁₂₃₄₅₆'[t]}")
        build(here).click()
        assert shown(here, 1) == truth[0][t:]
        assert shown(here, 2) == truth[1][t:]
    assert words(here) == "At γ = 0.9 the long way is worth 4.846 and wins; the short way is worth 3.05."
    assert build(here).get_attribute("aria-disabled") == "true"
    formula = here.page.locator(".rl-lane-2 .rl-lane-formula")
    expect(formula).to_have_text("G₀ = R₁ + γ G₁ = −0.1 + 0.9 · 5.495 = 4.846")
    here.page.get_by_role("button", name="Take back").click()
    assert words(here) == "Seen from t = 1, the short way is worth 3.5, and the long way is worth 5.495."
    assert state_now(here.page)["known"] == 1


def test_what_is_filled_adds_up_to_the_return(page_of):
    here = page_of(line(known=2))
    heights = "all => all.map(one => parseFloat(one.style.height))"
    here.page.emulate_media(reduced_motion="reduce")
    filled = here.page.locator(".rl-lane-2 .rl-bar-share").evaluate_all(heights)
    assert filled[:2] == [0, 0]
    unit = filled[-1] / (10 * 0.9**4)
    assert sum(filled[2:-1]) == pytest.approx(unit * 0.1 * sum(0.9**k for k in range(4)), rel=1e-3)


def test_a_discount_that_is_moved_changes_who_wins(page_of):
    here = page_of(line())
    here.page.get_by_role("button", name="Build all").click()
    slider = here.page.get_by_role("slider", name="Discount γ")
    slider.focus()
    for _ in range(12):
        slider.press("ArrowLeft")
    G = rl.returns(WAYS["short way"].rewards, 0.78)
    assert shown(here, 1) == pytest.approx(G, abs=1e-12)
    assert words(here).startswith("At γ = 0.78 the short way is worth 2.256 and wins")
    number = here.page.get_by_label("Discount γ, as a number")
    number.fill("0.81")
    number.press("Enter")
    assert words(here) == "At γ = 0.81 the two ways tie: both are worth 2.44."
    here.page.get_by_label("Show all discounts").check()
    expect(here.page.locator(".rl-tie")).to_have_text("The two ways tie at γ = 0 and at γ = 0.81.")


# ---------------------------------------------------------------- rewards
@pytest.mark.parametrize("width", ["desk", "telephone"])
def test_a_reward_is_dragged(page_of, width):
    here = page_of(line(known=0), width=width)
    knob = here.page.locator(".rl-lane-1 .rl-bar").nth(2).locator(".rl-bar-grip")
    knob.scroll_into_view_if_needed()
    box = knob.bounding_box()
    assert min(box["width"], box["height"]) >= 43.9
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    here.page.mouse.move(x, y)
    here.page.mouse.down()
    here.page.mouse.move(x, y - 40, steps=4)
    here.page.mouse.up()
    R = state_now(here.page)["ways"][0]["rewards"]
    assert R[:2] == SHORT[:2]
    assert 6 <= R[2] <= 12
    assert R[2] % 0.5 == 0
    assert shown(here, 1) == rl.returns(R, 0.9).tolist()


def test_a_reward_is_changed_by_keys(page_of):
    here = page_of(line(known=0))
    last = bar(here, 2, "R₇")
    last.focus()
    for key in ("ArrowUp", "ArrowUp", "ArrowLeft", "PageDown"):
        here.page.keyboard.press(key)
    assert state_now(here.page)["ways"][1]["rewards"][-2:] == [-2.1, 11]
    assert last.get_attribute("aria-valuenow") == "11"
    field = here.page.get_by_label("R₆ of the long way")
    field.fill("5")
    field.press("Enter")
    assert state_now(here.page)["ways"][1]["rewards"][-2:] == [5, 11]
    field.fill("50")
    field.press("Enter")
    expect(here.page.get_by_role("alert").filter(has_text="Type a number")).to_have_text(
        "Type a number from −12 to 12. 5 is kept."
    )


def test_the_keyboard_alone_is_enough(page_of):
    here = page_of(line())
    build(here).focus()
    for _ in range(7):
        here.page.keyboard.press("Enter")
    assert words(here).startswith("At γ = 0.9 the long way")
    for _ in range(20):
        here.page.keyboard.press("Tab")
        if here.page.evaluate("document.activeElement.getAttribute('aria-label')") == "Reward R₃":
            break
    for _ in range(5):
        here.page.keyboard.press("PageUp")
    assert words(here).startswith("At γ = 0.9 the short way is worth 9.53 and wins")


# ---------------------------------------------------------------- for everyone
@pytest.mark.parametrize("width", ["desk", "telephone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_stands_in_anyones_way(page_of, width, scheme):
    here = page_of(line(), width=width, scheme=scheme)
    assert findings(here.page) == []
    here.page.get_by_role("button", name="Build all").click()
    here.page.get_by_label("Show all discounts").check()
    settled(here.page)
    assert findings(here.page) == []
    if width == "telephone":
        here.page.set_viewport_size({"width": 360, "height": 740})
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_lecture_view_builds_by_the_space_bar(page_of):
    here = page_of(line())
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    here.page.keyboard.press("Space")
    assert words(here) == "Seen from t = 5, the long way is worth 8.9."
    here.page.get_by_role("button", name="Leave lecture view").click()


def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    widget = line()
    here = page_of(widget)
    first = words(here)
    here.page.get_by_role("button", name="Build all").click()
    bar(here, 1, "R₃").focus()
    here.page.keyboard.press("PageUp")
    here.page.get_by_role("button", name="Start again").click()
    assert words(here) == first
    assert state_now(here.page) == widget.state


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(line())
    kernel_sets(here.page, {"known": 0, "gamma": 0.5})
    assert shown(here, 2) == rl.returns(LONG, 0.5).tolist()
    told = words(here)
    kernel_sets(here.page, {"gamma": 3})
    here.page.get_by_role("alert").first.get_by_text("`gamma` must be a number in [0, 1]").wait_for()
    assert words(here) == told


def test_without_a_map_rewards_alone_are_compared(page_of):
    here = page_of(ReturnLine({"first offer": [0, 0, 5], "second offer": [2, 2]}, gamma=1.0, known=0))
    assert here.page.locator("canvas").count() == 0
    assert words(here) == "At γ = 1 the first offer is worth 5 and wins; the second offer is worth 4."


# ---------------------------------------------------------------- Python
def test_python_knows_the_rewards_and_draws_them_for_paper():
    widget = line()
    assert widget.G("long way") == pytest.approx(rl.returns(LONG, 0.9), abs=0)
    assert "discount of 0.9: the short way 3.050, the long way 4.846." in repr(widget)
    assert "the long way with 7 steps" in widget.alt
    widget.state = {**widget.state, "gamma": 0.5}
    assert widget.G("short way")[0] == rl.returns(SHORT, 0.5)[0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gamma": 1.5}, r"`gamma` must be a number in \[0, 1\]"),
        ({"known": -1}, "`known` must be an integer of at least 0"),
        ({"ways": []}, "`ways` must be two ways; got 0"),
        ({"curves": 1}, "`curves` must be"),
        ({"colour": 1}, "the key 'colour'"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    widget = line()
    before = widget.state
    with pytest.raises((TypeError, ValueError), match=message):
        widget.state = {**before, **change}
    assert widget.state == before


@pytest.mark.parametrize(
    ("ways", "message"),
    [
        ({"a": [1.0]}, "`ways` must be two ways; got 1"),
        ({"a": [1.0], "b": [99.0]}, r"`rewards` must be a number in \[-12, 12\]"),
        ({"a": [1.0], "b": [0.0] * 17}, "1 to 16 numbers; got 17"),
        ({"a": [1.0], "b": []}, "1 to 16 numbers; got 0"),
        ([1, 2], "`ways` must be"),
    ],
)
def test_arguments_are_checked(ways, message):
    with pytest.raises((TypeError, ValueError), match=message):
        ReturnLine(ways)


def test_a_map_needs_episodes():
    with pytest.raises(ValueError, match="Leave `task` out to compare rewards"):
        ReturnLine({"a": [1.0], "b": [2.0]}, task=TASK)
    assert re.search(r"'crashed': True", repr(line().state))
