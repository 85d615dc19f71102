"""Cells of a notebook, each with one change that a test of notebooks has to find."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Callable
from dataclasses import dataclass, field

import nbformat
import numpy as np
from nbformat import NotebookNode
from PIL import Image

from canonical import widget_models

Change = Callable[[NotebookNode], None]

SET_UP = """\
import io, warnings
import ipywidgets
from IPython.display import HTML, JSON, Image, Latex, display
from matplotlib.figure import Figure
import rlnav as rl
rl.plot.style()
def line(gamma=0.5, slip=0.0):
    if slip > 0.3: raise ArithmeticError("too slippery")
    figure = Figure(figsize=(2, 1))
    figure.subplots().plot([0, gamma])
    return figure, f"At most {gamma:.2f}."
def controls():
    return {"gamma": (0.5, 0.9, 0.1), "slip": [0.0, 0.2, 0.4]}
class Steps(rl.widgets.Explorable):
    entry, defaults, alt = "explorables/steps", {"steps": 1, "map": {"width": 4}}, "A line."
    _esm, _css = "export default { render() {} }", ""
    def still(self): return line(self.state["steps"] / 10)
"""
EXPLORABLE = "Steps({'steps': 5}, tables={'most': 9})"
REDRAWN = "Steps.still = lambda self: (line(0.6)[0], line(0.5)[1])"
LIVE = 'rl.widgets.Live(line, controls(), alt="A line up to {gamma}.")'
PNG = "buffer = io.BytesIO(); line()[0].savefig(buffer, dpi=50); Image(buffer.getvalue())"


@dataclass(frozen=True)
class Plant:
    """One cell, the change that is planted in it once it has been executed, and whether stock nbval finds that."""

    name: str
    source: str
    change: Change
    stock: bool = True
    tags: list[str] = field(default_factory=list)


def in_outputs(old: str, new: str) -> Change:
    """Change what is stored as the cell's result."""

    def change(cell: NotebookNode) -> None:
        text = json.dumps(cell.outputs)
        assert old in text, f"{old!r} is not in the outputs of {cell.source!r}"
        cell.outputs = nbformat.from_dict(json.loads(text.replace(old, new)))

    return change


def in_source(old: str, new: str) -> Change:
    """Change the code, so that it no longer gives the stored result."""

    def change(cell: NotebookNode) -> None:
        assert old in cell.source
        cell.source = cell.source.replace(old, new)

    return change


def pixel(cell: NotebookNode) -> None:
    """Change one pixel of a stored image."""
    data = cell.outputs[0].data
    pixels = np.array(Image.open(io.BytesIO(base64.b64decode(data["image/png"]))))
    pixels[5, 5, :3] = 255 - pixels[5, 5, :3]
    png = io.BytesIO()
    Image.fromarray(pixels).save(png, "png")
    data["image/png"] = base64.b64encode(png.getvalue()).decode()


def unrun(cell: NotebookNode) -> None:
    """Make the cell one that was written and never run."""
    cell.update(outputs=[], execution_count=None)


def no_output(cell: NotebookNode) -> None:
    """Remove the stored result."""
    cell.outputs = []


def twice(cell: NotebookNode) -> None:
    """Store the first result a second time."""
    cell.outputs = [cell.outputs[0], *cell.outputs]


def reverse(cell: NotebookNode) -> None:
    """Store the results in another order."""
    cell.outputs = cell.outputs[::-1]


def ignored(cell: NotebookNode) -> None:
    """Change a number and tell nbval to look away."""
    in_outputs("0.25", "0.24")(cell)
    cell.metadata["tags"] = ["nbval-ignore-output"]


PLANTS = [
    Plant("a number in a stream", "print('error', 0.25)", in_outputs("0.25", "0.24")),
    Plant("a number in a value", "0.25", in_outputs("0.25", "0.24")),
    Plant("a number in a table", "HTML('<td>0.25</td>')", in_outputs("0.25", "0.24")),
    Plant("a symbol in a formula", "Latex('$v_\\\\pi$')", in_outputs("pi", "mu")),
    Plant("an entry of JSON", "JSON({'steps': 7})", in_outputs("7", "8")),
    Plant("a line of a figure", "line()[0]", in_outputs("stroke-width: 1.5", "stroke-width: 1.6")),
    Plant("a pixel of an image", PNG, pixel, stock=False),
    Plant("an image that is no longer there", PNG, in_outputs("image/png", "image/gif")),
    Plant("the kind of an error", "line(slip=0.4)", in_outputs("Arithmetic", "Value"), tags=["raises-exception"]),
    Plant("the words of an error", "line(slip=0.4)", in_outputs("too slippery", "dry"), tags=["raises-exception"]),
    Plant("an error that no longer comes", "line(slip=0.4)", in_source("0.4", "0.2"), tags=["raises-exception"]),
    Plant("an error that is new", "_ = line(slip=0.2)", in_source("0.2", "0.4")),
    Plant("a warning that is new", "print('calm')", in_source("print", "warnings.warn('!'); print")),
    Plant("a result that is not stored", "0.25", no_output),
    Plant("a result that no longer comes", "print('once')", in_source("print", "str")),
    Plant("a result that is stored twice", "display(HTML('one'))", twice),
    Plant("results in another order", "print('one'); display(HTML('two'))", reverse, stock=False),
    Plant("a code cell that was never run", "print('once')", unrun, stock=False),
    Plant("a test that is switched off", "0.25", ignored, stock=False),
    Plant("metadata of a result", "display(HTML(''), metadata={'wide': 1})", in_outputs("wide", "tall"), stock=False),
    Plant("the value of a control", LIVE, in_outputs("gamma = 0.5", "gamma = 0.6")),
    Plant("the range of a control", LIVE, in_outputs("to 0.9", "to 0.8")),
    Plant("the options of a control", LIVE, in_source("controls()", "controls() | {'slip': [0.0, 0.2]}")),
    Plant("the alternative text of a figure", LIVE, in_source("A line", "One line")),
    Plant("the sentence below a figure", LIVE, in_outputs("At most", "At least")),
    Plant("the figure under the controls", LIVE, in_source("Live(line", "Live(lambda **v: (line(0.6)[0], line()[1])")),
    Plant("a setting of an explorable", EXPLORABLE, in_source("5", "6")),
    Plant("a setting that an explorable does not draw", EXPLORABLE, in_source("5}", "5, 'map': {'width': 8}}")),
    Plant("a setting in the page of an explorable", EXPLORABLE, in_outputs('\\"steps\\":5', '\\"steps\\":6')),
    Plant("the tables of an explorable", EXPLORABLE, in_source("9", "8")),
    Plant("the still picture of an explorable", EXPLORABLE, in_source("Steps", f"{REDRAWN}\nSteps")),
    Plant("the words of an explorable", EXPLORABLE, in_outputs("At most 0.50", "At most 0.60")),
    Plant("an error when a control moves", LIVE + ".controls['slip'].value = 0.2", in_source("= 0.2", "= 0.4")),
]

SLIDER = "import ipywidgets\nipywidgets.IntSlider(3, 0, 5)"
LINKED = """\
import ipywidgets
one, two = ipywidgets.IntSlider(), ipywidgets.IntSlider()
link = ipywidgets.jslink((one, "value"), (two, "value"))
ipywidgets.VBox([one, two])"""
OUTPUT = """\
import ipywidgets
area = ipywidgets.Output()
with area:
    print("captured")
area"""


def in_widgets(old: str, new: str) -> Change:
    """Change the stored state of the widgets."""

    def change(notebook: NotebookNode) -> None:
        text = json.dumps(notebook.metadata.widgets)
        assert old in text, f"{old!r} is not in the widgets"
        notebook.metadata.widgets = nbformat.from_dict(json.loads(text.replace(old, new)))

    return change


def in_cell(change: Change) -> Change:
    """Apply a change to the one cell of a notebook."""
    return lambda notebook: change(notebook.cells[0])


def no_widgets(notebook: NotebookNode) -> None:
    """Remove the state of the widgets, as JupyterLab does when it saves."""
    del notebook.metadata["widgets"]


def no_link(notebook: NotebookNode) -> None:
    """Remove the model that joins two sliders."""
    models = widget_models(notebook)
    (link,) = (model_id for model_id, model in models.items() if model["model_name"] == "LinkModel")
    del models[link]


# Each in a notebook of its own, found by the strict plugin alone: stock nbval never looks at widgets.
WIDGET_PLANTS = [
    Plant("the value of a slider", SLIDER, in_widgets('"value": 3', '"value": 4')),
    Plant("the range of a slider", SLIDER, in_widgets('"max": 5', '"max": 6')),
    Plant("widgets that are not stored", SLIDER, no_widgets),
    Plant("a link that is not stored", LINKED, no_link),
    Plant("the text in an Output widget", OUTPUT, in_widgets("captured", "taken")),
    Plant("an error that an Output widget swallows", OUTPUT, in_cell(in_source('"captured"', "1 / 0"))),
]
