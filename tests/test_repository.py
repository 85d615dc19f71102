"""The files around the library agree with it and with each other."""

import os
import re
import tomllib
from itertools import chain
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import rlnav

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
TALK_OF_MAKE = [*ROOT.glob("*.md"), *ROOT.glob("book/*.md"), *ROOT.glob(".github/workflows/*.yml"), ROOT / ".ci/run"]


def pins() -> dict[str, str]:
    """Return the exact versions that requirements.txt names."""
    lines = (line.split("#")[0].strip() for line in (ROOT / "requirements.txt").read_text().splitlines())
    pinned = (Requirement(line) for line in lines if line and not line.startswith("-"))
    return {canonicalize_name(r.name): str(r.specifier).removeprefix("==") for r in pinned}


def needed() -> list[Requirement]:
    """Return what the library and all its extras need, apart from the library itself."""
    lines = chain(PROJECT["dependencies"], *PROJECT["optional-dependencies"].values())
    return [requirement for requirement in map(Requirement, lines) if requirement.name != "rlnav"]


def test_one_version_everywhere():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["version"] == PROJECT["version"] == rlnav.__version__
    assert f"## {rlnav.__version__} " in (ROOT / "CHANGELOG.md").read_text()


def test_requirements_pin_all_that_the_extras_need():
    pinned = pins()
    assert {canonicalize_name(r.name) for r in needed()} <= pinned.keys()
    assert [str(r) for r in needed() if pinned[canonicalize_name(r.name)] not in r.specifier] == []


def test_every_make_command_that_is_mentioned_exists():
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    mentioned = {
        (path.name, target)
        for path in TALK_OF_MAKE
        for target in re.findall(r"(?:^|`|run: |exec )make ([a-z]+)", path.read_text(), re.MULTILINE)
    }
    assert {target for _, target in mentioned} >= {"book", "test"}
    assert {(name, target) for name, target in mentioned if target not in targets} == set()


def test_the_reference_names_everything_public():
    reference = (ROOT / "book/api.md").read_text()
    shown = set(re.findall(r"^\.\. auto\w+:: (?:rlnav\.)?(\w+)", reference, re.MULTILINE))
    assert set(rlnav.__all__) - shown == set()


@pytest.mark.parametrize("script", [".ci/run"])
def test_a_script_can_be_run(script):
    assert os.access(ROOT / script, os.X_OK)
