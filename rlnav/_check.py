"""Checks at the public door: each returns a clean value, or raises one error that says what to do."""

from __future__ import annotations

import math
from collections.abc import Callable
from numbers import Integral, Real
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

LARGEST = 1e100  # sums of larger numbers overflow
MOST_STEPS = 1_000_000  # of one episode


def show(value: object, limit: int = 60) -> str:
    """Quote the value as an error message does: short, on one line, with its shape where it has one."""
    if isinstance(value, np.ndarray) and value.size > 6:
        return f"an array of shape {value.shape} and type {value.dtype}"
    try:
        text = " ".join(repr(value.item() if isinstance(value, np.generic) else value).split())
    except Exception:  # an integer too long to print, or a reader's own class
        return f"something of type {type(value).__name__}"
    return text if len(text) <= limit else f"{text[: limit - 3]}..."


def fail(name: str, expected: str, got: str, advice: str = "", kind: type[Exception] = ValueError) -> NoReturn:
    """Raise `kind` in the one form of all messages: `name` must be EXPECTED; got ACTUAL. WHAT TO DO."""
    raise kind(f"`{name}` must be {expected}; got {got}." + (f" {advice}" if advice else ""))


def number(name: str, value: Any, low: float = -math.inf, high: float = math.inf, *, above: bool = False) -> float:
    """Return a finite real number in [low, high], or in (low, high] if `above`."""
    bounds = f"in {'(' if above else '['}{low:g}, {high:g}]"
    expected = "a finite number" if low == -math.inf and high == math.inf else f"a number {bounds}"
    if high == math.inf and low > -math.inf:
        expected = f"a finite number {'above' if above else 'of at least'} {low:g}"
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, Real):
        fail(name, expected, f"{show(value)} ({type(value).__name__})", kind=TypeError)
    try:
        x = float(value)
    except OverflowError:  # an integer beyond all floating-point numbers
        x = math.inf
    if not math.isfinite(x) or x < low or x > high or (above and x == low):
        fail(name, expected, show(value))
    if abs(x) > LARGEST:
        fail(name, f"a number between -{LARGEST:g} and {LARGEST:g}", show(value), "Sums of larger ones overflow.")
    return x


def integer(name: str, value: Any, low: int | None = None, high: int | None = None) -> int:
    """Return a whole number in [low, high]."""
    if type(value) is int and (low is None or value >= low) and (high is None or value <= high):
        return value  # at once: the model of a task asks this half a million times
    limits = {
        (False, False): "an integer",
        (True, False): f"an integer of at least {low}",
        (True, True): f"an integer from {low} to {high}",
    }
    expected = limits[low is not None, high is not None]
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, Integral):
        fail(name, expected, f"{show(value)} ({type(value).__name__})", kind=TypeError)
    n = int(value)
    if (low is not None and n < low) or (high is not None and n > high):
        fail(name, expected, show(n))
    return n


def cell(name: str, value: Any) -> tuple[int, int]:
    """Return a cell (x, y)."""
    pair = items(name, value, "a cell (x, y)")
    if len(pair) != 2:
        fail(name, "a cell (x, y)", show(value), kind=TypeError)
    return integer(name, pair[0]), integer(name, pair[1])


def items(name: str, value: Any, expected: str) -> tuple:
    """Return what a collection holds."""
    try:
        if not isinstance(value, (str, bytes)):
            return tuple(value)
    except TypeError:
        pass
    return fail(name, expected, f"{show(value)} ({type(value).__name__})", kind=TypeError)


def plain(name: str, value: ArrayLike, meaning: str) -> NDArray:
    """Return what NumPy makes of a number or nested sequences."""
    try:
        return np.asarray(value)
    except ValueError:
        return fail(name, meaning, "rows of different lengths", "Give every row the same length.")
    except Exception as error:
        return fail(name, meaning, f"{type(error).__name__}: {error}", kind=TypeError)


def array(name: str, value: ArrayLike, kind: str, shape: tuple[int | None, ...], meaning: str) -> NDArray:
    """Return an array of `kind` ("integer", "real" or "bool") whose shape fits; None in `shape` fits any length."""
    x = plain(name, value, meaning)
    kinds = {"integer": "iu", "real": "iuf", "bool": "b"}[kind]
    if x.dtype.kind not in kinds:
        whole = f"{meaning}, {'an integer' if kind == 'integer' else f'a {kind}'} array"
        fail(name, whole, f"type {x.dtype}", kind=TypeError)
    if x.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, x.shape, strict=True)):
        want = ", ".join("any" if n is None else str(n) for n in shape)
        fail(name, f"{meaning}, of shape ({want})", f"shape {x.shape}")
    if x.dtype.kind == "f" and not np.isfinite(x).all():
        where = np.argwhere(~np.isfinite(x))[0]
        fail(name, "finite everywhere", f"{x[tuple(where)]} at [{', '.join(map(str, where))}]")
    if x.dtype.kind == "f" and x.size and max(x.max(), -x.min()) > LARGEST:
        expected = f"between -{LARGEST:g} and {LARGEST:g} everywhere"
        fail(name, expected, f"{x.max():g}" if x.max() > LARGEST else f"{x.min():g}", "Sums of larger ones overflow.")
    return x


def states(name: str, value: ArrayLike) -> NDArray:
    """Return the numbers of one state or of several."""
    return array(name, np.atleast_1d(plain(name, value, "states")), "integer", (None,), "states")


def generator(rng: object) -> np.random.Generator:
    """Return the random generator that `rng` (None, an integer seed or a Generator) stands for."""
    if rng is None or isinstance(rng, np.random.Generator):
        return np.random.default_rng(rng)
    return np.random.default_rng(integer("rng", rng, 0))


def function(name: str, value: Any, formula: str) -> Callable:
    """Return a callable; `formula` shows how it is called."""
    if not callable(value):
        fail(name, f"a function {formula}", show(value), kind=TypeError)
    return value


def instance(name: str, value: Any, kind: type) -> Any:
    """Return an instance of `kind`."""
    if not isinstance(value, kind):
        fail(name, f"a {kind.__name__}", f"{show(value)} ({type(value).__name__})", kind=TypeError)
    return value


def called(name: str, own: Callable, *arguments: object) -> Any:
    """Call a reader's own function; what it raises becomes one ValueError that names it and its arguments."""
    try:
        return own(*arguments)
    except Exception as error:
        given = ", ".join(show(x, 200) for x in arguments)
        raise ValueError(
            f"`{name}` must be a function that takes these arguments; got {type(error).__name__}: {error}. "
            f"It was called with ({given})."
        ) from error
