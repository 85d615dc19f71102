"""Widgets in a real browser, as the built page shows them, without building the book.

    def test_a_click_moves_the_robot(page_of):
        here = page_of(rl.widgets.Simulator(task), width="telephone", scheme="dark", hash="#map=maze")
        here.page.get_by_role("button", name="One update").click()
        assert state_of(here.page)["view"]["updates"] == 1

`page_of` takes one widget or several (or HTML), waits until all of them are live, and gives a browsing.Visit; the
programs are minified, as the book's are. When the test is over, the page must not have had a single complaint: no error
in the console, no request outside. A telephone has a touch screen, so `here.page.touchscreen.tap(x, y)` and
`locator.tap()` work there. `state_of` and `write_page` are in pages.py.
"""

import shutil
from contextlib import ExitStack
from importlib.resources import files
from itertools import count

import pytest

import browsing
from rlnav.widgets import _bundle, _modules

from .pages import write_page
from .tiny import PROGRAM, STYLE, Tiny

ALL_LIVE = """() => {
  const all = [...document.querySelectorAll('.rlnav-explorable')];
  all.forEach(element => element.scrollIntoView()); // they start when they are near
  scrollTo(0, 0);
  return all.every(element => element.matches('.is-live'));
}"""


@pytest.fixture(scope="module")
def browser():
    with browsing.launched() as browser:
        yield browser


@pytest.fixture(scope="module")
def js(browser):
    """Run functions in a page that has the package's modules at /, as in `await import("/mdp.js")`."""
    with browsing.served(_modules.HOME) as address, browsing.visit(browser, address) as here:
        yield here.page.evaluate
        assert here.complaints == []


@pytest.fixture
def page_of(browser, tmp_path):
    """Open a page with one or more widgets; see the head of this file."""
    numbers, visits = count(), []
    with ExitStack() as open_until_the_end:

        def page_of(*widgets, width="desk", scheme="light", hash="", live=True, **options):
            folder = tmp_path / f"page{next(numbers)}"
            write_page(folder, *widgets, scheme=scheme)
            address = open_until_the_end.enter_context(browsing.served(folder))
            options.setdefault("has_touch", width == "telephone")
            here = open_until_the_end.enter_context(
                browsing.visit(browser, f"{address}index.html{hash}", width, scheme, **options)
            )
            visits.append(here)
            if live:
                here.page.wait_for_function(ALL_LIVE)
            return here

        yield page_of
        complaints = [complaint for here in visits for complaint in here.complaints]
    assert complaints == []


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Give the package more modules than it has: `program("explorables/tiny.js", text)`."""
    home = tmp_path / "js"
    shutil.copytree(files("rlnav") / "js", home)
    monkeypatch.setattr(_modules, "HOME", home)
    caches = (_bundle.module, _bundle.script, _bundle.part, _bundle.stylesheet, _modules.parse)

    def forget():
        for cache in caches:
            cache.cache_clear()

    def write(path, text):
        (home / path).parent.mkdir(exist_ok=True)
        (home / path).write_text(text, encoding="utf-8")
        forget()

    forget()
    yield write
    forget()


@pytest.fixture
def tiny(program):
    """The class of the smallest explorable, with its program in place."""
    program("explorables/tiny.js", PROGRAM)
    program("explorables/tiny.css", STYLE)
    return Tiny
