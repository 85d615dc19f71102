"""The tour of the controls: every kind works, by every hand, and is ticked off once it was tried."""

import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import ControlTour
from rlnav.widgets._control_tour import KINDS, MOST_STEPS, round_task

from .pages import kernel_sets, settled, state_of

DRIVES = """async turns => {
  const {drive, roundTask} = await import('/scenario/round.js');
  const task = roundTask();
  const poses = task.poses.filter(({x, y}) => !task.world.isGoal(x, y));
  return {map: String(task.world), all: turns.map(turn => poses.map(({x, y, theta}) =>
    drive(task, [x, y, theta], turn).map(one => [one.x, one.y, one.theta, Boolean(one.crashed)])))};
}"""


def told(here, text):
    expect(here.page.locator(".rl-explorable .rl-answer")).to_contain_text(text)


def ticked(here):
    settled(here.page)
    done = here.page.locator(".rl-tour-list li").evaluate_all("all => all.map(one => one.matches('.rl-done'))")
    return {kind for kind, one in zip(KINDS, done, strict=True) if one}


def click(here, name):
    here.page.get_by_role("button", name=name, exact=True).click()


def cell(here, x, y):
    """Where a cell is on the page."""
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    size = (box["width"] - 22 - 3) / 7
    return box["x"] + 22 + (x + 0.5) * size, box["y"] + 3 + (6 - y + 0.5) * size


def test_both_sides_drive_the_same(js):
    task = round_task()
    poses = [pose for pose in task.poses if (pose.x, pose.y) != task.world.goal]
    found = js(DRIVES, list(task.robot.steering))
    assert found["map"] == str(task.world)
    for turn, drives in zip(task.robot.steering, found["all"], strict=True):
        for pose, drive in zip(poses, drives, strict=True):
            assert [tuple(one[:3]) for one in drive if not one[3]] == driven(task, pose, turn)


def driven(task, pose, turn):
    """The poses of a drive, without the one at which it crashes."""
    poses = [pose]
    while len(poses) <= MOST_STEPS:
        t = task.transition(poses[-1], turn)
        if t.crash:
            break
        poses.append(t.s_next)
        if t.goal:
            break
    return [(one.x, one.y, one.theta) for one in poses]


def test_python_drives_as_its_transitions_say():
    task = round_task()
    for pose in (rl.Pose(1, 1, 90), rl.Pose(1, 1, 45), rl.Pose(0, 0, 180)):
        for turn in task.robot.steering:
            tour = ControlTour(pose, turn, steps=MOST_STEPS)
            assert [(one.x, one.y, one.theta) for one in tour.poses] == driven(task, pose, turn)


def test_each_control_is_ticked_off_when_it_was_used_and_not_before(page_of):
    here = page_of(ControlTour())
    page = here.page
    assert ticked(here) == set()
    expect(page.get_by_text("You have tried 0 of 10 controls.")).to_be_visible()
    tried = set()

    def now(kind):
        tried.add(kind)
        assert ticked(here) == tried

    click(here, "One step")
    told(here, "After 3 steps the robot is in cell (3, 2), heading 315°.")
    now("step")
    click(here, "Back")
    told(here, "After 2 steps the robot is in cell (2, 2), heading 0°.")
    now("back")
    click(here, "Play")
    now("play")
    page.wait_for_function("document.querySelector('.rl-answer').textContent.startsWith('After 5 steps')")
    click(here, "Pause")
    page.get_by_role("slider", name="Steps").press("Home")
    told(here, "After 0 steps the robot is in cell (1, 1), heading 90°.")
    now("slider")
    number = page.get_by_label("Steps, as a number")
    number.fill("99")
    number.press("Enter")
    expect(page.get_by_text("Type a whole number from 0 to 16. 0 is kept.")).to_be_visible()
    assert ticked(here) == tried
    number.fill("4")
    number.press("Enter")
    told(here, "After 4 steps the robot is in cell (3, 1), heading 270°.")
    now("number")
    page.get_by_label("In every step").select_option("straight on")
    told(here, "After 3 steps the robot has crashed.")
    now("menu")
    page.get_by_label("Leave a trail").uncheck()
    now("box")
    page.mouse.click(*cell(here, 3, 3))
    told(here, "After 0 steps the robot is in cell (3, 3), heading 90°.")
    now("map")
    click(here, "Start again")
    told(here, "After 2 steps the robot is in cell (2, 2), heading 0°.")
    now("again")
    click(here, "Lecture view")
    now("lecture")
    page.keyboard.press("Escape")
    told(here, "You have tried everything: you can work every figure of this book.")
    click(here, "Clear the ticks")
    assert ticked(here) == set()


def test_one_and_the_same_turn_can_lead_to_the_star(page_of):
    here = page_of(ControlTour(rl.Pose(5, 3, 45), 45, steps=2))
    told(here, "The star, after 2 steps: turn 45° to the left in every step, from cell (5, 3).")


def test_the_keyboard_alone_does_everything(page_of):
    here = page_of(ControlTour())
    page = here.page
    page.get_by_label("Leave a trail").focus()
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    for key in ("ArrowRight", "ArrowUp", "Enter"):
        page.keyboard.press(key)
    told(here, "After 0 steps the robot is in cell (2, 2), heading 90°.")
    page.keyboard.press("Enter")
    page.keyboard.press("r")
    told(here, "After 0 steps the robot is in cell (2, 2), heading 180°.")
    for name in ("Play", "Pause", "One step", "Back"):
        page.get_by_role("button", name=name, exact=True).focus()
        page.keyboard.press("Enter")
    page.get_by_label("Steps, as a number").focus()
    page.keyboard.press("ArrowUp")
    assert ticked(here) == {"box", "map", "play", "step", "back", "number"}


def test_a_finger_puts_the_robot_on_a_cell_and_turns_it(page_of):
    here = page_of(ControlTour(), width="telephone")
    here.page.touchscreen.tap(*cell(here, 4, 4))
    here.page.touchscreen.tap(*cell(here, 4, 4))
    told(here, "After 0 steps the robot is in cell (4, 4), heading 135°.")
    here.page.touchscreen.tap(*cell(here, 1, 4))
    expect(here.page.get_by_text("The robot can stand on a free cell only")).to_be_visible()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_stands_in_anyones_way(page_of, width, scheme):
    here = page_of(ControlTour(), width=width, scheme=scheme)
    click(here, "One step")
    assert findings(here.page) == []
    if width == "telephone":
        here.page.set_viewport_size({"width": 360, "height": 740})
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(ControlTour())
    kernel_sets(here.page, {"turn": 0, "steps": 1, "tried": ["menu"]})
    told(here, "After 1 step the robot is in cell (1, 2), heading 90°.")
    assert ticked(here) == {"menu"}
    kernel_sets(here.page, {"turn": 30})
    expect(here.page.get_by_role("alert").first).to_contain_text("`turn` must be one of")
    told(here, "After 1 step the robot is in cell (1, 2), heading 90°.")
    click(here, "One step")
    here.page.wait_for_timeout(200)
    assert state_of(here.page)["steps"] == 2


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pose": [1, 4, 0]}, "`pose` must be on a free cell"),
        ({"pose": [5, 5, 0]}, "`pose` must be on a free cell away from the star"),
        ({"turn": 30}, "`turn` must be one of -90, -45, 0, 45, 90; got 30"),
        ({"steps": 17}, "`steps` must be an integer"),
        ({"trail": 1}, "`trail` must be"),
        ({"tried": ["dial"]}, "`tried` must be one of"),
        ({"color": 1}, "the key 'color'"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    tour = ControlTour()
    before = tour.state
    with pytest.raises((TypeError, ValueError)) as refused:
        tour.state = {**before, **change}
    assert message in str(refused.value)
    assert tour.state == before


def test_on_paper_it_is_the_drive_so_far():
    assert "2 steps, turning by −45° in each." in repr(ControlTour())
    assert ControlTour().alt == "A small map with a star and a robot that turns by -45 degrees in every step."
