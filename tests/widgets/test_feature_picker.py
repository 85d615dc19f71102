"""The feature picker: what it learns and counts is the library's, by mouse, touch and keyboard."""

import base64

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav import designs
from rlnav.widgets import FeaturePicker

from .pages import kernel_sets, settled
from .pages import state_now as state_of

WORLD = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
SENSORS = (designs.goal_bearing(8), designs.moves_ahead())
QUICK = {"episodes": 1200}


def picker(*features, **settings):
    task = rl.Task(WORLD, features=features or SENSORS)
    return FeaturePicker(task, **{**QUICK, **settings})


LEARNED = """async ({scenario, variety}) => {
  const {Grounds, School} = await import('/scenario/school.js');
  const {featuresOf} = await import('/scenario/named.js');
  const {checkScenario} = await import('/scenario/scenario.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  const whole = checkScenario(scenario);
  const school = new School(whole, featuresOf(whole.features), new Grounds(whole), variety);
  while (school.slice(20));
  const {home, away, episode} = school;
  return {Q: bits(school.Q), home, away, episode, possible: school.grounds.home.possible};
}"""
MIXED = """async ({scenario}) => {
  const {mixedRows} = await import('/scenario/alias.js');
  const {solve} = await import('/planning.js');
  const {taskOf} = await import('/scenario/model.js');
  const task = taskOf(scenario);
  const mdp = task.mdp();
  const {Q} = solve(mdp, {tol: 1e-12});
  const phi = task.phi();
  const {met, mixed, pairs} = mixedRows(mdp, phi, Q);
  return {met, mixed, pairs, rows: phi.reduce((most, z) => Math.max(most, z), 0)};
}"""


def words(here):
    return here.page.locator(".rl-answer")


def train(here):
    here.page.get_by_role("button", name="Train").click()
    expect(words(here)).to_contain_text("Learned on", timeout=20_000)


@pytest.mark.parametrize("variety", ["one", "many"])
@pytest.mark.parametrize("features", [SENSORS, (designs.goal_direction(), designs.heading()), (designs.cell(),)])
def test_the_table_is_that_of_python_to_the_last_bit_and_its_exam_too(js, features, variety):
    figure = picker(*features, variety=variety, seed=3)
    found = js(LEARNED, {"scenario": figure.state["scenario"], "variety": variety})
    Q = figure.learned()
    assert np.array_equal(np.frombuffer(base64.b64decode(found["Q"])).reshape(Q.shape), Q)
    assert (found["home"]["success"], found["away"]["success"]) == pytest.approx(figure.exam(Q), abs=1e-12)
    mdp = figure.task.mdp()
    assert found["possible"] == pytest.approx(rl.evaluate(mdp, rl.solve(mdp).pi).success, abs=1e-12)
    assert found["episode"] == 1200


@pytest.mark.parametrize(
    "features",
    [SENSORS, (designs.cell(),), (designs.goal_direction(), designs.heading()), (designs.cell(), designs.heading())],
)
def test_rows_that_mix_poses_are_counted_as_in_python(js, features):
    figure = picker(*features)
    found = js(MIXED, {"scenario": figure.state["scenario"]})
    assert {name: found[name] for name in ("rows", "met", "mixed")} == figure.table
    mdp, phi = figure.task.mdp(), figure.task.phi()
    Q = rl.solve(mdp, tol=1e-12).Q
    losses = [pair["loss"] for pair in found["pairs"]]
    assert losses == sorted(losses, reverse=True)
    for pair in found["pairs"]:
        s, t = pair["states"]
        good = Q[[s, t]] >= Q[[s, t]].max(axis=1, keepdims=True) - 1e-9
        assert phi[s] == phi[t]
        assert not good.all(axis=0).any()


def test_a_whole_pose_mixes_nothing():
    whole = FeaturePicker(rl.Task(WORLD), **QUICK)
    assert whole.table == {"rows": 696, "met": 688, "mixed": 0}


def test_it_learns_and_tells_what_the_table_is_worth_here_and_elsewhere(page_of):
    figure = picker()
    here = page_of(figure)
    expect(words(here)).to_contain_text("It can tell 256 situations apart, and meets 62 on this map.")
    expect(words(here)).to_contain_text(f"{figure.table['mixed']} of these mix poses")
    train(here)
    home, away = figure.exam(figure.learned())
    expect(words(here)).to_contain_text(f"reaches the goal from {100 * home:.0f} % of all poses; 88 %")
    expect(words(here)).to_contain_text(f"never seen: {100 * away:.0f} % of 68 %")
    row = here.page.locator(".rl-tries tbody tr")
    expect(row).to_have_count(1)
    expect(row).to_contain_text("goal bearing (8), moves ahead")
    here.page.get_by_role("button", name="Train with another seed").click()
    expect(row).to_have_count(2)
    assert state_of(here.page)["scenario"]["seed"] == 1
    assert [one["seed"] for one in state_of(here.page)["tried"]] == [1, 0]
    here.page.get_by_role("button", name="Start again").click()
    expect(row).to_have_count(0)


def test_twenty_maps_teach_what_one_does_not(page_of):
    here = page_of(picker(variety="many", trained=True))
    expect(words(here)).to_contain_text("Learned on 20 random maps.", timeout=20_000)
    figure = picker(variety="many")
    _, away = figure.exam(figure.learned())
    expect(words(here)).to_contain_text(f"never seen: {100 * away:.0f} % of 68 %")


def test_pairs_that_share_a_row_are_shown_one_after_the_other(page_of):
    figure = picker(designs.heading())
    here = page_of(figure)
    what, more = here.page.locator(".rl-what"), here.page.get_by_role("button", name="Next pair")
    expect(what).to_contain_text("1 of 8: A at")
    more.click()
    expect(what).to_contain_text("2 of 8: A at")
    assert state_of(here.page)["turn"] == 1
    here.page.get_by_label("Its cell").check()
    expect(words(here)).to_contain_text("one turn is best for all of its poses: this table can be perfect.")
    expect(what).to_contain_text("No two poses that look alike need different turns.")


def test_a_learned_table_drives_here_and_on_maps_it_has_never_seen(page_of):
    here = page_of(picker())
    what = here.page.locator(".rl-what")
    here.page.get_by_role("radio", name="Unseen map").check()
    expect(what).to_contain_text("Map 1 of 20. Train first.")
    train(here)
    assert state_of(here.page)["view"] == "drive"
    expect(what).to_contain_text("step")
    here.page.get_by_role("radio", name="Unseen map").check()
    here.page.get_by_role("button", name="Another unseen map").click()
    expect(what).to_contain_text("step")


def test_a_table_of_poses_stays_at_home(page_of):
    here = page_of(picker())
    here.page.get_by_role("radio", name="20 random maps").check()
    here.page.get_by_role("radio", name="Its whole pose").check()
    assert state_of(here.page)["variety"] == "one"
    expect(here.page.get_by_role("radio", name="20 random maps")).to_be_disabled()
    train(here)
    expect(words(here)).to_contain_text("To other maps it cannot go")
    here.page.get_by_role("radio", name="A choice of features").check()
    assert state_of(here.page)["scenario"]["features"] == [["goal_bearing", 8], "moves_ahead"]


def test_the_keyboard_chooses_trains_and_looks(page_of):
    here = page_of(picker())
    page = here.page
    page.get_by_label("Its heading").focus()
    page.keyboard.press("Space")
    assert "heading" in state_of(page)["scenario"]["features"]
    page.get_by_role("button", name="Train").focus()
    page.keyboard.press("Enter")
    expect(words(here)).to_contain_text("Learned on", timeout=20_000)
    page.get_by_role("radio", name="Drive").focus()
    page.keyboard.press("ArrowRight")
    assert state_of(page)["view"] == "unseen"


def test_a_finger_trains_on_a_telephone(page_of):
    here = page_of(picker(), width="telephone")
    here.page.get_by_label("Its heading").tap()
    here.page.get_by_role("button", name="Train").tap()
    expect(words(here)).to_contain_text("Learned on this map", timeout=20_000)
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_lecture_view_trains_by_the_space_bar(page_of):
    here = page_of(picker())
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    expect(words(here)).to_contain_text("Learned on", timeout=20_000)
    here.page.keyboard.press("Escape")
    here.page.get_by_role("button", name="Lecture view").wait_for()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(picker(), width=width, scheme=scheme)
    train(here)
    settled(here.page)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(picker())
    scenario = {**picker(designs.heading()).state["scenario"]}
    kernel_sets(here.page, {"scenario": scenario})
    expect(words(here)).to_contain_text("It can tell 8 situations apart")
    kernel_sets(here.page, {"scenario": {**scenario, "features": ["smell"]}})
    expect(here.page.get_by_role("alert").first).to_contain_text("`features` must be one of")
    expect(words(here)).to_contain_text("It can tell 8 situations apart")


@pytest.mark.parametrize(
    ("state", "message"),
    [
        ({"variety": "two"}, "`variety` must be one of 'one', 'many'"),
        ({"view": "all"}, "`view` must be one of"),
        ({"turn": -1}, "`turn` must be an integer of at least 0"),
        ({"tried": [{"features": None}]}, "`tried` must be dicts with the keys"),
    ],
)
def test_settings_that_cannot_be_are_named(state, message):
    figure = picker()
    with pytest.raises(ValueError, match=message):
        figure.state = {**figure.state, **state}


def test_a_design_of_the_readers_own_and_a_pose_on_many_maps_are_refused():
    with pytest.raises(ValueError, match="functions of your own"):
        FeaturePicker(rl.Task(WORLD, features=lambda pose: pose.x))
    with pytest.raises(ValueError, match="'one' for the whole pose"):
        FeaturePicker(rl.Task(WORLD), variety="many")


def test_python_draws_a_row_for_paper():
    text = repr(picker())
    assert "256 rows, 62 of them are met on this map, 34 mix" in text
    assert "share one row" in picker().html()
