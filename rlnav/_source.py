"""The library's own lines, shown in the book: never a copy of them."""

from __future__ import annotations

import ast
import inspect
import sys
import textwrap
from collections.abc import Callable
from typing import Any

from . import _check


class Source(str):
    """Source code that a notebook shows as such."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)

    def _repr_markdown_(self) -> str:
        return f"```python\n{self}\n```"


def source(function: Callable) -> Source:
    """Show the lines of a function of the library, or of your own, without decorators and docstring.

    Where a public function only checks its arguments and starts a loop, the loop is shown: the function of the same
    name with an underscore in front, beside it.

    Parameters
    ----------
    function : function

    Returns
    -------
    Source
        A string that notebooks show as code.

    Examples
    --------
    >>> import rlnav as rl
    >>> rl.source(rl.sarsa_rule)
    def sarsa_rule(Q, s, a, r, s_next, a_next, gamma, alpha):
        Q[s, a] += alpha * (r + gamma * Q[s_next, a_next] - Q[s, a])
    """
    _check.function("function", function, "such as rl.value_iteration")
    shown: Any = function
    if hasattr(function, "__module__") and hasattr(function, "__name__"):
        shown = getattr(sys.modules.get(function.__module__), f"_{function.__name__}", function)
    shown = getattr(shown, "py_func", shown)  # compiled loops keep the function that they came from
    try:
        return Source(_without_docstring(textwrap.dedent(inspect.getsource(shown))))
    except (OSError, TypeError, SyntaxError):  # the last for the line of a lambda, which is not a statement of its own
        return _check.fail("function", "a function written in Python by `def`", _check.show(function))


def _without_docstring(text: str) -> str:
    node = ast.parse(text).body[0]
    lines = text.splitlines()
    keep = set(range(node.lineno, len(lines) + 1))  # from `def` on
    if isinstance(node, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(node) is not None:
        first = node.body[0]
        keep -= set(range(first.lineno, (first.end_lineno or first.lineno) + 1))
    return "\n".join(line for number, line in enumerate(lines, 1) if number in keep).rstrip()
