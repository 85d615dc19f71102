"""Every page of the built book, in a real browser with the network cut."""

import re

import pytest
from sphinx_external_toc.parsing import parse_toc_yaml

import browsing
from accessibility import findings
from building import ROOT, pages

CHAPTERS = [*parse_toc_yaml(ROOT / "_toc.yml")]
PAGES = [*CHAPTERS, "index", "search", "genindex"]

OVERFLOW = """() => {
  const width = document.documentElement.clientWidth;
  const scrollers = 'mjx-container, pre, .text_html, .pst-scrollable-table-container, .bd-sidebar';
  const sticksOut = element => element.getBoundingClientRect().right > width + 1 && !element.closest(scrollers);
  return document.documentElement.scrollWidth <= width ? [] :
    [...document.querySelectorAll('body *')].filter(sticksOut).slice(0, 5).map(e => `${e.tagName} ${e.className}`);
}"""
UNSET_MATHEMATICS = """() => [...document.querySelectorAll('.math')].filter(
  e => !e.querySelector('mjx-container') || e.querySelector('mjx-merror')).map(e => e.textContent)"""
IMAGES = "() => [...document.querySelectorAll('article img')].map(e => e.alt)"
EXPLORABLES_ARE_LIVE = """() => {
  const next = [...document.querySelectorAll('.rlnav-explorable')].find(element => !element.matches('.is-live'));
  next ? next.scrollIntoView() : scrollTo(0, 0); // they start when the reader comes near
  return !next;
}"""
COVERED_BUTTONS = """() => [...document.querySelectorAll('.rl-lecture .rl-run button')].filter(button => {
  const { x, y, width, height } = button.getBoundingClientRect();
  return width && !button.contains(document.elementFromPoint(x + width / 2, y + height / 2));
}).map(button => button.textContent)"""
LOOKS_LIKE_A_PATH = re.compile(r"^(\.*/|_images|data:|\S+/\S+$)|\.(png|svg|jpe?g|gif)$")


def assert_whole(here: browsing.Visit) -> None:
    """Look at the page in light and in dark mode."""
    page = here.page
    page.wait_for_function(EXPLORABLES_ARE_LIVE)
    assert page.evaluate(OVERFLOW) == [], "the page scrolls sideways"
    assert page.evaluate(UNSET_MATHEMATICS) == []
    alts = page.evaluate(IMAGES)
    assert [alt for alt in alts if not alt.strip() or LOOKS_LIKE_A_PATH.search(alt)] == []
    assert findings(page) == []
    page.emulate_media(color_scheme="dark")
    page.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    assert findings(page, "color-contrast") == []
    assert here.complaints == []


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_whole(browser, address, name, width):
    with browsing.visit(browser, f"{address}{name}.html", width) as here:
        assert_whole(here)


def test_no_page_is_forgotten(book):
    """Pages that the table of contents does not name would be published without being looked at."""
    built = {str(path.relative_to(book).with_suffix("")) for path in pages(book)}
    assert built - {"py-modindex"} <= set(PAGES) | {"index"}
    assert set(PAGES) <= built


@pytest.mark.parametrize("width", browsing.WIDTHS)
def test_nothing_of_the_page_lies_over_a_lecture(browser, address, width):
    with browsing.visit(browser, f"{address}book/18-simulator.html#lecture=1", width) as here:
        here.page.locator(".rl-lecture").wait_for()
        covered = here.page.evaluate(COVERED_BUTTONS)
        assert covered == []


@pytest.mark.parametrize("name", ["index", *CHAPTERS[:2], "book/18-simulator"])
def test_a_page_opens_from_a_folder(browser, book, name):
    with browsing.visit(browser, (book / f"{name}.html").as_uri()) as here:
        assert here.page.locator("article h1").first.is_visible()
        assert here.page.evaluate(UNSET_MATHEMATICS) == []
        here.page.wait_for_function(EXPLORABLES_ARE_LIVE)
        assert here.complaints == []


def test_the_search_finds_a_word(browser, address):
    with browsing.visit(browser, f"{address}search.html?q=robot") as here:
        here.page.wait_for_selector("ul.search li a")
        assert_whole(here)


def test_the_search_works_from_a_folder(browser, book):
    with browsing.visit(browser, f"{(book / 'search.html').as_uri()}?q=robot") as here:
        here.page.wait_for_selector("ul.search li a")
        assert here.complaints == []


def test_the_color_mode_can_be_changed_and_is_remembered(browser, address):
    with browsing.visit(browser, f"{address}{CHAPTERS[0]}.html", scheme="dark") as here:
        modes = {here.page.evaluate("document.documentElement.dataset.theme")}
        for _ in range(2):
            here.page.get_by_role("button", name="Color mode").click()
            modes.add(here.page.evaluate("document.documentElement.dataset.theme"))
        chosen = here.page.evaluate("document.documentElement.dataset.mode")
        here.page.reload()
        assert here.page.evaluate("document.documentElement.dataset.mode") == chosen
        assert modes == {"light", "dark"}
