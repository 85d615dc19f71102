"""The built page starts its explorables; what cannot start says so and leaves its still picture."""

import pytest

import browsing
from accessibility import findings

from .pages import state_of, write_page


@pytest.mark.parametrize("width", browsing.WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_an_explorable_takes_the_place_of_its_still_picture(tiny, page_of, width, scheme):
    page = page_of(tiny({"clicks": 3}), width=width, scheme=scheme).page
    assert not page.locator("img").is_visible()
    page.get_by_role("button", name="clicked 3 of many").click()
    assert page.get_by_role("button").inner_text() == "clicked 4 of many"
    assert page.get_by_role("button").evaluate("button => getComputedStyle(button).letterSpacing") == "3px"
    assert findings(page) == []


def test_what_the_reader_does_is_known_a_moment_later(tiny, page_of):
    page = page_of(tiny()).page
    page.get_by_role("button").click()
    page.wait_for_function("document.querySelector('.rlnav-explorable').model.get('state').clicks === 1")
    assert state_of(page) == {"clicks": 1, "names": {"button": "click"}}


def test_two_of_a_kind_share_a_page_and_nothing_else(tiny, page_of):
    here = page_of(tiny(), tiny({"clicks": 7}, tables={"most": 9}))
    first, second = here.page.get_by_role("button").all()
    first.click()
    assert [first.inner_text(), second.inner_text()] == ["clicked 1 of many", "clicked 7 of 9"]
    assert here.page.locator("script[src$='tiny.js']").count() == 1
    assert here.page.locator("link[href$='tiny.css']").count() == 1


def test_an_explorable_waits_until_the_reader_comes_near(tiny, page_of):
    here = page_of("<div style='height: 5000px'></div>", tiny(), live=False)
    assert here.page.locator("script[src$='tiny.js']").count() == 0
    here.page.locator("img").scroll_into_view_if_needed()
    here.page.get_by_role("button").wait_for()


def test_a_link_with_settings_starts_everything_at_once(tiny, page_of):
    here = page_of("<div style='height: 5000px'></div>", tiny(), live=False, hash="#alpha=0.5")
    here.page.get_by_role("button").wait_for()


def test_paper_shows_the_still_picture_only(tiny, page_of):
    page = page_of(tiny()).page
    page.emulate_media(media="print")
    assert page.locator("img").is_visible()
    assert not page.get_by_role("button").is_visible()


def test_a_page_without_scripts_shows_the_still_picture(tiny, page_of):
    page = page_of(tiny(), live=False, java_script_enabled=False).page
    assert page.locator("img").is_visible()
    assert "running notebook" in page.locator("figcaption").inner_text()


def test_a_page_opens_from_a_folder(tiny, browser, tmp_path):
    file = write_page(tmp_path / "a folder", tiny())
    with browsing.visit(browser, file.as_uri()) as here:
        here.page.get_by_role("button").click()
        assert here.page.get_by_role("button").inner_text() == "clicked 1 of many"
        assert here.complaints == []


BROKEN = {
    "settings are damaged": (lambda html: html.replace("{", "{,"), "The settings stored in this page are damaged."),
    "the program throws": (lambda html: html.replace('"clicks":0', '"clicks":-1'), "`clicks` must be at least 0"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_cannot_start_says_why_and_keeps_its_picture(tiny, page_of, case):
    change, message = BROKEN[case]
    here = page_of(change(tiny().html()), tiny({"clicks": 5}), live=False)
    alert = here.page.get_by_role("alert").filter(has_text=message)
    alert.wait_for()
    assert here.page.locator("img").first.is_visible()
    here.page.get_by_role("button").click()  # the other one works
    assert here.page.get_by_role("button").inner_text() == "clicked 6 of many"


def test_a_file_that_is_missing_is_named(tiny, browser, tmp_path):
    file = write_page(tmp_path, tiny())
    (tmp_path / "_static/rlnav/explorables/tiny.js").unlink()
    with browsing.served(file.parent) as address, browsing.visit(browser, f"{address}index.html") as here:
        alert = here.page.get_by_role("alert")
        alert.wait_for()
        assert "still picture is shown. The file tiny.js could not be loaded." in alert.inner_text()
        assert here.page.locator("img").is_visible()
        assert all("tiny.js" in complaint or "404" in complaint for complaint in here.complaints)
