"""Every chapter of the built book has an explorable: it does something there, and can fill the screen in a lecture."""

import re

import pytest
from playwright.sync_api import expect
from sphinx_external_toc.parsing import parse_toc_yaml

import browsing
from building import ROOT

from ..widgets.pages import first_button

CHAPTERS = [name for name in parse_toc_yaml(ROOT / "_toc.yml") if re.match(r"book/\d\d-", name)]
LIVE = re.compile(r"\bis-live\b")
LECTURE = re.compile(r"\brl-lecture\b")
every_chapter = pytest.mark.parametrize("name", CHAPTERS, scope="module")


@pytest.fixture(scope="module", params=browsing.WIDTHS)
def here(request, browser, address, name):
    """A chapter at the width of a desk or of a telephone, open for all that is tried there."""
    width = request.param
    with browsing.visit(browser, f"{address}{name}.html", width, has_touch=width == "telephone") as here:
        yield here


@pytest.fixture
def explorable(here):
    """The first explorable of the chapter, live."""
    element = here.page.locator(".rlnav-explorable").first
    element.scroll_into_view_if_needed()
    expect(element).to_have_class(LIVE)
    yield element
    assert here.complaints == []


@every_chapter
def test_its_first_button_does_something(explorable):
    frame = explorable.locator(".rlnav")
    before = frame.inner_text()
    first_button(frame).click()
    expect(frame).not_to_have_text(before, use_inner_text=True)
    expect(explorable.locator(".rl-error")).to_have_count(0)


@every_chapter
def test_it_has_a_lecture_view(explorable):
    frame = explorable.locator(".rlnav")
    frame.get_by_role("button", name="Lecture view").click()
    expect(frame).to_have_class(LECTURE)
    explorable.page.keyboard.press("Escape")
    expect(frame).not_to_have_class(LECTURE)
