"""Give each page with explorables the script that starts them, and the book the programs that they run."""

import hashlib
import re
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

from rlnav.widgets._bundle import programs, publish

ROOT = Path(__file__).resolve().parents[2]
ESBUILD = ROOT / "tools" / "vendor" / "esbuild"
ENTRY = re.compile(r'class="rlnav-explorable" data-entry="([\w/]+)"')


@cache
def minified(script: str) -> str:
    """Give local names one letter; where there is no minifier for this system, the script stays as it is."""
    program = next(ESBUILD.rglob("esbuild*"), None) if ESBUILD.is_dir() else None
    if program is None:
        return script
    command = [str(program), "--minify", "--charset=utf8", "--log-level=warning"]
    return subprocess.run(command, input=script, capture_output=True, text=True, encoding="utf-8", check=True).stdout


def add_host(app: Sphinx, page: str, template: str, context: dict, doctree: nodes.document | None) -> None:
    """Load the script on pages that have explorables, and only there."""
    if entries := sorted(set(ENTRY.findall(context.get("body", "")))):
        text = "".join(text for entry in entries for text in programs(entry).values())
        version: dict[str, Any] = {"data-version": hashlib.sha256(text.encode()).hexdigest()[:8]}
        app.add_js_file("explorables.js", loading_method="defer", **version)


def write_programs(app: Sphinx, error: Exception | None) -> None:
    """Write the program of every explorable of the book into the book's own folder of static files."""
    if error or app.builder.format != "html":
        return
    out = Path(app.outdir)
    pages = (path for path in out.rglob("*.html") if "_static" not in path.parts)
    for entry in {entry for page in pages for entry in ENTRY.findall(page.read_text(encoding="utf-8"))}:
        publish(entry, out / "_static" / "rlnav", minified)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("html-page-context", add_host)
    app.connect("build-finished", write_programs)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
