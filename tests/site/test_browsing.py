"""The browser tests can fail: a page with everything wrong is seen to be wrong."""

import browsing
from accessibility import findings
from test_pages import IMAGES, LOOKS_LIKE_A_PATH, OVERFLOW

BAD = """<!DOCTYPE html><html lang="en"><title>Bad</title><body><main><h1>Bad</h1><article>
<img src="https://example.org/counter.png" alt="_images/figure.svg"><img src="missing.png">
<div style="width: 2000px">wide</div><input type="range">
<script>console.error("planted complaint"); undefined_name();</script>
</article></main></body></html>"""


def test_a_page_with_everything_wrong_is_caught(browser, tmp_path):
    (tmp_path / "bad.html").write_text(BAD)
    with browsing.served(tmp_path) as address, browsing.visit(browser, f"{address}bad.html") as here:
        complaints = "\n".join(here.complaints)
        for planted in ("outside the book: https://example.org", "404: ", "planted complaint", "undefined_name"):
            assert planted in complaints
        assert here.page.evaluate(OVERFLOW) == ["DIV "]
        assert [bool(LOOKS_LIKE_A_PATH.search(alt)) for alt in here.page.evaluate(IMAGES)] == [True, False]
        broken = " ".join(findings(here.page))
        assert "image-alt" in broken
        assert "label (critical)" in broken
