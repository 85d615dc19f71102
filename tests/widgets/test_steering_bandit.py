"""The steering bandit: its luck and its strategies are the library's, and it is played by mouse, touch and keyboard."""

import base64

import numpy as np
import pytest
from playwright.sync_api import expect

import browsing
import rlnav as rl
from accessibility import findings
from rlnav.widgets import SteeringBandit

from .pages import kernel_sets, settled
from .pages import state_now as state_of

TASK = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES), rl.Robot(slip=0.1))
POSE = rl.Pose(0, 6, 315)
PULLS = 300
SETTINGS = {"epsilon": 0.1, "tau": 0.7, "c": 2.0, "Q0": 0.0, "alpha": None}

PLAY = """async ({values, noise, name, settings, seed, pulls}) => {
  const {Bandit, STRATEGIES, luckOf, play, summedUp} = await import('/scenario/bandit.js');
  const bits = array => btoa(Array.from(new Uint8Array(array.buffer), byte => String.fromCharCode(byte)).join(''));
  const bandit = new Bandit(values, noise);
  const {chosen, Q, N} = play(bandit, STRATEGIES[name], settings, luckOf(seed, pulls), pulls);
  return {chosen: Array.from(chosen), Q: bits(Q), N: Array.from(N), regret: bits(summedUp(bandit, chosen))};
}"""
CROWD = """async ({values, noise, names, settings, robots, pulls}) => {
  const {Bandit, Crowd} = await import('/scenario/bandit.js');
  const crowd = new Crowd(new Bandit(values, noise), names, settings, {robots, pulls});
  while (crowd.runFor(5));
  return crowd.rows.map(row => {
    const {mean, off} = crowd.curve(row);
    return {mean: Array.from(mean), off: Array.from(off), best: row.best / crowd.done};
  });
}"""


def game(**settings):
    return SteeringBandit(TASK, POSE, **settings)


def floats(text):
    return np.frombuffer(base64.b64decode(text), np.float64)


def pay(q, noise, v):
    return q + noise * (np.searchsorted(np.array([1, 5, 11, 15]) / 16, v, side="right") - 2)


def choose(name, Q, N, t, settings, u, w):
    """Choose as the chapter does: Q, N and two random numbers."""
    A = Q.size
    if name == "softmax":
        chances = np.exp((Q - Q.max()) / settings["tau"])
        return int((w * chances.sum() >= chances.cumsum()).sum())
    if name == "epsilon" and u < settings["epsilon"]:
        return int(w * A)
    bounds = Q
    if name == "ucb":
        with np.errstate(divide="ignore", invalid="ignore"):
            bounds = np.where(N > 0, Q + settings["c"] * np.sqrt(np.log(t + 1) / N), np.inf)
    tied = np.flatnonzero(bounds == bounds.max())
    return int(tied[int(w * tied.size)])


def played(q, noise, name, settings, seed, pulls):
    rng = np.random.default_rng(seed)
    Q, N, chosen = np.full(q.size, settings["Q0"] if name == "greedy" else 0.0), np.zeros(q.size), []
    for t in range(pulls):
        _, u, w, _, _, v = rng.random(6)
        a = choose(name, Q, N, t, settings, u, w)
        N[a] += 1
        Q[a] += (settings["alpha"] or 1 / N[a]) * (pay(q[a], noise, v) - Q[a])
        chosen.append(a)
    return chosen, Q


@pytest.mark.parametrize("name", ["greedy", "epsilon", "softmax", "ucb"])
@pytest.mark.parametrize(("alpha", "Q0"), [(None, 0.0), (0.1, 10.0)])
def test_a_strategy_chooses_as_in_python(js, name, alpha, Q0):
    q, settings = game().values, SETTINGS | {"alpha": alpha, "Q0": Q0}
    for seed in (0, 7):
        given = {"values": q.tolist(), "noise": 2, "name": name, "settings": settings, "seed": seed, "pulls": PULLS}
        found = js(PLAY, given)
        chosen, Q = played(q, 2.0, name, settings, seed, PULLS)
        assert found["chosen"] == chosen
        assert np.array_equal(floats(found["Q"]), Q)
        assert found["N"] == np.bincount(chosen, minlength=5).tolist()
        assert np.allclose(floats(found["regret"]), (q.max() - q[chosen]).cumsum(), atol=1e-10)


def test_an_exploring_robot_is_the_learner_of_the_library_bit_for_bit(js):
    widget, counts = game(), np.zeros(5)

    def mean(Q, s, a, r, s_next, a_next, gamma, alpha):
        counts[a] += 1
        rl.q_learning_rule(Q, s, a, r, s_next, a_next, gamma, 1 / counts[a])

    learned = rl.learn(widget.mdp(), mean, episodes=PULLS, epsilon=0.1, rng=3)
    given = {"values": widget.values.tolist(), "noise": 2, "name": "epsilon", "settings": SETTINGS, "seed": 3}
    found = js(PLAY, {**given, "pulls": PULLS})
    assert np.array_equal(floats(found["Q"]), learned.Q[0])
    constant = rl.q_learning(widget.mdp(), episodes=PULLS, alpha=0.25, epsilon=0.1, rng=3)
    found = js(PLAY, {**given, "settings": SETTINGS | {"alpha": 0.25}, "pulls": PULLS})
    assert np.array_equal(floats(found["Q"]), constant.Q[0])


def test_bands_are_confidence_intervals_of_the_mean(js):
    q, robots = game().values, 30
    given = {"values": q.tolist(), "noise": 2, "names": ["epsilon", "ucb"], "settings": SETTINGS}
    found = js(CROWD, {**given, "robots": robots, "pulls": 100})
    for row, name in zip(found, ("epsilon", "ucb"), strict=True):
        chosen = np.array([played(q, 2.0, name, SETTINGS, seed, 100)[0] for seed in range(robots)])
        regret = (q.max() - q[chosen]).cumsum(axis=1)
        assert row["mean"] == pytest.approx(regret.mean(axis=0), abs=1e-9)
        assert row["off"] == pytest.approx(1.96 * regret.std(axis=0, ddof=1) / np.sqrt(robots), abs=1e-6)
        assert row["best"] == pytest.approx((chosen[:, -1] == q.argmax()).mean())


def answer(here):
    return here.page.locator(".rl-answer")


def arm(here, a):
    return here.page.locator(".rl-arms tbody tr").nth(a)


def reveal(here):
    return here.page.get_by_role("button", name="Tell me the truth")


def paid(turns, seed=0, noise=2.0):
    luck = np.random.default_rng(seed).random((len(turns), 6))[:, 5]
    return np.array([pay(game().values[a], noise, v) for a, v in zip(turns, luck, strict=True)])


def test_a_game_by_hand_counts_averages_and_tells_what_it_cost(page_of):
    here = page_of(game())
    expect(answer(here)).to_contain_text("Take one, and see what it pays")
    assert reveal(here).get_attribute("aria-disabled") == "true"
    turns = [0, 1, 2, 3, 4, 4, 4, 1]
    for a in turns:
        arm(here, a).get_by_role("button").click()
    expect(arm(here, 4).locator("td").nth(0)).to_have_text("3")
    mean = float(arm(here, 4).locator("data").nth(1).get_attribute("value"))
    assert mean == pytest.approx(paid(turns)[np.array(turns) == 4].mean(), abs=1e-12)
    assert state_of(here.page)["turns"] == turns
    reveal(here).click()
    q = game().values
    lost = (q.max() - q[turns]).sum()
    expect(answer(here)).to_contain_text(
        f"worth {q.max():.2f} on average. You took it 3 of 8 times and lost {lost:.1f}"
    )
    for a in range(5):
        assert float(arm(here, a).locator(".rl-arm-truth").get_attribute("value")) == pytest.approx(q[a], abs=1e-9)
    expect(here.page.locator(".rl-rival-result").first).to_contain_text("200 robots", timeout=20_000)
    mine = float(here.page.locator(".rl-mine").nth(1).get_attribute("value"))
    chosen = played(q, 2.0, "epsilon", SETTINGS, 0, 8)[0]
    assert mine == pytest.approx((q.max() - q[chosen]).sum(), abs=1e-9)
    assert arm(here, 0).get_by_role("button").get_attribute("aria-disabled") == "true"


def test_a_new_game_is_another_pose_and_start_again_goes_back(page_of):
    here = page_of(game(turns=[0, 1], shown=True))
    here.page.get_by_role("button", name="New game").click()
    settled(here.page)
    state = state_of(here.page)
    assert (state["turns"], state["shown"], state["scenario"]["seed"]) == ([], False, 1)
    assert state["pose"] != [0, 6, 315]
    q = SteeringBandit(TASK, rl.Pose(*state["pose"])).values
    assert np.sort(q)[-1] - np.sort(q)[-2] > 0.25
    here.page.get_by_role("button", name="Start again").click()
    expect(answer(here)).to_contain_text("You took it 0 of 2 times")


def test_strategies_are_chosen_and_set_and_the_numbers_follow(page_of):
    here = page_of(game(turns=[4], shown=True, pulls=50))
    page = here.page
    page.get_by_label("Softmax", exact=True).check()
    page.get_by_label("UCB", exact=True).uncheck()
    field = page.get_by_label("ε-greedy: ε, as a number")
    field.fill("0.5")
    field.press("Enter")
    page.get_by_role("radio", name="0.1").check(force=True)
    expect(page.locator(".rl-rival-result").nth(1)).to_contain_text("200 robots", timeout=20_000)
    state = state_of(page)
    assert (state["playing"], state["epsilon"], state["alpha"]) == (["greedy", "epsilon", "softmax"], 0.5, 0.1)
    q, settings = game().values, SETTINGS | {"epsilon": 0.5, "alpha": 0.1}
    lost = [(q.max() - q[played(q, 2.0, "epsilon", settings, seed, 50)[0]]).sum() for seed in range(200)]
    assert float(page.locator(".rl-mean").nth(1).get_attribute("value")) == pytest.approx(np.mean(lost), abs=1e-9)


def test_it_works_by_keyboard_alone(page_of):
    here = page_of(game())
    page = here.page
    arm(here, 0).get_by_role("button").focus()
    for key in ("Enter", "3", "5", "Tab", "Space"):
        page.keyboard.press(key)
    assert state_of(page)["turns"] == [0, 2, 4, 1]
    reveal(here).focus()
    page.keyboard.press("Enter")
    expect(answer(here)).to_contain_text("You took it 1 of 4 times")
    assert page.evaluate("document.activeElement.textContent") == "New game"


def test_a_finger_can_play(page_of):
    here = page_of(game(), width="telephone")
    for a in (0, 4, 4):
        button = arm(here, a).get_by_role("button")
        assert button.bounding_box()["height"] >= 44
        button.tap()
    reveal(here).tap()
    expect(answer(here)).to_contain_text("You took it 2 of 3 times")


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(game())
    kernel_sets(here.page, {"turns": [4, 4], "noise": 0})
    expect(answer(here)).to_contain_text("+90° paid 4.8. 4 turns are still untried.")
    kernel_sets(here.page, {"noise": -1})
    expect(here.page.get_by_role("alert").first).to_contain_text("`noise` must be")
    expect(answer(here)).to_contain_text("+90° paid 4.8")


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme):
    here = page_of(game(turns=[0, 1, 2, 3, 4, 4], shown=True, pulls=50), width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"noise": -1}, "`noise` must be a finite number of at least 0"),
        ({"turns": [5]}, "`turns` must be an integer"),
        ({"playing": ["thompson"]}, "`playing` must be one of"),
        ({"epsilon": 2}, r"`epsilon` must be a number in \[0, 1\]"),
        ({"pulls": 3}, "`pulls` must be an integer"),
        ({"shown": "yes"}, "`shown` must be"),
        ({"luck": 1}, "`state` must be a dict with the keys"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises((ValueError, TypeError), match=message):
        game(**settings)
    with pytest.raises(ValueError, match="free cell"):
        SteeringBandit(TASK, rl.Pose(7, 8, 0))


def test_python_knows_the_bandit_and_hides_the_truth_until_it_is_told():
    widget = game()
    assert np.allclose(rl.solve(widget.mdp()).Q[0], widget.values)
    assert "3.57" not in repr(widget)
    widget.state = widget.state | {"shown": True}
    assert "True values: 3.57, 3.84, 2.49, 3.33, 4.78." in repr(widget)
