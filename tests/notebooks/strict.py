"""A pytest plugin that compares all of a notebook: `python -m pytest -p tests.notebooks.strict book`.

`nbval` runs the cells and compares text; this adds what it leaves out: images by their pixels, the order and the
metadata of outputs, the state of widgets with what they have captured, and cells that were never run. An explorable is
stored as HTML that holds its whole state, and compared by that.
"""

from __future__ import annotations

import base64
import io
import re
from pathlib import Path
from typing import Any

import nbval.plugin as nbval
import numpy as np
import pytest
from PIL import Image

from canonical import WIDGET_VIEW, is_program, number_widgets, rename_widgets, shown_widgets, widget_models

GREY_LEVELS = 2  # by how much a channel of a pixel may differ: less than an eye can see
IMAGE = re.compile(r"iVBORw0KGgo|/9j/")  # how a PNG and a JPEG begin in base64
CAPTURED = ("stream", "display_data", "execute_result", "error")


class Pixels:
    """An image that is equal to another one when no eye can tell them apart."""

    def __init__(self, encoded: str) -> None:
        image = Image.open(io.BytesIO(base64.b64decode(encoded)))
        self.rgba = np.asarray(image.convert("RGBA")).astype(int)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pixels) or self.rgba.shape != other.rgba.shape:
            return False
        return bool(np.abs(self.rgba - other.rgba).max(initial=0) <= GREY_LEVELS)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        height, width = self.rgba.shape[:2]
        return f"<image of {width} x {height} pixels, mean {self.rgba.mean():.3f}>"


def comparable(part: Any) -> Any:
    """Copy a part of a notebook with images as pixels, and without what differs from run to run."""
    if isinstance(part, str):
        return Pixels(part) if IMAGE.match(part) else part
    if isinstance(part, list | tuple):
        return [comparable(item) for item in part]
    if isinstance(part, dict):
        changing = {"execution_count", "traceback", "transient", "msg_id", WIDGET_VIEW}
        return {key: comparable(value) for key, value in part.items() if key not in changing}
    return part


class Widgets:
    """The widgets of a running notebook, followed through the messages of its kernel."""

    def __init__(self) -> None:
        self.models: dict[str, dict[str, Any]] = {}
        self.shown: list[str] = []
        self._capturing: dict[str, str] = {}  # by request: the Output widget that takes what it prints

    def follow(self, message: dict[str, Any]) -> bool:
        """Take in one message. True if an Output widget has captured it, so that the cell does not show it."""
        kind, content = message["msg_type"], message["content"]
        if kind in ("comm_open", "comm_msg"):
            self._update(content["comm_id"], content["data"], message.get("buffers", []))
        elif kind == "clear_output" or kind in CAPTURED:
            model_id = self._capturing.get(message["parent_header"].get("msg_id"))
            if model_id is not None and kind != "error":  # an error in a callback is an error of its cell
                self._capture(self.models[model_id]["state"], kind, content)
                return True
            view = content.get("data", {}).get(WIDGET_VIEW)
            self.shown += [view["model_id"]] if view else []
        return False

    def _update(self, model_id: str, data: dict[str, Any], buffers: list[Any]) -> None:
        model = self.models.setdefault(model_id, {"state": {}, "buffers": {}})
        model["state"].update(data.get("state", {}))
        for path, buffer in zip(data.get("buffer_paths", []), buffers, strict=True):
            model["buffers"][str(path)] = base64.b64encode(buffer).decode()
        if "msg_id" in data.get("state", {}):
            self._capturing = {request: other for request, other in self._capturing.items() if other != model_id}
            if request := data["state"]["msg_id"]:
                self._capturing[request] = model_id

    @staticmethod
    def _capture(state: dict[str, Any], kind: str, content: dict[str, Any]) -> None:
        outputs = list(state.get("outputs", ()))
        if kind == "clear_output" or state.pop("clear_next", False):
            state["clear_next"] = content.get("wait", False) and kind == "clear_output"
            outputs = outputs if state["clear_next"] else []
        if kind == "stream" and outputs and outputs[-1].get("name") == content["name"]:
            outputs[-1] = {**outputs[-1], "text": outputs[-1]["text"] + content["text"]}
        elif kind in CAPTURED:
            outputs.append({"output_type": kind, **content})
        state["outputs"] = outputs


class StrictCell(nbval.IPyNbCell):
    """A cell whose outputs are compared in full."""

    def runtest(self) -> None:
        if self.cell.source.strip() and self.cell.execution_count is None:
            self.raise_cell_error("This cell was never run. Execute the notebook before it is committed.")
        if self.options["skip"] or not self.options["check"]:
            self.raise_cell_error("This cell switches its own test off.")
        super().runtest()

    def sanitize(self, part: Any) -> Any:
        return comparable(super().sanitize(part))

    def compare_outputs(self, test: list[Any], ref: list[Any], skip_compare: Any = None) -> bool:
        if not super().compare_outputs(test, ref, skip_compare):
            return False
        stored, new = comparable(ref), comparable(test)
        if stored != new:
            self.format_output_compare("order or metadata of the outputs", stored, new)
        return stored == new


class WidgetStates(pytest.Item):
    """After the last cell: the widgets stand in the kernel as they are stored in the notebook."""

    def runtest(self) -> None:
        stored, new = widget_models(self.parent.nb), self.parent.widgets.models
        shown = shown_widgets(self.parent.nb)
        missing = [model_id for model_id in shown if model_id not in stored]
        assert not missing, "The state of a widget is not stored. Execute the notebook with tools/execute.py."
        new_shown = [model_id for model_id in self.parent.widgets.shown if not is_program(new[model_id])]
        assert _states(new, new_shown) == _states(stored, shown)

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, 0, f"{self.path.name}::widget states"


def _states(models: dict[str, Any], shown: list[str]) -> dict[str, Any]:
    """Return state and binary data of each widget that the page shows, by its number on the page."""
    new_ids = number_widgets(models, shown)
    states = {}
    for model_id, number in new_ids.items():
        buffers = models[model_id].get("buffers", {})
        if isinstance(buffers, list):  # as they are stored
            buffers = {str(buffer["path"]): buffer["data"] for buffer in buffers}
        states[number] = comparable(rename_widgets([models[model_id]["state"], buffers], new_ids))
    return states


class StrictFile(nbval.IPyNbFile):
    """A notebook whose cells and widgets are compared in full."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.skip_compare = tuple(key for key in self.skip_compare if key not in ("image/png", "image/jpeg"))
        self.widgets = Widgets()

    def collect(self) -> Any:
        for cell in super().collect():
            own = {"cell_num": cell.cell_num, "cell": cell.cell, "options": cell.options}
            yield StrictCell.from_parent(self, name=cell.name, **own)
        yield WidgetStates.from_parent(self, name="widget states")

    def get_kernel_message(self, timeout: float | None = None, stream: str = "iopub") -> dict[str, Any]:
        while True:
            message = super().get_kernel_message(timeout=timeout, stream=stream)
            if stream != "iopub" or not self.widgets.follow(message):
                return message


def pytest_configure(config: pytest.Config) -> None:
    config.option.nbval = True
    config.option.nbval_current_env = True
    config.option.nbval_cell_timeout = 60.0


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Any:
    found = yield
    return [StrictFile.from_parent(parent, path=file_path) if type(f) is nbval.IPyNbFile else f for f in found]
