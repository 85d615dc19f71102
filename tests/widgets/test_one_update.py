"""The one-update inspector: the run of Python bit for bit, a time machine that is exact, and words that fit."""

import json
import re

import numpy as np
import pytest

import browsing
import rlnav as rl
from accessibility import findings
from rlnav._sampling import expected
from rlnav.widgets import OneUpdate, _scenario

from .pages import kernel_sets
from .pages import state_now as state_of

OBSTACLES = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
SLIPPERY = rl.Task(rl.GridWorld.from_ascii("..#.\n....\n.#..\n>..G"), rl.Robot(slip=0.3))
HALL = rl.Task(rl.GridWorld.from_ascii(">..........G"), rl.Robot((-45, 0, 45)))
PARTS = ("after", "before", "alpha", "reward", "gamma", "next", "target", "td-error")


def words(here):
    return here.page.locator(".rl-answer").inner_text()


def shown(here):
    """The numbers of the formula, exactly, by their names."""
    read = "all => all.map(one => [one.dataset.part, one.querySelector('data')?.value ?? null])"
    return dict(here.page.locator("[data-part]").evaluate_all(read))


def button(here, name):
    return here.page.get_by_role("button", name=name, exact=True)


def log_of(task, rule, **settings):
    """Every update of a run in Python: (before, alpha, r, gamma, next row, after, Q)."""
    log = []
    mdp = task.mdp()

    def take_notes(Q, s, a, r, s_next, a_next, gamma, alpha):
        row, before = Q[s_next].copy(), Q[s, a]
        rule(Q, s, a, r, s_next, a_next, gamma, alpha)
        log.append((before, alpha, r, gamma, row, a_next, Q[s, a]))

    run = rl.learn(mdp, take_notes, task.phi(), **settings)
    return log, run


def numbers_in(note, following):
    before, alpha, r, gamma, row, a_next, after = note
    target = r + gamma * following(row, a_next)
    return dict(
        zip(PARTS, (after, before, alpha, r, gamma, following(row, a_next), target, target - before), strict=True)
    )


RULES = {
    "q_learning": (rl.q_learning_rule, lambda row, a_next: row.max()),
    "sarsa": (rl.sarsa_rule, lambda row, a_next: row[a_next]),
    "expected_sarsa": (
        lambda Q, s, a, r, s_next, a_next, gamma, alpha: Q.__setitem__(
            (s, a), Q[s, a] + alpha * (r + gamma * expected(Q, s_next, 0.3) - Q[s, a])
        ),
        lambda row, a_next: expected(row[None], 0, 0.3),
    ),
}


@pytest.mark.parametrize("algorithm", RULES)
def test_every_number_of_an_update_is_that_of_python_to_the_last_bit(page_of, algorithm):
    rule, following = RULES[algorithm]
    settings = {"alpha": 0.3, "epsilon": 0.3, "episodes": 60, "max_steps": 20}
    log, _ = log_of(SLIPPERY, rule, rng=5, **settings)
    here = page_of(OneUpdate(SLIPPERY, algorithm=algorithm, seed=5, update=len(log) - 12, **settings))
    for left, note in zip(range(12, -1, -1), log[-13:], strict=True):
        assert {name: float(value) for name, value in shown(here).items()} == numbers_in(note, following)
        if left:
            button(here, "One step").click()
    assert button(here, "One step").get_attribute("aria-disabled") == "true"
    assert int(state_of(here.page)["update"]) == len(log)


def test_the_time_machine_comes_back_to_the_same_bits(js):
    rng = np.random.default_rng(0)
    goto = rng.integers(0, 4000, 40).tolist()
    program = """async ({scenario, goto}) => {
      const {timelineOf} = await import('/scenario/timeline.js');
      const {taskOf, learnerOptions} = await import('/scenario/model.js');
      const {ruleOf, partsOf} = await import('/scenario/update.js');
      const task = taskOf(scenario);
      const make = () => timelineOf(task.mdp(), task.phi(), ruleOf('q_learning', false), learnerOptions(scenario));
      const told = line => JSON.stringify([line.now, Array.from(line.learner.Q), line.path, line.learner.episode,
                                           line.now && partsOf(line.learner, 'q_learning')]);
      const travelled = make();
      return goto.map(n => {
        travelled.seek(n);
        const fresh = make();
        fresh.seek(n);
        return told(travelled) === told(fresh) && travelled.now === n;
      });
    }"""
    scenario = _scenario.scenario_of(OBSTACLES, alpha=0.5, epsilon=0.2, episodes=2000)
    assert js(program, {"scenario": scenario, "goto": goto}) == [True] * len(goto)


def test_an_update_is_found_by_its_kind_forward_and_back(page_of):
    settings = {"alpha": 0.5, "epsilon": 0.1, "episodes": 1500}
    log, run = log_of(OBSTACLES, rl.q_learning_rule, rng=0, **settings)
    ends = run.steps.cumsum()
    goals = ends[run.success]
    here = page_of(OneUpdate(OBSTACLES, **settings))
    at = lambda: state_of(here.page)["update"]  # noqa: E731
    kind = here.page.get_by_label("Jump to")
    for end in ends[:3]:
        button(here, "Next").click()
        assert at() == end
    button(here, "Previous").click()
    assert at() == ends[1]
    kind.select_option("arrival at the goal")
    button(here, "Next").click()
    assert at() == goals[0]
    assert "The goal is reached: nothing follows the end, so γ is 0" in words(here)
    assert shown(here)["gamma"] == "0"
    kind.select_option("error above 1")
    surprises = [n for n, (b, _, r, g, row, _, _) in enumerate(log, 1) if abs(r + g * row.max() - b) > 1]
    button(here, "Next").click()
    assert at() == next(n for n in surprises if n > goals[0])
    button(here, "Previous").click()
    button(here, "Previous").click()
    assert at() == max(n for n in surprises if n < goals[0])


def test_a_search_in_vain_says_so_and_stays(page_of):
    here = page_of(OneUpdate(OBSTACLES, episodes=20, update=3))
    here.page.get_by_label("Jump to").select_option("arrival at the goal")
    button(here, "Next").click()
    here.page.get_by_text("has no such update").wait_for()
    assert state_of(here.page)["update"] == 3


def test_steps_go_back_to_the_beginning(page_of):
    here = page_of(OneUpdate(OBSTACLES, update=2))
    button(here, "Back").click()
    assert words(here).startswith("Update 1, episode 1: at (1, 1)")
    button(here, "Back").click()
    assert words(here).startswith("Nothing is learned yet.")
    assert button(here, "Back").get_attribute("aria-disabled") == "true"
    assert set(shown(here).values()) == {None}


def test_the_scrubber_and_its_number_reach_every_update(page_of):
    here = page_of(OneUpdate(OBSTACLES, update=500))
    number = here.page.get_by_label("Update, as a number")
    number.fill("77")
    number.press("Enter")
    assert words(here).startswith("Update 77, ")
    slider = here.page.get_by_role("slider", name="Update")
    slider.focus()
    slider.press("ArrowLeft")
    assert words(here).startswith("Update 76, ")
    slider.press("End")
    assert words(here).startswith("Update 500, ")


def test_it_plays_and_pauses(page_of):
    here = page_of(OneUpdate(OBSTACLES, episodes=30))
    speed = here.page.get_by_label("Speed of playing")
    speed.select_option("50 steps a second")
    button(here, "Play").click()
    here.page.wait_for_function("Number(document.querySelector('.rl-answer').textContent.match(/\\d+/)) > 5")
    button(here, "Pause").click()
    n = state_of(here.page)["update"]
    assert n > 5
    assert words(here).startswith(f"Update {n}, ")
    speed.select_option("as fast as it can")
    button(here, "Play").click()
    last = log_of(OBSTACLES, rl.q_learning_rule, rng=0, alpha=0.5, epsilon=0.1, episodes=30)[1].steps.sum()
    here.page.wait_for_function(f"document.querySelector('.rl-answer').textContent.startsWith('Update {last},')")
    assert button(here, "Play").get_attribute("aria-disabled") == "true"


@pytest.mark.parametrize(("label", "name", "value"), [("Step size α", "alpha", 0.2), ("Discount γ", "gamma", 0.5)])
def test_a_change_begins_a_new_run_at_the_same_update(page_of, label, name, value):
    here = page_of(OneUpdate(OBSTACLES, alpha=0.5, update=150))
    field = here.page.get_by_label(f"{label}, as a number")
    field.fill(str(value))
    field.press("Enter")
    task = rl.Task(OBSTACLES.world, gamma=value if name == "gamma" else 0.95)
    again = OneUpdate(task, alpha=value if name == "alpha" else 0.5, update=150)
    assert state_of(here.page)["update"] == 150
    assert float(shown(here)["after"]) == again.last.after
    assert float(shown(here)["before"]) == again.last.before
    button(here, "Start again").click()
    assert float(shown(here)["after"]) == OneUpdate(OBSTACLES, alpha=0.5, update=150).last.after


def test_the_algorithms_differ_in_one_term(page_of):
    here = page_of(OneUpdate(OBSTACLES, update=40))
    terms = {}
    for name in ("Q-learning", "SARSA", "Expected SARSA"):
        here.page.get_by_role("radio", name=name, exact=True).check()
        terms[name] = here.page.locator(".rl-above").all_inner_texts()
    q, sarsa, expected_sarsa = terms.values()
    for other in (sarsa, expected_sarsa):
        assert sum(a != b for a, b in zip(q, other, strict=True)) == 1
    assert state_of(here.page)["scenario"]["algorithm"] == "expected_sarsa"


def rows_of(here):
    return here.page.locator(".rl-two-rows tbody tr").evaluate_all(
        "rows => rows.map(row => [...row.querySelectorAll('data')].map(one => Number(one.value)))"
    )


def test_both_rows_are_those_before_the_update_even_where_they_are_one(page_of):
    task = rl.Task(SLIPPERY.world, SLIPPERY.robot, features=rl.designs.moves_ahead())
    settings = {"alpha": 0.5, "episodes": 40, "max_steps": 30}
    rows = []

    def take_notes(Q, s, a, r, s_next, a_next, gamma, alpha):
        rows.append((s, s_next, Q[s].copy(), Q[s_next].copy()))
        rl.q_learning_rule(Q, s, a, r, s_next, a_next, gamma, alpha)

    rl.learn(task.mdp(), take_notes, task.phi(), rng=0, epsilon=0.1, **settings)
    same = [n for n, (s, s_next, own, _) in enumerate(rows) if s == s_next and own.any()]
    assert same
    n = same[-1]
    here = page_of(OneUpdate(task, update=n + 1, **settings))
    assert rows_of(here) == np.transpose(rows[n][2:]).tolist()


def test_a_guess_is_told_what_went_wrong_and_then_the_number(page_of):
    here = page_of(OneUpdate(OBSTACLES, alpha=0.5, episodes=1500, update=11741, guess=True))
    button(here, "One step").click()
    assert shown(here)["after"] is None
    assert "target" not in shown(here)
    assert "4.675" not in here.page.locator(".rl-explorable").inner_text()
    field, verdict = here.page.get_by_label("The entry after this update"), here.page.locator(".rl-verdict")
    tried = {
        "7.025": "whole target",
        "2,35": "That is the change",
        "−0.025": "wrong way",
        "4.863": "The discount is missing",
        "4.725": "The reward is missing",
        "1.113": "The next row is missing",
        "what": "Type a number",
        "100": "Not yet. The entry was 2.325, and it rises.",
    }
    for guess, answer in tried.items():
        field.fill(guess)
        field.press("Enter")
        assert answer in verdict.inner_text()
    field.fill("4.68")
    button(here, "Check").click()
    assert not field.is_visible()
    assert shown(here)["after"] == "4.675000000000001"
    assert "The entry rises from 2.325 to 4.675." in words(here)
    button(here, "One step").click()  # the next one ends at the goal: nothing follows
    field.fill("8.75")
    field.press("Enter")
    assert "The entry rises from 7.5 to 8.75" in words(here)
    button(here, "One step").click()
    button(here, "Show it").click()
    assert shown(here)["after"] is not None


def test_the_end_can_be_given_a_value_and_the_table_then_promises_too_much(page_of):
    settings = {"alpha": 0.5, "Q0": 50, "episodes": 50}
    here = page_of(OneUpdate(HALL, update=1, end_has_value=True, **settings))
    kind = here.page.get_by_label("Jump to")
    kind.select_option("end of an episode")
    button(here, "Next").click()
    numbers = {name: float(value) for name, value in shown(here).items()}
    assert numbers["gamma"] == 0.95
    assert numbers["next"] == 50
    assert "careless" in words(here)
    n = state_of(here.page)["update"]
    assert OneUpdate(HALL, update=n, end_has_value=True, **settings).last.after == numbers["after"]
    here.page.get_by_text("Break it").click()
    here.page.get_by_label("Let something follow the end").uncheck()
    kind.select_option("end of an episode")
    button(here, "Next").click()
    assert shown(here)["gamma"] == "0"


def test_own_rewards_and_features_of_the_reader_are_learned_with(page_of):
    def reward(t):
        return 5.0 if t.goal else -3.0 if t.crash else -0.25

    task = rl.Task(OBSTACLES.world, reward=reward, features=lambda pose: pose.x + 10 * pose.y)
    settings = {"alpha": 0.4, "episodes": 100, "update": 321}
    here = page_of(OneUpdate(task, **settings))
    last = OneUpdate(task, **settings).last
    assert [float(shown(here)[name]) for name in ("before", "after", "reward")] == [last.before, last.after, last.r]


def test_the_lecture_view_takes_steps_with_the_space_bar(page_of):
    here = page_of(OneUpdate(OBSTACLES))
    button(here, "Lecture view").click()
    for n in (1, 2, 3):
        here.page.keyboard.press("Space")
        assert words(here).startswith(f"Update {n}, ")
    box = button(here, "One step").bounding_box()
    assert box["y"] + box["height"] <= 900  # in view, whatever the map's size
    here.page.keyboard.press("Escape")
    button(here, "Lecture view").wait_for()


def test_a_finger_takes_steps(page_of):
    here = page_of(OneUpdate(OBSTACLES), width="telephone")
    button(here, "One step").tap()
    button(here, "One step").tap()
    assert words(here).startswith("Update 2, ")
    for one in here.page.locator(".rl-explorable button").all():
        if one.is_visible():
            assert one.bounding_box()["height"] >= 44, one.inner_text()


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("algorithm", ["q_learning", "expected_sarsa"])
def test_nothing_is_wrong_for_those_who_use_other_senses(page_of, width, scheme, algorithm):
    widget = OneUpdate(OBSTACLES, algorithm=algorithm, update=11742, episodes=1500, guess=algorithm == "q_learning")
    here = page_of(widget, width=width, scheme=scheme)
    assert findings(here.page) == []
    assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"algorithm": "double_q_learning"}, "`algorithm` must be one of 'q_learning', 'sarsa', 'expected_sarsa'"),
        ({"alpha": 0}, r"`alpha` must be a number in \(0, 1\]"),
        ({"update": 500_001}, "`update` must be an integer from 0 to 500000"),
        ({"episodes": 0}, "`episodes` must be an integer"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        OneUpdate(OBSTACLES, **settings)


def test_an_update_beyond_the_end_is_the_last_one(page_of):
    widget = OneUpdate(OBSTACLES, episodes=3, update=400_000)
    here = page_of(widget)
    assert float(shown(here)["after"]) == widget.last.after
    assert button(here, "One step").get_attribute("aria-disabled") == "true"


@pytest.mark.parametrize("algorithm", RULES)
def test_paper_shows_the_table_and_the_numbers_of_the_update(algorithm):
    widget = OneUpdate(SLIPPERY, algorithm=algorithm, update=30)
    line = re.search(r"Update 30: (\S+) \+ 0.5 \[(\S+) \+ (\S+) \* (\S+) - (\S+)\] = (\S+)\.\n", repr(widget) + "\n")
    before, r, gamma, following, again, after = map(float, line.groups())
    assert before == again
    assert before + 0.5 * (r + gamma * following - before) == pytest.approx(after, abs=2e-3)
    assert json.loads(json.dumps(widget.state)) == widget.state
    assert "Before the first update." in repr(OneUpdate(SLIPPERY))


def test_what_a_kernel_sets_is_shown_and_nonsense_leaves_the_picture(page_of):
    here = page_of(OneUpdate(OBSTACLES, update=6))
    scenario = _scenario.scenario_of(OBSTACLES, alpha=0.25, epsilon=0.1, episodes=50, seed=4)
    kernel_sets(here.page, {"update": 9, "scenario": scenario})
    last = OneUpdate(OBSTACLES, alpha=0.25, epsilon=0.1, episodes=50, seed=4, update=9).last
    assert float(shown(here)["after"]) == last.after
    kernel_sets(here.page, {"scenario": scenario | {"alpha": 7}})
    here.page.get_by_role("alert").first.get_by_text("`alpha` must be").wait_for()
    assert float(shown(here)["after"]) == last.after
    button(here, "One step").click()
    assert words(here).startswith("Update 10, ")
