"""Policy iteration by hand: every step is the library's, and its parts work by mouse, touch and keyboard."""

import base64

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import PolicyIteration, _scenario

from .pages import kernel_sets, settled
from .pages import state_now as state_of

OBSTACLES = rl.GridWorld.from_ascii(rl.maps.OBSTACLES)
SLIPPERY = rl.Task(OBSTACLES, rl.Robot(slip=0.1), gamma=0.95)
SMALL = rl.Task(rl.GridWorld.from_ascii("....\n.#.G\n...."), rl.Robot((-45, 0, 45)))

STEPS = """async ({scenario, moves, pi, tol}) => {
  const {Rounds, Truth, wholeRun} = await import('/scenario/rounds.js');
  const {taskOf} = await import('/scenario/model.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  const mdp = taskOf(scenario).mdp(), truth = new Truth(mdp);
  const rounds = new Rounds(mdp, pi, tol, truth);
  rounds.replay(moves);
  const k = rounds.length;
  const runs = [1, 3, 10, 30, null].map(n => wholeRun(mdp, pi, tol, n, truth));
  return { V: bits(rounds.now.V), pi: Array.from(rounds.now.pi), changed: rounds.now.changed, runs,
           offPolicy: rounds.offPolicy(k), offBest: rounds.offBest(k), gap: rounds.gap(k),
           right: truth.right(rounds.now.pi), work: rounds.now.work, moves: rounds.moves };
}"""


def button(here, name):
    return here.page.get_by_role("button", name=name, exact=True)


def answer(here):
    return here.page.locator(".rl-answer")


def number(here, key):
    """Read the number that stands behind what is written in the table of the step."""
    settled(here.page)
    return float(here.page.locator(f".rl-is-{key}").get_attribute("value"))


def after(task, moves, pi=None):
    """Take the steps in Python: values and policy."""
    shown = PolicyIteration(task, pi, moves=moves)
    return shown.V, shown.pi


def costs(mdp, pi, n, tol):
    """Run modified policy iteration with the library's look-ahead: sweeps, improvements."""
    s, V, sweeps, improvements = np.arange(mdp.S), np.zeros(mdp.S), 0, 0
    while True:
        change, since = np.inf, 0
        while since < n if n else change > tol:
            V_new = rl.action_values(mdp, V)[s, pi]
            change, V, since = np.abs(V_new - V).max(), V_new, since + 1
        Q = rl.action_values(mdp, V)
        better = Q.max(axis=1) - Q[s, pi] > 1e-9 * max(1, np.abs(V).max())
        sweeps, improvements = sweeps + since, improvements + 1
        if not better.any() and change <= tol:
            return {"sweeps": sweeps, "improvements": improvements}
        pi = np.where(better, rl.greedy(Q), pi)


@pytest.mark.parametrize("drawing", ["OBSTACLES", "MAZE", "CLIFF"])
@pytest.mark.parametrize(("slip", "gamma"), [(0.0, 0.9), (0.25, 0.95)])
def test_every_step_is_the_step_of_python(js, drawing, slip, gamma):
    task = rl.Task(rl.GridWorld.from_ascii(getattr(rl.maps, drawing)), rl.Robot(slip=slip), gamma=gamma)
    mdp, scenario = task.mdp(), _scenario.scenario_of(task)
    straight, star = np.full(mdp.S, 2), rl.solve(mdp, tol=1e-13)
    for moves in ("", "sss", "sssissi", "isisisis"):
        found = js(STEPS, {"scenario": scenario, "moves": moves, "pi": straight.tolist(), "tol": 0.001})
        V, pi = after(task, moves)
        assert np.abs(np.frombuffer(base64.b64decode(found["V"]), np.float64) - V).max() <= 1e-12
        assert found["pi"] == pi.tolist()
        exact = rl.evaluate_policy(mdp, pi)
        assert found["offPolicy"] == pytest.approx(np.abs(V - exact).max(), abs=1e-8)
        assert found["offBest"] == pytest.approx(np.abs(V - star.V).max(), abs=1e-9)
        assert found["gap"] == pytest.approx((star.V - exact).max(), abs=1e-8)
        best = (star.Q.max(axis=1) - star.Q[np.arange(mdp.S), pi] <= 1e-9) & ~mdp.terminal
        assert found["right"] == best.sum()
        products = moves.count("s") * mdp.S * mdp.K + moves.count("i") * mdp.S * mdp.A * mdp.K
        assert found["work"] == products
    for n, run in zip((1, 3, 10, 30, None), found["runs"], strict=True):
        assert {name: run[name] for name in ("sweeps", "improvements")} == costs(mdp, straight, n, 0.001)
        assert run["gap"] <= 0.001 * gamma / (1 - gamma) * 2


def test_full_evaluations_and_improvements_are_policy_iteration(js):
    mdp, pi = SLIPPERY.mdp(), np.full(697, 2)
    rounds = rl.policy_iteration(mdp, pi=pi)
    moves = ("s" * 120 + "i") * (rounds.residuals.size - 1)
    given = {"scenario": _scenario.scenario_of(SLIPPERY), "moves": moves, "pi": pi.tolist(), "tol": 0.001}
    assert js(STEPS, given)["pi"] == rounds.pi.tolist()


def test_steps_go_forward_and_back(page_of):
    here = page_of(PolicyIteration(SLIPPERY))
    expect(answer(here)).to_contain_text("nothing is known of its values yet")
    assert button(here, "Back").get_attribute("aria-disabled") == "true"
    for _ in range(3):
        button(here, "One sweep").click()
    button(here, "Improve").click()
    V, pi = after(SLIPPERY, "sssi")
    changed = (pi != after(SLIPPERY, "")[1]).sum()
    expect(answer(here)).to_contain_text(f"Step 4: improved. {changed} poses changed the turn.")
    assert number(here, "changed") == changed
    exact = rl.evaluate_policy(SLIPPERY.mdp(), pi)
    assert number(here, "off-policy") == pytest.approx(np.abs(V - exact).max(), abs=1e-8)
    button(here, "Back").click()
    expect(answer(here)).to_contain_text("Step 3: one sweep.")
    assert state_of(here.page)["moves"] == "sss"
    button(here, "Start again").click()
    expect(answer(here)).to_contain_text("nothing is known of its values yet")
    assert state_of(here.page)["moves"] == ""


def test_a_run_ends_with_an_optimal_policy_and_tells_what_it_cost(page_of):
    here = page_of(PolicyIteration(SMALL, sweeps=10))
    button(here, "Run to the end").click()
    expect(button(here, "Run again")).to_be_visible(timeout=20_000)
    expect(answer(here)).to_contain_text("The policy is optimal")
    here.page.get_by_role("radio", name="30").check(force=True)
    button(here, "Run again").click()
    rows = here.page.locator(".rl-rounds-runs tbody tr")
    expect(rows).to_have_count(2, timeout=20_000)
    mdp = SMALL.mdp()
    for row, n in zip(rows.all(), (10, 30), strict=True):
        found = [float(one.get_attribute("value")) for one in row.locator("data").all()]
        assert found[:2] == list(costs(mdp, np.full(mdp.S, 1), n, 0.001).values())
    assert state_of(here.page)["tried"] == [10, 30]
    best = rl.solve(mdp).Q
    moves = state_of(here.page)["moves"]
    pi = after(SMALL, moves)[1]
    assert np.allclose(best.max(axis=1), best[np.arange(mdp.S), pi])


def test_it_works_by_keyboard_and_tells_what_an_improvement_would_do(page_of):
    here = page_of(PolicyIteration(SLIPPERY, moves="sss"))
    page = here.page
    page.get_by_role("application").focus()
    for key in ("ArrowUp", "ArrowRight", "r"):
        page.keyboard.press(key)
    V = after(SLIPPERY, "sss")[0]
    s = SLIPPERY.index(rl.Pose(1, 1, 135))
    q = rl.action_values(SLIPPERY.mdp(), V)[s]
    readout = page.locator(".rl-rounds-readout")
    expect(readout).to_contain_text("Cell (1, 1), heading 135°: straight on")
    expect(readout).to_contain_text(f"{q.max():.2f}".rstrip("0").replace("-", "−"))
    button(here, "One sweep").focus()
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(answer(here)).to_contain_text("Step 5: improved")


def test_a_finger_can_do_it_too(page_of):
    here = page_of(PolicyIteration(SLIPPERY), width="telephone")
    button(here, "One sweep").tap()
    button(here, "Improve").tap()
    expect(answer(here)).to_contain_text("Step 2: improved")
    for name in ("Back", "One sweep", "Improve", "Run to the end"):
        assert button(here, name).bounding_box()["height"] >= 44
    here.page.get_by_label("Headings").select_option("heading 90° ↑")
    here.page.get_by_role("radio", name="Changed").tap()
    assert {name: state_of(here.page)[name] for name in ("heading", "show")} == {"heading": 90, "show": "changed"}


def test_the_same_steps_are_taken_in_another_world(page_of):
    here = page_of(PolicyIteration(SLIPPERY, moves="ssissi"))
    field = here.page.get_by_label("Slip, as a number")
    field.fill("0.3")
    field.press("Enter")
    other = rl.Task(OBSTACLES, rl.Robot(slip=0.3), gamma=0.95)
    V, pi = after(other, "ssissi")
    exact = rl.evaluate_policy(other.mdp(), pi)
    assert number(here, "off-policy") == pytest.approx(np.abs(V - exact).max(), abs=1e-8)
    assert state_of(here.page)["moves"] == "ssissi"


def test_a_policy_and_a_reward_of_the_readers_own_are_the_beginning(page_of):
    def reward(t):
        return 3.0 if t.goal else -7.0 if t.crash else -0.2

    task = rl.Task(OBSTACLES, rl.Robot(slip=0.1), reward=reward)
    mdp = task.mdp()
    pi = rl.greedy(np.random.default_rng(0).random((mdp.S, mdp.A)))
    here = page_of(PolicyIteration(task, pi, moves="ss"))
    V = after(task, "ss", pi)[0]
    assert number(here, "off-policy") == pytest.approx(np.abs(V - rl.evaluate_policy(mdp, pi)).max(), abs=1e-8)


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(PolicyIteration(SLIPPERY))
    kernel_sets(here.page, {"moves": "ssi"})
    expect(answer(here)).to_contain_text("Step 3: improved")
    kernel_sets(here.page, {"moves": "sx"})
    expect(here.page.get_by_role("alert").first).to_contain_text("`moves` must be")
    expect(answer(here)).to_contain_text("Step 3: improved")
    button(here, "One sweep").click()
    expect(answer(here)).to_contain_text("Step 4: one sweep")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(PolicyIteration(SLIPPERY, moves="sssiss"), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"moves": "sxi"}, "`moves` must be at most 2000 letters"),
        ({"sweeps": 4}, "`sweeps` must be 1, 3, 10, 30 or None"),
        ({"tol": 0}, "`tol` must be a finite number above 0"),
        ({"show": "wave"}, "`show` must be one of"),
        ({"heading": 30}, "`heading` must be one of"),
        ({"policy": np.full((697, 5), 0.2)}, "`policy` must be one action a state"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        PolicyIteration(SLIPPERY, **settings)


def test_the_still_picture_tells_what_it_shows():
    shown = PolicyIteration(SLIPPERY, moves="ssi")
    assert "after 2 sweeps of evaluation and 1 improvements" in repr(shown)
    shown.state = shown.state | {"moves": ""}
    assert not shown.V.any()
