"""The reward mixer: its numbers are the library's, its parts do what they say, by mouse, touch and keyboard."""

from dataclasses import replace

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import RewardMixer, _scenario

from .pages import kernel_sets, settled
from .pages import state_now as state_of

D = rl.designs
WORLD = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
TASK = rl.Task(WORLD)
CLOSER = D.Progress(WORLD.goal, only_closer=True)
POSE = rl.Pose(1, 1, 45)

MIX = """async state => {
  const {Mixer} = await import('/scenario/mixer.js');
  const {worth, fates, drive, asked, best} = new Mixer().mix(state);
  return {worth, fates: Array.from(fates), end: drive.end, loop: drive.loop, states: Array.from(drive.states),
          rewards: Array.from(drive.rewards), V: Array.from(best.V)};
}"""
PLACE = """async ([states, loop, t]) => (await import('/scenario/mixer.js')).placeAt({states, loop}, t)"""
RECIPES = "async () => (await import('/scenario/mixer.js')).RECIPES"


def circling(**settings):
    return RewardMixer(TASK, CLOSER, pose=POSE, **settings)


def answer(here):
    return here.page.locator(".rl-answer")


def worth_on(here):
    values = here.page.locator(".rl-judges data").evaluate_all("all => all.map(one => Number(one.value))")
    return np.array(values).reshape(2, 2)


def place_of(here, x, y, theta=None):
    """Where a cell, or the middle of a wedge in it, is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / 10
    dx, dy = (0, 0) if theta is None else (0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta)))
    return box["x"] + 22 + (x + dx + 0.5) * cell, box["y"] + 3 + (9 - y - dy + 0.5) * cell


def type_in(here, label, text):
    field = here.page.get_by_label(f"{label}, as a number", exact=True)
    field.fill(text)
    field.press("Enter")


@pytest.mark.parametrize("drawing", ["FREE_SPACE", "OBSTACLES", "MAZE"])
def test_every_recipe_is_what_python_says(js, drawing):
    task = rl.Task(rl.GridWorld.from_ascii(getattr(rl.maps, drawing)))
    ends = set()
    for _, reward in js(RECIPES).values():
        mixer = RewardMixer(task)
        mixer.state = {**mixer.state, "scenario": {**mixer.state["scenario"], "reward": reward}}
        found = js(MIX, mixer.state)
        assert np.abs(np.array(found["worth"]) - mixer.worth).max() <= 1e-8  # the accuracy of evaluate_policy
        assert np.abs(np.array(found["V"]) - rl.solve(mixer.task.mdp(), tol=1e-12).V).max() <= 1e-10
        assert found["fates"] == mixer.fates.tolist()
        assert found["states"] == mixer.drive.states.tolist()
        assert found["rewards"] == mixer.drive.rewards.tolist()
        assert found["end"] == mixer.end
        assert (found["loop"] or {"length": 0})["length"] == mixer.loop
        ends.add(mixer.end)
    assert ends == {"goal", "circle", "crash"} - ({"crash"} if drawing == "FREE_SPACE" else set())


def test_where_a_policy_leads_is_what_the_exact_evaluation_says():
    mixer = circling()
    mdp, pi = mixer.task.mdp(), rl.solve(mixer.task.mdp(), tol=1e-12).pi
    for s in range(0, mdp.S - 1, 7):
        if not mdp.terminal[s]:
            score = rl.evaluate(replace(mdp, start=[s]), pi, max_steps=1000)
            assert mixer.fates[s] == score.success - score.crash


def test_a_drive_that_circles_goes_round_and_round(js):
    loop = {"from": 2, "length": 3, "paid": 0}
    assert [js(PLACE, [[9, 8, 1, 2, 3, 1], loop, t]) for t in range(10)] == [0, 1, 2, 3, 4, 5, 3, 4, 5, 3]
    assert js(PLACE, [[9, 8, 1], None, 7]) == 2


def test_it_says_that_the_robot_circles_and_what_a_round_pays(page_of):
    here = page_of(circling())
    expect(answer(here)).to_contain_text("It circles for ever, from step 8 on: each round of 4 steps pays +2,")
    expect(answer(here)).to_contain_text("By the task this is worth −2, and the best drive +4.83.")
    assert np.abs(worth_on(here) - circling().worth).max() <= 1e-8


def test_sliders_change_what_the_robot_does(page_of):
    here = page_of(RewardMixer(TASK, pose=POSE))
    expect(answer(here)).to_have_text("It arrives after 12 steps. The task could not ask for more.")
    slider = here.page.get_by_role("slider", name="Every other step")
    slider.focus()
    for _ in range(19):
        slider.press("ArrowLeft")
    expect(answer(here)).to_contain_text("It drives into the wall on purpose, after 2 steps")
    assert state_of(here.page)["scenario"]["reward"]["step"] == -2
    expect(here.page.get_by_label("Recipe")).to_have_value("impatient")
    type_in(here, "Every other step", "-0.1")
    type_in(here, "Each cell closer", "1.5")
    expect(answer(here)).to_contain_text("It arrives after 12 steps.")
    here.page.get_by_label("Forget to charge for going away").check()
    expect(answer(here)).to_contain_text("It circles for ever")
    expect(here.page.get_by_label("Recipe")).to_have_value("bonus")
    here.page.get_by_label("Recipe").select_option("task")
    expect(answer(here)).to_have_text("It arrives after 12 steps. The task could not ask for more.")


def test_a_reward_that_does_not_care_is_told(page_of):
    here = page_of(RewardMixer(TASK, D.Payment(0, 0, 0), pose=POSE))
    expect(answer(here)).to_contain_text("This reward does not care: it pays exactly as much for the way to the goal.")


def test_a_pose_that_is_lost_is_not_called_a_purpose(page_of):
    here = page_of(RewardMixer(TASK, pose=rl.Pose(9, 9, 90)))
    expect(answer(here)).to_contain_text("It crashes after 1 step: from this pose nothing can prevent it.")


def test_the_drive_is_played_and_its_returns_are_added_up(page_of):
    here = page_of(RewardMixer(TASK, CLOSER, pose=rl.Pose(8, 7, 90)))
    told = here.page.locator(".rl-tally")
    expect(answer(here)).to_contain_text("It arrives after 1 step.")
    here.page.get_by_role("button", name="Watch it drive").click()
    expect(told).to_have_text("Step 1. Return so far: +1 by this reward, +10 by the task.")
    here.page.get_by_role("button", name="Watch it drive").click()  # again, from the beginning
    expect(told).to_have_text("Step 1. Return so far: +1 by this reward, +10 by the task.")


def test_it_goes_on_circling_until_it_is_told_to_pause(page_of):
    here = page_of(circling())
    here.page.get_by_role("button", name="Watch it circle").click()
    told = here.page.locator(".rl-tally")
    expect(told).to_contain_text("round 2", timeout=9000)
    here.page.get_by_role("button", name="Pause").click()
    settled(here.page)
    text = told.inner_text()
    t = int(text.split()[1].rstrip(","))
    drive, mdp = circling().drive, TASK.mdp()
    steps = [i if i < 12 else 8 + (i - 8) % 4 for i in range(t)]
    own = sum(0.95**i * drive.rewards[k] for i, k in enumerate(steps))
    task = sum(0.95**i * mdp.reward[drive.states[k], drive.actions[k], 0] for i, k in enumerate(steps))
    numbers = [float(word.replace("−", "-")) for word in text.split() if word[0] in "+−"]
    assert numbers == pytest.approx([own, task], abs=0.0051)


def test_ten_robots_learn_and_the_reward_before_stays_for_comparison(page_of):
    here = page_of(RewardMixer(TASK, CLOSER, pose=POSE, episodes=150, alpha=0.5, epsilon=0.1, max_steps=60))
    go, words = here.page.get_by_role("button", name="Let it learn"), here.page.locator(".rl-mixer-learned")
    expect(words).to_have_text("Q-learning: 10 robots, each with a seed of its own, 150 episodes.")
    go.click()
    expect(words).to_contain_text("In the last 50 of 150 episodes", timeout=20000)
    here.page.get_by_label("Recipe").select_option("shaped")
    expect(words).to_contain_text("Q-learning: 10 robots")
    go.click()
    expect(words).to_contain_text("In the last 50 of 150 episodes", timeout=20000)
    keys = here.page.locator(".rl-keys li")
    expect(keys).to_have_text(["this reward", "before: +1 for each cell closer, and nothing else"])
    reward = D.Shaped(D.Payment(), D.Nearness(WORLD.goal), 0.95)
    how = {"episodes": 150, "alpha": 0.5, "epsilon": 0.1, "max_steps": 60}
    mdp = rl.Task(WORLD, reward=reward).mdp()
    ends = [rl.q_learning(mdp, **how, rng=seed).success[-50:].mean() for seed in range(1, 11)]
    low, middle, high = np.quantile(ends, [0.1, 0.5, 0.9])
    shown = [float(word.rstrip(".,;")) for word in words.inner_text().split() if word[0].isdigit()][-3:]
    assert shown == pytest.approx([middle, low, high], abs=0.0051)


def test_a_press_on_the_map_puts_the_robot_there(page_of):
    here = page_of(circling())
    here.page.mouse.click(*place_of(here, 8, 7, 90))
    expect(answer(here)).to_have_text("It arrives after 1 step. The task could not ask for more.")
    assert state_of(here.page)["pose"] == [8, 7, 90]
    here.page.mouse.click(*place_of(here, 7, 7))  # a wall
    assert state_of(here.page)["pose"] == [8, 7, 90]


def test_a_finger_does_so_too_and_nothing_is_wider_than_a_telephone(page_of):
    here = page_of(circling(), width="telephone")
    here.page.touchscreen.tap(*place_of(here, 8, 7, 90))
    expect(answer(here)).to_contain_text("It arrives after 1 step.")
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_keyboard_puts_the_robot_anywhere(page_of):
    here = page_of(circling())
    here.page.get_by_role("application").focus()
    for key in ("ArrowRight", "ArrowUp", "ArrowUp", "r", "r", "Enter"):
        here.page.keyboard.press(key)
    settled(here.page)
    assert state_of(here.page)["pose"] == [1, 2, 90]


def test_map_and_discount_can_be_changed_and_start_again_takes_all_back(page_of):
    here = page_of(circling())
    before = state_of(here.page)
    here.page.get_by_text("Map, discount and start").click()
    here.page.get_by_label("Map", exact=True).select_option("maze")
    expect(answer(here)).to_contain_text("each round of 20 steps pays +8.1")
    type_in(here, "Discount γ", "0.5")
    expect(answer(here)).not_to_contain_text("of 20 steps")
    assert state_of(here.page)["scenario"]["gamma"] == 0.5
    here.page.get_by_role("button", name="Start again").click()
    expect(answer(here)).to_contain_text("each round of 4 steps pays +2,")
    assert state_of(here.page) == before


def test_more_discount_makes_the_same_reward_a_trap(page_of):
    reward = D.Total(D.Payment(), CLOSER)
    here = page_of(RewardMixer(TASK, reward, pose=POSE))
    expect(answer(here)).to_contain_text("It arrives")
    here.page.get_by_text("Map, discount and start").click()
    type_in(here, "Discount γ", "0.99")
    expect(answer(here)).to_contain_text("It circles for ever")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(circling())
    kernel_sets(here.page, {"pose": [8, 7, 90]})
    expect(answer(here)).to_contain_text("It arrives after 1 step.")
    kernel_sets(here.page, {"scenario": {**_scenario.scenario_of(TASK), "slip": 0.5}})
    expect(here.page.get_by_role("alert").first).to_contain_text("`slip` must be 0")
    expect(answer(here)).to_contain_text("It arrives after 1 step.")
    kernel_sets(here.page, {"scenario": _scenario.scenario_of(TASK), "pose": [8, 8, 90]})
    expect(here.page.get_by_role("alert").first).to_contain_text("`pose` must be a pose away from the goal")


def test_the_lecture_view_fills_the_screen_and_the_space_bar_drives(page_of):
    here = page_of(circling())
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    here.page.get_by_role("button", name="Pause").wait_for()
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(circling(episodes=20), width=width, scheme=scheme)
    here.page.get_by_text("Map, discount and start").click()
    here.page.get_by_role("button", name="Let it learn").click()
    expect(here.page.locator(".rl-mixer-learned")).to_contain_text("In the last 50", timeout=20000)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: RewardMixer(replace(TASK, gamma=1.0)), r"`gamma` must be a number in \[0, 0.99\]"),
        (lambda: RewardMixer(rl.Task(WORLD, rl.Robot(slip=0.1))), "`slip` must be 0; got 0.1"),
        (lambda: RewardMixer(TASK, lambda t: 0.0), "`reward` must be made of the designs"),
        (lambda: RewardMixer(TASK, pose=rl.Pose(8, 8, 0)), "`pose` must be a pose away from the goal"),
        (lambda: RewardMixer(TASK, pose=rl.Pose(7, 8, 0)), "`pose` must be on a free cell"),
    ],
)
def test_settings_that_cannot_be_are_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_learner_settings_that_do_not_exist_are_named():
    with pytest.raises(TypeError, match="`learner` must be settings among"):
        RewardMixer(TASK, slip=0)


def test_paper_shows_the_drive_and_says_what_it_is_worth():
    mixer = circling()
    text = repr(mixer)
    assert "blue if the robot arrives from there" in text
    assert "It circles for ever: each round of 4 steps pays +2.00. Worth 13.02 by this reward and -2.00 by" in text
    mixer.state = {**mixer.state, "pose": [8, 7, 90]}
    assert "It arrives after 1 step." in repr(mixer)
