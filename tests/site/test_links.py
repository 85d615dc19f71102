"""Every link inside the built book leads somewhere."""

from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import browsing
from building import pages

SIMULATOR = 'data-entry="simulator/app"'  # its settings may follow the # of an address


class Links(HTMLParser):
    """The addresses a page refers to, and the places in it that can be referred to."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.places: set[str] = {"", "top"}

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.addresses += [named[key] for key in ("href", "src") if named.get(key)]
        self.places |= {named[key] for key in ("id", "name") if named.get(key)}


@cache
def read(path: Path) -> Links:
    links = Links()
    links.feed(path.read_text(encoding="utf-8"))
    return links


def test_every_internal_link_leads_somewhere(browser, address, book):
    dead, followed, settings = [], 0, set()
    for page in pages(book):
        for link in read(page).addresses:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (page.parent / unquote(parts.path)) if parts.path else page
            followed += 1
            if not target.is_file():
                dead.append(f"{page.relative_to(book)} -> {link}")
            elif "=" in parts.fragment and SIMULATOR in target.read_text(encoding="utf-8"):
                settings.add(f"{target.relative_to(book)}#{parts.fragment}")
            elif target.suffix == ".html" and unquote(parts.fragment) not in read(target).places:
                dead.append(f"{page.relative_to(book)} -> {link} (no such place)")
    assert dead == []
    assert followed > 100, "hardly any link was followed: is the book empty?"
    for link in settings:  # the simulator takes them without a complaint
        with browsing.visit(browser, address + link) as here:
            here.page.locator(".rlnav-explorable.is-live").first.wait_for(
                state="attached"
            )  # in a lecture it has no size
            assert here.page.locator(".rl-message").all_text_contents() == []
            assert here.complaints == []
