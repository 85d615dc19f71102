"""The kernel plays along: it computes what only Python can, shows what Python learned, and may die without a loss."""

import re

from playwright.sync_api import expect

from ..widgets.arena import Arena

OWN_REWARD = """
import rlnav as rl

def paid(t):
    return 5.0 if t.goal else -2.0 if t.crash else -0.25

task = rl.Task(rl.GridWorld.from_ascii(">...\\n....\\n....\\n...G"), reward=paid)
sim = rl.widgets.Simulator(task, episodes=60, seed=1, view={"speed": "max"})
sim
"""
OWN_RULE = """
import rlnav as rl

task = rl.Task(rl.GridWorld.from_ascii(">...\\n....\\n....\\n...G"))

def mine(Q, s, a, r, s_next, a_next, gamma, alpha):
    Q[s, a] += alpha * (r + gamma * Q[s_next].max() - Q[s, a])

run = rl.learn(task.mdp(), mine, task.phi(), episodes=300, alpha=0.5, rng=0, snapshots=20)
sim = rl.widgets.Simulator(task, training=run, view={"speed": "max"})
sim
"""
ENDLESS = """
import rlnav as rl
sim = rl.widgets.Simulator(episodes=1_000_000, view={"speed": "100"})
sim
"""
PAIR = """
import ipywidgets, rlnav as rl
one, other = rl.widgets.Simulator(seed=1, episodes=30), rl.widgets.Simulator(seed=2, episodes=30)
ipywidgets.HBox([one, other])
"""


def updates(sim):
    """How many updates the run bar tells of."""
    words = sim.element.locator(".rl-run-words").text_content()
    return int(re.search(r"([\d,]+) updates?", words)[1].replace(",", ""))


def test_a_reward_of_the_readers_own_is_computed_anew_when_a_wall_is_drawn(notebook):
    it = notebook(OWN_REWARD)
    sim = Arena(it.run())
    before = it.ask("sim.tables['mdp']")
    sim.open("World").get_by_role("radio", name="Obstacle").check()
    sim.drag((1, 0), (1, 1))
    it.wait_until("sim.tables['task']['map'] == ['....', '....', '.#..', '.#.G']")
    assert it.ask("sim.tables['mdp']") != before
    assert it.ask("sim.task.reward is paid")
    sim.press("Train")
    sim.wait_for(f"Episode 60 of 60, {it.ask('int(sim.train().steps.sum())'):,} updates")


def test_a_wall_around_the_goal_is_told_and_mended(notebook):
    it = notebook(OWN_REWARD)
    sim = Arena(it.run())
    sim.open("World").get_by_role("radio", name="Obstacle").check()
    sim.drag((2, 0), (2, 1), (3, 1))
    it.wait_until("'error' in sim.tables")
    sim.wait_for("goal")
    expect(sim.element.get_by_role("button", name="Train", exact=True)).to_have_attribute("aria-disabled", "true")
    sim.element.get_by_role("radio", name="Erase").check()
    sim.drag((3, 1), (3, 1))
    it.wait_until("'mdp' in sim.tables")
    sim.press("Train")
    sim.wait_for("Episode 60 of 60")


def test_what_python_learned_is_played(notebook):
    it = notebook(OWN_RULE)
    sim = Arena(it.run())
    sim.press("Train")
    sim.wait_for("Episode 300 of 300")
    x, y = sim.at(0, 3)
    sim.page.mouse.move(x + 15, y)  # the wedge that looks east
    values = it.ask("run.snapshots[-1][task.phi()[task.index(rl.Pose(0, 3, 0))]].tolist()")
    assert max(values) > 1
    expect(sim.element.locator("[data-key=inspector]")).to_contain_text(f"{max(values):.2f}")


def test_two_simulators_side_by_side_keep_apart(notebook):
    it = notebook(PAIR)
    output = it.run()
    one, other = Arena(output, 0), Arena(output, 1)
    one.press("Train")
    other.press("Train")
    other.drag((7, 7), (2, 8))
    it.wait_until("other.task.world.goal == (2, 8)")
    assert it.ask("one.task.world.goal") == [7, 7]
    one.wait_for("Episode 30 of 30")


def test_two_views_of_one_simulator_show_the_same(notebook):
    it = notebook(ENDLESS, "sim")
    one, other = Arena(it.run()), Arena(it.run(1))
    one.drag((7, 7), (2, 8))
    other.says("the goal at (2, 8)")
    other.drag((2, 8), (4, 4))
    one.says("the goal at (4, 4)")
    it.wait_until("sim.task.world.goal == (4, 4)")


def test_a_kernel_that_dies_while_it_plays_is_told_and_nothing_else_changes(notebook):
    it = notebook(ENDLESS)
    sim = Arena(it.run())
    sim.press("Train")
    it.kill()
    sim.wait_for("The kernel no longer answers")
    it.page.get_by_role("dialog").get_by_role("button", name="Ok").click()
    seen = updates(sim)
    expect(sim.element.locator(".rl-run-words")).not_to_have_text(re.compile(f" {seen:,} updates"))
    assert updates(sim) > seen
    sim.drag((7, 7), (2, 8))
    sim.says("the goal at (2, 8)")


def test_a_kernel_that_was_shut_down_is_told_with_the_next_change(notebook):
    it = notebook(ENDLESS)
    sim = Arena(it.run())
    it.shut_down()
    sim.drag((7, 7), (2, 8))
    sim.wait_for("The kernel no longer answers")
    sim.says("the goal at (2, 8)")


def test_a_page_that_is_loaded_again_finds_its_simulator_in_the_kernel(notebook, lab):
    it = notebook(ENDLESS)
    sim = Arena(it.run())
    sim.drag((7, 7), (2, 8))
    it.wait_until("sim.task.world.goal == (2, 8)")
    it.save()
    lab.load()
    again = lab.reopen(it.name)
    Arena(again.output()).says("the goal at (2, 8)")
