"""Open pages of the built book in a real Chromium that reaches nothing but the book, and write down what goes wrong."""

import functools
import http.server
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from playwright.sync_api import Browser, Page, Route, sync_playwright

import browser as chromium

# The browser's own window loads two pages for its address bar, anew for every visit: they cost as much as the page that
# is tested. Of several such lists Chromium obeys the last, so those that Playwright switches off stand here again.
OFF = (
    "WebUIOmniboxPopup,WebUIOmniboxAimPopup,SpareRendererForSitePerProcess,AvoidUnnecessaryBeforeUnloadCheckSync,"
    "DestroyProfileOnBrowserClose,HttpsUpgrades,HttpsFirstBalancedModeAutoEnable,LensOverlay,MediaRouter,PaintHolding,"
    "ThirdPartyStoragePartitioning,AvoidCorsURLLoaderRestartOnRedirect,OptimizationHints,NetworkTimeServiceQuerying,"
    "AimEnabled,PreconnectToSearch"
)
QUIET = (
    "--no-sandbox",  # containers run the tests as root
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    f"--disable-features={OFF}",
)
WIDTHS = {"desk": (1280, 900), "telephone": (390, 844)}
MATHEMATICS_IS_SHOWN = """async () => {
  await window.MathJax?.startup?.promise;
  await document.fonts.ready;
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A file server that keeps its log to itself."""

    def log_message(self, *args: object) -> None:
        """Say nothing."""


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder, and yield its address."""
    handler = functools.partial(Quiet, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever, args=[0.01])  # seconds that its end may take
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()
            thread.join()


@contextmanager
def launched() -> Iterator[Browser]:
    """Start the browser. Playwright holds the thread's event loop while this is open: close it soon."""
    path = chromium.find()
    if path is None:
        raise RuntimeError(chromium.HELP)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(QUIET))
        try:
            yield browser
        finally:
            browser.close()


@dataclass
class Visit:
    """A page that is open, and all the complaints about it so far."""

    page: Page
    complaints: list[str] = field(default_factory=list)


@contextmanager
def visit(browser: Browser, url: str, width: str = "desk", scheme: str = "light", **options: object) -> Iterator[Visit]:
    """Open `url`; anything that is not under the same root is refused, and every refusal and error is written down."""
    width_, height = WIDTHS[width]
    context = browser.new_context(
        viewport={"width": width_, "height": height}, color_scheme=scheme, reduced_motion="reduce", **options
    )
    page = context.new_page()
    this = Visit(page)
    root = "file://" if url.startswith("file://") else url[: url.index("/", len("http://")) + 1]

    def gate(route: Route) -> None:
        if route.request.url.startswith((root, "data:", "blob:")):
            route.continue_()
        else:
            this.complaints.append(f"asks for something outside the book: {route.request.url}")
            route.abort()

    page.route("**/*", gate)
    page.on("pageerror", lambda error: this.complaints.append(f"script error: {error}"))
    page.on("console", lambda m: this.complaints.append(f"console: {m.text}") if m.type == "error" else None)
    page.on("requestfailed", lambda r: this.complaints.append(f"request failed: {r.url}"))
    page.on("response", lambda r: this.complaints.append(f"{r.status}: {r.url}") if r.status >= 400 else None)
    try:
        page.goto(url, wait_until="load")
        page.wait_for_function("!document.querySelector('meta[http-equiv=refresh]')")  # the front door leads on
        page.wait_for_load_state("load")
        page.evaluate(MATHEMATICS_IS_SHOWN)
        yield this
    finally:
        context.close()
