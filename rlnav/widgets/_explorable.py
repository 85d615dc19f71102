"""What every explorable is: a small program in the browser, its settings in Python, and a still picture for paper."""

from __future__ import annotations

import inspect
import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any, ClassVar

import anywidget
import traitlets

from .._check import fail, show
from . import _bundle
from ._still import Still, digest, framed, no_open_figures, render

HINT = "Interactive in the built book and in a running notebook."


class State(traitlets.Dict):
    """A trait that holds nothing but what its explorable has checked."""

    def validate(self, obj: Any, value: Any) -> dict[str, Any]:
        """Return the checked state, or raise before anything has changed."""
        if not isinstance(value, Mapping):
            fail("state", "a dict", f"{show(value)} ({type(value).__name__})", kind=TypeError)
        return obj.checked(dict(value))


class Explorable(anywidget.AnyWidget):
    """Show a figure that readers operate: with a running kernel, in the built page, and still on paper.

    A subclass names its program in the browser (`entry`) and its `defaults`, checks its state, and draws its still
    picture::

        class ValueWave(Explorable):
            entry = "explorables/value_wave"
            defaults = {"scenario": DEFAULTS, "sweep": 0}
            alt = "Map with the value of every pose."

            def checked(self, state):
                return super().checked(state)  # raise ValueError or TypeError for what cannot be

            def still(self):
                return rl.plot.values(...)

    Attributes
    ----------
    state : dict
        All settings, as plain data. The browser changes it as the reader does, and shows what Python assigns; assign a
        new dict, for a change inside the old one is not noticed.
    tables : dict or None
        Arrays that only Python can compute, such as the model of a reward that is the reader's own function.
    training : dict or None
        A run of Python's that the browser plays.
    """

    __signature__: ClassVar[inspect.Signature]
    entry: ClassVar[str]
    defaults: ClassVar[Mapping[str, Any]] = {}
    alt: Any = ""  # a sentence for readers who cannot see the picture; a property where it depends on the state

    state = State().tag(sync=True)
    tables = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    training = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Tell editors and the reference the arguments, which a widget's own `__new__` hides."""
        super().__init_subclass__(**kwargs)
        cls.__signature__ = inspect.signature(partial(cls.__init__, None))  # type: ignore[arg-type]

    def __init__(self, state: Mapping[str, Any] | None = None, **traits: Any) -> None:
        self._drawn: tuple[str, Still] | None = None
        super().__init__(state={**self.defaults, **(state or {})}, **traits)

    @property
    def _esm(self) -> str:  # anywidget makes a trait of it, once an instance is made
        return _bundle.module(self.entry)

    @property
    def _css(self) -> str:
        return _bundle.stylesheet(self.entry)

    def checked(self, state: dict[str, Any]) -> dict[str, Any]:
        """Return the state in its complete form. A subclass checks more."""
        for name in state:
            if name not in self.defaults:
                fail("state", f"a dict with the keys {', '.join(self.defaults)}", f"the key {name!r}")
        return {**self.defaults, **state}

    def still(self) -> Any:
        """Draw the still picture: a figure, axes, or a pair of one of them and a sentence."""
        raise NotImplementedError

    def __repr__(self) -> str:
        lines = [type(self).__name__]
        lines += [f"  {name} = {value!r}" for name, value in _differences(self.state, self.defaults)]
        for name in ("tables", "training"):
            if (data := getattr(self, name)) is not None:
                lines += [f"  {name}: {digest(_json(data))}"]
        return "\n".join([*lines, self._still().words])

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """Offer the program to a notebook, its still picture to all others, and every setting as text to a test."""
        data, metadata = super()._repr_mimebundle_(**kwargs) or ({}, {})
        return {**data, "text/html": self.html(), "text/plain": repr(self)}, metadata

    def html(self) -> str:
        """Return what a page shows: the still picture, and the data with which the page's own script replaces it."""
        data = {"state": self.state, "tables": self.tables, "training": self.training}
        stored = "".join(f" data-{name}='{_quoted(_json(part))}'" for name, part in data.items() if part is not None)
        still = self._still()
        figure = framed(still, still.sentence, HINT)
        return f'<div class="rlnav-explorable" data-entry="{self.entry}"{stored}>{figure}</div>'

    def _still(self) -> Still:
        """Draw the picture, unless it has been drawn with the same settings already."""
        settings = _json([self.state, self.tables, self.training])
        if self._drawn is None or self._drawn[0] != settings:
            with no_open_figures():
                self._drawn = settings, render(self.still(), self.alt)
        return self._drawn[1]


def _json(data: Any) -> str:
    return json.dumps(data, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _quoted(text: str) -> str:
    """Make a text fit between single quotes in HTML; JSON is full of double ones."""
    for character, name in (("&", "&amp;"), ("'", "&#39;"), ("<", "&lt;"), (">", "&gt;")):
        text = text.replace(character, name)
    return text


def _differences(state: Any, defaults: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """List the settings that are not at their defaults, such as ("scenario.alpha", 0.5)."""
    if isinstance(state, Mapping) and isinstance(defaults, Mapping):
        for key in sorted(state):
            yield from _differences(state[key], defaults.get(key), f"{name}.{key}" if name else key)
    elif state != defaults:
        yield name, state
