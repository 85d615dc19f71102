"""Make the built pages whole: they need no other site, no kernel and no mouse."""

import html
import subprocess
import sys
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.config import Config
from sphinx.writers.html5 import HTML5Translator

FRONT_DOOR = """<!DOCTYPE html>
<html lang="{language}">
<head>
  <meta charset="utf-8">
  <meta name="viewport" content="width=device-width, initial-scale=1">
  <meta http-equiv="refresh" content="0; url={first}">
  <title>{title}</title>
</head>
<body>
  <main><h1>{title}</h1><p><a href="{first}">Open the book</a></p></main>
</body>
</html>
"""
VENDOR = Path(__file__).resolve().parents[2] / "tools" / "vendor.py"


def bring_files(app: Sphinx, config: Config) -> None:
    """Fetch MathJax and the minifier if they are not there yet, so that a plain build is the same as that of make."""
    subprocess.run([sys.executable, VENDOR, "mathjax", "esbuild"], check=True)


def drop_widget_state(app: Sphinx, doctree: object) -> None:
    """Leave out the stored state of ipywidgets: the page shows their static figure instead (see _config.yml)."""
    metadata = getattr(app.env, "nb_metadata", {}).get(app.env.docname, {})
    metadata.pop("js_files", None)


def drop_empty_headers(app: Sphinx, doctree: nodes.document) -> None:
    """Let a table go without a header: Markdown demands one, and a screen reader would read its empty cells."""
    for header in list(doctree.findall(nodes.thead)):
        if not header.astext().strip():
            header.parent.remove(header)


def complete_singlehtml(app: Sphinx) -> None:
    """Give the one-page builder every extension's html visitors.

    It loses them all as soon as one extension, here sphinx-exercise, registers visitors for it by name.
    """
    handlers = app.registry.translation_handlers
    handlers["singlehtml"] = {**handlers.get("html", {}), **handlers.get("singlehtml", {})}


def visit_citation(self: HTML5Translator, node: nodes.citation) -> None:
    """Call an entry of the bibliography a list item: docutils calls it a deprecated role that a list may not hold."""
    HTML5Translator.visit_citation(self, node)
    self.body[-1] = self.body[-1].replace('role="doc-biblioentry"', 'role="listitem"')


def depart_citation(self: HTML5Translator, node: nodes.citation) -> None:
    """Close the entry as docutils does."""
    HTML5Translator.depart_citation(self, node)


def write_front_door(app: Sphinx, error: Exception | None) -> None:
    """Send `index.html` on to the first page, by a page that has a language, a title and a link."""
    if error or app.builder.name != "html":
        return
    first, title = f"{app.config.root_doc}.html", html.escape(app.config.html_title)
    page = FRONT_DOOR.format(language=app.config.language, first=first, title=title)
    (Path(app.outdir) / "index.html").write_text(page, encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("config-inited", bring_files)
    app.connect("doctree-read", drop_widget_state)
    app.connect("doctree-read", drop_empty_headers)
    app.connect("builder-inited", complete_singlehtml)
    app.connect("build-finished", write_front_door, priority=400)  # before sphinx-external-toc writes a bare one
    app.add_node(nodes.citation, override=True, html=(visit_citation, depart_citation))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
