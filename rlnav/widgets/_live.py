"""Controls that drive a Python function, and its result beneath them."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any
from urllib.parse import quote

import ipywidgets
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from .._check import fail, show
from ..plot import to_svg
from ._controls import describe, listed, make_controls, name_of, tidy

_PLAIN_IN_URL = " !$&'()*+,-./:;=?@[]^_`{|}~"  # left as they are: shorter than base64, and text compresses well


@dataclass(frozen=True)
class _Shown:
    """What one call of the function put on the page: HTML, the sentence below it, and both in words for a test."""

    body: str
    sentence: str
    words: str


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
        self._area = ipywidgets.HTML(_framed(self._shown, self._shown.sentence))
        super().__init__([tidy(self.controls), self._area])
        for control in self.controls.values():
            control.observe(self._redraw, names="value")

    @property
    def values(self) -> dict[str, Any]:
        """The value of every control, without the last-digit noise of a slider's steps."""
        values = {name: control.value for name, control in self.controls.items()}
        return {name: round(value, 12) if isinstance(value, float) else value for name, value in values.items()}

    def _call(self) -> _Shown:
        """Call the function and draw what it returns. Every figure that it opened is closed again."""
        already_open = set(plt.get_fignums())
        try:
            return _render(self._fn(**self.values), self._alt.format(**self.values))
        finally:
            for number in set(plt.get_fignums()) - already_open:
                plt.close(number)

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
            self._area.value = message + _framed(self._shown, self._shown.sentence)

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
        still = _framed(self._shown, self._shown.sentence, settings)
        return {**super()._repr_mimebundle_(**kwargs), "text/html": still, "text/plain": repr(self)}


def _check_alt(alt: str, values: Mapping[str, Any]) -> None:
    if not isinstance(alt, str) or not alt.strip():
        advice = "Write it for a reader who cannot see the figure."
        fail("alt", 'a sentence that says what the result shows, such as "Values at gamma {gamma}."', show(alt), advice)
    try:
        alt.format(**values)
    except (LookupError, ValueError, AttributeError) as reason:
        fail("alt", f"a text with no names in braces but {', '.join(values)}", f"{show(alt)} ({reason!r})")


def _render(result: Any, alt: str) -> _Shown:
    drawing, sentence = result if isinstance(result, tuple) and len(result) == 2 else (result, "")
    figure = drawing if isinstance(drawing, Figure) else getattr(drawing, "figure", None)
    if isinstance(figure, Figure):
        return _render_figure(figure, str(sentence or ""), alt)
    if result is None:
        advice = "End the function with `return` and what it drew."
        fail("fn", "a function that returns a figure, axes or something to print", "None", advice, TypeError)
    text = f'<pre style="margin: 0; white-space: pre-wrap">{escape(str(result))}</pre>'
    return _Shown(f'<div role="group" aria-label="{escape(alt)}">{text}</div>', "", f"shows: {alt}\n{result}")


def _render_figure(figure: Figure, sentence: str, alt: str) -> _Shown:
    svg = to_svg(figure)
    plt.close(figure)
    width, height = (round(96 * inches) for inches in figure.get_size_inches())  # known before the image has loaded
    image = (
        f'<img src="data:image/svg+xml,{quote(svg, safe=_PLAIN_IN_URL)}" alt="{escape(alt)}" '
        f'width="{width}" height="{height}" style="max-width: 100%; height: auto">'
    )
    digest = hashlib.sha256(svg.encode()).hexdigest()[:12]
    return _Shown(image, sentence, "\n".join(filter(None, [f"shows: {alt}", sentence, f"figure {digest}"])))


def _framed(shown: _Shown, *caption: str) -> str:
    lines = "<br>".join(escape(line) for line in caption if line)
    caption_below = f'<figcaption style="line-height: 1.5">{lines}</figcaption>' if lines else ""
    return f'<figure class="rl-live" style="margin: 0">{shown.body}{caption_below}</figure>'


def _message(error: Exception, values: Mapping[str, Any]) -> str:
    """Say what went wrong, above the last good result."""
    what = escape(f"{type(error).__name__}: {error}")
    where = escape(listed(values))
    return (
        '<p role="alert" style="margin: 0.5em 0; padding: 0.25em 0.75em; border-left: 4px solid #d55e00; '
        f'line-height: 1.5"><strong>{what}</strong><br>at {where}. Below is the last result that worked.</p>'
    )
