"""Every chapter, as it is stored, keeps the rules of the book; and every rule notices when it is broken."""

import re
from pathlib import Path

import nbformat
import pytest

from canonical import canonical, read

from .rules import RULES

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = [path for path in sorted(ROOT.glob("book/**/*.ipynb")) if ".ipynb_checkpoints" not in path.parts]
NONE_YET = pytest.param(None, id="none", marks=pytest.mark.skip(reason="the book has no notebook yet"))
chapters = pytest.mark.parametrize("path", CHAPTERS or [NONE_YET], ids=lambda path: path.stem)


@chapters
@pytest.mark.parametrize("rule", RULES, ids=[rule.__name__ for rule in RULES])
def test_a_chapter_keeps(rule, path):
    assert list(rule(read(path))) == []


@chapters
def test_a_chapter_is_stored_in_its_canonical_form(path):
    assert path.read_text(encoding="utf-8") == canonical(read(path)), "run tools/execute.py"


def chapter(source, output=None, number=1, **metadata):
    """A chapter of one cell."""
    outputs = [] if output is None else [nbformat.from_dict(output)]
    cell = nbformat.v4.new_code_cell(source, outputs=outputs, execution_count=number, metadata=metadata)
    return nbformat.v4.new_notebook(cells=[cell])


def figure(kind):
    return {"output_type": "display_data", "metadata": {}, "data": {kind: ""}}


def stream(name, text):
    return {"output_type": "stream", "name": name, "text": text}


WORDS = {"image": {"alt": "Values of all cells of the map"}}
BROKEN = {
    "every_cell_was_run_in_order": [chapter("1", number=2), chapter("1", number=None)],
    "every_cell_fits_on_a_slide": [chapter("x = 1\n" * 13)],
    "no_output_is_a_warning": [chapter("1", stream("stderr", "UserWarning"))],
    "every_figure_is_svg_with_words_for_it": [
        chapter("ax", figure("image/png"), mystnb=WORDS),
        chapter("ax", figure("image/svg+xml")),
        chapter("ax", figure("image/svg+xml"), mystnb={"image": {"alt": "../_images/0a1b2c.svg"}}),
    ],
    "no_code_is_hidden": [
        chapter("import numpy\nV = solve()", tags=["hide-input"]),
        chapter("V = solve()", tags=["remove-cell"]),
    ],
    "no_test_is_switched_off": [chapter("# NBVAL_IGNORE_OUTPUT\n1"), chapter("1", tags=["nbval-skip"])],
    "no_cell_ends_in_a_semicolon": [chapter("rl.plot.values(task, V);")],
    "all_chance_has_a_seed": [
        chapter("rl.q_learning(mdp, episodes=9)"),
        chapter("runs = [rollout(mdp, pi) for _ in range(9)]"),
        chapter("np.random.default_rng()"),
        chapter("np.random.normal(3)"),
    ],
    "no_output_names_this_machine": [
        chapter("f", stream("stdout", "<function f at 0x7f3b2c1d>")),
        chapter("f", stream("stdout", "/home/student/rlnav")),
    ],
}
KEPT = [
    chapter("V", figure("image/svg+xml"), mystnb=WORDS),
    chapter("import rlnav as rl\nfrom myst_nb import glue\nglue('gap', 0.1, display=False)", tags=["hide-input"]),
    chapter("run = rl.q_learning(mdp, episodes=9, rng=0)\nnp.random.default_rng(0).random()"),
    chapter("V", stream("stdout", "[0.1 0.2]")),
]


@pytest.mark.parametrize("rule", RULES, ids=[rule.__name__ for rule in RULES])
def test_a_rule_notices_when_it_is_broken(rule):
    assert all(list(rule(broken)) for broken in BROKEN[rule.__name__])
    assert [list(rule(kept)) for kept in KEPT] == [[], [], [], []]


def test_instructors_are_told_the_minutes_that_the_chapters_name():
    told = dict(re.findall(r"\]\(([\w-]+)\.ipynb\) \| (\d+) \|", (ROOT / "book/instructors.md").read_text("utf-8")))
    named = {}
    for path in CHAPTERS:
        text = "\n".join(cell.source for cell in read(path).cells if cell.cell_type == "markdown")
        if minutes := re.search(r"\*\*Time\*\* (\d+) minutes", text):
            named[path.stem] = minutes[1]
    assert told == {chapter: minutes for chapter, minutes in named.items() if chapter != "00-how-to-use"}
