"""The step sizes of chapter 12: sums, verdicts and runs are those of the library, and readers can work them."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import StepSizes, _scenario

from .pages import fits_into, kernel_sets, settled, state_now

SMALL = rl.Task(rl.GridWorld.from_ascii("...G\n.#..\n...."), rl.Robot((-45, 0, 45), slip=0.2))
POSE, TURN = rl.Pose(1, 0, 0), 45
SCHEDULES = [
    {"kind": "constant", "c": 0.3},
    {"kind": "power", "c": 1.0, "p": 1.0},
    {"kind": "power", "c": 0.9, "p": 0.7},
    {"kind": "power", "c": 1.0, "p": 0.5},
    {"kind": "power", "c": 1.0, "p": 2.0},
    {"kind": "linear", "c": 0.8, "until": 13},
    {"kind": "halving", "c": 1.0, "until": 7},
]
LEARN = """async ({scenario, settings, s, a, seeds, points, table}) => {
  const sizes = await import("/scenario/step_sizes.js");
  const {taskOf} = await import("/scenario/model.js");
  const {solve} = await import("/planning.js");
  const mdp = taskOf(scenario).mdp();
  const entry = sizes.entryOf(mdp, s, a);
  const best = solve(mdp, {tol: 1e-12}).Q;
  const live = Array.from(best.keys()).filter(i => !mdp.terminal[Math.floor(i / mdp.A)]);
  const error = Q => live.reduce((sum, i) => sum + Math.abs(Q[i] - best[i]), 0) / live.length;
  const whole = {every: live.length, measure: error};
  const study = new sizes.Study(table ? mdp : entry.mdp, settings,
    {seeds, seed: scenario.seed, points, ...(table ? whole : {every: 1, measure: Q => Q[0]})});
  while (!study.done) study.advance();
  return { exact: entry.exact, noise: entry.noise, curves: study.curves, sums: sizes.sumsOf(settings, points),
           verdict: sizes.verdictOf(settings) };
}"""


def widget(**settings):
    return StepSizes(SMALL, POSE, TURN, **settings)


def run(js, settings, *, points, table=False, seed=5):
    complete = {"c": 0.5, "p": 1.0, "until": 200, **settings}
    scenario = _scenario.scenario_of(SMALL, seed=seed)
    s, a = SMALL.index(POSE), SMALL.robot.steering.index(TURN)
    asked = {"scenario": scenario, "settings": complete, "s": s, "a": a, "seeds": 4 if table else 8}
    return js(LEARN, {**asked, "points": points, "table": table})


def answer(here):
    settled(here.page)
    return here.page.locator(".rl-answer").inner_text()


def updates(here, n):
    field = here.page.get_by_label("Updates, as a number", exact=True)
    field.fill(str(n))
    field.press("Enter")
    settled(here.page)


def numbers(here):
    """Step size, both sums, and the share of the first target, exactly."""
    cells = here.page.locator(".rl-numbers td data")
    return [float(value) for value in cells.evaluate_all("all => all.map(one => one.value)")]


def choose(here, kind):
    here.page.get_by_label("Step size αₙ of the n-th update").select_option(kind)
    settled(here.page)


# ---------------------------------------------------------------- the numbers are the library's
@pytest.mark.parametrize("settings", SCHEDULES, ids=lambda one: " ".join(map(str, one.values())))
def test_step_sizes_and_sums_are_those_of_python(js, settings):
    sums = run(js, settings, points=60)["sums"]
    sizes = widget(**settings).step_sizes(60)
    np.testing.assert_allclose(sums["alpha"], sizes, rtol=1e-13)
    np.testing.assert_allclose(sums["first"], sizes.cumsum(), rtol=1e-12)
    np.testing.assert_allclose(sums["second"], (sizes**2).cumsum(), rtol=1e-12)
    weight = sizes[0] * np.cumprod([1, *(1 - sizes[1:])])
    np.testing.assert_allclose(sums["weight"], weight, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("settings", SCHEDULES, ids=lambda one: " ".join(map(str, one.values())))
def test_one_entry_is_learned_as_in_python(js, settings):
    found = run(js, settings, points=200)
    mine = widget(**settings, shown=200, seed=5)
    values, exact = mine.curves()
    assert found["exact"] == pytest.approx(exact, abs=1e-10)
    np.testing.assert_allclose(found["curves"], values, atol=1e-10)
    assert values.shape == (8, 201)


@pytest.mark.parametrize("settings", [SCHEDULES[0], SCHEDULES[2], SCHEDULES[5]], ids=lambda one: one["kind"])
def test_a_whole_table_is_learned_as_in_python(js, settings):
    found = run(js, settings, points=6, table=True)
    values, _ = widget(**settings, watch="table", shown=6, seed=5).curves()
    np.testing.assert_allclose(found["curves"], values, atol=1e-9)
    assert values.shape == (4, 7)


def test_the_entry_is_the_learned_one_of_the_task(js):
    mine = widget()
    model, exact = mine.problem()
    best, mdp = rl.solve(SMALL.mdp(), tol=1e-12), SMALL.mdp()
    assert exact == pytest.approx(best.Q[SMALL.index(POSE), 2])
    assert rl.solve(model).Q[0, 0] == pytest.approx(exact, abs=1e-6)
    spread = np.sqrt(mdp.prob[SMALL.index(POSE), 2] @ (model.reward[0, 0] - exact) ** 2)
    assert run(js, SCHEDULES[0], points=1)["noise"] == pytest.approx(spread, abs=1e-9)


@pytest.mark.parametrize(
    ("settings", "first", "second"),
    [
        ({"kind": "constant"}, True, False),
        ({"kind": "power", "p": 0.0}, True, False),
        ({"kind": "power", "p": 0.5}, True, False),
        ({"kind": "power", "p": 0.55}, True, True),
        ({"kind": "power", "p": 1.0}, True, True),
        ({"kind": "power", "p": 1.05}, False, True),
        ({"kind": "linear"}, False, True),
        ({"kind": "halving"}, False, True),
    ],
)
def test_verdicts_come_from_analysis(js, settings, first, second):
    assert run(js, settings, points=1)["verdict"] == {"first": first, "second": second}


# ---------------------------------------------------------------- it is operated
def test_a_constant_step_trembles_and_a_shrinking_one_settles(page_of):
    here = page_of(widget(kind="constant", c=0.5))
    assert answer(here).startswith("Nothing is learned yet. Press “Run”. It never settles")
    updates(here, 1000)
    floor = float(re.search(r"trembles by ±([\d.]+)", answer(here))[1])
    mine = widget(kind="constant", c=0.5, shown=1000)
    values, exact = mine.curves()
    assert floor == pytest.approx((values[:, 200:] - exact).std(), rel=0.15)
    assert numbers(here)[:3] == pytest.approx([0.5, 500, 250])
    choose(here, "c / nᵖ")
    assert "✓ holds" in here.page.locator(".rl-verdict li").first.inner_text()
    assert "settles at the exact value" in answer(here)
    power = widget(kind="power", c=0.5, p=1.0, shown=1000).curves()[0][:, -1]
    low, high = (f"{x:.2f}".rstrip("0").replace("-", "−") for x in (power.min(), power.max()))
    assert f"between {low} and {high}" in answer(here)


def test_p_beyond_one_stops_too_early(page_of):
    here = page_of(widget(kind="power", c=1.0, p=1.0, shown=50))
    field = here.page.get_by_label("p, as a number", exact=True)
    field.fill("1.5")
    field.press("Enter")
    assert "The steps end too early" in answer(here)
    first, second = here.page.locator(".rl-verdict li").all_inner_texts()
    assert "✗ fails" in first
    assert "has a limit, as p > 1" in first
    assert "✓ holds" in second
    assert state_now(here.page)["p"] == 1.5


def test_run_goes_on_by_itself_and_pause_stops_it(page_of):
    here = page_of(widget())
    here.page.get_by_role("button", name="Run", exact=True).click()
    here.page.wait_for_function("document.querySelector('.rl-answer').textContent.startsWith('After ')")
    here.page.get_by_role("button", name="Pause").click()
    expect(here.page.get_by_role("button", name="Run", exact=True)).to_be_visible()
    stopped = state_now(here.page)["shown"]
    here.page.wait_for_timeout(300)
    assert state_now(here.page)["shown"] == stopped > 0
    here.page.get_by_role("button", name="Start again").click()
    assert state_now(here.page) == widget().state


def test_a_whole_table_is_watched_and_luck_changes(page_of):
    here = page_of(widget(kind="power", c=1.0, p=0.7))
    here.page.get_by_role("radio", name="A whole table").check()
    updates(here, 5)
    values, _ = widget(kind="power", c=1.0, p=0.7, watch="table", shown=5).curves()
    text = f"After 5 updates of each entry the mean error is {f'{values[:, -1].mean():.2f}'.rstrip('0')}."
    expect(here.page.locator(".rl-answer")).to_contain_text(text)
    here.page.get_by_role("button", name="Other luck").click()
    settled(here.page)
    assert state_now(here.page)["scenario"]["seed"] == 8
    expect(here.page.locator(".rl-answer")).not_to_contain_text(text)


def test_only_the_settings_of_a_schedule_are_offered(page_of):
    here = page_of(widget())
    for kind, offered in {
        "constant c": ["c"],
        "c / nᵖ": ["c", "p"],
        "from c to 0 in N updates": ["c", "N"],
        "c, halved every N updates": ["c", "N"],
    }.items():
        choose(here, kind)
        names = [name for name in "cpN" if here.page.get_by_role("slider", name=name, exact=True).count()]
        assert names == offered


def test_keys_and_fingers_work_it(page_of):
    here = page_of(widget(), width="telephone")
    here.page.get_by_role("slider", name="Updates").focus()
    here.page.keyboard.press("End")
    settled(here.page)
    assert state_now(here.page)["shown"] == 1000
    here.page.get_by_role("button", name="Run again").tap()
    here.page.get_by_role("button", name="Pause").tap()
    for button in here.page.get_by_role("button").all():
        assert button.bounding_box()["height"] >= 44
    assert fits_into(here.page, 360)


def test_the_lecture_view_is_worked_by_the_space_bar(page_of):
    here = page_of(widget())
    here.page.get_by_role("button", name="Lecture view").click()
    here.page.keyboard.press("Space")
    here.page.wait_for_function("document.querySelector('.rl-answer').textContent.startsWith('After ')")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(widget(kind="halving", shown=60), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(widget(shown=9))
    kernel_sets(here.page, {"kind": "power", "c": 1.0, "shown": 4})
    settled(here.page)
    assert numbers(here) == pytest.approx([1 / 4, 1 + 1 / 2 + 1 / 3 + 1 / 4, 1 + 1 / 4 + 1 / 9 + 1 / 16, 1 / 4])
    kernel_sets(here.page, {"c": 7})
    expect(here.page.get_by_role("alert").first).to_contain_text("`c` must be")
    assert numbers(here)[0] == 1 / 4


# ---------------------------------------------------------------- Python
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "cosine"}, "`kind` must be one of 'constant', 'power'"),
        ({"c": 0}, r"`c` must be a number in \(0, 1\]"),
        ({"p": 2.5}, r"`p` must be a number in \[0, 2\]"),
        ({"until": 0}, "`until` must be an integer from 1"),
        ({"watch": "policy"}, "`watch` must be one of"),
        ({"watch": "table", "shown": 101}, "`shown` must be an integer from 0 to 100"),
        ({"steering": 90}, "`steering` must be one of -45, 0, 45; got 90"),
        ({"pose": [1, 1, 0]}, "`pose` must be on a free cell"),
        ({"speed": 1}, "the key 'speed'"),
    ],
)
def test_a_state_that_cannot_be_is_refused(change, message):
    mine = widget()
    before = mine.state
    with pytest.raises((TypeError, ValueError), match=message):
        mine.state = {**before, **change}
    assert mine.state == before


def test_a_world_that_is_too_large_for_a_page_is_refused():
    with pytest.raises(ValueError, match="at most 1000 states"):
        StepSizes(rl.Task(rl.maps.random(14, density=0.0, rng=0)), POSE, TURN)


def test_on_paper_it_shows_the_sums_and_what_is_learned():
    assert "60 updates with step sizes that are 1 / n^0.7." in repr(widget(kind="power", c=1, p=0.7, shown=60))
    assert "linear, from 0.5 to 0 in 200 updates" in repr(widget(kind="linear"))
    mine = widget(watch="table", shown=1)
    assert mine.alt == "The sums of step sizes and of their squares, and the mean error of the table, after 1 updates."
