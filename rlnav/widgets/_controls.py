"""From the short forms that an author writes to labeled ipywidgets in tidy columns."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Mapping
from decimal import Decimal
from numbers import Integral, Real
from typing import Any

import ipywidgets

from .._check import fail, function, show

Controls = dict[str, ipywidgets.ValueWidget]


def make_controls(fn: Callable[..., Any], controls: Mapping[str, Any]) -> Controls:
    """One labeled control for each argument of `fn`, at the argument's default where it has one."""
    function("fn", fn, "of the values of the controls")
    if not isinstance(controls, Mapping) or not controls:
        fail("controls", "a dict with one entry for each argument of `fn`", show(controls), kind=TypeError)
    signature = inspect.signature(fn)
    try:
        signature.bind(**dict.fromkeys(controls))
    except TypeError as mismatch:
        advice = "Give a control to every argument that has no default."
        expected = f"named as the arguments of {name_of(fn)}{signature}"
        fail("controls", expected, f"{', '.join(controls)} ({mismatch})", advice)
    defaults = {name: p.default for name, p in signature.parameters.items() if p.default is not p.empty}
    made = {name: _make_control(name, form, defaults.get(name)) for name, form in controls.items()}
    label_width = f"{max(map(len, made)) + 1}ch"
    for name, control in made.items():
        if control is not controls[name]:
            control.style.description_width = label_width
    return made


def tidy(controls: Controls) -> ipywidgets.GridBox:
    """Lay the controls out in two columns, or in one where the page is narrow."""
    columns = "repeat(auto-fill, minmax(min(100%, 24em), 1fr))"
    layout = ipywidgets.Layout(grid_template_columns=columns, grid_gap="0 1.5em", max_width="52em")
    return ipywidgets.GridBox(list(controls.values()), layout=layout)


def describe(control: ipywidgets.ValueWidget) -> str:
    """Write down the value of a control and all it may become, as text that a test compares."""
    if hasattr(control, "options"):
        return f"{control.value!r}, one of {', '.join(map(repr, control.options))}"
    if hasattr(control, "min") and hasattr(control, "max"):
        step = f" in steps of {control.step}" if hasattr(control, "step") else ""
        return f"{control.value}, from {control.min} to {control.max}{step}"
    return repr(control.value)


def listed(values: Mapping[str, Any]) -> str:
    """Write the settings in one line, such as `gamma 0.9, slip 0.1`."""
    return ", ".join(f"{name} {value}" for name, value in values.items())


def name_of(fn: Callable[..., Any]) -> str:
    """Return the name of a function, or of its type where it has none."""
    return getattr(fn, "__name__", type(fn).__name__)


def _make_control(name: str, form: Any, default: Any) -> ipywidgets.ValueWidget:
    look = {"description": name, "layout": ipywidgets.Layout(width="auto")}
    match form:
        case ipywidgets.ValueWidget():
            form.description = form.description or name
            return form
        case bool():
            return ipywidgets.Checkbox(bool(_start(name, default, form, (True, False))), **look)
        case [first, *_] if isinstance(form, list):
            return ipywidgets.Dropdown(options=form, value=_start(name, default, first, form), **look)
        case (Real(), Real(), Real()) if isinstance(form, tuple) and form[0] < form[1] and form[2] > 0:
            return _make_slider(name, form, default, look)
    expected = "(low, high, step) with low < high and step > 0, a list, True or False, or an ipywidgets control"
    return fail(f"controls[{name!r}]", expected, show(form))


def _make_slider(name: str, form: tuple[Any, Any, Any], default: Any, look: dict[str, Any]) -> ipywidgets.ValueWidget:
    low, high, step = form
    value = low if default is None else default
    if not isinstance(value, Real) or not low <= value <= high:
        fail(f"controls[{name!r}]", f"a range that holds the default of `{name}`, {show(value)}", show(form))
    if all(isinstance(number, Integral) for number in (*form, value)):
        return ipywidgets.IntSlider(value, low, high, step, **look)
    decimals = max(0, -int(Decimal(str(step)).as_tuple().exponent))
    return ipywidgets.FloatSlider(value, min=low, max=high, step=step, readout_format=f".{decimals}f", **look)


def _start(name: str, default: Any, first: Any, options: Collection[Any]) -> Any:
    if default is None:
        return first
    if default not in options:
        fail(f"controls[{name!r}]", f"options that hold the default of `{name}`, {show(default)}", show(options))
    return default
