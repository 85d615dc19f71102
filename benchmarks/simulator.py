"""Measure the simulator in a real Chromium: the engine, the frames while it plays, and the page that brings it."""

from __future__ import annotations

import gzip
import json
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / folder) for folder in ("tools", "tests/site", "tests/widgets", "book/_ext")]

import pages  # noqa: E402

import browsing  # noqa: E402
import rlnav as rl  # noqa: E402
from explorables import minified  # noqa: E402
from rlnav.widgets import _bundle  # noqa: E402

Rows = Iterator[tuple[object, ...]]

BOOK = ROOT / "_build" / "html"
PAGE = "book/18-simulator.html"
SLOW = 6  # times: a phone beside this machine
TIMES = 5  # fresh pages for each figure that is a median
SETTINGS = {"slip": 0.1, "alpha": 0.2, "epsilon": 0.2, "max_steps": 200, "seed": 0}
LESSON, LONG, ENDLESS = (10, 500), (20, 20_000), 1_000_000
WATCHED = 5  # seconds
WINDOW = {"width": 1280, "height": 900}

# What a page must know from its beginning: when the button is there.
OBSERVE = """(() => {
  const ready = (button) => /^Train/.test(button.textContent.trim()) && button.ariaDisabled !== "true";
  const look = () => {
    if ([...document.querySelectorAll(".rlnav button")].some(ready)) window.usable = performance.now();
    else requestAnimationFrame(look);
  };
  look();
})()"""
TRACED = ["devtools.timeline", "disabled-by-default-devtools.timeline"]
LEARN = """({ drawing, episodes, slip, alpha, epsilon, max_steps, seed }) => {
  const robot = new rl.Robot({ slip });
  const mdp = new rl.Task(rl.GridWorld.fromAscii(drawing), { robot }).mdp();
  const began = performance.now();
  const learner = new rl.Learner(mdp, null, rl.qLearning, { episodes, alpha, epsilon, maxSteps: max_steps, rng: seed });
  learner.run();
  return { ms: performance.now() - began, updates: learner.updates };
}"""


def speed() -> Rows:
    """Measure what a reader waits for, in Chromium, at full speed and with the processor slowed down six times."""
    yield "what", "target", "full speed", f"{SLOW} times slower"
    with browsing.launched() as browser:
        for measure in (engine, in_the_page, frames, opening):
            for full, slow in zip(measure(browser, 1), measure(browser, SLOW), strict=True):
                yield *full, slow[-1]


def weight() -> Rows:
    """Measure what is loaded, in kB (1000 bytes)."""
    yield "what", "target", "gzip", "as it is"
    for entry in ("simulator/app", *explorables()):
        with tempfile.TemporaryDirectory() as folder:
            _bundle.publish(entry, Path(folder), minified)
            files = {name: (Path(folder) / name).read_bytes() for name in _bundle.programs(entry)}
        for name, data in files.items():
            target = 60 if name == "simulator/app.js" else ""
            yield name if name.startswith(entry) else f"{name}, when it is wanted", target, *kilobytes([data])
    for name, chosen in loaded().items():
        yield f"{PAGE}, {name}: {len(chosen)} files", "", *kilobytes(chosen)


def explorables() -> list[str]:
    """Return the names of the explorables: the modules there that a page can start."""
    names = [f"explorables/{path.stem}" for path in sorted((ROOT / "rlnav/js/explorables").glob("*.js"))]
    return [name for name in names if "start" in _bundle.parse(f"{name}.js").exports]


def open_map(n: int) -> rl.GridWorld:
    """Return n x n free cells, which is the most to learn and to draw, with the way from one corner to the other."""
    return rl.GridWorld(n, n, (n - 2, n - 2), starts=tuple(rl.Pose(1, 1, theta) for theta in range(0, 360, 45)))


def kilobytes(files: list[bytes]) -> tuple[float, float]:
    """Return the size of files together, each compressed and as it is."""
    return sum(len(gzip.compress(data)) for data in files) / 1000, sum(map(len, files)) / 1000


# ------------------------------------------------------------------ pages
@contextmanager
def opened(browser: Any, address: str, slowdown: float = 1) -> Iterator[Any]:
    """Open an address in a browser that has never seen it."""
    context = browser.new_context(viewport=WINDOW)
    page = context.new_page()
    page.set_default_timeout(120_000)
    page.add_init_script(OBSERVE)
    context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": slowdown})
    try:
        page.goto(address)
        yield page
    finally:
        context.close()


@contextmanager
def simulator(browser: Any, n: int, episodes: int, slowdown: float, **view: Any) -> Iterator[Any]:
    """Open a page with nothing but the simulator, on an open map."""
    task = rl.Task(open_map(n), rl.Robot(slip=SETTINGS["slip"]))
    settings = {name: value for name, value in SETTINGS.items() if name != "slip"}
    widget = rl.widgets.Simulator(task, view=view, episodes=episodes, **settings)
    with tempfile.TemporaryDirectory() as folder:
        pages.write_page(Path(folder), widget)
        with browsing.served(Path(folder)) as address, opened(browser, address, slowdown) as page:
            page.wait_for_function("window.usable")
            yield page


def engine(browser: Any, slowdown: float) -> Rows:
    """Train without a picture, by the modules as they are joined for a page."""
    code, exports = _bundle.join("learning.js", "algorithms.js", "task.js", "robot.js", "world.js")
    names = ", ".join(f"{name}: {place}" for module in exports.values() for name, place in module.items())
    script = minified(f"(() => {{ {code} globalThis.rl = {{ {names} }}; }})();")
    for (n, episodes), target, unit in ((LESSON, "100 ms", 1), (LONG, "5 s", 1000)):
        job = {**SETTINGS, "drawing": str(open_map(n)), "episodes": episodes}
        with opened(browser, "about:blank", slowdown) as page:
            page.add_script_tag(content=script)
            first, *more = [page.evaluate(LEARN, job) for _ in range(TIMES)]
        name, time = f"engine, {n}x{n}, {episodes:,} episodes", target.split()[1]
        yield f"{name}, first time, {time}", target, first["ms"] / unit
        yield f"{name}, again, {time}", target, np.median([run["ms"] for run in more]) / unit
    rate = np.median([run["updates"] / run["ms"] for run in more]) / 1000
    yield "engine, million updates a second", "2 or more", rate


def in_the_page(browser: Any, slowdown: float) -> Rows:
    """Train in the simulator, as fast as possible: every frame also draws."""
    for n, episodes in (LESSON, LONG):
        with simulator(browser, n, episodes, slowdown, speed="max") as page:
            began = page.evaluate("() => performance.now()")
            page.get_by_role("button", name="Train").click()
            page.get_by_role("button", name="Watch it").wait_for()
            passed = page.evaluate("() => performance.now()") - began
        yield f"simulator, {n}x{n}, {episodes:,} episodes, s", "", passed / 1000


def frames(browser: Any, slowdown: float) -> Rows:
    """Watch it learn as fast as possible, and look at every frame: what it does in all, drawing and layout included."""
    for n in (10, 30):
        for glyph in ("needles", "ring"):
            with simulator(browser, n, ENDLESS, slowdown, speed="max", glyph=glyph) as page:
                browser.start_tracing(page=page, categories=TRACED)
                page.get_by_role("button", name="Train").click()
                page.wait_for_timeout(1000 * WATCHED)
                frames, longest = tasks(json.loads(browser.stop_tracing())["traceEvents"])
            yield f"{n}x{n}, {glyph}: a frame, median / 95 % / most, CPU ms", "16", three(frames)
            yield f"{n}x{n}, {glyph}: longest task, CPU ms", "50", longest


def tasks(trace: list[dict[str, Any]]) -> tuple[np.ndarray, float]:
    """Return the CPU time of every task that draws a frame, and of the longest task at all, in ms."""
    drawn = [event for event in trace if event["name"] == "FireAnimationFrame"]
    main = {(event["pid"], event["tid"]) for event in drawn}
    done = [event for event in trace if event["name"] == "RunTask" and (event["pid"], event["tid"]) in main]
    done.sort(key=lambda event: event["ts"])
    cpu = np.array([event.get("tdur", 0) for event in done]) / 1000
    which = np.searchsorted([event["ts"] for event in done], [event["ts"] for event in drawn], side="right") - 1
    return cpu[np.unique(which)], cpu.max()


def three(values: np.ndarray) -> str:
    """Return median, 95 % and maximum."""
    return " / ".join(f"{value:.1f}" for value in (*np.quantile(values, [0.5, 0.95]), values.max()))


def opening(browser: Any, slowdown: float) -> Rows:
    """Open the book's page from a local server in a browser that has never seen it."""
    with browsing.served(built()) as address:
        times = []
        for _ in range(TIMES):
            with opened(browser, address + PAGE, slowdown) as page:
                page.wait_for_function("window.usable")
                times.append(page.evaluate("() => window.usable"))
    yield "the book's page, until the button can be pressed, s", "1", np.median(times) / 1000


def loaded() -> dict[str, list[bytes]]:
    """Return the files that the book's page loads: all of them, and ours."""
    finished: list[Any] = []
    with browsing.launched() as browser, browsing.served(built()) as address:
        page = browser.new_context(viewport=WINDOW).new_page()
        page.on("requestfinished", lambda request: finished.append(request))
        page.goto(address + PAGE)
        page.wait_for_function("document.querySelector('.rlnav-explorable.is-live')")
        page.wait_for_load_state("networkidle")
        files = {request.url: request.response().body() for request in finished}
    ours = [data for url, data in files.items() if "/rlnav" in url or url.endswith("explorables.js")]
    return {"all": list(files.values()), "the simulator's own": ours}


def built() -> Path:
    """Return the folder of the built book."""
    if not (BOOK / PAGE).exists():
        raise SystemExit(f"{BOOK / PAGE} must be there; it is not. Run `make book` first.")
    return BOOK
