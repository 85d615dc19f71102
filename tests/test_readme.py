"""The README's promises."""

import re
from pathlib import Path

import pytest

import picture

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def test_the_readme_shows_code():
    assert len(BLOCKS) == 2


@pytest.mark.parametrize("code", BLOCKS, ids=["ten lines", "own functions"])
def test_the_code_in_the_readme_runs_as_printed(code):
    exec(compile(code, "README.md", "exec"), {})


def test_the_files_that_the_readme_links_exist():
    links = [link for link in re.findall(r"\]\(([^)#]+)\)", README) if "://" not in link]
    missing = [link for link in links if not (Path(__file__).parents[1] / link).exists()]
    assert links
    assert not missing


def test_the_make_targets_in_the_readme_exist():
    makefile = (Path(__file__).parents[1] / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"(?:^|`)make (\w+)", README, re.MULTILINE))
    assert {"book", "test"} <= targets
    for target in targets:
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


def test_the_picture_is_what_the_library_draws():
    assert picture.FILE.read_text(encoding="utf-8") == picture.draw(), "run `python tools/picture.py`"
