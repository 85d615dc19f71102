"""The simulator in a live JupyterLab: the page and the kernel share one state, and neither needs the other to go on."""

import re

from playwright.sync_api import expect

from ..widgets.arena import Arena

TASK = """
import rlnav as rl
sim = rl.widgets.Simulator()
heard = []
sim.observe(heard.append, "state")
sim
"""


def test_what_is_drawn_in_the_page_is_the_task_in_the_kernel(notebook):
    it = notebook(TASK)
    sim = Arena(it.run())
    sim.drag((7, 7), (5, 8), (2, 8))
    it.wait_until("sim.task.world.goal == (2, 8)")
    sim.open("World").get_by_role("radio", name="Obstacle").check()
    sim.drag((4, 5), (6, 5))
    it.wait_until("sorted(sim.task.world.obstacles) == [(4, 5), (5, 5), (6, 5)]")
    assert it.ask("sim.scenario['map'][1]") == "..G......."
    assert it.ask("sim.scenario['map'][4]") == "....###..."
    assert it.ask("len(heard)") == 2, "one message for each change, however many cells the pointer crossed"


def test_keys_pressed_in_the_map_reach_the_kernel_and_not_the_notebook(notebook):
    """JupyterLab takes letters and Delete for commands to the notebook."""
    it = notebook(TASK, "second = 2")
    sim = Arena(it.run())
    sim.map.focus()
    for key in ("ArrowRight", "ArrowUp", "Space", "ArrowUp", "g", "ArrowUp", "s", "Delete"):
        it.page.keyboard.press(key)
    it.wait_until("sim.task.world.goal == (1, 2) and sim.scenario['starts'][0][:2] == [1, 3]")
    assert it.ask("list(sim.task.world.obstacles)") == [[1, 1]]
    expect(it.element.locator(".jp-CodeCell")).to_have_count(2)


def test_the_page_follows_what_python_sets(notebook):
    it = notebook(TASK)
    sim = Arena(it.run())
    it.tell("sim.scenario = sim.scenario | {'map': ['....', '.#..', '...G', '....'], 'starts': None, 'slip': 0.3}")
    sim.says("4 by 4 cells, 1 of them obstacles, the goal at (3, 1).")
    slip = sim.open("World").locator("[data-key=slip] input").first
    expect(slip).to_have_value("0.3")
    it.tell("sim.state = {**sim.state, 'view': {**sim.state['view'], 'numbers': True}}")
    numbers = sim.element.get_by_role("checkbox", name="Numbers")
    expect(numbers).to_be_checked()
    numbers.uncheck()
    it.wait_until("sim.state['view']['numbers'] is False")
    assert it.ask("len(heard)") == 3, "the page does not answer what it was told"


def test_what_python_refuses_changes_nothing(notebook):
    it = notebook(TASK, "sim.scenario = sim.scenario | {'slip': 3}")
    sim = Arena(it.run())
    expect(it.run(1, fails=True)).to_contain_text(re.compile("slip.*must be"))
    assert it.ask("sim.scenario['slip']") == 0
    sim.drag((7, 7), (2, 8))
    it.wait_until("sim.task.world.goal == (2, 8)")


def test_the_run_in_the_kernel_is_the_run_in_the_page(notebook):
    it = notebook(TASK)
    sim = Arena(it.run())
    it.tell("sim.state = {'scenario': sim.scenario | {'episodes': 40, 'seed': 3}, 'view': {'speed': 'max'}}")
    sim.press("Train")
    updates = it.ask("int(sim.train().steps.sum())")
    sim.wait_for(f"Episode 40 of 40, {updates:,} updates")
