"""The one form in which notebooks are kept: nothing in it depends on when, where or by whom they were executed."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode

WIDGET_STATE = "application/vnd.jupyter.widget-state+json"
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"

KERNEL = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
LANGUAGE = {"file_extension": ".py", "mimetype": "text/x-python", "name": "python", "pygments_lexer": "ipython3"}
AUTHORS_NOTES = {"mystnb", "tags"}  # the metadata that authors write; editors and kernels write the rest


def read(path: Path) -> NotebookNode:
    """Read a notebook. A cell without an id gets one that follows from its text and place."""
    raw = json.loads(path.read_text(encoding="utf-8"))
    for place, cell in enumerate(raw["cells"]):
        name = f"{place} {''.join(cell['source'])}"
        cell.setdefault("id", hashlib.sha256(name.encode()).hexdigest()[:8])
    raw["nbformat_minor"] = max(5, raw["nbformat_minor"])
    return nbformat.reads(json.dumps(raw), as_version=4)


def canonical(notebook: NotebookNode) -> str:
    """Write a notebook as text that is the same whenever its cells and outputs are the same."""
    notebook = without_programs(notebook)
    models = widget_models(notebook)
    new_ids = number_widgets(models, shown_widgets(notebook))
    tidy = rename_widgets(notebook, new_ids)
    tidy.metadata = _notes(notebook) | {"kernelspec": KERNEL, "language_info": LANGUAGE}
    if new_ids:
        state = rename_widgets({model_id: models[model_id] for model_id in new_ids}, new_ids)
        tidy.metadata["widgets"] = {WIDGET_STATE: {"state": state, "version_major": 2, "version_minor": 0}}
    for cell in tidy.cells:
        cell.metadata = _notes(cell)
        for output in cell.get("outputs", ()):
            if output.output_type == "error":  # the rest of a traceback holds the paths of this machine
                output.traceback = [f"{output.ename}: {output.evalue}"]
    return nbformat.writes(nbformat.from_dict(tidy)) + "\n"


def widget_models(notebook: NotebookNode) -> dict[str, Any]:
    """Return the stored state of every widget, by model id."""
    return notebook.metadata.get("widgets", {}).get(WIDGET_STATE, {}).get("state", {})


def shown_widgets(notebook: NotebookNode) -> list[str]:
    """Return the model ids that the outputs show, in the order of the page."""
    outputs = (output for cell in notebook.cells for output in cell.get("outputs", ()))
    return [output.data[WIDGET_VIEW]["model_id"] for output in outputs if WIDGET_VIEW in output.get("data", {})]


def without_programs(notebook: NotebookNode) -> NotebookNode:
    """Copy a notebook in which widgets that bring a program along are shown by their HTML only.

    It holds all of their settings. Their views would need the program, which is no part of a notebook; without it
    JupyterLab would show an error where it can show their still picture.
    """
    notebook, models = nbformat.from_dict(json.loads(json.dumps(notebook))), widget_models(notebook)
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if "text/html" in data and WIDGET_VIEW in data and is_program(models.get(data[WIDGET_VIEW]["model_id"])):
                del data[WIDGET_VIEW]
    return notebook


def is_program(model: dict[str, Any] | None) -> bool:
    """Tell whether the state of a widget brings the program of an anywidget along."""
    return model is not None and "_esm" in model["state"]


def number_widgets(models: dict[str, Any], shown: list[str]) -> dict[str, str]:
    """Give the models numbers in the order in which the page reaches them, and none to those it does not reach."""
    new_ids: dict[str, str] = {}

    def visit(model_id: str) -> None:
        if model_id in models and model_id not in new_ids:
            new_ids[model_id] = f"{len(new_ids):032x}"
            for other in _mentioned(models[model_id]["state"]):
                visit(other)

    for model_id in shown:
        visit(model_id)
    for model_id in _links_between(models, new_ids):
        visit(model_id)
    return new_ids


def rename_widgets(part: Any, new_ids: dict[str, str]) -> Any:
    """Copy a part of a notebook with all its model ids replaced at once."""
    text = json.dumps(part)
    if new_ids:
        text = re.sub("|".join(map(re.escape, new_ids)), lambda found: new_ids[found[0]], text)
    return nbformat.from_dict(json.loads(text))


def _notes(node: NotebookNode) -> dict[str, Any]:
    return {key: value for key, value in node.metadata.items() if key in AUTHORS_NOTES}


def _mentioned(state: Any) -> Iterator[str]:
    """Yield the model ids in a state, which stand in references and in the captured outputs of an Output widget."""
    if isinstance(state, str) and state.startswith("IPY_MODEL_"):
        yield state.removeprefix("IPY_MODEL_")
    elif isinstance(state, dict):
        if isinstance(state.get("model_id"), str):
            yield state["model_id"]
        for key in sorted(state):
            yield from _mentioned(state[key])
    elif isinstance(state, list):
        for item in state:
            yield from _mentioned(item)


def _links_between(models: dict[str, Any], new_ids: dict[str, str]) -> list[str]:
    """Find what joins two numbered widgets in the browser: nothing mentions a link, it mentions its ends."""
    ends = {
        model_id: [(new_ids.get(end.removeprefix("IPY_MODEL_"), ""), trait) for end, trait in joined]
        for model_id, model in models.items()
        if (joined := [model["state"].get(end) for end in ("source", "target")]) and None not in joined
    }
    complete = [model_id for model_id, joined in ends.items() if all(number for number, _ in joined)]
    return sorted(complete, key=ends.__getitem__)
