"""The mystery robot: it hides the same in Python and in the page, tells what an agent gets, and reveals the truth."""

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import MysteryRobot

from .pages import kernel_sets, settled, state_of

HIDDEN = """async states => {
  const {Mystery} = await import('/scenario/mystery.js');
  return states.map(state => {
    const m = new Mystery(state);
    const {answer, task, turns, names, start, drives} = m;
    return {map: String(task.world), turns, names, start, score: answer.score, steps: answer.steps,
            byChance: answer.byChance, steering: answer.steering, best: m.bestNumber,
            drives: drives.map(({states, rewards, score, end}) => ({states, rewards, score, end}))};
  });
}"""
CRASH = "CCA"  # in mystery 2, free space
GOAL = "BBBDCD"  # an optimal drive there
CIRCLE = "BBBB"


def mystery(**settings):
    return MysteryRobot(2, **settings)


def press(here, letters):
    for letter in letters:
        here.page.locator(".rl-pad button").nth("ABCDE".index(letter)).click()


def click(here, name):
    here.page.get_by_role("button", name=name, exact=True).click()


def told(here, text):
    expect(here.page.locator(".rl-explorable .rl-answer")).to_contain_text(text)


def rows(here, caption):
    table = here.page.get_by_role("region", name=caption)
    return [row.locator("td").all_inner_texts() for row in table.locator("tbody tr").all()]


def pad(here):
    settled(here.page)
    return here.page.locator(".rl-pad-note").all_inner_texts()


# ---------------------------------------------------------------- Python and the page hide the same
def test_both_sides_hide_the_same_and_drive_the_same(js):
    presses = np.random.default_rng(5).choice(list("ABCDE"), size=(30, 3))
    states = []
    for level in ("free", "obstacles", "slip"):
        for seed in range(4):
            drives = []
            for letters in presses.T[: seed % 3 + 1]:
                drives.append(longest(level, seed, drives, "".join(letters)))
            states.append(MysteryRobot(seed, level, drives=drives).state)
    for found, state in zip(js(HIDDEN, states), states, strict=True):
        here = MysteryRobot(**state)
        hidden, mdp = here.hidden, here.task.mdp()
        assert found["map"] == str(here.task.world)
        assert (tuple(found["turns"]), tuple(found["names"])) == (hidden.turns, hidden.names)
        assert found["start"] == mdp.start[0]
        assert found["steering"] == list(here.buttons.values())
        assert found["score"] == pytest.approx(here.best.V[mdp.start[0]], abs=1e-12)
        chance = rl.evaluate(mdp, np.full((mdp.S, mdp.A), 0.2), max_steps=30)
        assert found["byChance"] == pytest.approx(chance.success, abs=1e-12)
        for drive, episode in zip(found["drives"], here.episodes, strict=True):
            assert drive["states"] == episode.states.tolist()
            assert drive["rewards"] == episode.rewards.tolist()
            assert drive["score"] == pytest.approx(episode.rewards.sum(), abs=1e-12)
            assert (drive["end"] in ("goal", "crash")) == episode.terminated


def longest(level, seed, drives, letters):
    """Cut the presses where the drive ends."""
    for n in range(len(letters), 0, -1):
        try:
            MysteryRobot(seed, level, drives=[*drives, letters[:n]])
            return letters[:n]
        except ValueError:
            continue
    raise AssertionError


@pytest.mark.parametrize("level", ["free", "obstacles", "slip"])
def test_no_first_press_spoils_the_drive(level):
    for seed in range(12):
        here = MysteryRobot(seed, level)
        sure = rl.Task(here.task.world, gamma=1.0).mdp()
        V, s = rl.solve(sure).V, sure.start[0]
        assert (V[sure.next_state[s, :, 0]] > 0).all()  # the goal can still be reached
        assert 0 < V[s] < 9.55
        assert sorted(here.buttons.values()) == [-90, -45, 0, 45, 90]


def test_levels_do_not_give_each_other_away():
    assert MysteryRobot(2).buttons != MysteryRobot(2, "obstacles").buttons


# ---------------------------------------------------------------- driving
def test_a_press_tells_what_an_agent_gets_and_no_more(page_of):
    here = page_of(mystery())
    told(here, "You are in cell (2, 4), heading 90°. Press any button: nobody tells you what it does.")
    assert pad(here) == ["?"] * 5
    press(here, "C")
    told(here, "C: reward −0.1. You are in cell (2, 5), heading 90°.")
    press(here, "A")
    told(here, "A: reward −0.1. You are in cell (2, 6), heading 45°.")
    assert rows(here, "This drive, press by press") == [
        ["", "", "(2, 4) ↑"],
        ["C", "−0.1", "(2, 5) ↑"],
        ["A", "−0.1", "(2, 6) ↗"],
    ]
    assert here.page.locator(".rl-gauges b").all_inner_texts() == ["1", "2 of 30", "−0.2"]
    expect(here.page.locator(".rl-truth")).to_be_hidden()


def test_a_crash_and_the_goal_terminate_and_the_scores_are_kept(page_of):
    here = page_of(mystery())
    press(here, CRASH)
    told(here, "A: reward −10. You hit something: the drive has terminated. Score −10.2.")
    assert here.page.locator(".rl-pad button").first.get_attribute("aria-disabled") == "true"
    click(here, "Next drive")
    told(here, "Drive 2: the same start, the same buttons, the same hidden goal.")
    press(here, GOAL)
    told(here, "D: reward +10. You found the goal: the drive has terminated. Score 9.5.")
    assert rows(here, "Your drives") == [
        ["1", "3", "terminated (crash)", "−10.2"],
        ["2", "6", "terminated (goal)", "9.5"],
    ]
    here.page.wait_for_timeout(200)
    assert state_of(here.page)["drives"] == [CRASH, GOAL]


def test_a_drive_that_goes_nowhere_is_truncated(page_of):
    here = page_of(mystery(max_steps=4))
    press(here, CIRCLE)
    told(here, "After 4 steps the drive is cut off: truncated. Score −0.4.")
    assert rows(here, "Your drives") == [["1", "4", "truncated (out of time)", "−0.4"]]


def test_the_whole_figure_is_operated_by_the_keyboard(page_of):
    here = page_of(mystery())
    page = here.page
    page.locator(".rl-pad button").first.focus()
    page.keyboard.press("c")
    page.keyboard.press("3")
    told(here, "C: reward −0.1. You are in cell (2, 6), heading 90°.")
    page.keyboard.press("Enter")  # the focus is on A: straight into the edge
    told(here, "You hit something")
    expect(page.get_by_role("button", name="Next drive")).to_be_focused()
    page.keyboard.press("n")
    told(here, "Drive 2")
    expect(page.locator(".rl-pad button").first).to_be_focused()


def test_fingers_drive_on_a_telephone(page_of):
    here = page_of(mystery(), width="telephone")
    for button in ("C", "A"):
        here.page.locator(".rl-pad button").nth("ABCDE".index(button)).tap()
    told(here, "A: reward −0.1. You are in cell (2, 6), heading 45°.")
    sizes = here.page.locator(".rl-explorable button").evaluate_all(
        "all => all.map(one => Math.min(one.offsetHeight, one.offsetWidth))"
    )
    assert min(sizes) >= 44


def test_who_sees_only_numbers_is_told_a_name_and_what_was_tried_there(page_of):
    here = page_of(mystery(see="numbers"))
    names, episode = mystery().hidden.names, mystery(drives=["CC"]).episodes[0]
    numbers = [names[s] for s in episode.states]
    told(here, f"You are in state {numbers[0]}. Press any button")
    expect(here.page.locator(".rl-grid")).to_be_hidden()
    press(here, "CC")
    expect(here.page.locator(".rl-card")).to_contain_text(f"You are in state {numbers[2]}")
    expect(here.page.locator(".rl-card")).to_contain_text("You were never here before.")
    press(here, "A")  # into the edge
    told(here, "A: reward −10. That was bad: the drive has terminated. Score −10.2.")
    click(here, "Next drive")
    expect(here.page.locator(".rl-card")).to_contain_text("You were here 1 time before.")
    assert pad(here) == ["?", "?", f"→ {numbers[1]}", "?", "?"]
    here.page.get_by_role("radio", name="A map").check()
    expect(here.page.locator(".rl-grid")).to_be_visible()
    assert pad(here) == ["?"] * 5


# ---------------------------------------------------------------- the truth
def test_everything_is_revealed_and_hidden_again(page_of):
    here = page_of(mystery(drives=[CRASH, GOAL]))
    click(here, "Reveal")
    truth = here.page.locator(".rl-truth")
    expect(truth).to_have_text(
        "The best driver needs 6 presses and scores 9.5. Your best score is 9.5, in drive 2. "
        "A driver who presses at random finds the goal in one drive of 48."
    )
    assert pad(here) == ["−45°", "−90°", "0°", "+90°", "+45°"]
    assert rows(here, "Your drives")[-1] == ["best possible", "6", "terminated (goal)", "9.5"]
    expect(here.page.get_by_text("Solid: your best drive. Dashed: an optimal drive.")).to_be_visible()
    assert "one drive of 48" in here.page.locator(".rl-grid .rl-hidden").inner_text()
    click(here, "Hide again")
    expect(truth).to_be_hidden()
    assert pad(here) == ["?"] * 5


def test_with_slips_the_best_score_is_a_mean(page_of):
    here = page_of(MysteryRobot(1, "slip", revealed=True))
    best = MysteryRobot(1, "slip").best.V[MysteryRobot(1, "slip").task.mdp().start[0]]
    expect(here.page.locator(".rl-truth")).to_contain_text(f"scores {best:.2f} on average")


def test_a_new_mystery_hides_something_else(page_of):
    here = page_of(mystery(drives=[CRASH], revealed=True))
    click(here, "New mystery")
    first = MysteryRobot(3).task.world.starts[0]
    told(here, f"You are in cell ({first.x}, {first.y}), heading {first.theta}°.")
    here.page.wait_for_timeout(200)
    state = state_of(here.page)
    assert (state["seed"], state["drives"], state["revealed"]) == (3, [], False)
    here.page.get_by_role("radio", name="Obstacles", exact=True).check()
    number = here.page.get_by_label("Mystery number")
    number.fill("7")
    number.press("Enter")
    first = MysteryRobot(7, "obstacles").task.world.starts[0]
    told(here, f"You are in cell ({first.x}, {first.y}), heading {first.theta}°.")


def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    widget = mystery()
    here = page_of(widget)
    press(here, CRASH)
    click(here, "Next drive")
    click(here, "Reveal")
    here.page.get_by_role("radio", name="Only numbers").check()
    click(here, "Start again")
    told(here, "You are in cell (2, 4), heading 90°. Press any button")
    here.page.wait_for_timeout(200)
    assert state_of(here.page) == widget.state


def test_the_lecture_view_begins_with_the_first_button(page_of):
    here = page_of(mystery())
    click(here, "Lecture view")
    here.page.keyboard.press("Space")
    told(here, "A: reward −0.1.")
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_stands_in_anyones_way(page_of, width, scheme):
    here = page_of(mystery(drives=[CRASH, GOAL]), width=width, scheme=scheme)
    assert findings(here.page) == []
    click(here, "Reveal")
    assert findings(here.page) == []
    if width == "telephone":
        here.page.set_viewport_size({"width": 360, "height": 740})
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


# ---------------------------------------------------------------- Python
def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(mystery())
    kernel_sets(here.page, {"drives": ["CA"]})
    told(here, "A: reward −0.1. You are in cell (2, 6), heading 45°.")
    kernel_sets(here.page, {"drives": ["CCACC"]})
    expect(here.page.get_by_role("alert").first).to_contain_text("5 presses in drive 1, which ended after 3")
    told(here, "A: reward −0.1. You are in cell (2, 6), heading 45°.")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"level": "hard"}, "`level` must be one of 'free', 'obstacles', 'slip'"),
        ({"see": "all"}, "`see` must be one of 'map', 'numbers'"),
        ({"max_steps": 0}, "`max_steps` must be an integer"),
        ({"drives": ["AF"]}, "`drives` must be texts of the letters A to E; got 'AF'"),
        ({"drives": ["CCAC"]}, "got 4 presses in drive 1, which ended after 3"),
        ({"revealed": 1}, "`revealed` must be"),
        ({"drives": [""] * 201}, "`drives` must be at most 200 drives; got 201"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises((TypeError, ValueError)) as refused:
        mystery(**settings)
    assert message in str(refused.value)


def test_the_still_picture_gives_nothing_away_before_it_is_revealed():
    here = mystery(drives=["CA"])
    assert "question marks" in here.alt
    assert "Drive 1, step 2: score −0.2." in repr(here)
    here.state = here.state | {"revealed": True}
    assert "an optimal drive" in here.alt
    assert "The best score is 9.50." in repr(here)
