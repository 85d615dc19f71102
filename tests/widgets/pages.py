"""Write a page with explorables, and all that it loads, as the book does."""

from contextlib import contextmanager
from pathlib import Path

from explorables import minified
from rlnav.widgets import _bundle

ROOT = Path(__file__).parents[2]
HOST = ROOT / "book" / "_static" / "explorables.js"
PAGE = """<!DOCTYPE html>
<html lang="en" data-theme="{scheme}">
<head>
  <meta charset="utf-8">
  <meta name="viewport" content="width=device-width, initial-scale=1">
  <title>Explorables</title>
  <style>
    body {{ font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 60rem; padding: 16px; }}
    html[data-theme=dark] {{ background: #16191d; color: #ced6dd; }}
  </style>
  <script defer src="_static/explorables.js"></script>
</head>
<body><main><h1>Explorables</h1>
{body}
</main></body>
</html>
"""


def html_of(widget):
    return widget if isinstance(widget, str) else widget.html()


def entries_in(body):
    """The programs that a page of explorables needs."""
    return {part.split('"', 1)[0] for part in body.split('data-entry="')[1:]}


def write_page(folder, *widgets, scheme="light"):
    """Write a page with these widgets, and all that it loads; return its file."""
    body = "\n".join(map(html_of, widgets))
    page = folder / "index.html"
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(PAGE.format(scheme=scheme, body=body), encoding="utf-8")
    (folder / "_static").mkdir(exist_ok=True)
    (folder / "_static" / HOST.name).write_text(HOST.read_text(encoding="utf-8"), encoding="utf-8")
    for entry in entries_in(body):
        _bundle.publish(entry, folder / "_static" / "rlnav", minified)
    return page


def state_of(page, number=0):
    """The state of one explorable of a page, as a kernel would know it: a moment after the last change."""
    return page.evaluate("n => document.querySelectorAll('.rlnav-explorable')[n].model.get('state')", number)


def state_now(page, number=0):
    """The same without waiting: the page is told that it is left, and saves what it has."""
    page.evaluate("dispatchEvent(new Event('pagehide'))")
    return state_of(page, number)


def kernel_sets(page, patch):
    """Change a part of the state of the page's first explorable, as its kernel would."""
    page.evaluate(
        """patch => {
          const { model } = document.querySelector('.rlnav-explorable');
          model.set('state', { ...model.get('state'), ...patch });
        }""",
        patch,
    )


@contextmanager
def in_lecture(page):
    """Show the explorable in the lecture view, and then the page again."""
    page.get_by_role("button", name="Lecture view").click()
    yield
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Lecture view").wait_for()


def fits_into(page, width):
    """Whether nothing sticks out sideways in a window of so many pixels."""
    page.set_viewport_size({"width": width, "height": 740})
    settled(page)
    return page.evaluate("document.documentElement.scrollWidth") <= width


def settled(page):
    """Wait until what has just been done is drawn: a program draws in the next frame, and that may be late."""
    page.evaluate("() => new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn)))")


def first_button(explorable):
    """Return the button that asks to be pressed: the colored one, or else the first below the title."""
    colored = explorable.locator(".rl-primary:visible")
    return (
        colored
        if colored.count()
        else explorable.locator(".rl-explorable-body .rl-button:visible:not([aria-disabled=true])")
    ).first
