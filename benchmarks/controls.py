"""Measure how long a control of a chapter makes its reader wait: the function, its figure, and the figure as SVG."""

from __future__ import annotations

import contextlib
import io
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import nbformat
import numpy as np

import rlnav as rl

VALUES = 7  # places of a slider that are tried, at most


def made_by(notebook: Path) -> list[rl.widgets.Live]:
    """Run a chapter and return its controls."""
    made: list[rl.widgets.Live] = []
    live = rl.widgets.Live

    class Noted(live):
        def __init__(self, *args: Any, **settings: Any) -> None:
            super().__init__(*args, **settings)
            made.append(self)

    names: dict[str, Any] = {}
    rl.widgets.Live = Noted
    try:
        for cell in nbformat.read(notebook, 4).cells:
            if cell.cell_type == "code":
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile(cell.source, f"{notebook.name} {cell.id}", "exec"), names)
                plt.close("all")
    finally:
        rl.widgets.Live = live
    return made


def places(control: Any) -> list[Any]:
    """List values over the whole range of a control."""
    if hasattr(control, "options"):
        return list(control.options)[:VALUES]
    if isinstance(control.value, bool):
        return [False, True]
    steps = round((control.max - control.min) / control.step)
    chosen = np.unique(np.linspace(0, steps, VALUES).round().astype(int))
    return [type(control.value)(control.min + int(step) * control.step) for step in chosen]


def waits(control: Any) -> Iterator[float]:
    """Move a control over its range and back; yield the CPU milliseconds of each answer."""
    first, tried = control.value, places(control)
    for value in [*tried, first]:
        if value != control.value:
            began = time.process_time()
            control.value = value
            yield 1000 * (time.process_time() - began)


def rows(notebook: Path) -> list[tuple[object, ...]]:
    """List chapter, control's function, control, and the median and the longest answer in milliseconds."""
    mpl.use("module://matplotlib_inline.backend_inline")
    answers = [
        (repr(live).partition("\n")[0], name, list(waits(control)))
        for live in made_by(notebook)
        for name, control in live.controls.items()
    ]
    return [(notebook.stem, *control, float(np.median(took)), max(took)) for *control, took in answers if took]
