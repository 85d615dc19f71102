"""Find a Chromium for the tests, or bring one: `python tools/browser.py` prints where it is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
HELP = (
    "The tests need Chromium or Chrome, and none was found or could be installed.\n"
    "Install one (Debian, Ubuntu: sudo apt install chromium; macOS: brew install --cask chromium),\n"
    "or name yours: export RLNAV_CHROMIUM=/path/to/chrome"
)


def find() -> str | None:
    """Return the path of a browser: the one named by RLNAV_CHROMIUM, one on the PATH, or Playwright's own."""
    if named := os.environ.get("RLNAV_CHROMIUM"):
        if not os.access(named, os.X_OK):
            raise SystemExit(f"RLNAV_CHROMIUM must be the path of a browser; got {named!r}, which cannot be run.")
        return named
    on_path = (shutil.which(name) for name in NAMES)
    return next((path for path in on_path if path), None) or playwrights_own()


def playwrights_own() -> str | None:
    """Return the path of the browser that `playwright install chromium` has brought, if it has."""
    from playwright.sync_api import sync_playwright

    try:
        with sync_playwright() as playwright:
            path = playwright.chromium.executable_path
    except Exception:  # a bare system may lack what Playwright itself needs; a browser's packages bring it along
        return None
    return path if Path(path).exists() else None


def bring() -> None:
    """Install a browser: from the system's packages where this user may, else Playwright's own."""
    if os.geteuid() == 0 and shutil.which("apt-get"):
        environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
        subprocess.run(["apt-get", "update"], env=environment)
        # Without a font every letter is an empty box; Playwright's own driver needs libatomic1.
        packages = ["chromium", "fonts-liberation", "libatomic1"]
        install = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
        if subprocess.run(install, env=environment).returncode == 0:
            return
    subprocess.run([sys.executable, "-m", "playwright", "install", "chromium"])


def main() -> None:
    """Find a browser or bring one, and say where it is."""
    path = find()
    if path is None:
        bring()
        path = find() or sys.exit(HELP)
    print(f"Browser: {path}")


if __name__ == "__main__":
    main()
