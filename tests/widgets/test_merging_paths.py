"""The merging paths of chapter 10: the drives and both tables are those of the library, and readers can work them."""

import base64
import re

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import MergingPaths, _scenario

from .pages import fits_into, kernel_sets, settled, state_now

ROADS = "##G##\n##.##\n##.##\n#...#\n.....\n..#..\n^###^"
TASK = rl.Task(rl.GridWorld.from_ascii(ROADS), rl.Robot((-90, 0, 90)))
MDP = TASK.mdp()
TRUNK = [TASK.index(rl.Pose(2, y, 90)) for y in (3, 4, 5)]
POLICY = np.eye(MDP.A)[rl.solve(MDP).pi]
POLICY[TRUNK] = [0.05, 0.9, 0.05]
DRIVES = [0] * 8 + [1] * 4
LEARN = """async ({scenario, policy, drives, alpha, batch}) => {
  const {Merging} = await import("/scenario/merging.js");
  const {taskOf} = await import("/scenario/model.js");
  const bits = array => btoa(String.fromCharCode(...new Uint8Array(Float64Array.from(array).buffer)));
  const merging = new Merging(taskOf(scenario).mdp(), Float64Array.from(policy.flat()), {seed: scenario.seed});
  const moments = merging.learn(drives, {alpha, batch});
  return { mc: moments.map(({mc}) => bits(mc)), td: moments.map(({td}) => bits(td)), states: merging.states,
           exact: bits(merging.exact), mcError: moments.map(({mcError}) => mcError) };
}"""


def widget(**settings):
    return MergingPaths(TASK, POLICY, **{"drives": DRIVES, "seed": 25, **settings})


def numbers(text):
    return np.frombuffer(base64.b64decode(text), np.float64)


def shown(here):
    """The numbers of the table, row by row: Monte Carlo, TD, exact."""
    rows = here.page.locator(".rl-numbers tbody tr")
    return [
        [float(value) for value in row.locator("data").evaluate_all("all => all.map(one => one.value)")]
        for row in rows.all()
    ]


def expected(**settings):
    mine = widget(**settings)
    exact = rl.evaluate_policy(MDP, POLICY)
    return [[V[s] for V in (mine.V_mc, mine.V_td, exact)] for s in MDP.start]


def press(here, name, times=1):
    for _ in range(times):
        here.page.get_by_role("button", name=name, exact=True).click()


def answer(here):
    settled(here.page)
    return here.page.locator(".rl-answer").inner_text()


# ---------------------------------------------------------------- the numbers are the library's
@pytest.mark.parametrize("alpha", [0.1, 0.5, 1.0])
def test_both_tables_are_those_of_the_library_to_the_last_bit(js, alpha):
    scenario = _scenario.scenario_of(TASK, seed=3)
    found = js(
        LEARN, {"scenario": scenario, "policy": POLICY.tolist(), "drives": DRIVES, "alpha": alpha, "batch": False}
    )
    for k in (0, 1, 9, 12):
        mine = widget(seed=3, alpha=alpha, shown=k)
        np.testing.assert_array_equal(numbers(found["mc"][k]), mine.V_mc)
        np.testing.assert_array_equal(numbers(found["td"][k]), mine.V_td)
    np.testing.assert_allclose(numbers(found["exact"]), rl.evaluate_policy(MDP, POLICY), rtol=1e-12, atol=1e-12)
    assert len(found["states"]) == 9


def test_learned_again_and_again_both_tables_come_to_rest_where_many_small_steps_lead(js):
    scenario = _scenario.scenario_of(TASK, seed=25)
    found = js(LEARN, {"scenario": scenario, "policy": POLICY.tolist(), "drives": DRIVES, "alpha": 0.5, "batch": True})
    mine = widget(shown=12, batch=True)
    np.testing.assert_allclose(numbers(found["mc"][12]), mine.V_mc, atol=1e-12)
    np.testing.assert_allclose(numbers(found["td"][12]), mine.V_td, atol=1e-9)
    td, episodes = np.zeros(MDP.S), mine.episodes()
    for _ in range(700):  # batch updating as Sutton and Barto describe it: all changes of a sweep are added at its end
        change = np.zeros(MDP.S)
        for episode in episodes:
            s, s_next = episode.states[:-1], episode.states[1:]
            np.add.at(change, s, episode.rewards + MDP.gamma * td[s_next] - td[s])
        td += 0.08 * change
    np.testing.assert_allclose(mine.V_td, td, atol=1e-6)


def test_the_drives_are_those_of_rollout(page_of):
    here = page_of(widget(shown=9))
    drive = rl.rollout(MDP, POLICY, start=int(MDP.start[1]), rng=25 + 8)
    G = rl.returns(drive.rewards, MDP.gamma)[0]
    assert not MDP.goal[drive.states[-1]]
    begin = f"Drive 9, right road: a crash in step {drive.actions.size}, return −{-G:.2f}."
    assert answer(here).startswith(begin)
    assert shown(here) == expected(shown=9)


# ---------------------------------------------------------------- it is operated
def test_one_road_learns_from_the_other_only_by_bootstrapping(page_of):
    here = page_of(widget())
    assert answer(here).startswith("No drive yet: both tables are 0. 12 drives are recorded")
    press(here, "Next drive", 9)
    (_, (mc, td, exact)) = shown(here)
    assert shown(here) == expected(shown=9)
    assert mc == pytest.approx(-4.1, abs=0.01)
    assert td == pytest.approx(-0.05)
    here.page.get_by_role("radio", name="again and again").check()
    settled(here.page)
    for row, mine in zip(shown(here), expected(shown=9, batch=True), strict=True):
        assert row == pytest.approx(mine, abs=1e-9)
    (_, left, _), (mc, right, _) = shown(here)
    assert left == pytest.approx(right)  # mirror images: what is true of one road is true of the other
    assert mc < -8
    assert abs(right - exact) < 2
    assert "The right road is worth −8.19 to Monte Carlo, the mean of its own drive" in answer(here)
    assert here.page.get_by_role("slider", name="Step size α").is_disabled()


def test_drives_go_back_play_to_the_end_and_start_again(page_of):
    here = page_of(widget(shown=1, drives=[0, 1, 0]))
    press(here, "Back")
    expect(here.page.get_by_role("button", name="Back")).to_have_attribute("aria-disabled", "true")
    press(here, "Play")
    expect(here.page.get_by_role("button", name="All played")).to_be_visible(timeout=15_000)
    expect(here.page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    assert state_now(here.page)["shown"] == 3
    press(here, "Start again")
    assert state_now(here.page) == widget(shown=1, drives=[0, 1, 0]).state


def test_the_reader_chooses_roads_and_luck(page_of):
    here = page_of(widget(shown=3))
    press(here, "+ right road")
    press(here, "+ left road")
    state = state_now(here.page)
    assert (state["drives"], state["shown"]) == ([0, 0, 0, 1, 0], 5)
    assert shown(here) == expected(drives=[0, 0, 0, 1, 0], shown=5)
    press(here, "Other luck")
    assert state_now(here.page)["scenario"]["seed"] == 125
    assert shown(here) == expected(drives=[0, 0, 0, 1, 0], shown=5, seed=125)


def test_the_step_size_is_set_by_keyboard_alone(page_of):
    here = page_of(widget(shown=12))
    slider = here.page.get_by_role("slider", name="Step size α")
    slider.focus()
    here.page.keyboard.press("End")
    settled(here.page)
    assert shown(here) == expected(shown=12, alpha=1.0)
    here.page.get_by_role("button", name="Back").focus()
    here.page.keyboard.press("Space")
    settled(here.page)
    assert shown(here) == expected(shown=11, alpha=1.0)


def test_a_finger_plays_drives(page_of):
    here = page_of(widget(), width="telephone")
    here.page.get_by_role("button", name="Next drive").tap()
    here.page.get_by_role("button", name="+ right road").tap()
    settled(here.page)
    assert state_now(here.page)["drives"] == [0, 1]
    for button in here.page.get_by_role("button").all():
        assert button.bounding_box()["height"] >= 44
    assert fits_into(here.page, 360)


def test_sixty_drives_are_enough(page_of):
    here = page_of(widget(drives=[0, 1] * 30, shown=60))
    expect(here.page.get_by_role("button", name="+ left road")).to_have_attribute("aria-disabled", "true")


def test_the_lecture_view_is_stepped_by_the_space_bar(page_of):
    here = page_of(widget())
    press(here, "Lecture view")
    here.page.keyboard.press("Space")
    here.page.keyboard.press("Space")
    settled(here.page)
    assert state_now(here.page)["shown"] == 2


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(widget(shown=9), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(widget(shown=9))
    kernel_sets(here.page, {"shown": 4, "alpha": 0.25})
    settled(here.page)
    assert shown(here) == expected(shown=4, alpha=0.25)
    kernel_sets(here.page, {"drives": [0, 7]})
    expect(here.page.get_by_role("alert").first).to_contain_text("`drives[1]` must be an integer from 0 to 1")
    assert shown(here) == expected(shown=4, alpha=0.25)


# ---------------------------------------------------------------- Python
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"drives": [0, 2]}, "`drives` must be an integer from 0 to 1; got 2"),
        ({"drives": [0] * 61}, "`drives` must be at most 60 drives"),
        ({"shown": 13}, "`shown` must be an integer from 0 to 12"),
        ({"alpha": 0}, r"`alpha` must be a number in \(0, 1\]"),
        ({"batch": 1}, "`batch` must be a bool"),
        ({"speed": 1}, "the key 'speed'"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    mine = widget()
    before = mine.state
    with pytest.raises((TypeError, ValueError), match=message):
        mine.state = {**before, **change}
    assert mine.state == before


def test_a_task_without_roads_that_merge_is_refused():
    lane = rl.Task(rl.GridWorld.from_ascii(">..G"))
    with pytest.raises(ValueError, match="at least two start poses"):
        MergingPaths(lane, rl.solve(lane.mdp()).pi, drives=[0])
    with pytest.raises(ValueError, match="comes to each cell with one heading"):
        MergingPaths(TASK, np.full((MDP.S, MDP.A), 1 / 3), drives=[0])
    with pytest.raises(TypeError, match="`policy` must be"):
        MergingPaths(TASK, None, drives=[0])


def test_on_paper_it_shows_the_roads_and_the_values_along_them():
    mine = widget(shown=9)
    assert "9 of 12 recorded drives, learned from once." in repr(mine)
    assert re.match(r"Map of the roads, and for each road the values of its poses after 9 drives", mine.alt)
    assert "0 of 12 recorded drives, learned from again and again." in repr(widget(batch=True))
