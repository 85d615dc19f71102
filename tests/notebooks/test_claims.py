"""Every number in the text of a chapter comes from one of its cells, and the tool that says so notices if not."""

import nbformat
import pytest

from canonical import read
from claims import claims

from .test_chapters import chapters


@chapters
def test_every_number_in_the_text_comes_from_a_cell(path):
    lost = [f'{claim.number} in "{claim.words}"' for claim in claims(read(path)) if claim.cell is None]
    assert lost == [], "pass it on by `glue`, or print it"


def chapter(text, source="success = 0.83\nprint(success)", printed="0.83\n", passed_on=()):
    outputs = [nbformat.v4.new_output("stream", text=printed)]
    for name in passed_on:
        metadata = {"scrapbook": {"mime_prefix": "application/papermill.record/", "name": name}}
        outputs.append(nbformat.v4.new_output("display_data", {}, metadata=metadata))
    code = nbformat.v4.new_code_cell(source, outputs=outputs, execution_count=1)
    return nbformat.v4.new_notebook(cells=[nbformat.v4.new_markdown_cell(text), code])


@pytest.mark.parametrize("text", ["It succeeds in 0.84 of all drives.", "After 1,234 updates", "{glue:text}`no-such`"])
def test_a_number_from_nowhere_is_noticed(text):
    assert [claim.cell for claim in claims(chapter(text))] == [None]


@pytest.mark.parametrize(
    ("text", "source"),
    [
        ("It succeeds in 0.83 of all drives.", "print(success)"),
        ("After 1,234 updates", "updates = 1_234"),
    ],
)
def test_a_number_is_found_in_its_cell(text, source):
    assert [claim.cell for claim in claims(chapter(text, source))] == [1]


def test_a_number_that_is_passed_on_is_found_by_its_name():
    text = "{glue:text}`share-0:.2f` of all drives"
    assert [claim.cell for claim in claims(chapter(text, "glue(f'share-{slip}', success)", passed_on=["share-0"]))] == [
        1
    ]


@pytest.mark.parametrize(
    "text",
    [
        ":::{quickcheck} Is 0.84 right?\n- [x] Yes. :: It is 0.84.\n- [ ] No. :: 0.7\n:::",
        ":::{solution-start} ex\n:class: dropdown\n:::\n\n0.84 + 0.1 = 0.94",
        "$0.84$ and `0.84` and [here](#fig-0.84), chapters 21 and 22, section 6.6",
        "turn by 45 degrees, five times, in 2018",
    ],
)
def test_what_is_given_or_worked_out_is_no_claim(text):
    assert list(claims(chapter(text))) == []
