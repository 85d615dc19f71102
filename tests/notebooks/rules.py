"""What every chapter of the book keeps to: each rule is a function that yields what breaks it."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterator

from IPython.core.inputtransformer2 import TransformerManager
from nbformat import NotebookNode

import rlnav
from execute import complaints

Complaints = Iterator[str]

LONGEST_CELL = 12  # lines: as many as a slide holds
HIDING = {"hide-input", "hide-output", "hide-cell", "remove-input", "remove-output", "remove-cell"}
SILENCING = re.compile(r"nbval|skip-execution|PYTEST_VALIDATE_IGNORE", re.IGNORECASE)
MACHINE = re.compile(r"\b0x[0-9a-f]{6,}|/(home|tmp|root|Users)/|site-packages")
LEGACY = re.compile(r"(np|numpy)\.random\.\w+")  # draws from one hidden generator that all share
SAMPLING = {name for name in rlnav.__all__ if inspect.isfunction(getattr(rlnav, name))}
SAMPLING = {name for name in SAMPLING if "rng" in inspect.signature(getattr(rlnav, name)).parameters}


def every_cell_was_run_in_order(notebook: NotebookNode) -> Complaints:
    """A notebook that was run from top to bottom holds the numbers 1, 2, 3 and so on."""
    for place, cell in numbered_cells(notebook):
        if cell.execution_count != place:
            yield f"cell {place} has the number {cell.execution_count}"


def every_cell_fits_on_a_slide(notebook: NotebookNode) -> Complaints:
    """One idea a cell."""
    for place, cell in numbered_cells(notebook):
        if (lines := len(cell.source.splitlines())) > LONGEST_CELL:
            yield f"cell {place} has {lines} lines, {LONGEST_CELL} are allowed"


def no_output_is_a_warning(notebook: NotebookNode) -> Complaints:
    """Nothing on stderr, no error inside of a widget."""
    yield from complaints(notebook)


def every_figure_is_svg_with_words_for_it(notebook: NotebookNode) -> Complaints:
    """Stock nbval compares SVG and skips other images; without words, readers would hear the path of a file."""
    for place, cell in numbered_cells(notebook):
        kinds = [kind for output in cell.outputs for kind in output.get("data", {}) if kind.startswith("image/")]
        if set(kinds) - {"image/svg+xml"}:
            yield f"cell {place} shows {kinds}: call rl.plot.style() first"
        if len(kinds) > 1:
            yield f"cell {place} shows {len(kinds)} figures: they cannot share their alternative text"
        alt = cell.metadata.get("mystnb", {}).get("image", {}).get("alt", "")
        if kinds and len(alt.split()) < 4:
            yield f"cell {place} needs a sentence in its metadata mystnb.image.alt, and has {alt!r}"


def no_code_is_hidden(notebook: NotebookNode) -> Complaints:
    """Only imports, and calls of `glue` that carry numbers into the text, may be folded away."""
    for place, cell in numbered_cells(notebook):
        hiding = HIDING.intersection(cell.metadata.get("tags", ()))
        if hiding and not all(is_import_or_glue(statement) for statement in statements(cell)):
            yield f"cell {place} hides code by {', '.join(sorted(hiding))}"


def no_test_is_switched_off(notebook: NotebookNode) -> Complaints:
    """Every result is compared."""
    for place, cell in numbered_cells(notebook):
        if found := SILENCING.search(f"{cell.source} {cell.metadata.get('tags', '')}"):
            yield f"cell {place} switches its test off by {found[0]}"


def no_cell_ends_in_a_semicolon(notebook: NotebookNode) -> Complaints:
    """A semicolon hides a result from JupyterLab but not from nbval, which would then find one too many."""
    for place, cell in numbered_cells(notebook):
        if cell.source.rstrip().endswith(";"):
            yield f"cell {place} ends in a semicolon: give the result a name instead, such as `ax = ...`"


def all_chance_has_a_seed(notebook: NotebookNode) -> Complaints:
    """Readers see `rng=` wherever something is sampled, and get the numbers that the text speaks of."""
    for place, cell in numbered_cells(notebook):
        for call in (node for statement in statements(cell) for node in ast.walk(statement)):
            if isinstance(call, ast.Call) and (unseeded := sampled_without_seed(call)):
                yield f"cell {place} samples without a seed in {unseeded}"


def no_output_names_this_machine(notebook: NotebookNode) -> Complaints:
    """An address in memory or a path differs from machine to machine."""
    for place, cell in numbered_cells(notebook):
        for output in cell.outputs:
            texts = [output.get("text", ""), output.get("evalue", ""), output.get("data", {}).get("text/plain", "")]
            if found := MACHINE.search(" ".join(texts)):
                yield f"cell {place} shows {found[0]}"


RULES: list[Callable[[NotebookNode], Complaints]] = [
    every_cell_was_run_in_order,
    every_cell_fits_on_a_slide,
    no_output_is_a_warning,
    every_figure_is_svg_with_words_for_it,
    no_code_is_hidden,
    no_test_is_switched_off,
    no_cell_ends_in_a_semicolon,
    all_chance_has_a_seed,
    no_output_names_this_machine,
]


def numbered_cells(notebook: NotebookNode) -> Iterator[tuple[int, NotebookNode]]:
    """Yield the cells that Python runs, counted from 1."""
    return enumerate((cell for cell in notebook.cells if cell.cell_type == "code"), 1)


def statements(cell: NotebookNode) -> list[ast.stmt]:
    """Parse a cell as IPython does, magic commands included."""
    return ast.parse(TransformerManager().transform_cell(cell.source)).body


def is_import_or_glue(statement: ast.stmt) -> bool:
    """Tell whether a statement only loads a library or passes a number to the text."""
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return True
    return (
        isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call) and called(statement.value) == "glue"
    )


def called(call: ast.Call) -> str:
    """Return the last part of the name that is called: `q_learning` of `rl.q_learning(...)`."""
    return ast.unparse(call.func).rpartition(".")[2]


def sampled_without_seed(call: ast.Call) -> str:
    """Return the name of a function that draws random numbers which nobody has seeded, or nothing."""
    name = ast.unparse(call.func)
    if called(call) == "default_rng":
        return "" if call.args or call.keywords else name
    seeded = any(keyword.arg == "rng" for keyword in call.keywords)
    return name if LEGACY.fullmatch(name) or (called(call) in SAMPLING and not seeded) else ""
