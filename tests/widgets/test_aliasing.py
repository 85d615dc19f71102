"""Aliasing: its forecasts are Python's, its drives are drawn from them, and it is operated by mouse, touch and keys."""

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import Aliasing, _scenario

from .pages import fits_into, in_lecture, kernel_sets
from .pages import state_now as state_of

ROOM = rl.GridWorld.from_ascii(".....\n...G.\n.#...\n.....\nS....")
TASK = rl.Task(ROOM)
ICY = rl.Task(ROOM, rl.Robot(slip=0.2))
HERE = rl.Pose(2, 2, 45)

FORECAST = """async ({scenario, perceive, pose, turn}) => {
  const {History} = await import('/scenario/history.js');
  const {taskOf} = await import('/scenario/model.js');
  const {Pose} = await import('/robot.js');
  const {named} = await import('/explorables/aliasing_words.js');
  const task = taskOf(scenario);
  const look = new History(task, task.mdp(), perceive);
  const a = task.robot.steering.indexOf(turn);
  const {all, rows, most} = look.forecast(task.index(new Pose(...pose)), a);
  const words = o => named(o, perceive, look, {x: pose[0], y: pose[1]}).words;
  const name = o => words(o).replace(/^(a|the) /, '').replace('heading ', '');
  const plain = next => Object.fromEntries([...next].map(([o, p]) => [name(o), p]));
  return { all: plain(all.next), most, count: look.count(),
           rows: Object.fromEntries(rows.map(row => [name(row.h), [row.weight, plain(row.next)]])) };
}"""

DRIVES = """async ({scenario, perceive, pose, turn, n}) => {
  const {History} = await import('/scenario/history.js');
  const {taskOf} = await import('/scenario/model.js');
  const {Pose} = await import('/robot.js');
  const {Generator} = await import('/rng.js');
  const task = taskOf(scenario);
  const look = new History(task, task.mdp(), perceive);
  const [s, a] = [task.index(new Pose(...pose)), task.robot.steering.indexOf(turn)];
  const chance = new Generator(scenario.seed);
  return Array.from({length: n}, () => { const d = look.draw(s, a, chance); return [d.before, d.s, d.next]; });
}"""


def asked(js, widget):
    state = {name: widget.state[name] for name in ("scenario", "perceive", "pose", "turn")}
    return js(FORECAST, state)


def words(here):
    return here.page.locator(".rl-answer")


def shown(here, row):
    """The forecast of a row as it stands behind the bar: the chances by observation."""
    parts = here.page.locator(".rl-forecast tbody tr").nth(row).locator(".rl-part")
    return {part["o"]: float(part["p"]) for part in parts.evaluate_all("all => all.map(one => ({...one.dataset}))")}


def place_of(here, x, y):
    canvas = here.page.get_by_role("application")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    cell = (box["width"] - 22 - 3) / 5
    return box["x"] + 22 + (x + 0.5) * cell, box["y"] + 3 + (4 - y + 0.5) * cell


@pytest.mark.parametrize("task", [TASK, ICY, rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), rl.Robot(slip=0.3))])
@pytest.mark.parametrize("perceive", ["cell", "heading", "pose"])
@pytest.mark.parametrize("turn", [0, -90])
def test_forecasts_are_those_of_python(js, task, perceive, turn):
    widget = Aliasing(task, HERE, turn, perceive=perceive)
    found = asked(js, widget)
    all_, rows = widget.forecasts()
    assert found["all"] == pytest.approx(all_, abs=1e-12)
    assert found["rows"].keys() == rows.keys()
    for name, (weight, next_) in rows.items():
        assert found["rows"][name][0] == pytest.approx(weight, abs=1e-12)
        assert found["rows"][name][1] == pytest.approx(next_, abs=1e-12)
    assert found["most"] == pytest.approx(widget.helps, abs=1e-12)


def test_forecasts_are_what_many_rollouts_show():
    """An oracle that knows nothing of the formula: 200,000 drives of two steps, seed 0; the bound is four sd."""
    mdp, rng = ICY.mdp(), np.random.default_rng(0)
    live = np.flatnonzero(~mdp.terminal)
    states = rng.choice(live, 200_000)
    path = [states]
    actions = [rng.integers(mdp.A, size=states.size), np.full(states.size, 2)]
    for a in actions:
        u = rng.random(states.size)
        k = (u[:, None] >= mdp.prob[path[-1], a].cumsum(axis=1)).sum(axis=1).clip(max=mdp.K - 1)
        path.append(mdp.next_state[path[-1], a, k])
    cells = np.array([p.y * 5 + p.x for p in ICY.poses] + [99])
    now = (cells[path[1]] == 12) & ~mdp.terminal[path[1]]
    from_below = now & (cells[path[0]] == 7)
    share = (cells[path[2]][from_below] == 99).mean()
    exact = Aliasing(ICY, HERE).forecasts()[1]["(2, 1)"][1]["crash"]
    assert abs(share - exact) < 4 * np.sqrt(exact * (1 - exact) / from_below.sum())


def test_the_pose_is_markov_everywhere_and_the_cell_is_not(js):
    assert asked(js, Aliasing(ICY, HERE, perceive="pose"))["count"] == {"helped": 0, "of": 23 * 8 * 5}
    cell = asked(js, Aliasing(ICY, HERE))["count"]
    assert cell["of"] == 23 * 5
    assert cell["helped"] > 100


def test_drives_are_drawn_from_the_seed(js):
    state = Aliasing(ICY, HERE, seed=7).state
    drives = js(DRIVES, {**{k: state[k] for k in ("scenario", "perceive", "pose", "turn")}, "n": 300})
    mdp, rng = ICY.mdp(), np.random.default_rng(7)
    steps = []  # as the program lists them: by first state, and by the order in which successors first appear
    for before in np.flatnonzero(~mdp.terminal):
        weights = {}
        for s, p in zip(mdp.next_state[before].ravel(), mdp.prob[before].ravel(), strict=True):
            if not mdp.terminal[s] and (ICY.pose(int(s)).x, ICY.pose(int(s)).y) == (2, 2):
                weights[int(s)] = weights.get(int(s), 0.0) + p
        steps += [(int(before), s, p) for s, p in weights.items()]
    edges = np.cumsum([p for *_, p in steps])
    for before, s, next_ in drives:
        place, luck = np.searchsorted(edges, rng.random() * edges[-1], side="right"), rng.random()
        assert (before, s) == steps[place][:2]
        k = int((luck >= mdp.prob[s, 2].cumsum()).sum())
        assert next_ == mdp.next_state[s, 2, k]


def test_it_opens_with_one_observation_and_many_futures(page_of):
    here = page_of(Aliasing(TASK, HERE))
    expect(words(here)).to_contain_text("Not Markov. It perceives only the cell (2, 2), which 8 poses share.")
    expect(here.page.locator(".rl-forecast tbody tr")).to_have_count(5)  # not known, and four ways to come here
    all_ = Aliasing(TASK, HERE).forecasts()[0]
    assert sorted(shown(here, 0).values()) == pytest.approx(sorted(all_.values()), abs=1e-12)


def test_showing_the_heading_leaves_one_future(page_of):
    here = page_of(Aliasing(TASK, HERE))
    here.page.get_by_role("radio", name="cell and heading").check()
    expect(words(here)).to_contain_text("Markov. It perceives the pose (2, 2) ↗, which no other pose shares.")
    expect(words(here)).to_contain_text("The past adds nothing in any of the 920 situations")
    assert all(shown(here, row) == shown(here, 0) for row in range(3))
    assert state_of(here.page)["perceive"] == "pose"


def test_chance_is_not_what_makes_it_lose_the_markov_property(page_of):
    here = page_of(Aliasing(TASK, HERE, perceive="pose"))
    slip = here.page.get_by_label("Slip, as a number")
    slip.fill("0.2")
    slip.press("Enter")
    expect(words(here)).to_contain_text("Chance is left, but the past does not help against it.")
    assert sorted(shown(here, 0).values()) == pytest.approx([0.1, 0.1, 0.8])
    assert shown(here, 1) == pytest.approx(shown(here, 0))


def test_a_turn_asks_another_question(page_of):
    here = page_of(Aliasing(TASK, HERE))
    here.page.get_by_role("radio", name="+90°").check()
    all_ = Aliasing(TASK, HERE, 90).forecasts()[0]
    expect(words(here)).to_contain_text("With a turn 90° to the left")
    assert sorted(shown(here, 0).values()) == pytest.approx(sorted(all_.values()), abs=1e-12)


def test_drives_are_counted_and_told(page_of):
    here = page_of(Aliasing(TASK, HERE))
    here.page.get_by_role("button", name="Drive two steps").click()
    expect(here.page.locator(".rl-told")).to_contain_text("Drive 1: it came from")
    here.page.get_by_role("button", name="100 drives").click()
    counts = here.page.locator(".rl-forecast .rl-tried")
    expect(counts.first).to_contain_text("101")
    rows = [int(text) for text in counts.all_inner_texts() if text.strip().isdigit()]
    assert sum(rows[1:]) == rows[0] == 101
    assert state_of(here.page)["drives"] == 101


def test_another_question_forgets_what_was_tried(page_of):
    here = page_of(Aliasing(TASK, HERE, drives=50))
    expect(here.page.locator(".rl-tried").first).to_contain_text("50")
    here.page.get_by_role("radio", name="heading", exact=True).check()
    expect(here.page.locator(".rl-tried").first).to_have_text("–")


@pytest.mark.parametrize("way", ["click", "touch", "keys"])
def test_another_cell_is_picked(page_of, way):
    here = page_of(Aliasing(TASK, HERE), width="telephone" if way == "touch" else "desk")
    if way == "click":
        here.page.mouse.click(*place_of(here, 3, 1))
    elif way == "touch":
        here.page.touchscreen.tap(*place_of(here, 3, 1))
    else:
        here.page.get_by_role("radio", name="0°", exact=True).focus()
        here.page.keyboard.press("Tab")
        for key in ("ArrowRight", "ArrowDown", "Enter"):
            here.page.keyboard.press(key)
    expect(words(here)).to_contain_text("only the cell (3, 1)")
    assert state_of(here.page)["pose"][:2] == [3, 1]


def test_the_robot_is_turned_by_keys(page_of):
    here = page_of(Aliasing(TASK, HERE, perceive="pose"))
    here.page.get_by_role("application").focus()
    here.page.keyboard.press("l")
    expect(words(here)).to_contain_text("the pose (2, 2) ↑")


def test_where_it_cannot_be_is_told_and_changes_nothing(page_of):
    here = page_of(Aliasing(TASK, HERE))
    here.page.mouse.click(*place_of(here, 1, 2))
    here.page.get_by_text("An obstacle stands there.").wait_for()
    here.page.mouse.click(*place_of(here, 3, 3))
    here.page.get_by_text("The goal: the episode is over there.").wait_for()
    assert state_of(here.page)["pose"] == [2, 2, 45]


def test_a_row_shows_which_poses_it_leaves(page_of):
    here = page_of(Aliasing(TASK, HERE))
    row = here.page.get_by_role("button", name="(3, 2)")
    row.click()
    expect(row).to_have_attribute("aria-pressed", "true")
    assert state_of(here.page)["before"] == 13
    row.press("Enter")
    expect(row).to_have_attribute("aria-pressed", "false")
    expect(row).to_be_focused()


def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    widget = Aliasing(TASK, HERE)
    here = page_of(widget)
    first = words(here).inner_text()
    here.page.get_by_role("radio", name="heading", exact=True).check()
    here.page.get_by_role("button", name="100 drives").click()
    here.page.get_by_role("button", name="Start again").click()
    expect(words(here)).to_have_text(first)
    assert state_of(here.page) == widget.state


def test_the_space_bar_drives_in_a_lecture(page_of):
    here = page_of(Aliasing(TASK, HERE))
    with in_lecture(here.page):
        here.page.keyboard.press("Space")
        expect(here.page.locator(".rl-told")).to_contain_text("Drive 1:")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(Aliasing(ICY, HERE, drives=30), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert fits_into(here.page, 360)


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(Aliasing(TASK, HERE))
    kernel_sets(here.page, {"perceive": "heading", "drives": 5})
    expect(words(here)).to_contain_text("only the heading 45° ↗")
    kernel_sets(here.page, {"pose": [1, 2, 0]})
    here.page.get_by_role("alert").first.get_by_text("`pose` must be on a free cell").wait_for()
    expect(words(here)).to_contain_text("only the heading 45° ↗")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"perceive": "smell"}, "`perceive` must be one of 'cell', 'heading', 'pose'"),
        ({"pose": rl.Pose(1, 2, 0)}, "`pose` must be on a free cell"),
        ({"pose": rl.Pose(3, 3, 0)}, "`pose` must be a pose from which the robot can drive"),
        ({"pose": (1, 2)}, r"`pose` must be a pose \[x, y, theta\]; got 2 numbers"),
        ({"turn": 30}, "`turn` must be one of the steerings"),
        ({"drives": -1}, "`drives` must be an integer from 0 to 5000"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        Aliasing(**{"task": TASK, "pose": HERE, **settings})


def test_on_paper_it_is_the_futures_and_their_forecasts():
    widget = Aliasing(TASK, HERE)
    assert "The past moves a chance by up to 51 %." in repr(widget)
    assert widget.alt.startswith("Left, a map with the robot in cell (2, 2)")
    widget.state = {**widget.state, "perceive": "pose"}
    assert "The past adds nothing here." in repr(widget)
    with pytest.raises(ValueError, match="a scenario with the same map"):
        widget.state = {**widget.state, "scenario": _scenario.DEFAULTS}
