"""What axe-core finds on a page, without the few findings that are known and have a reason."""

from playwright.sync_api import Page

import vendor

# rule of axe-core -> why the book lives with it
ACCEPTED: dict[str, str] = {}

AXE = vendor.PACKAGES["axe-core"]


def findings(page: Page, *rules: str) -> list[str]:
    """Return one line for each rule that the page breaks; only these rules are tried, or all."""
    vendor.fetch(AXE)
    page.evaluate((AXE.folder / "axe.min.js").read_text())
    options = {"resultTypes": ["violations"], **({"runOnly": list(rules)} if rules else {})}
    result = page.evaluate("options => axe.run(document, options)", options)
    return [
        f"{broken['id']} ({broken['impact']}): {broken['help']}; first at {broken['nodes'][0]['html'][:200]}"
        for broken in result["violations"]
        if broken["id"] not in ACCEPTED
    ]
