"""Controls that drive a Python function, and its result beneath them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from html import escape
from typing import Any

import ipywidgets

from .._check import fail, show
from ._controls import describe, listed, make_controls, name_of, tidy
from ._still import Still, framed, no_open_figures, render


class Live(ipywidgets.VBox):
    """Call `fn` with the values of the controls, and show what it returns; again whenever a control moves.

    Parameters
    ----------
    fn : callable
        Called as ``fn(**values)``. Returns a matplotlib Figure or Axes, or any object to be shown as text, or a pair
        (figure, sentence): the sentence is printed below the figure.
    controls : dict
        One entry for each argument of `fn`: (low, high, step) gives a slider, a list a menu, True or False a box to
        tick; an ipywidgets control is used as it is. A control starts at the default of the argument, if it has one.
    alt : str
        What the result shows, for those who cannot see it. May hold the values, as in "Values at gamma {gamma}.".

    Attributes
    ----------
    controls : dict of ipywidgets
        ``live.controls["gamma"].value = 0.9`` moves a control from Python.
    error : Exception or None
        What `fn` raised in the last call. The last good result stays on the page, with the message above it.

    Raises
    ------
    ValueError, TypeError
        If `fn`, `controls` and `alt` do not fit together. What `fn` itself raises is raised here as well.

    Examples
    --------
    >>> def horizon(gamma=0.9):
    ...     return f"{1 / (1 - gamma):.0f} steps"
    >>> Live(horizon, {"gamma": (0.5, 0.99, 0.01)}, alt="How far an agent looks ahead at gamma {gamma}.")
    Live(horizon)
      gamma = 0.9, from 0.5 to 0.99 in steps of 0.01
    shows: How far an agent looks ahead at gamma 0.9.
    10 steps
    """

    def __init__(self, fn: Callable[..., Any], controls: Mapping[str, Any], *, alt: str = "") -> None:
        self.controls = make_controls(fn, controls)
        self.error: Exception | None = None
        self._fn, self._alt = fn, alt
        _check_alt(alt, self.values)
        self._shown = self._call()
        self._area = ipywidgets.HTML(framed(self._shown, self._shown.sentence))
        super().__init__([tidy(self.controls), self._area])
        for control in self.controls.values():
            control.observe(self._redraw, names="value")

    @property
    def values(self) -> dict[str, Any]:
        """The value of every control, without the last-digit noise of a slider's steps."""
        values = {name: control.value for name, control in self.controls.items()}
        return {name: round(value, 12) if isinstance(value, float) else value for name, value in values.items()}

    def _call(self) -> Still:
        """Call the function and draw what it returns. Every figure that it opened is closed again."""
        with no_open_figures():
            return render(self._fn(**self.values), self._alt.format(**self.values))

    def _redraw(self, change: object) -> None:
        try:
            self._shown = self._call()
            self.error = None
        except Exception as error:
            self.error = error
            error.add_note(f"The controls stood at {listed(self.values)}.")
            raise  # so that in a notebook under test the cell that moved the control fails
        finally:
            message = _message(self.error, self.values) if self.error else ""
            self._area.value = message + framed(self._shown, self._shown.sentence)

    def __repr__(self) -> str:
        lines = [f"Live({name_of(self._fn)})"]
        lines += [f"  {name} = {describe(control)}" for name, control in self.controls.items()]
        lines += [self._shown.words]
        if self.error is not None:
            lines += [f"then failed with {type(self.error).__name__}: {self.error}"]
        return "\n".join(lines)

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """Offer controls to a notebook, the bare result to a page without Python, every setting as text to a test."""
        settings = f"{listed(self.values)}. Run this notebook to move the controls."
        still = framed(self._shown, self._shown.sentence, settings)
        return {**super()._repr_mimebundle_(**kwargs), "text/html": still, "text/plain": repr(self)}


def _check_alt(alt: str, values: Mapping[str, Any]) -> None:
    if not isinstance(alt, str) or not alt.strip():
        advice = "Write it for a reader who cannot see the figure."
        fail("alt", 'a sentence that says what the result shows, such as "Values at gamma {gamma}."', show(alt), advice)
    try:
        alt.format(**values)
    except (LookupError, ValueError, AttributeError) as reason:
        fail("alt", f"a text with no names in braces but {', '.join(values)}", f"{show(alt)} ({reason!r})")


def _message(error: Exception, values: Mapping[str, Any]) -> str:
    """Say what went wrong, above the last good result."""
    what = escape(f"{type(error).__name__}: {error}")
    where = escape(listed(values))
    return (
        '<p role="alert" style="margin: 0.5em 0; padding: 0.25em 0.75em; border-left: 4px solid #d55e00; '
        f'line-height: 1.5"><strong>{what}</strong><br>at {where}. Below is the last result that worked.</p>'
    )
