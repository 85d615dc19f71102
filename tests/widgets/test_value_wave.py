"""The value wave: its numbers are the library's, its parts do what they say, by mouse, touch and keyboard."""

import base64
import re

import numpy as np
import pytest

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import ValueWave, _scenario

from .pages import kernel_sets
from .pages import state_now as state_of

OBSTACLES = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
SLIPPERY = rl.Task(OBSTACLES, rl.Robot(slip=0.1), gamma=0.95)

SWEEPS = """async ({scenario, tol, k}) => {
  const {Wave} = await import('/scenario/wave.js');
  const {taskOf} = await import('/scenario/model.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  const wave = new Wave(taskOf({...scenario, starts: null}).mdp(), tol);
  while (wave.runFor(5));
  const errors = wave.values.map((_, i) => wave.error(i));
  return { V: bits(wave.values[Math.min(k, wave.length)]), residuals: wave.residuals.slice(1), errors,
           steps: Array.from(wave.steps), heard: wave.heard, length: wave.length };
}"""


def exact(locator):
    """Read the numbers that stand behind what is written."""
    return [float(number) for number in locator.locator("data").evaluate_all("all => all.map(one => one.value)")]


def words(here):
    return here.page.locator(".rl-answer").inner_text()


def numbers_of(text):
    return [float(number.replace("−", "-")) for number in re.findall(r"[−\d.]*\d", text)]


def place_of(here, x, y, theta=None):
    """Where a cell, or the middle of a wedge in it, is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / 10
    dx, dy = (0, 0) if theta is None else (0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta)))
    return box["x"] + 22 + (x + dx + 0.5) * cell, box["y"] + 3 + (9 - y - dy + 0.5) * cell


@pytest.mark.parametrize("drawing", ["OBSTACLES", "MAZE", "CLIFF", "ROOMS"])
@pytest.mark.parametrize(("slip", "gamma"), [(0.0, 0.9), (0.25, 0.95), (0.1, 0.5)])
def test_every_sweep_is_the_sweep_of_python(js, drawing, slip, gamma):
    world = rl.GridWorld.from_ascii(getattr(rl.maps, drawing))
    task = rl.Task(world, rl.Robot(slip=slip), gamma=gamma)
    mdp, scenario = task.mdp(), _scenario.scenario_of(task)
    truth = rl.value_iteration(mdp, tol=1e-4)
    star = rl.value_iteration(mdp, tol=1e-13).V
    for k in (1, 2, 7, truth.residuals.size):
        found = js(SWEEPS, {"scenario": scenario, "tol": 1e-4, "k": k})
        V = np.frombuffer(base64.b64decode(found["V"]), np.float64)
        expected = rl.value_iteration(mdp, tol=1e-4, max_sweeps=k).V
        assert np.abs(V - expected).max() <= 1e-12
        assert found["errors"][min(k, found["length"])] == pytest.approx(np.abs(expected - star).max(), abs=1e-10)
    assert found["length"] == truth.residuals.size
    assert found["residuals"] == pytest.approx(truth.residuals, abs=1e-12)


def test_a_pose_hears_of_the_goal_after_as_many_sweeps_as_it_needs_steps(js):
    world = rl.GridWorld.from_ascii(rl.maps.MAZE)
    task = rl.Task(world)
    found = js(SWEEPS, {"scenario": _scenario.scenario_of(task), "tol": 1e-9, "k": 0})
    paid = rl.Task(world, reward=rl.designs.Payment(goal=1, crash=0, step=0), gamma=0.5).mdp()
    V = rl.solve(paid, tol=1e-13).V  # 0.5 ** (steps - 1) where the goal can be reached, and 0 elsewhere
    steps = np.where(V > 0, np.round(1 - np.log2(np.where(V > 0, V, 1))), -1)
    steps[paid.goal] = 0
    assert found["steps"] == steps.tolist()
    assert found["heard"] == [int(((steps > 0) & (steps <= k)).sum()) for k in range(len(found["heard"]))]


def test_the_backup_of_a_pose_is_shown_with_the_numbers_of_python(page_of):
    pose = rl.Pose(8, 6, 90)
    here = page_of(ValueWave(SLIPPERY, sweep=6, pose=pose))
    mdp, s = SLIPPERY.mdp(), SLIPPERY.index(pose)
    before = rl.value_iteration(mdp, max_sweeps=5).V
    Q = rl.action_values(mdp, before)[s]
    rewards = (mdp.prob[s] * mdp.reward[s]).sum(axis=1)
    following = (mdp.prob[s] * before[mdp.next_state[s]]).sum(axis=1)
    rows = here.page.locator(".rl-look-ahead tbody tr")
    assert rows.count() == mdp.A
    for a in range(mdp.A):
        assert exact(rows.nth(a)) == pytest.approx([rewards[a], following[a], Q[a]], abs=1e-12)
        assert ("max" in rows.nth(a).inner_text()) == (Q.max() - Q[a] <= 1e-9)
    assert exact(here.page.locator(".rl-look-ahead caption")) == pytest.approx([Q.max()], abs=1e-12)


def test_sweeps_go_forward_and_back(page_of):
    here = page_of(ValueWave(SLIPPERY))
    truth = rl.value_iteration(SLIPPERY.mdp(), tol=0.001)
    back, step = (here.page.get_by_role("button", name=name, exact=True) for name in ("Back", "One sweep"))
    assert "Sweep 0: every value is 0" in words(here)
    assert back.get_attribute("aria-disabled") == "true"
    step.click()
    step.click()
    assert words(here).startswith("Sweep 2: ")
    assert numbers_of(words(here))[-2] == pytest.approx(truth.residuals[1], abs=0.06)
    back.click()
    assert words(here).startswith("Sweep 1: ")
    assert state_of(here.page)["sweep"] == 1
    typed = here.page.get_by_label("Sweep, as a number")
    typed.fill("12")
    typed.press("Enter")
    assert words(here).startswith("Sweep 12: ")
    slider = here.page.get_by_role("slider", name="Sweep")
    slider.focus()
    slider.press("End")
    last = truth.residuals.size
    assert words(here).startswith(f"Sweep {last}: all ")
    assert "so the sweeps stop" in words(here)
    assert step.get_attribute("aria-disabled") == "true"
    promise, error = numbers_of(words(here))[-2:]
    best = rl.solve(SLIPPERY.mdp(), tol=1e-12).V
    assert promise == pytest.approx(19 * truth.residuals[-1], rel=0.05)
    assert error == pytest.approx(np.abs(truth.V - best).max(), rel=0.05)
    assert state_of(here.page)["sweep"] == last


def test_it_plays_to_the_end_and_stops_there(page_of):
    task = rl.Task(rl.GridWorld.from_ascii("....\n....\n...G"))
    here = page_of(ValueWave(task))
    last = rl.value_iteration(task.mdp(), tol=0.001).residuals.size
    here.page.get_by_role("button", name="Play").click()
    here.page.get_by_role("button", name="Pause").wait_for()
    here.page.wait_for_function(f"document.querySelector('.rl-answer').textContent.startsWith('Sweep {last}:')")
    here.page.get_by_role("button", name="Play").wait_for()  # it has paused itself
    assert "so the sweeps stop" in words(here)


def test_the_planner_is_told_of_other_settings_and_keeps_its_sweep(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=9, pose=rl.Pose(1, 1, 45)))
    number = here.page.get_by_label("Slip, as a number")
    number.fill("0.4")
    number.press("Enter")
    field = here.page.get_by_label("Discount γ, as a number")
    field.fill("0.8")
    field.press("Enter")
    mdp = rl.Task(OBSTACLES, rl.Robot(slip=0.4), gamma=0.8).mdp()
    V = rl.value_iteration(mdp, max_sweeps=9).V
    shown = exact(here.page.locator(".rl-look-ahead caption"))
    assert shown == pytest.approx([V[SLIPPERY.index(rl.Pose(1, 1, 45))]], abs=1e-12)
    assert state_of(here.page)["scenario"]["slip"] == 0.4
    here.page.get_by_role("button", name="Start again").click()
    assert number.input_value() == "0.1"
    assert state_of(here.page)["scenario"] == _scenario.scenario_of(SLIPPERY)


def test_a_pointer_shows_the_numbers_of_a_wedge_and_a_press_keeps_them(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=6))
    caption = here.page.locator(".rl-look-ahead caption")
    assert not caption.is_visible()
    here.page.mouse.move(*place_of(here, 9, 7, 135))
    assert caption.inner_text().startswith("Sweep 6 at (9, 7) ↖: V₆ = ")
    here.page.mouse.move(5, 5)
    assert not caption.is_visible()
    here.page.mouse.click(*place_of(here, 9, 7, 135))
    here.page.mouse.move(5, 5)
    assert caption.inner_text().startswith("Sweep 6 at (9, 7) ↖")
    assert state_of(here.page)["pose"] == [9, 7, 135]


def test_a_finger_picks_a_pose(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=6), width="telephone")
    here.page.touchscreen.tap(*place_of(here, 4, 4, 180))
    assert here.page.locator(".rl-look-ahead caption").inner_text().startswith("Sweep 6 at (4, 4) ←")
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_keyboard_picks_a_pose_and_builds_a_wall(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=6))
    page = here.page
    page.get_by_label("Draw walls").focus()
    page.keyboard.press("Tab")
    for key in ("ArrowUp", "ArrowRight", "ArrowRight", "r", "Enter"):
        page.keyboard.press(key)
    assert state_of(page)["pose"] == [2, 1, 135]
    page.keyboard.press("ArrowUp")
    page.keyboard.press("w")
    assert state_of(page)["scenario"]["map"][7] == "..#......."
    page.keyboard.press("w")
    assert state_of(page)["scenario"]["map"][7] == ".........."


def test_walls_are_drawn_with_one_stroke_and_change_the_plan(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=20, pose=rl.Pose(1, 1, 90)))
    here.page.get_by_label("Draw walls").check()
    here.page.mouse.move(*place_of(here, 0, 7))
    here.page.mouse.down()
    here.page.mouse.move(*place_of(here, 1, 7), steps=3)
    here.page.mouse.up()
    rows = state_of(here.page)["scenario"]["map"]
    assert rows[2] == "####...#.."
    drawn = "\n".join(rows)
    mdp = rl.Task(rl.GridWorld.from_ascii(drawn), rl.Robot(slip=0.1)).mdp()
    task = rl.Task(rl.GridWorld.from_ascii(drawn), rl.Robot(slip=0.1))
    V = rl.value_iteration(mdp, max_sweeps=20).V[task.index(rl.Pose(1, 1, 90))]
    assert exact(here.page.locator(".rl-look-ahead caption")) == pytest.approx([V], abs=1e-12)


def test_what_cannot_be_built_is_refused_in_words_and_nothing_is_lost(page_of):
    task = rl.Task(rl.GridWorld.from_ascii("....\n....\n.#..\nG#.."), rl.Robot())
    here = page_of(ValueWave(task, sweep=3))
    before, told = state_of(here.page)["scenario"], words(here)
    here.page.get_by_role("application").focus()
    here.page.keyboard.press("w")  # on the goal itself
    assert "neither on the goal nor on the start" in here.page.get_by_role("alert").first.inner_text()
    here.page.keyboard.press("ArrowUp")
    here.page.keyboard.press("w")  # the only way to the goal
    assert "walled in" in here.page.get_by_role("alert").first.inner_text()
    assert state_of(here.page)["scenario"] == before
    assert words(here) == told


def test_one_heading_has_its_numbers_on_the_map(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=6))
    here.page.get_by_label("Headings").select_option("heading 45° ↗")
    assert state_of(here.page)["heading"] == 45
    here.page.mouse.move(*place_of(here, 7, 5, 270))  # a cell has one value now, whatever the sector
    assert here.page.locator(".rl-look-ahead caption").inner_text().startswith("Sweep 6 at (7, 5) ↗")
    here.page.get_by_role("radio", name="Changes").check()
    assert state_of(here.page)["show"] == "changes"
    assert "change in this sweep" in here.page.locator(".rl-legend").inner_text()


def test_the_lecture_view_fills_the_screen_and_the_space_bar_sweeps(page_of):
    here = page_of(ValueWave(SLIPPERY))
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    here.page.keyboard.press("Space")
    assert words(here).startswith("Sweep 2")
    assert here.page.get_by_role("button", name="One sweep").is_visible()
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


def test_a_reward_of_the_readers_own_is_planned_with_too(page_of):
    def reward(t):
        return 3.0 if t.goal else -7.0 if t.crash else -0.2 - 0.1 * (t.a != 0)

    task = rl.Task(OBSTACLES, rl.Robot(slip=0.1), reward=reward, gamma=0.9)
    here = page_of(ValueWave(task, sweep=8, pose=rl.Pose(8, 6, 90)))
    V = rl.value_iteration(task.mdp(), max_sweeps=8).V[task.index(rl.Pose(8, 6, 90))]
    assert exact(here.page.locator(".rl-look-ahead caption")) == pytest.approx([V], abs=1e-12)
    assert here.page.get_by_label("Draw walls").is_disabled()
    number = here.page.get_by_label("Slip, as a number")
    number.fill("0.3")
    number.press("Enter")
    other = rl.Task(OBSTACLES, rl.Robot(slip=0.3), reward=reward, gamma=0.9).mdp()
    V = rl.value_iteration(other, max_sweeps=8).V[task.index(rl.Pose(8, 6, 90))]
    assert exact(here.page.locator(".rl-look-ahead caption")) == pytest.approx([V], abs=1e-12)


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(ValueWave(SLIPPERY, sweep=6, pose=rl.Pose(8, 6, 90)), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_largest_map_is_planned_in_slices(page_of):
    world = rl.maps.random(30, density=0.2, rng=1)
    here = page_of(ValueWave(rl.Task(world, rl.Robot(slip=0.3), gamma=0.99), tol=1e-6, sweep=5))
    slider = here.page.get_by_role("slider", name="Sweep")
    here.page.wait_for_function("n => Number(document.querySelector('.rl-run input').max) === n", arg=sweeps(world))
    slider.focus()
    slider.press("End")
    assert "so the sweeps stop" in words(here)


def sweeps(world):
    return rl.value_iteration(rl.Task(world, rl.Robot(slip=0.3), gamma=0.99).mdp(), tol=1e-6).residuals.size


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"gamma": 1.0}, r"`gamma` must be a number in \[0, 0.99\]"),
        ({"tol": 0}, "`tol` must be a finite number above 0"),
        ({"sweep": -1}, "`sweep` must be an integer of at least 0"),
        ({"heading": 30}, "`heading` must be one of"),
        ({"show": "errors"}, "`show` must be one of 'values', 'changes'"),
        ({"pose": rl.Pose(7, 8, 0)}, "`pose` must be on a free cell"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        ValueWave(SLIPPERY, **settings)


def test_python_knows_the_values_that_are_shown_and_draws_them_for_paper():
    wave = ValueWave(SLIPPERY, sweep=6)
    assert np.array_equal(wave.V, rl.value_iteration(SLIPPERY.mdp(), max_sweeps=6).V)
    assert "Sweep 6: the largest change was 7.7." in repr(wave)
    wave.state = wave.state | {"sweep": 0, "show": "changes"}
    assert not wave.V.any()
    assert "Sweep 0: every value is 0." in repr(wave)


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=6))
    kernel_sets(here.page, {"sweep": 3, "heading": 90, "pose": [8, 6, 90]})
    assert words(here).startswith("Sweep 3: ")
    V = rl.value_iteration(SLIPPERY.mdp(), max_sweeps=3).V[SLIPPERY.index(rl.Pose(8, 6, 90))]
    assert exact(here.page.locator(".rl-look-ahead caption")) == pytest.approx([V], abs=1e-12)
    kernel_sets(here.page, {"scenario": {"map": ["#G#", "###"], "slip": 2}})
    here.page.get_by_role("alert").first.get_by_text("`slip` must be").wait_for()
    assert words(here).startswith("Sweep 3: ")
    here.page.get_by_role("button", name="One sweep").click()
    assert words(here).startswith("Sweep 4: ")


def test_two_of_them_on_one_page_do_not_disturb_each_other(page_of):
    here = page_of(ValueWave(SLIPPERY, sweep=2), ValueWave(SLIPPERY, sweep=9))
    here.page.get_by_role("button", name="One sweep").nth(1).click()
    first, second = here.page.locator(".rl-answer").all_inner_texts()
    assert first.startswith("Sweep 2: ")
    assert second.startswith("Sweep 10: ")
