"""Whatever changes in a notebook is found: by stock nbval in the style of the book, and by the strict plugin always."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import nbformat
import pytest

from canonical import canonical, read
from execute import execute

from .plants import PLANTS, SET_UP, WIDGET_PLANTS, Plant

ROOT = Path(__file__).resolve().parents[2]
FILES = [f"widget{number}.ipynb" for number in range(len(WIDGET_PLANTS))]


def executed(folder: Path, plants: list[Plant]) -> nbformat.NotebookNode:
    """A notebook with the cells of `plants`, as they are before any change."""
    cells = [nbformat.v4.new_code_cell(plant.source, metadata={"tags": plant.tags}) for plant in plants]
    path = folder / "draft.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=cells), path)
    path.write_text(canonical(execute(path)))
    notebook = read(path)
    path.unlink()
    return notebook


def failures(folder: Path, *options: str) -> set[tuple[str, str]]:
    """The names (file, cell) of what fails in one run of pytest over a folder of notebooks."""
    report = folder.parent / "report.xml"
    command = [sys.executable, "-m", "pytest", *options, f"--junitxml={report}", "-q", "-p", "no:cacheprovider"]
    command += ["-c", str(ROOT / "pyproject.toml"), f"--rootdir={folder}", str(folder)]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    cases = list(ElementTree.parse(report).iter("testcase"))
    assert run.returncode in (0, 1), run.stdout + run.stderr
    assert cases, "no cell was run"
    return {(case.get("classname"), case.get("name")) for case in cases if len(case)}


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """What stock nbval and the strict plugin find in the same notebooks, with and without planted changes."""
    house, widgets = tmp_path_factory.mktemp("house"), tmp_path_factory.mktemp("widgets")
    notebook = executed(house, [Plant("set-up", SET_UP, lambda cell: None), *PLANTS])
    nbformat.write(notebook, house / "intact.ipynb")
    for cell, plant in zip(notebook.cells[1:], PLANTS, strict=True):
        plant.change(cell)
    nbformat.write(notebook, house / "planted.ipynb")
    for name, plant in zip(FILES, WIDGET_PLANTS, strict=True):
        notebook = executed(widgets, [plant])
        nbformat.write(notebook, widgets / f"intact-{name}")
        plant.change(notebook)
        nbformat.write(notebook, widgets / name)
    return {
        "stock": failures(house, "--nbval"),
        "strict": failures(house, "-p", "tests.notebooks.strict") | failures(widgets, "-p", "tests.notebooks.strict"),
    }


@pytest.mark.parametrize("way", ["stock", "strict"])
def test_a_notebook_without_changes_passes(found, way):
    assert [(file, cell) for file, cell in found[way] if file.startswith("intact")] == []


@pytest.mark.parametrize("number", range(len(PLANTS)), ids=[plant.name for plant in PLANTS])
def test_a_change_in_a_cell_is_found(found, number):
    failure = ("planted.ipynb", f"Cell {number + 1}")
    assert failure in found["strict"]
    assert failure in found["stock"] or not PLANTS[number].stock


@pytest.mark.parametrize("number", range(len(WIDGET_PLANTS)), ids=[plant.name for plant in WIDGET_PLANTS])
def test_a_change_in_a_widget_is_found(found, number):
    assert FILES[number] in {file for file, _ in found["strict"]}
