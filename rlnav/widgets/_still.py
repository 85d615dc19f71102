"""The still picture of a control or an explorable: what a page without Python, a printout and a test show of it."""

from __future__ import annotations

import gc
import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from typing import Any
from urllib.parse import quote

from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from .._check import fail
from ..plot import to_svg

_PLAIN_IN_URL = " !$&'()*+,-./:;=?@[]^_`{|}~"  # left as they are: shorter than base64, and text compresses well


@dataclass(frozen=True)
class Still:
    """A result as HTML, the sentence below it, and both in words for a test."""

    body: str
    sentence: str
    words: str


@contextmanager
def no_open_figures() -> Iterator[None]:
    """Close every figure that is opened inside, and clear away what is left of it.

    A figure is thousands of objects that know each other.  Swept up while they are young they cost milliseconds; left
    to grow old, they would make every twentieth answer of a control wait for a sweep of everything that is in memory.
    """
    already_open, collecting = set(plt.get_fignums()), gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        for number in set(plt.get_fignums()) - already_open:
            plt.close(number)
        if collecting:
            gc.enable()
            gc.collect(1)


def render(result: Any, alt: str) -> Still:
    """Draw a figure, axes, a text, or a pair of one of them and a sentence."""
    drawing, sentence = result if isinstance(result, tuple) and len(result) == 2 else (result, "")
    figure = drawing if isinstance(drawing, Figure) else getattr(drawing, "figure", None)
    if isinstance(figure, Figure):
        return _render_figure(figure, str(sentence or ""), alt)
    if result is None:
        advice = "End the function with `return` and what it drew."
        fail("fn", "a function that returns a figure, axes or something to print", "None", advice, TypeError)
    text = f'<pre style="margin: 0; white-space: pre-wrap">{escape(str(result))}</pre>'
    return Still(f'<div role="group" aria-label="{escape(alt)}">{text}</div>', "", f"shows: {alt}\n{result}")


def _render_figure(figure: Figure, sentence: str, alt: str) -> Still:
    svg = to_svg(figure)
    plt.close(figure)
    width, height = (round(96 * inches) for inches in figure.get_size_inches())  # known before the image has loaded
    image = (
        f'<img src="data:image/svg+xml,{quote(svg, safe=_PLAIN_IN_URL)}" alt="{escape(alt)}" '
        f'width="{width}" height="{height}" style="max-width: 100%; height: auto">'
    )
    return Still(image, sentence, "\n".join(filter(None, [f"shows: {alt}", sentence, f"figure {digest(svg)}"])))


def framed(still: Still, *caption: str) -> str:
    """Put the result into a figure with these lines below it."""
    lines = "<br>".join(escape(line) for line in caption if line)
    caption_below = f'<figcaption style="line-height: 1.5">{lines}</figcaption>' if lines else ""
    return f'<figure class="rl-live" style="margin: 0">{still.body}{caption_below}</figure>'


def digest(text: str) -> str:
    """Return a short name that changes whenever the text does."""
    return hashlib.sha256(text.encode()).hexdigest()[:12]
