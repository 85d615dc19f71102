"""What the book's own parts do, seen on a chapter that has one of everything."""

import re

import pytest

import browsing
from accessibility import findings
from building import build
from test_pages import assert_whole


@pytest.fixture
def chapter(browser, sample_address):
    with browsing.visit(browser, f"{sample_address}book/sample.html") as here:
        yield here.page
        assert here.complaints == []


@pytest.mark.parametrize("width", browsing.WIDTHS)
def test_a_chapter_with_everything_is_whole(browser, sample_address, width):
    with browsing.visit(browser, f"{sample_address}book/sample.html", width) as here:
        assert_whole(here)


def test_a_page_shows_the_figure_instead_of_controls_without_python(chapter, sample_book):
    html = (sample_book / "book/sample.html").read_text()
    for dead in ("widget-view+json", "widget-state+json", "html-manager", "require.js", "requirejs"):
        assert dead not in html
    assert chapter.locator(".cell_output img:not(.rlnav-explorable *)").count() == 3
    assert chapter.get_by_text("Run this notebook to move the controls").is_visible()


def test_an_explorable_starts_when_the_reader_comes_to_it(chapter):
    explorable = chapter.locator(".rlnav-explorable")
    explorable.scroll_into_view_if_needed()
    explorable.get_by_role("button").first.wait_for()
    assert not explorable.locator(".rl-live").is_visible()
    assert findings(chapter) == []


def test_nothing_around_an_explorable_scrolls_or_clips(chapter):
    """Or what sticks to the window inside it would not, and its rings of focus would be cut."""
    around = "e => (e = e.parentElement) ? [getComputedStyle(e).overflow, ...around(e)] : []"
    overflow = chapter.locator(".rlnav-explorable").evaluate(f"e => {{ const around = {around}; return around(e); }}")
    assert set(overflow) == {"visible"}


def test_only_pages_with_explorables_load_their_script(sample_book):
    host = re.search(r"<script [^>]*explorables\.js[^>]*>", (sample_book / "book/sample.html").read_text())
    assert re.search(r'data-version="[0-9a-f]{8}"', host[0]), "a browser may keep a program until it changes"
    assert "explorables.js" not in (sample_book / "book/other.html").read_text()
    programs = [path.name for path in (sample_book / "_static/rlnav").rglob("*.*")]
    assert sorted(programs) == ["loop_debugger.css", "loop_debugger.js"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_an_explorable_draws_is_not_taken_for_a_figure(browser, sample_address, scheme):
    """A figure is put on a white card where the page is dark; an explorable has a dark look of its own."""
    with browsing.visit(browser, f"{sample_address}book/sample.html", scheme=scheme) as here:
        here.page.locator(".rlnav-explorable").scroll_into_view_if_needed()
        here.page.locator(".rlnav svg").first.wait_for(state="attached")
        looks = "all => all.map(e => [getComputedStyle(e).filter, getComputedStyle(e).backgroundColor])"
        drawn = here.page.locator(".rlnav :is(svg, img, canvas)").evaluate_all(looks)
        assert {tuple(look) for look in drawn} == {("none", "rgba(0, 0, 0, 0)")}


def test_the_big_icon_script_is_not_loaded_and_icons_are_there(chapter):
    assert "fontawesome.js" not in chapter.content()
    assert chapter.evaluate("document.fonts.check('900 16px \"Font Awesome 6 Free\"')")


def test_a_wide_formula_can_be_scrolled_with_the_keyboard(chapter):
    formulas = chapter.locator('mjx-container[display="true"]')
    assert formulas.nth(0).get_attribute("tabindex") is None, "it fits, so it is no stop of the Tab key"
    assert formulas.nth(1).get_attribute("tabindex") == "0"
    formulas.nth(1).focus()
    chapter.keyboard.press("ArrowRight")
    chapter.wait_for_function("document.querySelectorAll('mjx-container[display=true]')[1].scrollLeft > 0")


def test_a_quick_check_answers_the_choice_and_only_that(chapter):
    check = chapter.get_by_role("group", name="Does the best policy change")
    answers, comments = check.get_by_role("radio"), check.get_by_role("status").locator("p")
    assert [comments.nth(i).is_visible() for i in range(3)] == [False, False, False]
    check.get_by_label("No.").check()
    assert [comments.nth(i).is_visible() for i in range(3)] == [False, True, False]
    assert comments.nth(1).inner_text().startswith("Right. ")
    answers.nth(1).press("ArrowUp")
    assert [comments.nth(i).is_visible() for i in range(3)] == [True, False, False]
    assert comments.nth(0).inner_text().startswith("Not quite. ")
    assert "what was best stays best" in comments.nth(0).inner_text(), "a comment may go on in the next line"
    assert check.locator("mjx-container").count() == 5
    assert findings(chapter) == []


def test_a_quick_check_works_without_scripts(browser, sample_address):
    with browsing.visit(browser, f"{sample_address}book/sample.html", java_script_enabled=False) as here:
        check = here.page.get_by_role("group", name="Does the best policy change")
        check.get_by_label("No.").check()
        assert check.get_by_text("Every return doubles").is_visible()


def test_hints_and_solutions_open_one_by_one_with_the_keyboard(chapter):
    first, second = (chapter.get_by_text(hint) for hint in ("Which states change", "The news travels"))
    assert not first.is_visible()
    chapter.locator("summary", has_text="Hint 1").press("Enter")
    assert first.is_visible()
    assert not second.is_visible()
    solution = chapter.get_by_text("As many as the longest shortest path")
    assert not solution.is_visible()
    chapter.locator(".solution .toggle-button").press("Enter")
    assert solution.is_visible()


def test_print_shows_what_was_folded_and_no_navigation(browser, sample_address):
    with browsing.visit(browser, f"{sample_address}book/sample.html", scheme="dark") as here:
        page = here.page
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        page.emulate_media(media="print", color_scheme="dark")
        for folded in ("Which states change", "The news travels", "As many as the longest", "Every return doubles"):
            assert page.get_by_text(folded).is_visible(), folded
        for navigation in ("#pst-primary-sidebar", "#pst-secondary-sidebar", ".prev-next-footer"):
            assert not page.locator(navigation).is_visible(), navigation
        assert page.locator("h1", has_text="A chapter with everything").locator("visible=true").count() == 1
        assert page.evaluate("getComputedStyle(document.querySelector('article p')).color") == "rgb(0, 0, 0)"


def test_the_whole_book_builds_as_one_page(sample_source, tmp_path):
    pages = build(sample_source, tmp_path, "--builder", "singlehtml") / "singlehtml"
    html = "".join(path.read_text() for path in pages.rglob("*.html"))
    assert "Contraction" in html
    assert "<fieldset" in html
