"""The simulator's panels as a reader uses them: set, read, compare, carry over, and give away."""

import csv
import io
import json
import re

import numpy as np
import pytest
from playwright.sync_api import expect

import rlnav as rl

from .arena import Arena
from .pages import state_of

WIDTHS = pytest.mark.parametrize("width", ["desk", "telephone"])
CLOSED = (
    "Object.defineProperty(navigator, 'clipboard', {value: {writeText: () => Promise.reject(new Error('closed'))}})"
)


@pytest.fixture
def opened(page_of):
    """Open a page with one simulator; return what operates it."""

    def opened(simulator=None, **where):
        here = page_of(rl.widgets.Simulator(episodes=60) if simulator is None else simulator, **where)
        return Arena(here.page.locator("body"))

    return opened


def scenario(sim):
    return state_of(sim.page)["scenario"]


def field(sim, label):
    """A menu or a field by its label."""
    return sim.element.locator("select, input").and_(sim.element.get_by_label(label, exact=True))


def typed(sim, label, text):
    """Type into the field of a number, as a user would."""
    found = sim.element.get_by_role("textbox", name=label, exact=True)
    found.fill(text)
    found.press("Enter")
    return found


def trained(sim):
    """Learn to the end, as fast as possible, and wait for the exact scores."""
    field(sim, "Speed").select_option("max")
    sim.press("Train")
    sim.wait_for("Exact: all starts and all luck weighed")


def scores(sim):
    """The exact scores that the page shows, by name."""
    rows = sim.element.locator(".rl-scores tr").all()
    return {row.locator("th").inner_text(): row.locator("td").first.inner_text() for row in rows}


# ---------------------------------------------------------------- world


@WIDTHS
def test_a_preset_brings_its_map_and_its_start(opened, width):
    sim = opened(width=width)
    sim.open("World")
    field(sim, "Map").select_option("cliff")
    sim.says("12 by 4 cells")
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["starts"] == [[0, 0, 90]]
    assert "\n".join(scenario(sim)["map"]) == rl.maps.CLIFF.strip().replace("^", ".")


def test_a_random_map_is_the_one_that_python_draws(opened):
    sim = opened()
    sim.open("World")
    field(sim, "Map").select_option("random")
    typed(sim, "Map seed", "5")
    typed(sim, "Obstacles, as a number", "0.35")
    sim.says("10 by 10")
    sim.page.wait_for_timeout(300)
    assert "\n".join(scenario(sim)["map"]) == str(rl.maps.random(10, density=0.35, rng=5))
    before = scenario(sim)["map"]
    sim.press("Another map")
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["map"] != before
    expect(field(sim, "Map seed")).to_have_value("6")


@WIDTHS
def test_a_size_out_of_range_is_refused_beside_its_field(opened, width):
    sim = opened(width=width)
    group = sim.open("World")
    typed(sim, "Width", "31")
    expect(group.get_by_text("Type a whole number from 4 to 30. 10 is kept.")).to_be_visible()
    assert len(scenario(sim)["map"][0]) == 10
    typed(sim, "Width", "15")
    expect(group.get_by_text("Type a whole number")).to_have_count(0)
    sim.says("15 by 10 cells")


def test_a_goal_that_cannot_be_reached_is_told_where_the_world_is_drawn(opened):
    walls = "........\n.......G\n........\n........"
    sim = opened(rl.widgets.Simulator(rl.Task(rl.GridWorld.from_ascii(walls)), episodes=60))
    group = sim.open("World")
    group.get_by_label("Obstacle", exact=True).check()
    for cell in ((6, 1), (6, 2), (6, 3), (7, 1), (7, 3)):
        sim.drag(cell)
    sign = group.get_by_role("alert").filter(has_text="No free cell leads to the goal")
    expect(sign).to_be_visible()
    group.get_by_label("Erase", exact=True).check()
    sim.drag((6, 2))
    expect(sign).to_be_hidden()


def test_the_start_is_anywhere_or_in_one_place_with_a_heading(opened):
    sim = opened()
    group = sim.open("World")
    group.get_by_label("Anywhere").check()
    expect(group.get_by_label("Heading at the start")).to_be_hidden()
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["starts"] is None
    group.get_by_label("In one place").check()
    group.get_by_label("Heading at the start").select_option("90")
    sim.page.wait_for_timeout(300)
    assert [theta for _, _, theta in scenario(sim)["starts"]] == [90]


# ---------------------------------------------------------------- design


@WIDTHS
def test_features_change_the_size_of_the_table(opened, width):
    sim = opened(width=width)
    group = sim.open("Design")
    expect(group.get_by_text("801 rows × 5 = 4,005 numbers").first).to_be_visible()
    group.get_by_label("A choice of features").check()
    task = rl.Task(
        rl.GridWorld.from_ascii(rl.maps.FREE_SPACE), features=[rl.designs.goal_bearing(), rl.designs.moves_ahead()]
    )
    rows = task.phi().max() + 1
    expect(group.get_by_text(f"{rows:,} rows × 5 = {5 * rows:,} numbers")).to_be_visible()
    typed(sim, "Sectors", "16")
    expect(group.get_by_text("513 rows × 5 = 2,565 numbers")).to_be_visible()
    group.get_by_label("Distance to the goal").check()
    typed(sim, "Limits", "2, 1")
    expect(group.get_by_text("ascending distances, such as 1.5, 3, 6. The last ones are kept.")).to_be_visible()
    typed(sim, "Limits", "2, 4")
    expect(group.get_by_text("1,537 rows × 5")).to_be_visible()
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["features"] == [["goal_bearing", 16], ["goal_distance", [2, 4]], "moves_ahead"]


def test_the_last_feature_and_the_last_turn_cannot_be_taken_away(opened):
    sim = opened()
    group = sim.open("Design")
    group.get_by_label("A choice of features").check()
    group.get_by_label("Goal as seen from the robot").uncheck()
    expect(group.get_by_label("Moves that would crash")).to_be_disabled()
    for turn in ("−90°", "−45°", "+45°", "+90°"):
        sim.press(turn)
    last = group.get_by_role("button", name="0°", exact=True)
    expect(last).to_have_attribute("aria-disabled", "true")
    last.click(force=True)
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["steering"] == [0]


def test_a_sign_tells_of_situations_that_look_alike_and_shows_two_of_them(opened):
    sim = opened()
    group = sim.open("Design")
    expect(group.get_by_role("button", name="Show two of them")).to_be_hidden()
    group.get_by_label("A choice of features").check()
    group.get_by_label("Moves that would crash").uncheck()
    show = group.get_by_role("button", name="Show two of them")
    show.click()
    expect(show).to_have_attribute("aria-pressed", "true")
    expect(group.get_by_text(re.compile(r"A at .* look alike. The best turn at A is .*, at B "))).to_be_visible()
    group.get_by_label("Its whole pose").check()
    expect(show).to_be_hidden()


def test_turns_are_chosen_as_a_set_or_one_by_one(opened):
    sim = opened()
    group = sim.open("Design")
    turns = group.get_by_label("Turns to choose from in each step")
    turns.select_option("-45,0,45")
    sim.press("+180°")
    expect(turns).to_have_value("own")
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["steering"] == [-45, 0, 45, 180]


def test_each_term_of_the_reward_is_typed_and_nonsense_is_refused(opened):
    sim = opened()
    group = sim.open("Design")
    for label, number in {
        "Goal": "20",
        "Crash": "-5",
        "Step": "-0.25",
        "Turn": "-0.1",
        "Progress": "1",
        "Potential shaping": "0.5",
    }.items():
        typed(sim, label, number)
    group.get_by_label("Forget to charge for going away").check()
    typed(sim, "Goal", "much")
    expect(group.get_by_text("Type a number. 20 is kept.")).to_be_visible()
    sim.page.wait_for_timeout(300)
    assert scenario(sim)["reward"] == {
        "goal": 20, "crash": -5, "step": -0.25, "turn": -0.1, "progress": 1, "only_closer": True, "shaping": 0.5,
    }  # fmt: skip


def test_the_discount_tells_how_far_it_looks(opened):
    sim = opened()
    group = sim.open("Design")
    for gamma, words in {
        "0.99": "about 100 steps ahead",
        "1": "counts in full",
        "0": "Only the very next reward",
    }.items():
        typed(sim, "Discount γ, as a number", gamma)
        expect(group.get_by_text(re.compile(words))).to_be_visible()


# ---------------------------------------------------------------- learner


def test_the_learner_is_set_and_its_summary_tells_it(opened):
    sim = opened()
    group = sim.open("Learner")
    group.get_by_label("Algorithm").select_option("double_q_learning")
    expect(group.get_by_text("One table picks the best action, another rates it")).to_be_visible()
    group.get_by_label("ε over the episodes").select_option("linear")
    typed(sim, "ε at the end", "0.05")
    typed(sim, "Step size α, as a number", "0.5")
    sim.press("Next seed")
    expect(group.locator("summary")).to_contain_text("Double Q-learning, α 0.5, ε 0.2 → 0.05, 60 episodes")
    sim.page.wait_for_timeout(300)
    now = scenario(sim)
    assert [now[key] for key in ("seed", "epsilon_schedule", "epsilon_end", "alpha")] == [1, "linear", 0.05, 0.5]


def test_a_schedule_that_cannot_be_is_refused_and_the_last_one_stays(opened):
    sim = opened()
    group = sim.open("Learner")
    typed(sim, "Exploration ε, as a number", "0")
    group.get_by_label("ε over the episodes").select_option("exponential")
    expect(sim.element.locator(".rl-message")).to_be_visible()
    expect(group.get_by_label("ε over the episodes")).to_have_value("constant")
    assert scenario(sim)["epsilon_schedule"] == "constant"


# ---------------------------------------------------------------- metrics and inspector


@WIDTHS
def test_the_scores_are_those_of_python(opened, width):
    simulator = rl.widgets.Simulator(episodes=300, seed=2)
    sim = opened(simulator, width=width)
    trained(sim)
    task = simulator.task
    result = rl.evaluate(task.mdp(), simulator.train().pi[task.phi()])
    shown = scores(sim)
    assert float(shown["Value"].replace("−", "-")) == pytest.approx(result.value, abs=0.005)
    assert float(shown["Gap"]) == pytest.approx(result.gap, abs=0.005)
    assert float(shown["Success"].rstrip(" %")) == pytest.approx(100 * result.success, abs=0.05)
    assert float(shown["Steps"]) == pytest.approx(result.steps, abs=0.005)


def test_every_curve_can_be_chosen_and_other_seeds_make_a_band(opened):
    sim = opened()
    trained(sim)
    curve = sim.element.get_by_role("region", name="Metrics").locator("svg[role=img]")
    for name in ("Success", "Steps", "TD error", "Coverage", "Return"):
        sim.element.get_by_role("group", name="Curve").get_by_label(name, exact=True).check()
        expect(curve).to_have_attribute("aria-label", re.compile(rf"^{name}\. This run: .+ at episode 60\."))
    typed(sim, "Other seeds beside it", "3")
    expect(sim.element.get_by_text("3 other seeds, middle 80 %")).to_be_visible()
    typed(sim, "Other seeds beside it", "10")
    expect(sim.element.get_by_text("Type a whole number from 0 to 9. 3 is kept.")).to_be_visible()


def test_the_inspector_fills_the_formula_with_the_numbers_of_the_last_update(opened):
    sim = opened(rl.widgets.Simulator(episodes=60, algorithm="sarsa"))
    formula = sim.element.locator(".rl-formula")
    expect(formula).to_be_hidden()
    for _ in range(3):
        sim.press("Episode")
    words = formula.get_attribute("aria-label")
    number = {
        name: float(text.replace("−", "-"))
        for name, text in re.findall(
            r"(new entry|old entry|step size|reward|discount|value of what comes next) (−?[\d.]+)(?= |\.)", words
        )
    }
    target = number["reward"] + number["discount"] * number["value of what comes next"]
    expected = number["old entry"] + number["step size"] * (target - number["old entry"])
    assert number["new entry"] == pytest.approx(expected, abs=0.002)
    assert f"Target {target:.2f}".replace("-", "−") in words
    sim.press("Back")
    expect(formula).not_to_have_attribute("aria-label", words)


def test_the_inspector_shows_the_row_of_the_pose_that_is_pointed_at(opened):
    simulator = rl.widgets.Simulator(episodes=300)
    sim = opened(simulator)
    trained(sim)
    x, y = sim.at(3, 3)
    sim.page.mouse.move(x + 10, y)  # the wedge that looks east
    expect(sim.element.get_by_text("Q at (3, 3), looking east, 0°")).to_be_visible()
    task = simulator.task
    s = task.index(rl.Pose(3, 3, 0))
    exact = rl.value_iteration(task.mdp()).Q[s]
    learned = simulator.train().Q[task.phi()[s]]
    cells = [
        row.locator("td:not(.rl-q-scale)").all_inner_texts() for row in sim.element.locator(".rl-q tbody tr").all()
    ]
    numbers = np.array([[float(text.replace("−", "-").replace(",", "")) for text in row] for row in cells])
    np.testing.assert_allclose(numbers[:, 0], learned, atol=0.0051)
    np.testing.assert_allclose(numbers[:, 1], exact, atol=0.0051)
    best = sim.element.locator(".rl-q-winner th")
    expect(best).to_contain_text("best")
    assert sim.element.locator(".rl-q tbody tr").all()[int(learned.argmax())].get_attribute("class") == "rl-q-winner"


# ---------------------------------------------------------------- compare and carry over


@WIDTHS
def test_a_pinned_run_is_compared_with_the_next_one(opened, width):
    sim = opened(width=width)
    group = sim.open("Compare")
    expect(group.get_by_role("button", name="Pin this run")).to_have_attribute("aria-disabled", "true")
    trained(sim)
    before = scores(sim)
    sim.press("Pin this run")
    expect(group.get_by_text("The same settings so far")).to_be_visible()
    sim.open("Learner")
    field(sim, "Algorithm").select_option("sarsa")
    trained(sim)
    after = scores(sim)
    rows = {
        row.locator("th").inner_text(): row.locator("td").all_inner_texts() for row in group.locator("tbody tr").all()
    }
    assert rows["Algorithm"] == ["q learning", "sarsa"]
    assert rows["Value"][0] == before["Value"]
    assert rows["Value"][1].startswith(after["Value"])
    expect(sim.element.get_by_role("region", name="Metrics").get_by_text("Pinned run")).to_be_visible()
    sim.press("Unpin")
    expect(group.locator("table")).to_be_hidden()


def test_a_table_is_carried_to_another_map(opened):
    features = [rl.designs.goal_bearing(), rl.designs.moves_ahead()]
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), features=features)
    simulator = rl.widgets.Simulator(task, episodes=2000)
    sim = opened(simulator)
    group = sim.open("Compare")
    other = group.get_by_label("Other map", exact=True)
    other.select_option("free_space")
    expect(group.get_by_text("Train first: the table is empty.")).to_be_visible()
    trained(sim)
    there = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE), features=features)
    result = rl.evaluate(there.mdp(), simulator.train().pi[there.phi()])
    words = group.get_by_text(re.compile("There it reaches the goal in"))
    expect(words).to_be_visible()
    success = re.search(r"goal in (\S+) %", words.inner_text())[1]
    assert float(success) == pytest.approx(100 * result.success, abs=0.05)
    expect(group.get_by_role("application", name="Where the learned table is tried")).to_be_visible()
    assert "#" in "".join(scenario(sim)["map"])  # the run's own map is as it was


def test_a_table_of_poses_cannot_be_carried_and_says_what_to_do(opened):
    sim = opened()
    trained(sim)
    group = sim.open("Compare")
    group.get_by_label("Other map", exact=True).select_option("maze")
    expect(group.get_by_text(re.compile("Choose features that mean the same"))).to_be_visible()


def test_obstacles_are_drawn_on_the_other_map_by_keyboard(opened):
    features = [rl.designs.goal_bearing(), rl.designs.moves_ahead()]
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), features=features)
    sim = opened(rl.widgets.Simulator(task, episodes=500))
    trained(sim)
    group = sim.open("Compare")
    group.get_by_label("Other map", exact=True).select_option("free_space")
    words = group.get_by_text(re.compile("There it reaches the goal in"))
    before = words.inner_text()
    group.get_by_label("Draw obstacles on it").check()
    there = group.get_by_role("application", name="Where the learned table is tried")
    there.focus()
    for key in ("ArrowRight", "ArrowUp", "ArrowUp", "ArrowUp", "Space", "ArrowRight", "Space", "ArrowRight", "Space"):
        there.press(key)
    expect(words).not_to_have_text(before)


# ---------------------------------------------------------------- share


def test_python_that_is_copied_makes_the_same_run(opened):
    sim = opened(permissions=["clipboard-read", "clipboard-write"])
    sim.open("Learner")
    field(sim, "Algorithm").select_option("expected_sarsa")
    sim.open("Share")
    sim.press("Copy as Python")
    sim.wait_for("The code is on the clipboard")
    code = sim.page.evaluate("navigator.clipboard.readText()")
    assert code == sim.element.locator(".rl-code").text_content()
    namespace = {}
    exec(code, namespace)
    assert len(namespace["run"].returns) == 60


def test_a_closed_clipboard_shows_the_text_selected(opened):
    sim = opened()
    sim.page.evaluate(CLOSED)
    sim.open("Share")
    sim.press("Copy link")
    shown = sim.element.get_by_label(re.compile("^The link. The browser keeps its clipboard closed"))
    expect(shown).to_be_focused()
    selected = sim.page.evaluate(
        "document.activeElement.value.slice(document.activeElement.selectionStart, document.activeElement.selectionEnd)"
    )
    assert selected == shown.input_value()
    assert selected.startswith("http")
    sim.press("Close")
    expect(shown).to_be_hidden()


def test_settings_go_out_as_a_file_and_come_back(opened):
    sim = opened()
    sim.open("Learner")
    typed(sim, "Episodes", "77")
    sim.open("Share")
    with sim.page.expect_download() as waiting:
        sim.press("Settings (JSON)")
    text = waiting.value.path().read_text(encoding="utf-8")
    assert json.loads(text)["scenario"]["episodes"] == 77
    typed(sim, "Episodes", "5")
    sim.element.locator("summary", has_text="Open settings").click()
    sim.element.get_by_label("From a file").set_input_files(
        {"name": "s.json", "mimeType": "application/json", "buffer": text.encode()}
    )
    expect(field(sim, "Episodes")).to_have_value("77")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"rlnav": 99}', '{"scenario": {"alpha": 5}}', "x" * 2000, "null"])
def test_damaged_settings_get_a_plain_message_and_change_nothing(opened, text):
    sim = opened()
    before = scenario(sim)
    sim.open("Share")
    sim.element.locator("summary", has_text="Open settings").click()
    sim.element.get_by_label("Or paste them here").fill(text)
    sim.press("Take over")
    told = sim.element.locator(".rl-fault, .rl-message").filter(has_text=re.compile(r"\w+"))
    expect(told.first).to_be_visible()
    sim.page.wait_for_timeout(300)
    assert scenario(sim) == before


def test_the_run_goes_out_as_a_table(opened):
    simulator = rl.widgets.Simulator(episodes=60)
    sim = opened(simulator)
    trained(sim)
    sim.open("Share")
    with sim.page.expect_download() as waiting:
        sim.press("Run (CSV)")
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text(encoding="utf-8"))))
    run = simulator.train()
    assert [int(row["episode"]) for row in rows] == list(range(1, 61))
    assert [float(row["return"]) for row in rows] == run.returns.tolist()
    assert [int(row["steps"]) for row in rows] == run.steps.tolist()
    assert [bool(int(row["success"])) for row in rows] == run.success.tolist()
    coverage = [float(row["coverage"]) for row in rows]
    assert coverage == sorted(coverage)
    assert 0 < coverage[0] < coverage[-1] <= 1
    assert all(float(row["td_error"]) >= 0 for row in rows)


def test_the_map_goes_out_as_a_picture(opened):
    sim = opened()
    sim.open("Share")
    with sim.page.expect_download() as waiting:
        sim.press("Picture (PNG)")
    assert waiting.value.suggested_filename == "rlnav-map.png"
    assert waiting.value.path().read_bytes().startswith(b"\x89PNG")


@WIDTHS
def test_a_link_for_a_lecture_leaves_out_what_was_chosen(opened, width):
    sim = opened(width=width)
    sim.page.evaluate(CLOSED)
    group = sim.open("Share")
    group.locator("summary", has_text="Link for a lecture").click()
    for name in ("World", "Compare"):
        group.get_by_label(name, exact=True).check()
    group.locator("summary", has_text="Single controls").click()
    group.get_by_label("Slip", exact=True).check()
    sim.press("Copy lecture link")
    link = sim.page.evaluate("document.activeElement.value")
    sim.page.goto("about:blank")
    sim.page.goto(link)
    element = sim.page.locator(".rlnav.rl-lecture").first
    expect(element.locator("summary", has_text=re.compile("^Design"))).to_be_visible()
    for name in ("World", "Compare"):
        expect(element.locator("summary", has_text=re.compile(f"^{name}"))).to_be_hidden()
