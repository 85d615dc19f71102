"""The `formula` directive: an equation again, away from the chapter that explains it.

    ```{formula} eq-return
    ```

shows the equation with the label `eq-return` once more, without a number. It is taken from its chapter, so that the two
can never differ.
"""

from typing import ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import SphinxDirective
from sphinx.util.logging import getLogger


class formula(nodes.General, nodes.Element):  # noqa: N801 - docutils names visitors after the class
    """The place of an equation that is known only when all chapters have been read."""


class Formula(SphinxDirective):
    """Read the label of an equation."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the place where the equation will stand."""
        place = formula(label=self.arguments[0])
        self.set_source_info(place)
        return [place]


class Equations:
    """The equations of all chapters, by label."""

    key: ClassVar[str] = "rlnav_equations"

    def __init__(self, env: BuildEnvironment) -> None:
        if not hasattr(env, self.key):
            setattr(env, self.key, {})
        self.by_label: dict[str, tuple[str, str]] = getattr(env, self.key)

    def forget(self, docname: str) -> None:
        """Drop the equations of a page that is read anew."""
        for label in [label for label, (home, _) in self.by_label.items() if home == docname]:
            del self.by_label[label]

    def note(self, docname: str, doctree: nodes.document) -> None:
        """Keep the equations of a page."""
        for block in doctree.findall(nodes.math_block):
            if label := block.get("label"):
                self.by_label[label] = docname, block.astext()


def purge(app: Sphinx, env: BuildEnvironment, docname: str) -> None:
    """Forget what a page had before it is read again."""
    Equations(env).forget(docname)


def collect(app: Sphinx, doctree: nodes.document) -> None:
    """Keep what a page has that was just read."""
    Equations(app.env).note(app.env.docname, doctree)


def fill(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    """Put every equation into its place."""
    equations = Equations(app.env).by_label
    for place in list(doctree.findall(formula)):
        label = place["label"]
        if label not in equations:
            getLogger(__name__).warning("no chapter has an equation with the label %r", label, location=place)
            place.parent.remove(place)
            continue
        latex = equations[label][1]
        place.replace_self(nodes.math_block(latex, latex, docname=docname, nowrap=False, number=None, label=None))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.add_node(formula)
    app.add_directive("formula", Formula)
    app.connect("env-purge-doc", purge)
    app.connect("doctree-read", collect)
    app.connect("doctree-resolved", fill)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
