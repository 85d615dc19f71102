"""The `quickcheck` directive: one question, a few answers, and a comment on the answer that the reader picks.

In a chapter::

    :::{quickcheck} Does the best policy change when every reward doubles?

    - [ ] Yes, the values are larger. :: They are, by the same factor everywhere,
      so that what was best stays best.
    - [x] No. :: Every return doubles, so the order of the policies is the same.

    :::

`[x]` marks a right answer, `::` ends the answer and begins the comment; a line that continues is indented. All of it
may hold mathematics and emphasis. The empty lines make it a readable list in JupyterLab too, where nothing is hidden.
The page needs no script: radio buttons and a style sheet show the comment of the chosen answer.
"""

import re
from dataclasses import dataclass

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

ANSWER = re.compile(r"^- \[(?P<mark>[ xX])\] +(?P<text>.*?) +:: +(?P<comment>.*)$")


@dataclass
class Answer:
    """One answer that can be chosen."""

    right: bool
    text: str
    comment: str


class quickcheck(nodes.General, nodes.Element):  # noqa: N801 - docutils names visitors after the class
    """The whole question; its children are the question's text and the answers."""


class quickcheck_question(nodes.General, nodes.TextElement):  # noqa: N801
    """What is asked."""


class quickcheck_answer(nodes.General, nodes.Element):  # noqa: N801
    """One answer; its children are its text and its comment."""


class quickcheck_text(nodes.General, nodes.TextElement):  # noqa: N801
    """The words of an answer."""


class quickcheck_comment(nodes.General, nodes.TextElement):  # noqa: N801
    """What the reader is told after choosing the answer."""


class QuickCheck(SphinxDirective):
    """Read one question with its answers."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the question as nodes."""
        answers = self.answers()
        name = f"quickcheck-{self.env.new_serialno('quickcheck') + 1}"
        check = quickcheck(name=name)
        check += self.inline(quickcheck_question(name=name), self.arguments[0])
        for number, answer in enumerate(answers, start=1):
            node = quickcheck_answer(name=name, number=number, right=answer.right)
            node += self.inline(quickcheck_text(), answer.text)
            node += self.inline(quickcheck_comment(right=answer.right), answer.comment)
            check += node
        self.set_source_info(check)
        return [check]

    def answers(self) -> list[Answer]:
        """Read the list of answers; a mistake is reported with the line that holds it."""
        answers: list[Answer] = []
        for line, (_, at) in zip(self.content, self.content.items, strict=True):
            if found := ANSWER.match(line):
                answers.append(Answer(found["mark"] != " ", found["text"], found["comment"]))
            elif answers and line.startswith("  "):
                answers[-1].comment += " " + line.strip()
            elif line.strip():
                message = "an answer of a quickcheck must be `- [ ] answer :: comment` or `- [x] answer :: comment`"
                raise self.severe(f"{message}; got {line!r} (line {at + 1}).")
        if len(answers) < 2 or not any(answer.right for answer in answers):
            raise self.severe("a quickcheck must have two or more answers, at least one of them marked [x].")
        return answers

    def inline(self, parent: nodes.TextElement, text: str) -> nodes.TextElement:
        """Parse `text` as one line of the chapter, mathematics and all, into `parent`."""
        children, messages = self.state.inline_text(text, self.lineno)
        parent += children
        parent += messages
        return parent


def visit_quickcheck(self, node):
    """Open the group; its question is the group's name."""
    self.body.append(self.starttag(node, "fieldset", CLASS="quickcheck"))


def depart_quickcheck(self, node):
    """Close the group."""
    self.body.append("</fieldset>\n")


def visit_question(self, node):
    """Open the question, which assistive technology reads with each answer."""
    self.body.append('<legend><span class="quickcheck-label">Quick check</span> ')


def depart_question(self, node):
    """Close the question."""
    self.body.append("</legend>\n")


def visit_answer(self, node):
    """Write a radio button; the comment that follows is shown when it is chosen."""
    name, number = node["name"], node["number"]
    self.body.append(f'<div class="quickcheck-answer {"right" if node["right"] else "wrong"}">')
    self.body.append(f'<input type="radio" name="{name}" id="{name}-{number}" autocomplete="off">')
    self.body.append(f'<label for="{name}-{number}">')


def depart_answer(self, node):
    """Close the answer."""
    self.body.append("</div>\n")


def visit_text(self, node):
    """Write the answer's words, inside the label."""


def depart_text(self, node):
    """Close the label."""
    self.body.append("</label>")


def visit_comment(self, node):
    """Open a live region: a screen reader says the comment as soon as it appears."""
    verdict = "Right." if node["right"] else "Not quite."
    self.body.append(f'<div class="quickcheck-comment" role="status"><p><strong>{verdict}</strong> ')


def depart_comment(self, node):
    """Close the live region."""
    self.body.append("</p></div>")


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.add_directive("quickcheck", QuickCheck)
    app.add_node(quickcheck, html=(visit_quickcheck, depart_quickcheck))
    app.add_node(quickcheck_question, html=(visit_question, depart_question))
    app.add_node(quickcheck_answer, html=(visit_answer, depart_answer))
    app.add_node(quickcheck_text, html=(visit_text, depart_text))
    app.add_node(quickcheck_comment, html=(visit_comment, depart_comment))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
