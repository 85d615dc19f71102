"""Notebooks are executed to the same bytes every time, or left as they were."""

import nbformat
import pytest

import execute
from canonical import WIDGET_STATE, WIDGET_VIEW, canonical, read, widget_models

CHAPTER = [
    "import rlnav as rl\nfrom matplotlib.figure import Figure\nrl.plot.style()",
    "def draw(gamma=0.5):\n    figure = Figure()\n    figure.subplots().plot([0, gamma])\n    return figure",
    "rl.widgets.Live(draw, {'gamma': (0.5, 0.9, 0.1)}, alt='A line up to {gamma}.')",
    "draw(0.7)",
    "print({'north', 'east', 'south', 'west'})",
]


@pytest.fixture
def notebook(tmp_path):
    """Write cells to a new notebook and return its path."""

    def write(*cells):
        path = tmp_path / "chapter.ipynb"
        code = [nbformat.v4.new_code_cell(cell) for cell in cells]
        nbformat.write(nbformat.v4.new_notebook(cells=code), path)
        return path

    return write


def run(monkeypatch, *arguments):
    monkeypatch.setattr("sys.argv", ["execute.py", *map(str, arguments)])
    return execute.main()


def test_executing_twice_gives_the_same_bytes(notebook, monkeypatch, capsys):
    path = notebook(*CHAPTER)
    assert run(monkeypatch, path) == 0
    first = path.read_bytes()
    assert run(monkeypatch, path) == 0
    assert path.read_bytes() == first
    assert [line.split(": ")[1][:7] for line in capsys.readouterr().out.splitlines()] == ["written", "unchang"]
    assert first.count(b"IPY_MODEL_") > 5
    assert b"<svg" in first


def test_a_check_reports_what_differs_and_changes_nothing(notebook, monkeypatch, capsys):
    path = notebook("0.25")
    run(monkeypatch, path)
    stale = read(path)
    stale.cells[0].outputs[0].data["text/plain"] = "0.24"
    path.write_text(canonical(stale))
    assert run(monkeypatch, "--check", path) == 1
    assert path.read_text() == canonical(stale)
    assert '-       "0.24"' in capsys.readouterr().out


def test_an_explorable_is_stored_without_its_program_and_with_its_picture(notebook, monkeypatch):
    steps = (
        "class Steps(rl.widgets.Explorable):\n    entry = 'explorables/steps'\n    _esm, _css = 'export default {}', ''"
    )
    path = notebook(CHAPTER[0], f"{steps}\n    alt, still = 'A line.', lambda self: Figure(figsize=(2, 1))\nSteps()")
    assert run(monkeypatch, path) == 0
    (output,) = read(path).cells[1].outputs
    assert set(output.data) == {"text/html", "text/plain"}  # JupyterLab shows the picture, until the cell is run
    assert widget_models(read(path)) == {}


@pytest.mark.parametrize(
    ("cell", "reason"),
    [
        ("1 / 0", "cell [2] failed"),
        ("import warnings; warnings.warn('soon gone')", "cell [2] wrote to stderr"),
        ("import ipywidgets\narea = ipywidgets.Output()\nwith area: 1 / 0\narea", "a widget holds an error"),
    ],
)
def test_a_notebook_that_fails_or_warns_is_left_as_it_was(notebook, monkeypatch, capsys, cell, reason):
    path = notebook("'first'", cell)
    before = path.read_bytes()
    assert run(monkeypatch, path) == 1
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]
    assert reason in capsys.readouterr().err


def test_an_error_that_a_chapter_shows_is_kept_without_the_paths_of_the_machine(notebook, monkeypatch):
    path = notebook("import json\njson.loads('[')")
    draft = read(path)
    draft.cells[0].metadata["tags"] = ["raises-exception"]
    nbformat.write(draft, path)
    assert run(monkeypatch, path) == 0
    (output,) = read(path).cells[0].outputs
    assert output.traceback == [f"JSONDecodeError: {output.evalue}"]


def test_a_folder_is_searched_without_the_copies_of_jupyterlab(tmp_path):
    for name in ("one.ipynb", "part/two.ipynb", ".ipynb_checkpoints/one-checkpoint.ipynb", "page.md"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert [path.name for path in execute.find([tmp_path])] == ["one.ipynb", "two.ipynb"]


def test_an_empty_folder_is_said_to_be_empty(tmp_path, monkeypatch, capsys):
    assert run(monkeypatch, tmp_path) == 0
    assert "no notebook" in capsys.readouterr().out


def with_widgets(box, slider, stray):
    """A notebook that shows a box with a slider in it; one widget more is stored and not shown."""
    output = nbformat.v4.new_output("display_data", {WIDGET_VIEW: {"model_id": box}})
    cell = nbformat.v4.new_code_cell("box", outputs=[output], execution_count=1, id="one", metadata={"scrolled": True})
    models = {
        stray: {"model_name": "IntSliderModel", "state": {"value": 9}},
        slider: {"model_name": "IntSliderModel", "state": {"value": 3}},
        box: {"model_name": "VBoxModel", "state": {"children": [f"IPY_MODEL_{slider}"]}},
    }
    notebook = nbformat.v4.new_notebook(cells=[cell])
    notebook.metadata["language_info"] = {"name": "python", "version": "3.11.7"}
    notebook.metadata["widgets"] = {WIDGET_STATE: {"state": models, "version_major": 2, "version_minor": 0}}
    return notebook


def test_the_canonical_form_does_not_depend_on_the_ids_of_widgets():
    one, other = with_widgets("c" * 32, "b" * 32, "a" * 32), with_widgets("1" * 32, "2" * 32, "3" * 32)
    assert canonical(one) == canonical(other)
    assert canonical(with_widgets("0" * 31 + "1", "0" * 32, "9" * 32)) == canonical(one)


def test_the_canonical_form_keeps_what_is_shown_and_drops_the_traces_of_a_run(tmp_path):
    path = tmp_path / "canonical.ipynb"
    path.write_text(canonical(with_widgets("c" * 32, "b" * 32, "a" * 32)))
    kept = read(path)
    states = [model["state"] for model in kept.metadata.widgets[WIDGET_STATE]["state"].values()]
    assert states == [{"children": ["IPY_MODEL_" + "0" * 31 + "1"]}, {"value": 3}]
    assert kept.cells[0].metadata == {}
    assert "version" not in kept.metadata.language_info
    assert canonical(kept) == path.read_text()


def test_a_cell_without_an_id_gets_one_that_stays(tmp_path):
    path = tmp_path / "old.ipynb"
    old = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1"), nbformat.v4.new_code_cell("1")])
    for cell in old.cells:
        del cell["id"]
    old.nbformat_minor = 4
    path.write_text(nbformat.writes(old))
    ids = [cell.id for cell in read(path).cells]
    assert len(set(ids)) == 2
    assert ids == [cell.id for cell in read(path).cells]
