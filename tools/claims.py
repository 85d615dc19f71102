"""List every number in the text of a chapter and the cell that it comes from.

    python tools/claims.py                  # every chapter, as a Markdown table
    python tools/claims.py book/one.ipynb   # this one

A number comes from a cell if the cell passes it on (`glue`), prints it, or sets it. Numbers of exercises, quick checks
and formulas are not claims: they are given, or worked out on the page. Small whole numbers count what the reader sees.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from nbformat import NotebookNode

from canonical import read
from execute import ROOT, find

GLUED = re.compile(r"\{glue:text\}`([\w-]+)(?::[^`]*)?`")
LEFT_OUT = [
    re.compile(r"^(:{3,}|`{3,})\{(?:quickcheck|exercise|solution|dropdown|math|figure)\}.*?^\1\s*$", re.M | re.S),
    re.compile(r"^```.*?^```", re.M | re.S),  # code
    re.compile(r"\$\$.*?\$\$", re.S),
    re.compile(r"\$[^$]*\$"),
    re.compile(r"`[^`]*`"),
    re.compile(r"\]\([^)]*\)"),  # where a link leads
    re.compile(r"<[^>]*>"),
    re.compile(r"^#.*$", re.M),
    re.compile(r"\*\*Time\*\* \d+ minutes"),
    re.compile(r"\b(?:chapter|section|example|figure|page|table)s? [\d.]+(?:(?:,|,? and|,? or| to) [\d.]+)*", re.I),
    re.compile(r"\(\d+(?:\.\d+)*\)"),
]
NUMBER = re.compile(r"(?<![\w.,])[-−+]?\d+(?:,\d{3})*(?:\.\d+)?(?!\w|\.\d)")
FEW = 20  # whole numbers up to this count what is on the page
WORLD = {"0.1", "0.95", "45", "90", "135", "180", "225", "270", "315", "360"}  # the robot's own
PERCENT = {"95", "100"}  # the confidence of all intervals, and all


@dataclass(frozen=True)
class Claim:
    """A number in the text, the words around it, and the number of the cell that it comes from, or None."""

    number: str
    words: str
    cell: int | None
    how: str


def claims(notebook: NotebookNode) -> Iterator[Claim]:
    """Yield every number of the text that somebody could check, in order."""
    cells = [(n, cell) for n, cell in enumerate((c for c in notebook.cells if c.cell_type == "code"), 1)]
    solving = False
    for cell in notebook.cells:
        if cell.cell_type != "markdown":
            continue
        for found in GLUED.finditer(cell.source):
            home = next((n for n, code in cells if found[1] in glued(code)), None)
            yield Claim(found[0], around(cell.source, found), home, "glue")
        text, solving = outside_of_solutions(cell.source, solving)
        for pattern in LEFT_OUT:
            text = pattern.sub(lambda found: " " * len(found[0]), text)
        for found in NUMBER.finditer(text):
            if counts(found[0]):
                yield Claim(found[0], around(text, found), *source_of(found[0], cells))


def glued(cell: NotebookNode) -> set[str]:
    """Return the names under which a cell has passed numbers on to the text."""
    return {
        output.metadata["scrapbook"]["name"] for output in cell.outputs if "scrapbook" in output.get("metadata", {})
    }


def outside_of_solutions(text: str, solving: bool) -> tuple[str, bool]:
    """Return the text without solutions that span several cells, and whether one goes on in the next cell."""
    kept = ""
    for part in re.split(r"(\{solution-start\}|\{solution-end\})", text):
        if part in ("{solution-start}", "{solution-end}"):
            solving = part == "{solution-start}"
        elif not solving:
            kept += part
    return kept, solving


def counts(number: str) -> bool:
    """Tell whether a number is one that a run could change."""
    plain = number.replace("−", "-").replace(",", "").lstrip("+-")
    return plain not in WORLD | PERCENT and not ("." not in plain and (int(plain) <= FEW or 1900 <= int(plain) <= 2100))


def source_of(number: str, cells: list[tuple[int, NotebookNode]]) -> tuple[int | None, str]:
    """Find the first cell that prints or sets a number."""
    plain = number.replace("−", "-").replace(",", "").lstrip("+-")
    there = re.compile(rf"(?<![\d.]){re.escape(plain)}0*(?![\d]|\.\d)")
    for n, cell in cells:
        printed = " ".join(
            str(output.get("text") or output.get("data", {}).get("text/plain", "")) for output in cell.outputs
        )
        for how, text in (("printed", printed), ("set", cell.source)):
            if there.search(text.replace(",", "").replace("_", "")):
                return n, how
    return None, "nowhere"


def around(text: str, found: re.Match[str], width: int = 34) -> str:
    """Return the words around a place."""
    piece = text[max(0, found.start() - width) : found.end() + width]
    return " ".join(piece.replace("|", " ").split())


def main() -> int:
    """Print the table; fail if a number comes from nowhere."""
    parser = argparse.ArgumentParser(description="List the numbers in the text of chapters and where they come from.")
    parser.add_argument("paths", nargs="*", type=Path, default=[ROOT / "book"], help="notebooks or folders (book)")
    lost = 0
    print("| chapter | number | in the text | cell | how |\n|---|---|---|---|---|")
    for path in find(parser.parse_args().paths):
        for claim in claims(read(path)):
            lost += claim.cell is None
            cell = f"[{claim.cell}]" if claim.cell else "?"
            print(f"| {path.stem} | {claim.number} | {claim.words} | {cell} | {claim.how} |")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
