"""The steering fan: its moves are those of the library, its parts do what they say by mouse, touch and keyboard."""

import math

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import SteeringFan, _scenario

from .pages import kernel_sets, settled
from .pages import state_now as state_of

OBSTACLES = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
TASK = rl.Task(OBSTACLES)
POSE = rl.Pose(4, 2, 90)
SETS = [(-90, -45, 0, 45, 90), (-45, 0, 45), (-90, 0, 90), (0,), (-180, -135, -90, -45, 0, 45, 90, 135, 180)]

REACH = """async ({scenario, pose, k}) => {
  const {Reach} = await import('/scenario/reach.js');
  const {taskOf} = await import('/scenario/model.js');
  const {Pose} = await import('/robot.js');
  const reach = new Reach(taskOf(scenario), new Pose(...pose));
  const steps = Array.from(reach.steps, step => step > k ? -1 : step);
  return {steps, ends: reach.ends(k), within: reach.within(k), toGoal: reach.toGoal,
          way: reach.wayTo(reach.arrival)?.map(({x, y, theta}) => [x, y, theta]) ?? null};
}"""
FAN = """async ({scenario, pose, parts}) => {
  const {arcAt, chancesOf, fanOf} = await import('/scenario/reach.js');
  const {taskOf} = await import('/scenario/model.js');
  const {Pose} = await import('/robot.js');
  const [task, from] = [taskOf(scenario), new Pose(...pose)];
  return {
    moves: fanOf(task, from).map(({a, point, to, crash, goal}) => ({a, point, to: {...to}, crash, goal})),
    chances: task.robot.steering.map((_, a) => chancesOf(task.robot, a)),
    arcs: task.robot.steering.map(a => parts.map(part => arcAt(from, a, part))),
  };
}"""


def words(here):
    return here.page.locator(".rl-answer")


def place_of(here, x, y, theta=None):
    """Where a cell, or the middle of a wedge in it, is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / 10
    dx, dy = (0, 0) if theta is None else (0.3 * np.cos(np.radians(theta)), 0.3 * np.sin(np.radians(theta)))
    return box["x"] + 22 + (x + dx + 0.5) * cell, box["y"] + 3 + (9 - y - dy + 0.5) * cell


def turn(here, name):
    return here.page.get_by_role("group", name="Turns to choose from").get_by_role("button", name=name, exact=True)


@pytest.mark.parametrize("steering", SETS)
@pytest.mark.parametrize("drawing", ["OBSTACLES", "ROOMS"])
def test_the_poses_that_can_be_reached_are_those_of_python(js, drawing, steering):
    world = rl.GridWorld.from_ascii(getattr(rl.maps, drawing))
    task = rl.Task(world, rl.Robot(steering, slip=0.1))
    for pose, k in ((world.starts[0], 1), (world.starts[3], 4), (rl.Pose(4, 2, 90), 9)):
        fan = SteeringFan(task, pose, steps=k)
        found = js(REACH, {"scenario": fan.state["scenario"], "pose": fan.state["pose"], "k": k})
        assert found["steps"] == fan.reach.tolist()
        cells = {(task.poses[s].x, task.poses[s].y) for s in np.flatnonzero(fan.reach >= 0)}
        assert found["within"] == {"poses": int((fan.reach >= 0).sum()), "cells": len(cells)}


@pytest.mark.parametrize("steering", SETS)
def test_all_ways_to_steer_end_as_those_of_a_robot_that_steers_at_random(js, steering):
    world = rl.GridWorld(10, 10, OBSTACLES.goal, OBSTACLES.obstacles, starts=(POSE,))
    mdp = rl.Task(world, rl.Robot(steering)).mdp()
    scenario = _scenario.scenario_of(rl.Task(world, rl.Robot(steering)))
    found = js(REACH, {"scenario": {**scenario, "starts": None}, "pose": [4, 2, 90], "k": 5})
    at_random = rl.evaluate(mdp, np.full((mdp.S, mdp.A), 1 / mdp.A), max_steps=5)
    assert found["ends"]["crash"] == pytest.approx(at_random.crash, abs=1e-12)
    assert found["ends"]["success"] == pytest.approx(at_random.success, abs=1e-12)


def test_the_shortest_way_to_the_goal_is_as_long_as_the_optimal_drive(js):
    fan = SteeringFan(TASK, POSE)
    found = js(REACH, {"scenario": fan.state["scenario"], "pose": fan.state["pose"], "k": 3})
    mdp = TASK.mdp()
    drive = rl.rollout(mdp, rl.solve(mdp).pi, start=TASK.index(POSE), rng=0)
    assert found["toGoal"] == drive.actions.size == len(found["way"]) - 1
    for before, after in zip(found["way"], found["way"][1:], strict=False):
        assert rl.Pose(*after) in [TASK.robot.move(rl.Pose(*before), a) for a in TASK.robot.steering]


@pytest.mark.parametrize("pose", [rl.Pose(4, 2, 90), rl.Pose(8, 6, 180), rl.Pose(0, 0, 225), rl.Pose(2, 4, 315)])
def test_moves_crashes_and_chances_are_those_of_the_library(js, pose):
    task = rl.Task(OBSTACLES, rl.Robot(SETS[-1], slip=0.3))
    scenario = SteeringFan(task, pose).state["scenario"]
    found = js(FAN, {"scenario": scenario, "pose": [pose.x, pose.y, pose.theta], "parts": [0, 0.5, 1]})
    for i, move in enumerate(found["moves"]):
        t = task.transition(pose, move["a"])
        assert move["to"] == {"x": t.s_next.x, "y": t.s_next.y, "theta": t.s_next.theta}
        assert (bool(move["crash"]), move["goal"]) == (t.crash, t.goal)
        assert [math.floor(c + 0.5) for c in move["point"]] == [t.s_next.x, t.s_next.y]
        chances = np.zeros(9)
        for a, p in task.robot.outcomes(i):
            chances[task.robot.steering.index(a)] += p
        assert found["chances"][i] == pytest.approx(chances.tolist(), abs=1e-15)


def test_an_arc_is_the_integral_of_its_directions(js):
    scenario = SteeringFan(rl.Task(OBSTACLES, rl.Robot(SETS[-1])), POSE).state["scenario"]
    found = js(FAN, {"scenario": scenario, "pose": [4, 2, 90], "parts": [1]})
    part = (np.arange(20_000) + 0.5) / 20_000
    for a, [[x, y]] in zip(SETS[-1], found["arcs"], strict=True):
        direction = np.radians(90 + a * part)
        assert (x, y) == pytest.approx((4 + np.cos(direction).mean(), 2 + np.sin(direction).mean()), abs=1e-8)


def test_one_step_more_and_less_is_told_and_kept(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    more, less = (here.page.get_by_role("button", name=f"One step {which}") for which in ("more", "less"))
    expect(words(here)).to_contain_text("Within 1 step: ")
    more.click()
    reach = SteeringFan(TASK, POSE, steps=2).reach
    expect(words(here)).to_contain_text(f"Within 2 steps: {(reach >= 0).sum()} poses on")
    expect(words(here)).to_contain_text("the 25 ways to steer")
    assert state_of(here.page)["steps"] == 2
    less.click()
    less.click()
    expect(words(here)).to_contain_text("Before the first step there is one pose.")
    expect(less).to_have_attribute("aria-disabled", "true")


def test_the_steering_set_is_the_readers_and_changes_how_far_the_goal_is(page_of):
    here = page_of(SteeringFan(TASK, rl.Pose(1, 1, 180)))
    far = rl.Task(OBSTACLES, rl.Robot((-45, 0, 45))).mdp()
    steps = rl.rollout(far, rl.solve(far).pi, start=TASK.index(rl.Pose(1, 1, 180)), rng=0)
    for name in ("−90°", "+90°"):
        turn(here, name).click()
    assert state_of(here.page)["scenario"]["steering"] == [-45, 0, 45]
    if steps.terminated and far.goal[steps.states[-1]]:
        expect(words(here)).to_contain_text(f"The goal is {steps.actions.size} steps away.")
    else:
        expect(words(here)).to_contain_text("From here the goal cannot be reached.")
    for name in ("−45°", "+45°"):
        turn(here, name).click()
    expect(turn(here, "0°")).to_have_attribute("aria-disabled", "true")
    turn(here, "0°").click(force=True)  # the last turn stays
    assert state_of(here.page)["scenario"]["steering"] == [0]
    here.page.get_by_role("button", name="Start again").click()
    assert state_of(here.page)["scenario"]["steering"] == [-90, -45, 0, 45, 90]


def test_a_slip_shows_what_comes_of_a_turn_that_is_told(page_of):
    here = page_of(SteeringFan(rl.Task(OBSTACLES, rl.Robot(slip=0.2)), POSE, told=90))
    moves = here.page.locator(".rl-moves")
    expect(moves).to_contain_text("Told “turn 90° to the left”, it does: 90 % +90°")
    here.page.get_by_label("The robot is told").select_option("0°")
    expect(moves).to_contain_text("80 % 0°")
    expect(moves).to_contain_text("10 % −45°")
    number = here.page.get_by_label("Slip, as a number")
    number.fill("0.5")
    number.press("Enter")
    expect(moves).to_contain_text("50 % 0°")
    here.page.get_by_label("The robot is told").select_option("any turn")
    assert state_of(here.page)["told"] is None
    number.fill("0.1")
    number.press("Enter")
    assert state_of(here.page)["told"] == 0  # a slip is one of a turn that is told


def test_a_click_puts_the_robot_on_a_pose_and_a_wall_is_no_place_for_it(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    here.page.mouse.click(*place_of(here, 2, 4, 45))
    assert state_of(here.page)["pose"] == [2, 4, 45]
    here.page.mouse.click(*place_of(here, 7, 8))
    expect(here.page.get_by_role("alert").first).to_contain_text("a free cell that is not the goal")
    assert state_of(here.page)["pose"] == [2, 4, 45]


def test_a_finger_puts_the_robot_on_a_pose(page_of):
    here = page_of(SteeringFan(TASK, POSE), width="telephone")
    here.page.touchscreen.tap(*place_of(here, 2, 4, 45))
    assert state_of(here.page)["pose"] == [2, 4, 45]
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_keyboard_moves_the_robot_builds_walls_and_chooses_turns(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    page = here.page
    turn(here, "+90°").focus()
    page.keyboard.press("Space")
    assert state_of(page)["scenario"]["steering"] == [-90, -45, 0, 45]
    page.get_by_role("application").focus()
    for key in ("ArrowUp", "ArrowRight", "r", "Enter"):
        page.keyboard.press(key)
    assert state_of(page)["pose"] == [1, 1, 135]
    page.keyboard.press("ArrowUp")
    page.keyboard.press("w")
    assert state_of(page)["scenario"]["map"][7] == ".#........"
    page.keyboard.press("w")
    assert state_of(page)["scenario"]["map"][7] == ".........."
    page.get_by_role("button", name="One step more").focus()
    page.keyboard.press("Enter")
    assert state_of(page)["steps"] == 2


def test_walls_are_drawn_with_one_stroke_and_stop_the_robot(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    here.page.get_by_label("Draw walls").check()
    here.page.mouse.move(*place_of(here, 3, 3))
    here.page.mouse.down()
    here.page.mouse.move(*place_of(here, 5, 3), steps=4)
    here.page.mouse.up()
    assert state_of(here.page)["scenario"]["map"][6] == ".######..."
    expect(words(here)).to_contain_text("Every way to steer ends in a crash")
    expect(words(here)).to_contain_text("From here the goal cannot be reached.")


def test_a_goal_that_is_walled_in_is_refused_and_nothing_is_lost(page_of):
    task = rl.Task(rl.GridWorld.from_ascii("....\n....\n.#..\nG#.."))
    here = page_of(SteeringFan(task, rl.Pose(3, 0, 90)))
    before = state_of(here.page)["scenario"]
    page = here.page
    page.get_by_role("application").focus()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("w")
    expect(page.get_by_role("alert").first).to_contain_text("No free cell leads to the goal")
    assert state_of(page)["scenario"] == before


def test_the_lecture_view_fills_the_screen_and_the_space_bar_goes_on(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    here.page.keyboard.press("Space")
    expect(words(here)).to_contain_text("Within 3 steps")
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    slippery = rl.Task(OBSTACLES, rl.Robot(slip=0.2))
    here = page_of(SteeringFan(slippery, rl.Pose(8, 6, 135), steps=4, told=45), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(SteeringFan(TASK, POSE))
    kernel_sets(here.page, {"steps": 3, "pose": [1, 1, 0]})
    expect(words(here)).to_contain_text("Within 3 steps")
    kernel_sets(here.page, {"pose": [7, 8, 0]})
    expect(here.page.get_by_role("alert").first).to_contain_text("`pose` must be on a free cell")
    settled(here.page)
    expect(words(here)).to_contain_text("Within 3 steps")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"pose": rl.Pose(7, 8, 0)}, "`pose` must be on a free cell"),
        ({"pose": rl.Pose(8, 8, 0)}, "`pose` must be away from the goal"),
        ({"pose": POSE, "steps": 13}, "`steps` must be an integer from 0 to 12|`steps` must be an integer in"),
        ({"pose": POSE, "told": 135}, "`told` must be one of the steerings"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        SteeringFan(TASK, **settings)


def test_python_draws_it_for_paper():
    fan = SteeringFan(TASK, POSE, steps=2)
    assert f"Within 2 steps: {(fan.reach >= 0).sum()} poses" in repr(fan)
    assert "from cell (4, 2), heading 90 degrees" in fan.html()
    assert fan.task == rl.Task(rl.GridWorld(10, 10, OBSTACLES.goal, OBSTACLES.obstacles))
