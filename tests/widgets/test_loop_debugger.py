"""The step debugger: its episodes are the library's, and every moment of a step is told, drawn and logged as it is."""

import base64
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import LoopDebugger, _scenario

from .pages import state_of as state_told

MODULES = Path(rl.__file__).parent / "js"

WORLD = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
TASK = rl.Task(WORLD, rl.Robot(slip=0.2))
LANE = rl.Task(rl.GridWorld.from_ascii(">...G"))
STRAIGHT = np.full(LANE.mdp().S, 2)

EPISODES = """async runs => {
  const {Loop} = await import('/scenario/loop.js');
  const {taskOf} = await import('/scenario/model.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  return runs.map(({scenario, pi, mixed}) => {
    const loop = new Loop(taskOf(scenario).mdp(), {seed: scenario.seed, maxSteps: scenario.max_steps});
    const policy = mixed ? Float64Array.from(pi) : Int32Array.from(pi);
    while (loop.forward(loop.waits ? loop.choice(policy) : null));
    return {states: [loop.first, ...loop.steps.map(({sNext}) => sNext)], actions: loop.actions,
            rewards: bits(Float64Array.from(loop.steps, ({r}) => r)), end: loop.moment};
  });
}"""
THERE_AND_BACK = """async ({scenario, moments}) => {
  const {Loop} = await import('/scenario/loop.js');
  const {taskOf} = await import('/scenario/model.js');
  const mdp = taskOf(scenario).mdp();
  const pi = new Float64Array(mdp.S * mdp.A).fill(1 / mdp.A);
  const loop = new Loop(mdp, {seed: scenario.seed, maxSteps: scenario.max_steps});
  const all = loop => JSON.stringify([loop.position, loop.t, loop.s, loop.moment, loop.rows, loop.actions]);
  const seen = [all(loop)];
  const reloaded = [];
  for (let i = 0; i < moments && loop.forward(loop.waits ? loop.choice(pi) : null); i++) {
    seen.push(all(loop));
    const {actions, position} = loop;
    const same = new Loop(mdp, {seed: scenario.seed, maxSteps: scenario.max_steps, actions, position});
    reloaded.push(all(same));
  }
  const back = [all(loop)];
  while (loop.back()) back.push(all(loop));
  return {seen, back: back.reverse(), reloaded};
}"""


@pytest.fixture(scope="module")
def js(browser):
    """Run functions in a page that has the package's modules at /."""
    with browsing.served(MODULES) as address, browsing.visit(browser, address) as here:
        yield here.page.evaluate
        assert here.complaints == []


def state_of(here):
    """The state, told at once as by a page that is left."""
    here.page.evaluate("dispatchEvent(new Event('pagehide'))")
    return state_told(here.page)


def words(here):
    return here.page.locator(".rl-answer").inner_text()


def press(here, times=1):
    for _ in range(times):
        here.page.locator(".rl-next").click()


def let(here, chooser):
    here.page.get_by_role("radio", name=chooser).check()


def log(here):
    rows = here.page.locator(".rl-loop-below .rl-log tbody tr").all()
    return [[cell.inner_text() for cell in row.locator("td").all()] for row in rows]


def to_the_end(here):
    while "new episode" not in here.page.locator(".rl-next").inner_text():
        press(here)


def looks(here):
    """All that a reader sees, in words."""
    page = here.page
    symbols = page.locator(".rl-loop-gap text").all_text_contents()
    return [words(here), log(here), symbols, page.locator(".rl-line li").all_inner_texts()]


# ---------------------------------------------------------------- the numbers are the library's
def test_the_episode_is_that_of_rollout_to_the_last_bit(js):
    random = np.random.default_rng(0)
    cases = []
    for number in range(30):
        world = rl.maps.random(5, 6, density=0.2, rng=number)
        task = rl.Task(world, rl.Robot(slip=float(random.choice([0.0, 0.1, 0.5]))), gamma=0.9)
        mdp = task.mdp()
        mixed = number % 2 == 0
        pi = random.dirichlet(np.ones(mdp.A), mdp.S) if mixed else random.integers(0, mdp.A, mdp.S)
        scenario = _scenario.scenario_of(task, seed=number, max_steps=4)
        cases.append((rl.rollout(mdp, pi, max_steps=4, rng=number), scenario, pi, mixed))
    runs = js(EPISODES, [{"scenario": s, "pi": pi.ravel().tolist(), "mixed": m} for _, s, pi, m in cases])
    for (episode, *_), run in zip(cases, runs, strict=True):
        assert run["states"] == episode.states.tolist()
        assert run["actions"] == episode.actions.tolist()
        assert base64.b64decode(run["rewards"]) == episode.rewards.tobytes()
        assert run["end"] == ("terminated" if episode.terminated else "truncated")
    assert {episode.terminated for episode, *_ in cases} == {True, False}


@pytest.mark.parametrize("seed", range(4))
def test_every_moment_comes_back_and_can_be_come_back_to(js, seed):
    scenario = _scenario.scenario_of(TASK, seed=seed, max_steps=7)
    there = js(THERE_AND_BACK, {"scenario": scenario, "moments": 60})
    assert len(there["seen"]) > 6
    assert there["back"] == there["seen"]
    assert there["reloaded"] == there["seen"][1:]


@pytest.mark.parametrize(("chooser", "name"), [("random", "Chance"), ("optimal", "The best policy")])
def test_the_log_is_the_episode_of_python(page_of, chooser, name):
    debugger = LoopDebugger(TASK, seed=5, max_steps=9)
    debugger.state = {**debugger.state, "chooser": chooser}
    episode = debugger.episode()
    here = page_of(debugger)
    expect(here.page.get_by_role("radio", name=name)).to_be_checked()
    while here.page.get_by_role("button", name="Whole step").get_attribute("aria-disabled") == "false":
        here.page.get_by_role("button", name="Whole step").click()
    assert state_of(here)["actions"] == episode.actions.tolist()
    rows = log(here)
    assert [float(row[3].replace("−", "-")) for row in rows] == episode.rewards.round(3).tolist()
    poses = [TASK.pose(s) for s in episode.states]
    assert [row[1].split(")")[0] for row in rows] == [f"({pose.x}, {pose.y}" for pose in poses[:-1]]
    assert [row[5] for row in rows] == ["no"] * (len(rows) - 1) + ["terminated" if episode.terminated else "truncated"]


def test_the_given_policy_is_the_one_that_drives(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    expect(here.page.get_by_role("radio", name="The given policy")).to_be_checked()
    to_the_end(here)
    assert state_of(here)["actions"] == [2, 2, 2, 2]
    assert words(here).startswith("Terminated after 4 steps: the robot is at the goal.")


def test_a_reward_of_the_readers_own_is_paid(page_of):
    task = rl.Task(LANE.world, LANE.robot, reward=lambda t: 7.25 if t.goal else t.s_next.x / 8)
    here = page_of(LoopDebugger(task, STRAIGHT))
    to_the_end(here)
    assert [row[3] for row in log(here)] == ["0.125", "0.25", "0.375", "7.25"]


# ---------------------------------------------------------------- one step
def test_each_press_lights_one_part_and_one_line(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    page = here.page
    seen = []
    for _ in range(7):
        parts = page.locator(".rl-part.rl-active .rl-part-name").all_inner_texts()
        lit = page.locator(".rl-loop-gap text.rl-lit").all_text_contents()
        (line,) = page.locator(".rl-program li[aria-current]").all_inner_texts()
        seen.append(("".join(parts), [text for text in lit if text[0] in "SAR"], line.strip()))
        press(here)
    assert seen == [
        ("Agent", ["S₀"], "while not world.ended(s) and t < limit:"),
        ("Agent", ["A₀"], "a = agent.choose(s)"),
        ("Environment", [], "s_next = world.move(s, a)"),
        ("Environment", ["R₁"], "r = world.pay(s, a, s_next)"),
        ("Environment", ["S₁"], "agent.hear(r, s_next)"),
        ("", [], "s, t = s_next, t + 1"),
        ("Agent", ["S₁"], "while not world.ended(s) and t < limit:"),
    ]


def test_the_log_fills_as_the_step_goes_on(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    filled = []
    for _ in range(7):
        filled.append([sum(1 for cell in row if cell) for row in log(here)])
        press(here)
    # t and S_t; A_t; nothing new while the robot moves; R_{t+1}; S_{t+1}; whether it ends; the next line
    assert filled == [[2], [3], [3], [4], [5], [6], [6, 2]]


def test_the_index_of_the_reward_is_explained(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    press(here, 3)
    assert words(here) == (
        "The environment pays R₁ = −0.1 for A₀. It comes with the next state, so it has the next index."
    )
    line = here.page.locator(".rl-line li").all_inner_texts()
    assert [item.split()[0] for item in line] == ["S0", "A0", "R1"]


def test_back_shows_what_was_seen_before(page_of):
    here = page_of(LoopDebugger(TASK, seed=2, max_steps=4))
    seen = [looks(here)]
    while "new episode" not in here.page.locator(".rl-next").inner_text():
        press(here)
        seen.append(looks(here))
    for before in reversed(seen[:-1]):
        here.page.get_by_role("button", name="Back").click()
        assert looks(here) == before
    assert here.page.get_by_role("button", name="Back").get_attribute("aria-disabled") == "true"
    assert len(seen) > 7


@pytest.mark.parametrize(("name", "position"), [("S₀", 0), ("A₀", 1), ("R₁", 3), ("S₁", 4), ("A₁", 7), ("R₂", 9)])
def test_a_press_on_the_time_line_goes_back_to_that_moment(page_of, name, position):
    here = page_of(LoopDebugger(TASK, seed=2, max_steps=4))
    seen = [looks(here)]
    for _ in range(9):
        press(here)
        seen.append(looks(here))
    here.page.get_by_role("button", name=f"Go to {name}:").click()
    assert looks(here) == seen[position]
    assert state_of(here)["position"] == position
    if position < 9:
        press(here)
        assert looks(here) == seen[position + 1]


def test_a_slip_is_told(page_of):
    here = page_of(LoopDebugger(rl.Task(WORLD, rl.Robot(slip=1.0)), seed=0))
    press(here, 2)
    assert "It slipped: the steering was" in words(here)


# ---------------------------------------------------------------- you choose
@pytest.mark.parametrize("way", ["click", "key", "touch"])
def test_you_choose_by_mouse_key_and_finger(page_of, way):
    here = page_of(LoopDebugger(LANE), width="telephone" if way == "touch" else "desk")
    let(here, "You")
    press(here)
    assert words(here) == "It is your turn: press one of the actions of the agent."
    ahead = here.page.get_by_role("group", name="Actions").get_by_role("button", name="0°", exact=True)
    if way == "click":
        ahead.click()
    elif way == "touch":
        ahead.tap()
    else:
        here.page.keyboard.press("3")
    assert words(here) == "The agent chooses A₀: straight on."
    assert state_of(here)["actions"] == [2]


def test_the_actions_wait_for_their_turn(page_of):
    here = page_of(LoopDebugger(LANE))
    buttons = here.page.get_by_role("group", name="Actions").get_by_role("button")
    blocked = [button.get_attribute("aria-disabled") for button in buttons.all()]
    assert blocked == ["true"] * 5
    assert "The policy chooses" in buttons.first.get_attribute("title")
    buttons.first.click(force=True)
    here.page.keyboard.press("3")
    assert state_of(here)["position"] == 0


def test_who_chooses_may_change_in_the_middle(page_of):
    here = page_of(LoopDebugger(LANE))
    let(here, "You")
    here.page.get_by_role("group", name="Actions").get_by_role("button", name="0°", exact=True).click()
    let(here, "The best policy")
    to_the_end(here)
    mdp = LANE.mdp()
    rest = rl.rollout(mdp, rl.solve(mdp).pi, start=LANE.index(rl.Pose(1, 0, 0)))
    assert state_of(here)["actions"] == [2, *rest.actions]


# ---------------------------------------------------------------- ends
def test_a_limit_truncates_and_a_longer_one_lets_the_robot_drive_on(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT, max_steps=2))
    to_the_end(here)
    assert words(here).startswith("Truncated: the step limit of 2 is reached. The robot could drive on")
    assert log(here)[-1][-1] == "truncated"
    here.page.get_by_role("spinbutton").or_(here.page.get_by_role("textbox")).first.fill("30")
    here.page.keyboard.press("Enter")
    to_the_end(here)
    assert words(here).startswith("Terminated after 4 steps: the robot is at the goal. S₄ is an end of the task itself")
    assert state_of(here)["scenario"]["max_steps"] == 30


def test_a_crash_is_an_end_too(page_of):
    here = page_of(LoopDebugger(rl.Task(rl.GridWorld.from_ascii("^.G")), np.full(25, 2)))
    to_the_end(here)
    assert words(here).startswith("Terminated after 1 step: the robot has crashed.")
    assert log(here) == [["0", "(0, 0) ↑", "0°", "−10", "crashed", "terminated"]]


def test_next_goes_on_to_a_new_episode_with_the_next_seed(page_of):
    here = page_of(LoopDebugger(TASK, seed=3, max_steps=1))
    to_the_end(here)
    press(here)
    state = state_of(here)
    assert (state["scenario"]["seed"], state["position"], state["actions"]) == (4, 0, [])


def test_start_again_goes_back_to_the_page_as_it_was(page_of):
    debugger = LoopDebugger(TASK, seed=3, max_steps=5)
    here = page_of(debugger)
    first = looks(here)
    let(here, "The best policy")
    press(here, 9)
    here.page.get_by_role("button", name="New episode").click()
    here.page.get_by_role("button", name="Start again").click()
    assert state_of(here) == debugger.state
    assert looks(here) == first


def test_a_place_in_an_episode_is_kept_in_the_state(page_of):
    debugger = LoopDebugger(LANE, STRAIGHT)
    debugger.state = {**debugger.state, "actions": [2, 2], "position": 9}
    here = page_of(debugger)
    assert words(here).startswith("The environment pays R₂ = −0.1 for A₁.")
    assert len(log(here)) == 2


def test_play_goes_on_by_itself_and_pause_stops_it(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    here.page.get_by_role("button", name="Play").click()
    here.page.wait_for_function("document.querySelectorAll('.rl-line li').length >= 2")
    here.page.get_by_role("button", name="Pause").click()
    before = state_of(here)["position"]
    here.page.wait_for_timeout(1200)  # more than a moment takes
    assert state_of(here)["position"] == before >= 1


# ---------------------------------------------------------------- the exercise
def test_a_log_is_labeled(page_of):
    here = page_of(LoopDebugger(TASK))
    page = here.page
    page.get_by_text("Label a log").click()
    check = page.get_by_role("button", name="Check")
    check.click()
    feedback = page.locator(".rl-feedback")
    expect(feedback).to_have_text("Column 1 has no name yet.")
    rows = [
        [cell.inner_text() for cell in row.locator("td").all()] for row in page.locator(".rl-label-log tbody tr").all()
    ]
    columns = list(zip(*rows, strict=True))
    names = [name_of(column, columns) for column in columns]
    assert sorted(names) == sorted(["t", "Sₜ", "Aₜ", "Rₜ₊₁", "Sₜ₊₁"])
    for i, name in enumerate(names):
        page.get_by_label(f"Column {i + 1}").select_option("Rₜ" if name == "Rₜ₊₁" else name)
    check.click()
    expect(feedback.locator("li")).to_have_count(1)
    expect(feedback).to_contain_text("so its index is t+1")
    page.get_by_label(f"Column {names.index('Rₜ₊₁') + 1}").select_option("Rₜ₊₁")
    expect(feedback).to_be_empty()
    check.click()
    expect(feedback).to_contain_text("All five are right.")


def name_of(column, columns):
    """What a column is, found as a reader would: from its numbers alone."""
    if column == ("0", "1", "2", "3"):
        return "t"
    if "°" in column[0]:
        return "Aₜ"
    if "(" not in column[0]:
        return "Rₜ₊₁"
    other = next(one for one in columns if "(" in one[0] and one != column)
    return "Sₜ" if column[1:] == other[:-1] else "Sₜ₊₁"


# ---------------------------------------------------------------- for everyone
def test_the_lecture_view_is_stepped_by_the_space_bar(page_of):
    here = page_of(LoopDebugger(LANE, STRAIGHT))
    here.page.get_by_role("button", name="Lecture view").click()
    expect(here.page.locator(".rl-lecture")).to_have_count(1)
    here.page.keyboard.press("Space")
    here.page.keyboard.press("Space")
    assert state_of(here)["position"] == 2
    here.page.get_by_role("button", name="Leave lecture view").click()
    expect(here.page.locator(".rl-lecture")).to_have_count(0)


@pytest.mark.parametrize("width", ["desk", "telephone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_stands_in_anyones_way(page_of, width, scheme):
    here = page_of(LoopDebugger(TASK, seed=1), width=width, scheme=scheme)
    here.page.get_by_text("Label a log").click()
    for _ in range(2):
        press(here, 4)
        assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_it_fits_into_360_pixels(page_of):
    here = page_of(LoopDebugger(TASK, seed=1), width="telephone")
    here.page.set_viewport_size({"width": 360, "height": 740})
    here.page.get_by_text("Label a log").click()
    press(here, 10)
    assert here.page.evaluate("document.documentElement.scrollWidth") <= 360


# ---------------------------------------------------------------- Python
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"chooser": "me"}, "`chooser` must be one of"),
        ({"chooser": "own"}, "`chooser` must be one of 'random', 'optimal', 'you'"),
        ({"position": -1}, "`position` must be an integer of at least 0"),
        ({"actions": [0.5]}, "`actions` must be an integer"),
        ({"speed": 1}, "the key 'speed'"),
        ({"scenario": {}}, "a scenario with the same map"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    debugger = LoopDebugger(LANE)
    before = debugger.state
    with pytest.raises((TypeError, ValueError)) as refused:
        debugger.state = {**before, **change}
    assert message in str(refused.value)
    assert debugger.state == before


def test_arguments_are_checked():
    with pytest.raises(TypeError, match="`task` must be a Task"):
        LoopDebugger(WORLD)
    with pytest.raises(ValueError, match="one action for each of the"):
        LoopDebugger(LANE, [0, 1])
    with pytest.raises(ValueError, match="`max_steps` must be"):
        LoopDebugger(LANE, max_steps=0)


def test_on_paper_it_is_the_way_and_the_log():
    debugger = LoopDebugger(LANE, STRAIGHT)
    assert "4 steps, terminated. The log shows the first 4." in repr(debugger)
    assert debugger.alt == "Map with the robot's way, and the log of its first steps; the given policy chose."
    assert repr(LoopDebugger(LANE, STRAIGHT)) == repr(debugger)
