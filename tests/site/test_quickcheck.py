"""An author who slips while writing a quick check is told what to mend."""

import io

import pytest
from sphinx.testing.util import SphinxTestApp

from building import ROOT

CONF = """
extensions = ["myst_parser", "quickcheck"]
myst_enable_extensions = ["colon_fence"]
"""
GOOD = "- [ ] Yes. :: No.\n- [x] No. :: Right,\n  because."
BROKEN = {
    "an answer without a comment": ("- [ ] Yes\n- [x] No. :: Right.", "must be `- [ ] answer :: comment`"),
    "a line that is no answer": ("Hello\n- [x] Yes. :: Fine.\n- [ ] No. :: No.", "got 'Hello'"),
    "no right answer": ("- [ ] Yes. :: No.\n- [ ] No. :: No.", "at least one of them marked [x]"),
    "a single answer": ("- [x] Yes. :: Fine.", "two or more answers"),
}


def warnings_of(source, folder, monkeypatch) -> str:
    """Build a page with this quick check, and return what the build complains about."""
    monkeypatch.syspath_prepend(ROOT / "book/_ext")
    (folder / "conf.py").write_text(CONF)
    (folder / "index.md").write_text(f"# Page\n\n:::{{quickcheck}} Why?\n{source}\n:::\n")
    warnings = io.StringIO()
    app = SphinxTestApp("html", srcdir=folder, warning=warnings)
    try:
        app.build()
    finally:
        app.cleanup()
    return warnings.getvalue()


def test_a_right_quick_check_builds_in_silence(tmp_path, monkeypatch):
    assert warnings_of(GOOD, tmp_path, monkeypatch) == ""


@pytest.mark.parametrize("slip", BROKEN)
def test_a_slip_is_reported(slip, tmp_path, monkeypatch):
    source, advice = BROKEN[slip]
    assert advice in warnings_of(source, tmp_path, monkeypatch)
