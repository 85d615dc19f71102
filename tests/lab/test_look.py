"""How explorables look in JupyterLab: each of them, in its dark theme, and in a notebook that was only stored."""

import re

import nbformat
import pytest

import rlnav as rl
from canonical import canonical
from execute import execute

from ..widgets.arena import Arena
from ..widgets.pages import first_button

EXPLORABLES = {  # what each is made from; most need a task only
    "Aliasing": "task, here",
    "ControlTour": "",
    "MergingPaths": "(roads := rl.Task(rl.GridWorld.from_ascii('>>.G'))), [2] * roads.mdp().S, drives=[0, 1, 0]",
    "MysteryRobot": "",
    "PaintPolicy": "task, here",
    "ReturnLine": "{'short': [0, 3], 'long': [0, 0, 0, 5]}",
    "SteeringBandit": "task, here",
    "StepSizes": "rl.Task(task.world, rl.Robot(slip=0.2)), here, 45",
}
TASK = """
import rlnav as rl
task = rl.Task(rl.GridWorld.from_ascii(">...\\n.#..\\n...G"))
here = rl.Pose(1, 2, 0)
"""
SIMULATOR = "import rlnav as rl\nrl.widgets.Simulator(episodes=20)"
LUMINANCE = """element => {
  const canvas = document.createElement("canvas").getContext("2d");
  const linear = c => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = color => {
    canvas.fillStyle = color;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map(linear);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  let ground = element;
  while (getComputedStyle(ground).backgroundColor === "rgba(0, 0, 0, 0)") ground = ground.parentElement;
  return [luminance(getComputedStyle(element).color), luminance(getComputedStyle(ground).backgroundColor)];
}"""


@pytest.mark.parametrize("name", sorted(set(rl.widgets.__all__) - {"Explorable", "Live", "Simulator"}))
def test_an_explorable_starts_and_tells_its_state_to_the_kernel(notebook, name):
    it = notebook(TASK, f"w = rl.widgets.{name}({EXPLORABLES.get(name, 'task')})\nw")
    it.run()
    root = it.run(1).locator(".rlnav")
    it.tell("before = w.state")
    if name == "RewardMixer":  # its colored button plays what the settings ask for, and changes none
        root.get_by_label("Recipe").select_option(index=1)
    else:
        first_button(root).click()
    it.wait_until("w.state != before")
    assert root.get_by_role("alert").filter(has_text=re.compile(r"\w")).count() == 0


def test_keys_pressed_in_its_controls_are_not_for_the_notebook(notebook):
    """JupyterLab would go to the next cell with an arrow key, and cut the cell with x."""
    it = notebook(TASK, "w = rl.widgets.ValueWave(task)\nw", "'the last cell'")
    it.run()
    root = it.run(1).locator(".rlnav")
    front = "() => [jupyterapp.shell.currentWidget.content].map(n => [n.activeCellIndex, n.widgets.length])[0]"
    gamma = it.ask("w.state['scenario']['gamma']")
    slider = root.get_by_role("slider", name="Discount γ")
    slider.focus()
    before = it.page.evaluate(front)
    slider.press("ArrowRight")
    it.wait_until(f"w.state['scenario']['gamma'] > {gamma}")
    root.get_by_role("button", name="One sweep").press("x")
    assert it.page.evaluate(front) == before


def test_the_dark_theme_is_followed_while_it_is_open(notebook, lab):
    sim = Arena(notebook(SIMULATOR).run())
    words = sim.element.locator(".rl-run-words")
    light = words.evaluate(LUMINANCE)
    lab.theme("JupyterLab Dark")
    dark = words.evaluate(LUMINANCE)
    assert light[0] < light[1]
    assert dark[0] > dark[1]
    for ink, ground in (light, dark):
        assert (max(ink, ground) + 0.05) / (min(ink, ground) + 0.05) >= 4.5


def test_a_stored_notebook_shows_the_still_picture(lab, tmp_path):
    """There is no kernel that knows the widget, so JupyterLab would only say that it does not find it."""
    path = tmp_path / "stored.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SIMULATOR)]), path)
    (lab.folder / "stored.ipynb").write_text(canonical(execute(path)))
    output = lab.reopen("stored").output()
    picture = output.get_by_role("img")
    assert "Map with the value of every pose" in picture.get_attribute("alt")
    assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 200
    assert "Error" not in output.inner_text()
