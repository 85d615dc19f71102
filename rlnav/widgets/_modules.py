"""Read the browser's modules: what each imports and exports, and its code without comments and indentation."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from itertools import groupby
from operator import itemgetter
from typing import NamedTuple

from .._check import fail

HOME: Traversable = files("rlnav") / "js"
COMMENT, CODE, VERBATIM = "comment", "code", "verbatim"

IMPORT = re.compile(r'import \{([^{}]*)\} from "(\.{1,2}/[\w./-]+\.js)";\n')
EXPORT = re.compile(r"^export ((?:async )?function\b\*? ?|class |const )([\w$]+)", re.MULTILINE)
OTHER_FORM = re.compile(r"^(?:im|ex)port\b[^\n]*|\bimport\s*[(.]", re.MULTILINE)

TOKEN = re.compile(
    r"""(?P<comment> //[^\n]* | /\*.*?\*/ )
      | (?P<verbatim> "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*' )
      | (?P<code> [^"'`/{}]+ | . )""",
    re.VERBOSE | re.DOTALL,
)
TEMPLATE = re.compile(r"(?:\\.|\$(?!\{)|[^`\\$])*(?:`|\$\{)", re.DOTALL)  # up to its end, or to code within it
REGEX = re.compile(r"/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\[\n])+/\w*")
BEFORE_REGEX = re.compile(r"(?:[(,=:\[!&|?{;+*%<>~^-]|\b(?:return|typeof|case|of|in|throw))\s*$|^\s*$")
CSS_TOKEN = re.compile(r"""("(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')|/\*.*?\*/""", re.DOTALL)


class Module(NamedTuple):
    """What a module imports, as paths with {name there: name here}; what later; what it exports; the code between."""

    imports: list[tuple[str, dict[str, str]]]
    parts: list[str]
    exports: list[str]
    code: str


@cache
def parse(path: str) -> Module:
    """Read a module, and take its imports and the word `export` out of it."""
    text, imports, parts, exports = squeezed(read(path)), [], [], []
    while found := IMPORT.match(text):
        pairs = (name.strip().partition(" as ") for name in found[1].split(",") if name.strip())
        wanted = {name: here or name for name, _, here in pairs}
        imports.append((_beside(path, found[2]), wanted))
        text = text[found.end() :]
    code = ""
    for kind, pieces in groupby(_pieces(text), key=itemgetter(0)):
        piece = "".join(part for _, part in pieces)
        if code.endswith("import(") and piece.startswith('"'):
            parts.append(_beside(path, piece.strip('"')))
            code, piece = code.removesuffix("import("), f'rlnav$part("{parts[-1]}"'
        elif kind == CODE:
            exports += [name for _, name in EXPORT.findall(piece)]
            piece = EXPORT.sub(r"\1\2", piece)
        if strange := OTHER_FORM.search(code[-len("import(") :] if kind == VERBATIM else piece.removesuffix("import(")):
            forms = '`import { a } from "./file.js";` at its head, and `export function`, `class` or `const`'
            fail(path, f"a module with no other forms than {forms}", repr(strange[0].strip()))
        code += piece
    return Module(imports, parts, exports, code)


def _beside(path: str, relative: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(path), relative))


def _pieces(source: str) -> Iterator[tuple[str, str]]:
    """Cut a module into code, comments, and what is kept to the letter: texts and regular expressions."""
    at, last = 0, ""
    open_braces: list[int] = []  # one count for each `${` that the code is in
    while at < len(source):
        found = TOKEN.match(source, at)
        assert found is not None
        kind, text = str(found.lastgroup), found[0]
        in_template = text == "`" or (text == "}" and open_braces and open_braces[-1] == 0)
        if in_template:
            rest = TEMPLATE.match(source, at + 1) or _unended(source, at)
            open_braces = open_braces[: -1 if text == "}" else None] + ([0] if rest[0].endswith("${") else [])
            kind, text = VERBATIM, text + rest[0]
        elif text == "/" and BEFORE_REGEX.search(last):
            kind, text = VERBATIM, (REGEX.match(source, at) or _unended(source, at))[0]
        elif text in ("{", "}") and open_braces:
            open_braces[-1] += 1 if text == "{" else -1
        elif text in "\"'":
            _unended(source, at)
        yield kind, text
        at += len(text)
        last = last if kind == COMMENT or text.isspace() else text[-12:]


def _unended(source: str, at: int) -> re.Match[str]:
    return fail("module", "a text whose quotes and slashes are in pairs", repr(source[at : at + 40]))


def squeezed(source: str) -> str:
    """Leave out comments, indentation and empty lines. Where lines end stays: it may matter in JavaScript."""
    done, code = "", ""
    for kind, text in _pieces(source):
        if kind == VERBATIM:
            done, code = done + _lines(code) + text, ""
        else:
            code += text if kind == CODE else "\n" if "\n" in text else " "
    return f"{done}{_lines(code)}".strip() + "\n"


def _lines(code: str) -> str:
    return re.sub(r"\s*\n\s*", "\n", code)


def squeezed_css(text: str) -> str:
    return re.sub(r"\s*\n\s*", "\n", CSS_TOKEN.sub(lambda found: found[1] or "", text)).strip() + "\n"


def _file(path: str) -> Traversable:
    return HOME.joinpath(*path.split("/"))


def exists(path: str) -> bool:
    return not path.startswith("..") and _file(path).is_file()


def read(path: str) -> str:
    if not exists(path):
        fail("path", "a file in rlnav/js", repr(path))
    return _file(path).read_text(encoding="utf-8")
