"""Join the browser's small modules into one text: there is nothing to build, and nothing generated is kept.

Jupyter takes a figure's program as one self-contained module; a page takes a classic script, which works from a folder
too. Both are the same modules, each in a function scope of its own, after those that it imports. So that a few lines
can join them, a module imports and exports in one plain form only::

    import { first, second as other } from "../folder/file.js";
    export function name() {}    export class Name {}    export const name = 1;
    const { third } = await import("./part.js");    // a page loads that part when it is wanted, Jupyter at once
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from .._check import fail
from ._modules import Module, exists, parse, read, squeezed_css

STAGE = "views/stage.js"  # mounts what an entry starts

Modules = dict[str, Module]  # by path, each after those that it imports


class Joined(NamedTuple):
    """Modules as one text, and by path and name where in it their exports are: {"mdp.js": {"greedy": "rlnav$3[2]"}}."""

    code: str
    exports: dict[str, dict[str, str]]


@cache
def module(entry: str) -> str:
    """Return the module that Jupyter loads for `entry`, such as "explorables/value_wave": anywidget's `render`."""
    modules = _modules(_roots(entry))
    modules |= _modules(_parts(modules))
    names = _names(modules)
    parts = ", ".join(f'"{path}": {_exports_of(path, modules, names)}' for path in _parts(modules))
    later = f"const rlnav$part = async (name) => ({{ {parts} }})[name];\n" if parts else ""
    return f"{later}{_joined(modules, names)}export default {_render(entry, modules, names)};\n"


@cache
def script(entry: str) -> str:
    """Return the script that a page loads for `entry`: it leaves the same `render` where the page's host finds it."""
    modules = _modules(_roots(entry))
    names = _names(modules)
    shared = ", ".join(names.values()) if _parts(modules) else ""
    return _alone(
        "const rlnav$part = (name) => globalThis.rlnavExplorables.part(name);\n" if shared else "",
        _joined(modules, names),
        f'(globalThis.rlnavExplorables ??= {{}})["{entry}"] = '
        f"{{ ...{_render(entry, modules, names)}, shared: {{ {shared} }} }};\n",
    )


@cache
def part(entry: str, path: str) -> str:
    """Return the script that a page loads when the program of `entry` wants the module at `path`."""
    main = _modules(_roots(entry))
    own = {name: found for name, found in _modules((path,)).items() if name not in main}
    names = _names(main | own)
    wanted = {names[needed] for found in own.values() for needed, _ in found.imports if needed in main}
    return _alone(
        f'const {{ {", ".join(sorted(wanted))} }} = globalThis.rlnavExplorables["{entry}"].shared;\n',
        _joined(own, names, main),
        f'globalThis.rlnavExplorables["{path}"] = {_exports_of(path, own, names)};\n',
    )


def programs(entry: str) -> dict[str, str]:
    """Return all that a page may load for `entry`: its script, those of its parts, and its style, by file name."""
    parts = {path: part(entry, path) for path in _parts(_modules(_roots(entry)))}
    return {f"{entry}.js": script(entry), **parts, f"{entry}.css": stylesheet(entry)}


@cache
def stylesheet(entry: str) -> str:
    """Return the style of an entry: that of the shared views, of its folder, and of the modules that have one."""
    folder = posixpath.dirname(entry)
    modules = _modules(_roots(entry))
    own = [f"{path.removesuffix('.js')}.css" for path in modules | _modules(_parts(modules))]
    paths = dict.fromkeys(["views/views.css", f"{folder}/{posixpath.basename(folder)}.css", *own])
    return "".join(squeezed_css(read(path)) for path in paths if exists(path))


def publish(entry: str, folder: Path, minified: Callable[[str], str] = str) -> None:
    """Write the scripts of an entry, minified, and its style below a folder, where a page's host looks for them."""
    for name, text in programs(entry).items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(minified(text) if name.endswith(".js") else text, encoding="utf-8", newline="\n")


def join(*roots: str) -> Joined:
    """Join modules with all that they import.

    Raises
    ------
    ValueError
        If a module is missing, imports a name that is not exported, imports itself on a detour, or has another form.
    """
    modules = _modules(roots)
    names = _names(modules)
    exports = {
        path: {name: _place(path, name, modules, names) for name in found.exports} for path, found in modules.items()
    }
    return Joined(_joined(modules, names), exports)


def _roots(entry: str) -> tuple[str, str]:
    path = f"{entry}.js"
    for owner, function in ((path, "start"), (STAGE, "open")):
        if function not in (exports := parse(owner).exports):
            fail(owner, f"a module that exports `{function}`", ", ".join(exports) or "no exports")
    return path, STAGE


def _render(entry: str, modules: Modules, names: dict[str, str]) -> str:
    opened, start = _place(STAGE, "open", modules, names), _place(f"{entry}.js", "start", modules, names)
    return f"{{ render: ({{ model, el }}) => {opened}(model, el, {start}) }}"


def _modules(roots: tuple[str, ...]) -> Modules:
    modules: Modules = {}
    _collect(roots, modules, ())
    return modules


def _parts(modules: Modules) -> tuple[str, ...]:
    return tuple(dict.fromkeys(path for found in modules.values() for path in found.parts))


def _names(modules: Modules) -> dict[str, str]:
    return {path: f"rlnav${number}" for number, path in enumerate(modules)}


def _joined(modules: Modules, names: dict[str, str], given: Modules | None = None) -> str:
    return "".join(_scope(path, modules | (given or {}), names) for path in modules)


def _place(path: str, name: str, modules: Modules, names: dict[str, str]) -> str:
    """Return where in the joined text an export is."""
    return f"{names[path]}[{modules[path].exports.index(name)}]"


def _exports_of(path: str, modules: Modules, names: dict[str, str]) -> str:
    return f"{{ {', '.join(f'{name}: {_place(path, name, modules, names)}' for name in modules[path].exports)} }}"


def _alone(*code: str) -> str:
    """Keep the names of a classic script to itself."""
    return f'(() => {{\n"use strict";\n{"".join(code)}}})();\n'


def _collect(paths: tuple[str, ...], modules: Modules, above: tuple[str, ...]) -> None:
    """Add modules to `modules`, each after those that it imports."""
    for path in paths:
        if path in above:
            fail("import", "of modules that do not need each other", " -> ".join([*above[above.index(path) :], path]))
        if path not in modules:
            found = parse(path)
            for needed, _ in found.imports:
                if not exists(needed):
                    fail(f"import in {path}", "of a file in rlnav/js", repr(needed))
            _collect(tuple(needed for needed, _ in found.imports), modules, (*above, path))
            _check_imports(path, found, modules)
            modules[path] = found


def _check_imports(path: str, found: Module, modules: Modules) -> None:
    for needed, names in found.imports:
        for wanted in names:
            if wanted not in modules[needed].exports:
                fail(f"import in {path}", f"of a name that {needed} exports", f"{wanted!r}")


def _scope(path: str, modules: Modules, names: dict[str, str]) -> str:
    """Put a module into a function that returns its exports as an array: places are shorter than names."""
    found = modules[path]
    lines = []
    for needed, wanted in found.imports:
        places = (f"{modules[needed].exports.index(name)}: {here}" for name, here in wanted.items())
        lines.append(f"const {{ {', '.join(places)} }} = {names[needed]};\n")
    return (
        f"const {names[path]} = (() => {{\n{''.join(lines)}{found.code}return [{', '.join(found.exports)}];\n}})();\n"
    )
