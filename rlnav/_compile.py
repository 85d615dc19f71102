"""Machine code for loops where numba is installed; the same loops as plain Python elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar

njit: Any = None
register_jitable: Any = None
with suppress(ImportError):
    from numba import njit
    from numba.extending import register_jitable

F = TypeVar("F", bound=Callable)


def kernel(function: F) -> F:
    """Compile `function` at its first call, and keep the machine code for the next process where a folder allows it."""
    if njit is None:
        return function
    try:
        return njit(cache=True)(function)
    except RuntimeError:  # a read-only installation without a writable cache folder
        return njit(function)


def inline(function: F) -> F:
    """Let kernels that call `function` contain its machine code; a call with arrays would cost more than its lines do.

    Called from Python it stays plain Python.
    """
    return function if njit is None else register_jitable(forceinline=True)(function)
