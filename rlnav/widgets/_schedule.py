"""How the step size and the chance to explore change with the episodes; `rlnav/js/scenario/schedule.js` mirrors it.

Only + - * /, in the same order, so that both give the same bits.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

SCHEDULES = ("constant", "linear", "harmonic", "exponential")
RATIOS = ("harmonic", "exponential")  # made from end / start: neither may be 0


def schedule(kind: str, start: float, end: float, episodes: int) -> NDArray[Any]:
    """Return one number for each episode, from `start` in the first to `end` in the last.

    Examples
    --------
    >>> [float(rate) for rate in schedule("harmonic", 0.5, 0.125, 4)]
    [0.5, 0.25, 0.16666666666666666, 0.125]
    """
    last = episodes - 1
    rates: NDArray[Any] = np.full(episodes, float(start))
    if kind == "constant" or last == 0:
        return rates
    if kind == "linear":
        rates = np.linspace(start, end, episodes)
    elif kind == "harmonic":
        rates = start / (1 + (start / end - 1) * np.arange(episodes) / last)
    else:
        rates = np.cumprod([start, *[factor(start, end, episodes)] * last])
    return np.minimum(rates, 1) if end > start else rates  # rounding may lift the last ones above 1


def factor(start: float, end: float, episodes: int) -> float:
    """Return the number by which an exponential schedule multiplies from episode to episode: a root of end / start."""
    ratio = end / start
    low, high = min(ratio, 1.0), max(ratio, 1.0)
    while low < (middle := (low + high) / 2) < high:
        if _power(middle, episodes - 1) < ratio:
            low = middle
        else:
            high = middle
    return high


def _power(base: float, n: int) -> float:
    """Return base ** n by multiplications: the bits of pow differ between machines."""
    product, square = 1.0, base
    while n:
        if n % 2:
            product *= square
        square, n = square * square, n // 2
    return product
