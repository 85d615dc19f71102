"""Execute notebooks and store them in their canonical form: the only way in which they are committed.

    python tools/execute.py                  # every notebook of the book
    python tools/execute.py book/one.ipynb   # this one
    python tools/execute.py --check          # only report what would change

A notebook that fails, warns or writes to stderr is left as it was.
"""

from __future__ import annotations

import argparse
import difflib
import os
import re
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import matplotlib
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat import NotebookNode

from canonical import canonical, read, widget_models

ROOT = Path(__file__).resolve().parent.parent
COLORS = re.compile(r"\x1b\[[0-9;]*m")  # of a terminal, in tracebacks
BUDGET = 20.0  # seconds that a reader, and a test, may have to wait for one notebook


class RefusedNotebookError(Exception):
    """What a notebook did that one in the book may not do."""


def execute(path: Path) -> NotebookNode:
    """Run every cell of the notebook at `path` in a fresh kernel of this Python, and return it with its outputs."""
    notebook = without_outputs(read(path))
    with tempfile.TemporaryDirectory() as profile:
        client = NotebookClient(
            notebook,
            kernel_name="python3",
            extra_arguments=["--log-level=ERROR"],
            resources={"metadata": {"path": str(path.parent)}},
            timeout=int(3 * BUDGET),
            coalesce_streams=True,
            record_timing=False,
        )
        try:
            client.execute(env=_environment(profile))
        except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
            raise RefusedNotebookError(f"{_last_started(notebook)} failed\n{COLORS.sub('', str(error))}") from None
    for complaint in complaints(notebook):
        raise RefusedNotebookError(complaint)
    return notebook


def without_outputs(notebook: NotebookNode) -> NotebookNode:
    """Return a notebook as it was before its first run."""
    notebook.metadata.pop("widgets", None)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.update(outputs=[], execution_count=None)
    return notebook


def complaints(notebook: NotebookNode) -> Iterator[str]:
    """Yield what no reader should meet: warnings and whatever else goes to stderr, errors swallowed by a widget."""
    for number, cell in enumerate((cell for cell in notebook.cells if cell.cell_type == "code"), 1):
        for output in cell.outputs:
            if output.get("name") == "stderr":
                yield f"cell [{number}] wrote to stderr\n{output.text}"
    for model in widget_models(notebook).values():
        for output in model["state"].get("outputs") or ():
            if output.get("name") == "stderr" or output["output_type"] == "error":
                yield f"a widget holds an error\n{output.get('text') or output.get('evalue')}"


def _environment(profile: str) -> dict[str, str]:
    """Return an environment in which no habit of this machine or user changes a figure or the order of a set."""
    fixed = {
        "IPYTHONDIR": profile,
        "MATPLOTLIBRC": str(Path(matplotlib.get_data_path(), "matplotlibrc")),
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "PYTHONHASHSEED": "0",
        "SOURCE_DATE_EPOCH": "0",
    }
    return os.environ | fixed


def _last_started(notebook: NotebookNode) -> str:
    started = [cell for cell in notebook.cells if cell.cell_type == "code" and cell.execution_count is not None]
    return f"cell [{len(started)}]"


def find(paths: list[Path]) -> list[Path]:
    """List the notebooks in files and folders, without the copies that JupyterLab keeps."""
    found = [sorted(path.rglob("*.ipynb")) if path.is_dir() else [path] for path in paths]
    return [path.resolve() for group in found for path in group if ".ipynb_checkpoints" not in path.parts]


def _replace(path: Path, text: str) -> None:
    """Write the whole file, or leave the old one."""
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8", newline="\n")
    os.replace(part, path)


def _differences(old: str, new: str) -> str:
    """Show the first lines that differ; a figure is one long line."""
    lines = difflib.unified_diff(old.splitlines(), new.splitlines(), "stored", "executed now", n=1, lineterm="")
    return "\n".join(line if len(line) <= 160 else f"{line[:157]}..." for line in islice(lines, 40))


def _run(path: Path, check: bool) -> bool:
    """Execute one notebook, report it in one line, and store it unless this is a check."""
    started = time.perf_counter()
    try:
        new = canonical(execute(path))
    except RefusedNotebookError as refusal:
        print(f"{os.path.relpath(path)}: left as it was, {refusal}", file=sys.stderr)
        return False
    seconds = time.perf_counter() - started
    old = path.read_text(encoding="utf-8")
    if not check and new != old:
        _replace(path, new)
    verdict = "unchanged" if new == old else "differs" if check else "written"
    slow = f", over the budget of {BUDGET:.0f} s" if seconds > BUDGET else ""
    print(f"{os.path.relpath(path)}: {verdict}, {seconds:.1f} s{slow}", flush=True)
    if verdict == "differs":
        print(_differences(old, new))
    return verdict != "differs"


def main() -> int:
    """Read the command line and execute what it names."""
    parser = argparse.ArgumentParser(description="Execute notebooks and store them in their canonical form.")
    parser.add_argument("paths", nargs="*", type=Path, default=[ROOT / "book"], help="notebooks or folders (book)")
    parser.add_argument("--check", action="store_true", help="report what would change, and change nothing")
    arguments = parser.parse_args()
    notebooks = find(arguments.paths)
    if not notebooks:
        print("There is no notebook to execute.")
    verdicts = [_run(path, arguments.check) for path in notebooks]
    return 0 if all(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
