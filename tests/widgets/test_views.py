"""The shared views in a real browser: the map, curves, diagrams, controls, time, and the stage that they stand on."""

import colorsys
import itertools
import shutil
from contextlib import ExitStack
from importlib.resources import files

import numpy as np
import pytest

import browsing
from accessibility import findings
from rlnav.plot import _look, _policy, _values

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Views</title><link rel="icon" href="data:,"><link rel="stylesheet" href="/views/views.css">
<style>
  body { background: #fff; font: 16px/1.5 system-ui, sans-serif; margin: 16px; }
  html[data-theme=dark] body { background: #16191d; color: #e8ecf0; }
</style></head>
<body><main><h1>Views</h1><div class="rlnav"><div class="rl-stage" id="place"></div></div></main></body></html>"""
LOAD = """async () => {
  const names = ["controls", "curve", "diagram", "dom", "glyphs", "grid", "grid_values", "icons", "legend", "player",
                 "stage", "theme"];
  window.v = Object.assign({}, ...await Promise.all(names.map(name => import(`/views/${name}.js`))));
  window.place = document.getElementById("place");
  // a map of n by n cells in which each pose has a value; `heard` is what the view has told
  window.mapOf = (n, more = {}) => {
    const numbers = Array.from({ length: n * n * 8 }, (_, i) => (i * 7919) % 97 / 9.7);
    return { width: n, height: n, obstacles: new Uint8Array(n * n), goal: [n - 1, n - 1],
             rings: Float64Array.from(numbers), scale: { low: 0, high: 10 }, ...more };
  };
  window.showMap = (n = 10, more = {}, options = {}) => {
    window.heard = { cells: [], hovers: [], keys: [] };
    window.view = new v.GridView(place, {
      label: "Map", onCell: cell => heard.cells.push(cell), onHover: cell => heard.hovers.push(cell),
      onKey: event => { heard.keys.push(event.key); return event.key === "x"; }, ...options,
    });
    view.draw(mapOf(n, more));
  };
  window.pixelAt = (x, y, inside = view) => {
    const { cell, left, top, height } = inside.geometry;
    const at = [left + (x + 0.5) * cell, top + (height - y - 0.5) * cell].map(Math.round);
    return [...inside.context.getImageData(...at, 1, 1).data];
  };
  window.modelOf = (state, more = {}) => {
    const listeners = {};
    return {
      data: { state }, saved: [], get(name) { return this.data[name]; },
      set(name, value) { this.data[name] = value; this.emit(`change:${name}`); },
      save_changes() { this.saved.push(structuredClone(this.data.state)); },
      on(name, fn) { (listeners[name] ??= []).push(fn); },
      off(name, fn) { listeners[name] = (listeners[name] ?? []).filter(other => other !== fn); },
      emit(name) { (listeners[name] ?? []).forEach(fn => fn()); },
      listening() { return Object.values(listeners).flat().length; }, send() {}, ...more,
    };
  };
}"""
# where a cell is on the screen
CELL = """([x, y]) => {
  const box = view.canvas.getBoundingClientRect(), { cell, left, top, height, ratio } = view.geometry;
  return [box.left + (left + (x + 0.5) * cell) / ratio, box.top + (top + (height - y - 0.5) * cell) / ratio];
}"""
CROSSED = "heard.cells.map(({ type, x, y }) => [type, x, y])"


@pytest.fixture(scope="module")
def browser():
    with browsing.launched() as browser:
        yield browser


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    home = tmp_path_factory.mktemp("views")
    shutil.copytree(files("rlnav") / "js" / "views", home / "views")
    (home / "index.html").write_text(PAGE)
    return home


@pytest.fixture(scope="module")
def address(folder):
    with browsing.served(folder) as address:
        yield address


@pytest.fixture
def open_views(browser, address):
    """Open the page with all views loaded as `v`; when the test is over it must not have complained."""
    with ExitStack() as stack:
        visits = []

        def open_views(width="desk", scheme="light", **options):
            here = stack.enter_context(browsing.visit(browser, address, width, scheme, **options))
            visits.append(here)
            here.page.evaluate(LOAD)
            return here.page

        yield open_views
        complaints = [complaint for here in visits for complaint in here.complaints]
    assert complaints == []


@pytest.fixture
def page(open_views):
    return open_views()


def rgb(color):
    return [int(color[i : i + 2], 16) for i in (1, 3, 5)]


# ---------------------------------------------------------------------------------------------------------- colors


def test_color_maps_are_those_of_the_printed_figures(page):
    printed = {"SEQUENTIAL": _look.SEQUENTIAL(range(64)), "DIVERGING": _look.DIVERGING(range(65))}
    for name, table in printed.items():
        mine = [rgb(color) for color in page.evaluate(f"[...v.{name}]")]
        assert np.abs(np.round(255 * table[:, :3]) - mine).max() <= (name == "DIVERGING")  # blended, not listed
    for t in np.linspace(0, 1, 201):
        expected = [round(255 * c) for c in _look.SEQUENTIAL(float(t))[:3]]
        assert rgb(page.evaluate("t => v.sequential(t)", float(t))) == expected
    assert page.evaluate("v.sequential(-0.01)") == "#17111f"


def test_text_on_a_color_is_black_or_white_as_in_print(page):
    colors = ["#%02x%02x%02x" % tuple(round(255 * c) for c in colorsys.hsv_to_rgb(h / 12, s / 3, b / 6))  # noqa: UP031
              for h, s, b in itertools.product(range(12), range(4), range(7))]  # fmt: skip
    shown = page.evaluate("colors => colors.map(v.readableOn)", colors)
    wanted = [_look.readable_on((*(c / 255 for c in rgb(color)), 1.0)) for color in colors]
    assert shown == [{"white": "#ffffff", "black": "#000000"}[ink] for ink in wanted]


def test_wedges_and_needles_have_the_shapes_of_print(page):
    for k, wedge in enumerate(_values.WEDGES):
        mine = np.array(page.evaluate("k => v.wedgeOf(k)", k))
        assert np.allclose(sorted(map(tuple, mine.round(9))), sorted(set(map(tuple, wedge.vertices.round(9)))))
    for k, turn in itertools.product(range(8), range(-2, 3)):
        (small,), (large, _) = _policy._small(45 * k, 45 * turn), _policy._large(45 * k, 45 * turn)
        for printed, size in ((small, "false"), (large, "true")):
            mine = np.array(page.evaluate(f"([k, turn]) => v.needle(k, turn, {size})", [k, turn])).reshape(4, 2)
            assert np.allclose(mine, printed.vertices, atol=1e-12)


# ---------------------------------------------------------------------------------------------------------- the map


def test_a_wedge_has_the_color_of_its_heading_and_nothing_is_drawn_for_nan(page):
    page.evaluate("showMap(6)")
    page.evaluate("""() => {
      const data = mapOf(6), at = (2 * 6 + 3) * 8;
      data.rings.fill(NaN); data.rings[at + 2] = 9.9; data.rings[at + 4] = -5;
      data.obstacles[0] = 1; view.draw(data);
    }""")
    assert page.evaluate("pixelAt(3, 2.3)")[:3] == rgb("#fde725")  # up
    assert page.evaluate("pixelAt(2.7, 2)")[:3] == rgb("#17111f")  # left, below the scale
    assert page.evaluate("pixelAt(3.3, 2)")[:3] == [255, 255, 255]  # right: nothing known
    assert page.evaluate("pixelAt(0, 0)")[:3] == rgb("#56616d")  # an obstacle


def test_after_any_changes_the_picture_equals_one_drawn_afresh(page):
    differences = page.evaluate("""async () => {
      showMap(7, { needles: new Int8Array(7 * 7 * 8).fill(1) });
      const data = view.data;
      let seed = 1;
      const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
      const found = [];
      for (let round = 0; round < 12; round++) {
        for (let k = 0; k < 20; k++) {
          const numbers = data.rings ?? data.cells;
          numbers[Math.floor(random() * numbers.length)] = random() < 0.2 ? NaN : 14 * random() - 2;
          data.needles[Math.floor(random() * 392)] = random() < 0.3 ? 127 : Math.floor(5 * random()) - 2;
        }
        if (round === 4) data.obstacles[8] = 1;
        if (round === 6) Object.assign(data, { scale: { low: -10, high: 10, diverging: true } });
        if (round === 8) Object.assign(data, { needlesAt: 45 });
        if (round === 10) Object.assign(data, { cells: data.rings.slice(0, 49), rings: null, numbers: true });
        view.draw(data);
        const fresh = new v.GridView(place, { label: "Fresh" });
        fresh.draw(data);
        const [a, b] = [view, fresh].map(({ canvas, context }) =>
          context.getImageData(0, 0, canvas.width, canvas.height).data);
        found.push(a.length === b.length ? a.reduce((sum, value, i) => sum + (value !== b[i]), 0) : "size");
        fresh.destroy();
      }
      return found;
    }""")
    assert differences == [0] * 12


def test_values_that_do_not_change_are_not_drawn_again(page):
    page.evaluate("showMap(30, { needles: new Int8Array(7200) })")
    sets = page.evaluate("""() => {
      let sets = 0;
      const setCell = view.values.setCell.bind(view.values);
      view.values.setCell = i => { sets += 1; setCell(i); };
      const counts = [];
      const draw = change => { sets = 0; change(); view.draw(view.data); counts.push(sets); };
      draw(() => {});
      draw(() => { view.data.robot = { x: 3, y: 3, theta: 0 }; });
      draw(() => { view.data.rings[80] += 5; });
      draw(() => { view.data.scale = { low: 0, high: 20 }; });
      return counts;
    }""")
    assert sets[:3] == [0, 0, 1]
    assert sets[3] > 800


@pytest.mark.parametrize("n", [4, 10, 30])
@pytest.mark.parametrize("ratio", [1, 1.5, 3])
def test_the_map_is_crisp_and_fits_its_place(open_views, n, ratio):
    page = open_views("telephone", device_scale_factor=ratio)
    page.evaluate("n => showMap(n)", n)
    sizes = page.evaluate("""() => ({ cell: view.geometry.cell, pixels: view.canvas.width,
      shown: view.canvas.getBoundingClientRect().width, room: place.clientWidth, top: view.canvas.offsetHeight })""")
    assert sizes["cell"] == int(sizes["cell"])
    assert sizes["pixels"] == pytest.approx(sizes["shown"] * ratio, abs=0.05)
    assert sizes["shown"] <= sizes["room"]
    assert sizes["shown"] >= 0.9 * sizes["room"]  # the map fills the width of a telephone
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_map_is_drawn_once_it_is_put_on_the_page(page):
    page.evaluate("""() => {
      window.apart = document.createElement("div");
      window.view = new v.GridView(apart, { label: "Map" });
      view.draw(mapOf(5, { obstacles: new Uint8Array(25).fill(1, 0, 1) }));
      place.append(apart);
    }""")
    page.wait_for_function("view.geometry && pixelAt(0, 0)[0] === 0x56")


def test_dark_and_light_recolor_the_map_at_once(page):
    page.evaluate("showMap(5, { rings: null })")
    assert page.evaluate("pixelAt(1, 1)")[:3] == [255, 255, 255]
    for switch_on, off in (
        ("document.documentElement.dataset.theme = 'dark'", "delete document.documentElement.dataset.theme"),
        ("document.body.dataset.jpThemeLight = 'false'", "delete document.body.dataset.jpThemeLight"),
    ):
        page.evaluate(switch_on)
        page.wait_for_function("pixelAt(1, 1)[0] === 0x34")
        page.evaluate(off)
        page.wait_for_function("pixelAt(1, 1)[0] === 0xff")
    page.emulate_media(color_scheme="dark")
    page.wait_for_function("pixelAt(1, 1)[0] === 0x34")
    page.emulate_media(color_scheme="dark", media="print")  # paper is white
    page.wait_for_function("pixelAt(1, 1)[0] === 0xff")


def test_the_theme_of_the_page_wins_over_that_of_the_system(open_views):
    page = open_views(scheme="dark")
    page.evaluate("document.documentElement.dataset.theme = 'light'")
    page.evaluate("showMap(5, { rings: null })")
    assert page.evaluate("pixelAt(1, 1)")[:3] == [255, 255, 255]


def test_a_quick_stroke_of_the_mouse_tells_every_cell_on_its_way(page):
    page.evaluate("showMap(20)")
    start, end = page.evaluate(CELL, [1, 2]), page.evaluate(CELL, [18, 11])
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end)  # one event for the whole way
    page.mouse.up()
    told = page.evaluate(CROSSED)
    assert told[0] == ["down", 1, 2]
    assert told[-1] == ["up", 18, 11]
    way = [cell for cell, _ in itertools.groupby((x, y) for _, x, y in told)]
    assert way[-1] == (18, 11)
    assert len(set(way)) == len(way) >= 18
    assert all(max(abs(a - c), abs(b - d)) == 1 for (a, b), (c, d) in itertools.pairwise(way))


def test_a_stroke_that_leaves_the_map_tells_only_cells_of_the_map(page):
    page.evaluate("showMap(6)")
    page.mouse.move(*page.evaluate(CELL, [4, 4]))
    page.mouse.down()
    page.mouse.move(*page.evaluate(CELL, [9, 4]), steps=3)
    page.mouse.move(*page.evaluate(CELL, [9, 1]), steps=3)
    page.mouse.move(*page.evaluate(CELL, [4, 1]), steps=3)
    page.mouse.up()
    told = page.evaluate(CROSSED)
    assert all(0 <= x < 6 and 0 <= y < 6 for _, x, y in told)
    assert told[-1] == ["up", 4, 1]


def test_a_cell_knows_which_of_its_eight_sides_was_touched(page):
    page.evaluate("showMap(4)")
    for theta, (dx, dy) in {0: (0.3, 0), 45: (0.3, 0.3), 90: (0, 0.3), 225: (-0.3, -0.3), 315: (0.3, -0.3)}.items():
        page.mouse.click(*page.evaluate(CELL, [2 + dx, 1 + dy]))
        cell = page.evaluate("heard.cells.at(-1)")
        assert (cell["x"], cell["y"], cell["theta"], cell["pointerType"]) == (2, 1, theta, "mouse")


def test_escape_cancels_a_stroke(page):
    page.evaluate("showMap(6)")
    page.evaluate("view.focus()")
    page.mouse.move(*page.evaluate(CELL, [1, 1]))
    page.mouse.down()
    page.mouse.move(*page.evaluate(CELL, [3, 1]))
    page.keyboard.press("Escape")
    page.mouse.move(*page.evaluate(CELL, [5, 1]))
    page.mouse.up()
    assert page.evaluate(CROSSED)[-1] == ["cancel", 3, 1]


def finger(page, *points):
    """Put a finger down, draw it along, and lift it."""
    session = page.context.new_cdp_session(page)
    for kind, point in zip(
        ["touchStart", *["touchMove"] * (len(points) - 1), "touchEnd"], [*points, None], strict=True
    ):
        touches = [] if point is None else [{"x": point[0], "y": point[1]}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})


def test_a_finger_paints_where_it_may_and_else_scrolls_the_page(open_views):
    page = open_views("telephone", has_touch=True, is_mobile=True)
    page.evaluate("document.body.style.paddingBottom = '2000px'")
    page.evaluate("showMap(8)")
    way = [page.evaluate(CELL, [2, y]) for y in (2, 3, 4, 5, 6, 7)]
    page.evaluate("view.touch = 'paint'")
    finger(page, *way)
    told = page.evaluate(CROSSED)
    assert [told[0], told[-1]] == [["down", 2, 2], ["up", 2, 7]]
    assert {(x, y) for _, x, y in told} == {(2, y) for y in range(2, 8)}
    assert page.evaluate("scrollY") == 0
    page.evaluate("view.touch = 'scroll'; heard.cells.length = 0")
    page.touchscreen.tap(*page.evaluate(CELL, [5, 5]))
    assert page.evaluate(CROSSED) == [["down", 5, 5], ["up", 5, 5]]
    finger(page, *way[::-1], (way[0][0], way[0][1] - 300))
    page.wait_for_function("scrollY > 0")
    assert page.evaluate(CROSSED)[-1][0] == "cancel"


def test_arrow_keys_move_the_cursor_to_the_edges_and_no_further(page):
    page.evaluate("showMap(4)")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement === view.canvas && view.cursorShown")
    frame = page.evaluate("pixelAt(0, 0.48)")
    for key, cursor in [("ArrowUp", [0, 1]), ("ArrowLeft", [0, 1]), ("ArrowRight", [1, 1]), ("ArrowDown", [1, 0]),
                        ("ArrowDown", [1, 0]), *[("ArrowRight", [min(x, 3), 0]) for x in (2, 3, 4)]]:  # fmt: skip
        page.keyboard.press(key)
        assert page.evaluate("view.cursor") == cursor
    assert page.evaluate("pixelAt(0, 0.48)") != frame  # the frame has moved on
    assert page.evaluate("heard.hovers.at(-1)") == {"x": 3, "y": 0, "theta": None}
    page.keyboard.press("x")  # a key that the owner uses
    assert page.evaluate("heard.keys.at(-1)") == "x"
    page.keyboard.press("Tab")
    assert not page.evaluate("view.cursorShown")


def test_the_cursor_stays_on_a_map_that_shrinks(page):
    page.evaluate("showMap(10); view.cursor = [9, 9]; view.draw(mapOf(4))")
    assert page.evaluate("view.cursor") == [3, 3]


def test_the_robot_drives_along_its_needle_and_a_crash_ends_half_way(page):
    way = page.evaluate("""[0, 0.25, 0.5, 0.75, 1].map(at =>
      v.onTheWay({ x: 1, y: 1, theta: 0 }, { x: 2, y: 2, theta: 90 }, at))""")
    assert [way[0], way[-1]] == [{"x": 1, "y": 1, "theta": 0}, {"x": 2, "y": 2, "theta": 90}]
    assert all(b["x"] > a["x"] and b["y"] > a["y"] for a, b in itertools.pairwise(way))
    turn = page.evaluate("v.onTheWay({ x: 0, y: 0, theta: 315 }, { x: 1, y: 0, theta: 45 }, 0.5)")
    assert turn["theta"] == 360  # the short way round
    page.evaluate("""showMap(5, { rings: null, robot: { x: 4, y: 2, theta: 0, from: { x: 3, y: 2, theta: 0 }, at: 1,
      crashed: true } })""")
    assert page.evaluate("pixelAt(3.42, 2.27)")[:3] == rgb("#d55e00")
    assert page.evaluate("pixelAt(4.2, 2)")[:3] == [255, 255, 255]


def test_a_picture_of_the_map_is_a_png_with_its_ground(page):
    page.evaluate("showMap(5)")
    size = page.evaluate("""async () => {
      const picture = await createImageBitmap(await view.toBlob());
      return [picture.width === view.canvas.width, (await view.toBlob()).type];
    }""")
    assert size == [True, "image/png"]


# ---------------------------------------------------------------------------------------------------------- controls


def slider(page, **options):
    page.evaluate(
        """options => {
          window.changes = [];
          window.slider = v.slider({ label: "Step size", onChange: value => changes.push(value), ...options });
          place.append(slider.element);
        }""",
        {"min": 0, "max": 1, "step": 0.05, "value": 0.2, **options},
    )
    return page.get_by_label("Step size, as a number")


def test_a_number_can_be_typed_beside_its_slider(page):
    field = slider(page)
    field.fill("0.123")
    field.press("Enter")
    assert page.evaluate("[slider.value, changes]") == [0.123, [0.123]]
    assert page.get_by_role("slider").get_attribute("aria-valuetext") == "0.123"
    field.fill("0,5")  # as half of Europe writes it
    field.blur()
    assert page.evaluate("slider.value") == 0.5
    assert page.get_by_role("slider").input_value() == "0.5"


def test_a_number_that_cannot_be_is_refused_in_words_and_the_last_good_one_stays(page):
    field = slider(page)
    fault = page.locator(".rl-fault")
    for typed in ("2", "-1", "abc", "", "1e999", "0.2.3", "NaN"):
        field.fill(typed)
        field.press("Enter")
        assert fault.inner_text() == "Type a number from 0 to 1. 0.2 is kept.", typed
        assert field.get_attribute("aria-invalid") == "true"
        assert page.evaluate("[slider.value, changes]") == [0.2, []]
    field.fill("0.3")
    field.press("Enter")
    assert not fault.is_visible()
    assert field.get_attribute("aria-invalid") == "false"


def test_leaving_a_wrong_number_shows_the_kept_one(page):
    field = slider(page)
    field.fill("7")
    field.blur()
    assert field.input_value() == "0.2"
    assert page.locator(".rl-fault").inner_text() == "Type a number from 0 to 1. 0.2 is kept."


def test_whole_numbers_stay_whole_and_arrow_keys_step_within_the_range(page):
    field = slider(page, min=1, max=10, step=1, value=9)
    field.fill("2.5")
    field.press("Enter")
    assert page.locator(".rl-fault").inner_text() == "Type a whole number from 1 to 10. 9 is kept."
    field.fill("9")
    for _ in range(3):
        field.press("ArrowUp")
    assert page.evaluate("slider.value") == 10
    field.press("ArrowDown")
    assert page.evaluate("slider.value") == 9
    page.get_by_role("slider").press("ArrowRight")
    assert page.evaluate("slider.value") == 10


def test_a_logarithmic_slider_reaches_both_ends_and_gives_neat_numbers(page):
    slider(page, min=1, max=20000, step=1, value=500, log=True)
    range_ = page.get_by_role("slider")
    range_.press("Home")
    assert page.evaluate("slider.value") == 1
    seen = []
    for _ in range(20):
        range_.press("PageUp")
        seen.append(page.evaluate("slider.value"))
    assert seen == sorted(seen)
    assert all(value == int(f"{value:.2g}".replace("e+0", "e").split("e")[0].replace(".", "") or 0)
               or float(f"{value:.2g}") == value for value in seen)  # fmt: skip
    range_.press("End")
    assert page.evaluate("slider.value") == 20000


def test_a_range_is_told_while_it_moves_and_once_when_it_rests(page):
    page.evaluate("""() => {
      window.told = [];
      place.append(v.slider({ label: "Speed", min: 0, max: 10, step: 1, value: 5,
        onInput: value => told.push(["input", value]), onChange: value => told.push(["change", value]) }).element);
    }""")
    page.get_by_role("slider").press("ArrowRight")
    assert page.evaluate("told") == [["input", 6], ["change", 6]]


def test_a_blocked_button_says_why_keeps_the_focus_and_does_nothing(page):
    page.evaluate("""() => {
      window.clicks = 0;
      window.step = v.button({ label: "Step back", icon: "back", onClick: () => { clicks += 1; } });
      place.append(step.element);
    }""")
    button = page.get_by_role("button", name="Step back")
    button.press("Enter")
    page.evaluate("step.disabled('Nothing to take back yet.')")
    assert page.evaluate("document.activeElement === step.element")
    button.press("Enter")
    button.click(force=True)
    assert page.evaluate("clicks") == 1
    assert button.get_attribute("title") == "Nothing to take back yet."
    assert button.is_disabled()
    page.evaluate("step.disabled('')")
    button.click()
    assert page.evaluate("clicks") == 2


def test_segments_menus_and_boxes_work_by_key_and_tell_their_value(page):
    page.evaluate("""() => {
      window.told = [];
      const tell = name => value => told.push([name, value]);
      window.parts = {
        show: v.segmented({ label: "Show", options: [["v", "Value"], ["n", "Visits"]], value: "v",
          onChange: tell("show") }),
        rule: v.choice({ label: "Rule", options: [["q", "Q-learning"], ["s", "SARSA"]], value: "s",
          onChange: tell("rule") }),
        box: v.toggle({ label: "Numbers", value: true, onChange: tell("box") }),
      };
      for (const part of Object.values(parts)) place.append(part.element);
    }""")
    page.get_by_role("radio", name="Value").press("ArrowRight")
    page.get_by_label("Rule").select_option("Q-learning")
    page.get_by_label("Numbers").press("Space")
    assert page.evaluate("told") == [["show", "n"], ["rule", "q"], ["box", False]]
    assert page.evaluate("Object.values(parts).map(part => part.value)") == ["n", "q", False]
    page.evaluate("parts.show.value = 'v'; parts.rule.value = 's'; parts.box.value = true")
    assert page.evaluate("Object.values(parts).map(part => part.value)") == ["v", "s", True]
    assert len(page.evaluate("told")) == 3  # what a program sets is no news to it
    page.evaluate("parts.rule.disabled('A run is loaded from Python.')")
    assert page.get_by_label("Rule").is_disabled()
    assert page.get_by_text("A run is loaded from Python.").is_visible()


# ---------------------------------------------------------------------------------------------------------- time

# a clock that the test moves: `frame(ms)` shows the next frame after so many milliseconds
CLOCK = """() => {
  let now = 0, waiting = null;
  performance.now = () => now;
  requestAnimationFrame = fn => { waiting = fn; return 1; };
  cancelAnimationFrame = () => { waiting = null; };
  window.pass = ms => { now += ms; };
  window.frame = ms => { now += ms; const fn = waiting; waiting = null; fn?.(now); return fn !== null; };
  window.hide = hidden => {
    Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  };
  window.ticks = 0; window.draws = []; window.stops = [];
  window.play = (speed, tick = () => (ticks += 1) < 1e6) => {
    const onStop = error => stops.push(String(error));
    window.player = new v.Player({ tick, draw: at => draws.push(at), speed, onStop });
    player.play();
  };
}"""


@pytest.fixture
def clock(page):
    page.emulate_media(reduced_motion="no-preference")
    page.evaluate(CLOCK)
    return page


def test_a_player_ticks_at_its_speed_and_draws_in_between(clock):
    clock.evaluate("play(4); frame(0)")
    assert clock.evaluate("ticks") == 1  # at once
    for _ in range(100):
        clock.evaluate("frame(10)")
    assert clock.evaluate("ticks") == pytest.approx(5, abs=1)
    assert clock.evaluate("draws.length") == 101
    assert 0.3 < np.mean(clock.evaluate("draws")) < 0.7


def test_a_hidden_page_stands_still_and_nothing_is_made_up_for(clock):
    clock.evaluate("play(20); frame(0); frame(50)")
    before = clock.evaluate("ticks")
    clock.evaluate("hide(true)")
    assert not clock.evaluate("frame(60_000)")
    assert clock.evaluate("player.playing")
    clock.evaluate("hide(false)")
    clock.evaluate("frame(60_000)")
    assert clock.evaluate("ticks") == before
    clock.evaluate("frame(50)")
    assert clock.evaluate("ticks") == before + 1


def test_a_frame_that_came_late_is_not_paid_back_by_a_burst(clock):
    clock.evaluate("play(1000); frame(0); window.before = ticks; frame(5000)")
    assert clock.evaluate("ticks - before") <= 101


def test_ticks_never_take_more_than_their_part_of_a_frame(clock):
    clock.evaluate("play(Infinity, () => { ticks += 1; pass(3); return true; }); frame(16)")
    assert clock.evaluate("ticks") == 3  # of 3 ms each in a budget of 8
    clock.evaluate("player.pause(); ticks = 0; play(1000, () => { ticks += 1; pass(3); return true; })")
    clock.evaluate("frame(0); ticks = 0; frame(100)")
    assert clock.evaluate("ticks") <= 4
    clock.evaluate("ticks = 0; frame(1)")
    assert clock.evaluate("ticks") <= 4


def test_a_player_stops_at_the_end_and_after_an_error(clock):
    clock.evaluate("play(4, () => false); frame(0)")
    assert clock.evaluate("[player.playing, draws.length, stops]") == [False, 1, ["null"]]
    clock.evaluate("play(4, () => { throw new RangeError('no'); }); frame(0)")
    assert clock.evaluate("[player.playing, stops.at(-1)]") == [False, "RangeError: no"]
    clock.evaluate("play(4, () => { player.pause(); return true; }); frame(0)")
    assert not clock.evaluate("frame(1000)")


def test_reduced_motion_draws_four_pictures_a_second_but_ticks_on(clock):
    clock.emulate_media(reduced_motion="reduce")
    clock.evaluate("play(20); frame(0)")
    for _ in range(100):
        clock.evaluate("frame(10)")
    assert clock.evaluate("ticks") == pytest.approx(21, abs=1)
    assert clock.evaluate("draws.length") <= 5
    assert set(clock.evaluate("draws")) == {1}  # nothing glides


# ---------------------------------------------------------------------------------------------------------- the stage


def test_changes_reach_the_kernel_together_once_they_settle(page):
    page.clock.install()
    page.evaluate("""() => {
      window.model = modelOf({ alpha: 0.1, view: 1 });
      window.kernelSet = [];
      v.open(model, place, stage => { window.stage = stage; stage.onState(state => kernelSet.push(state)); });
      for (const alpha of [0.2, 0.3, 0.4]) stage.update({ alpha });
    }""")
    assert page.evaluate("[stage.state, model.saved]") == [{"alpha": 0.4, "view": 1}, []]
    page.clock.run_for(200)
    assert page.evaluate("[model.saved, kernelSet]") == [[{"alpha": 0.4, "view": 1}], []]  # not our own news


def test_the_kernels_word_is_the_last_one(page):
    page.clock.install()
    page.evaluate("""() => {
      window.model = modelOf({ alpha: 0.1 });
      window.heard = [];
      v.open(model, place, stage => { window.stage = stage; stage.onState(state => heard.push(state)); });
      stage.update({ alpha: 0.9 });
      model.set("state", { alpha: 0.5 });
    }""")
    page.clock.run_for(1000)
    assert page.evaluate("[stage.state, heard, model.saved]") == [{"alpha": 0.5}, [{"alpha": 0.5}], []]


def test_a_state_that_cannot_be_is_told_and_the_last_good_one_stays(page):
    page.evaluate("""() => {
      window.model = modelOf({ alpha: 0.1 });
      v.open(model, place, stage => {
        window.stage = stage;
        stage.onState(({ alpha }) => { if (alpha > 1) throw new RangeError("`alpha` must be at most 1; got 7."); });
      });
      model.set("state", { alpha: 7 });
    }""")
    assert page.get_by_role("alert").inner_text() == "`alpha` must be at most 1; got 7."
    assert page.evaluate("stage.state") == {"alpha": 0.1}
    page.evaluate("stage.message('')")
    assert page.get_by_role("alert").inner_text() == ""


@pytest.mark.parametrize(
    "death",
    [
        "model.save_changes = () => { throw new Error('comm closed'); }",
        "model.save_changes = () => Promise.reject(new Error('kernel is dead'))",
        "place.classList.add('jupyter-widgets-disconnected'); model.emit('comm_live_update')",
        "model.emit('comm:close')",
    ],
)
def test_a_kernel_that_dies_is_told_once_and_the_figure_goes_on(page, death):
    page.evaluate("""() => {
      window.model = modelOf({ alpha: 0.1 });
      v.open(model, place, stage => { window.stage = stage; });
    }""")
    page.evaluate(f"() => {{ {death}; }}")
    for alpha in (0.2, 0.3):
        page.evaluate("alpha => { stage.update({ alpha }); stage.save(); }", alpha)
    page.get_by_text("The kernel no longer answers").wait_for()
    assert page.get_by_text("The kernel no longer answers").count() == 1
    page.evaluate("stage.message('Saved.', 'note'); stage.message('')")  # other messages come and go beside it
    assert page.get_by_text("The kernel no longer answers").count() == 1
    assert page.evaluate("stage.state.alpha") == 0.3


def test_a_kernel_that_comes_back_takes_the_message_away(page):
    page.evaluate("""() => {
      window.model = modelOf({});
      v.open(model, place, () => {});
      place.classList.add("jupyter-widgets-disconnected");
      model.emit("comm_live_update");
    }""")
    page.get_by_text("The kernel no longer answers").wait_for()
    page.evaluate("place.classList.remove('jupyter-widgets-disconnected'); model.emit('comm_live_update')")
    page.get_by_text("The kernel no longer answers").wait_for(state="detached")


def test_a_figure_that_cannot_start_says_so_and_leaves_its_neighbor_alone(page):
    page.evaluate("""() => {
      v.open(modelOf({}), place, () => { throw new RangeError("`map` must have a goal; got none."); });
      v.open(modelOf({}), place, stage => stage.root.append("The neighbor"));
    }""")
    assert page.get_by_text("`map` must have a goal; got none.").is_visible()
    assert page.get_by_text("The neighbor").is_visible()
    assert page.locator(".rl-failed").count() == 1


def test_taking_a_figure_away_leaves_nothing_behind(page):
    saved = page.evaluate("""() => {
      window.calls = [];
      const model = modelOf({ alpha: 0.1 });
      const close = v.open(model, place, stage => {
        stage.onCleanup(() => { calls.push("broken"); throw new Error("broken cleanup"); });
        stage.onData("tables", () => {});
        stage.update({ alpha: 0.2 });
        return () => calls.push("cleanup");
      });
      close();
      return { saved: model.saved, left: place.childElementCount, listening: model.listening(), calls };
    }""")
    assert saved == {"saved": [{"alpha": 0.2}], "left": 0, "listening": 0, "calls": ["cleanup", "broken"]}


def test_two_figures_on_a_page_share_no_id_and_no_state(page):
    page.evaluate("""() => {
      window.stages = [];
      for (const alpha of [0.1, 0.9]) {
        v.open(modelOf({ alpha }), place, stage => {
          stages.push(stage);
          const alphas = v.slider({ label: "Alpha", min: 0, max: 1, step: 0.1, value: alpha, help: "Help." });
          const shown = v.segmented({ label: "Show", options: [["a", "A"], ["b", "B"]], value: "a" });
          stage.root.append(alphas.element, shown.element);
        });
      }
      stages[0].update({ alpha: 0.5 });
    }""")
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map(({ id }) => id)")
    assert len(set(ids)) == len(ids)
    page.get_by_role("radio", name="B").first.check()
    assert page.evaluate("[stages[1].state.alpha, document.querySelectorAll('input:checked').length]") == [0.9, 2]


def test_a_screen_reader_hears_at_most_one_sentence_a_second_and_always_the_last(page):
    page.clock.install()
    page.evaluate("""() => {
      window.spoken = [];
      v.open(modelOf({}), place, stage => {
        window.stage = stage;
        new MutationObserver(() => spoken.push(stage.voice.textContent)).observe(stage.voice, { childList: true });
      });
      for (let k = 1; k <= 50; k++) stage.say(`Episode ${k}.`);
    }""")
    page.clock.run_for(3000)
    assert page.evaluate("spoken") == ["Episode 1.", "Episode 50."]


# ---------------------------------------------------------------------------------------------------------- curves


def test_twenty_thousand_points_are_thinned_without_losing_a_peak(page):
    runs = page.evaluate("""() => {
      const x = Array.from({ length: 20000 }, (_, i) => i), y = x.map(i => Math.sin(i / 50));
      y[7777] = 9; y[12345] = -9;
      window.curve = new v.CurveView(place, { label: "Learning", xLabel: "episode", yLabel: "return" });
      curve.draw({ series: [{ name: "Q-learning", x, y }] });
      const path = place.querySelector("g path.rl-line").getAttribute("d");
      const points = path.slice(1).split("L").map(p => p.split(" ").map(Number));
      return { count: points.length, low: Math.min(...points.map(p => p[1])), high: Math.max(...points.map(p => p[1])),
               width: curve.element.clientWidth, sorted: points.every((p, i) => !i || p[0] >= points[i - 1][0]) };
    }""")
    assert runs["count"] <= 4 * runs["width"]
    assert runs["sorted"]
    ticks = page.evaluate("[...place.querySelectorAll('text')].map(text => text.textContent)")
    assert {"return", "episode", "−10", "0", "10"} <= set(ticks)
    box = page.evaluate("curve.box")
    at = {value: box["bottom"] + (value + 10) / 20 * (box["top"] - box["bottom"]) for value in (9, -9)}
    assert runs["low"] == pytest.approx(at[9], abs=0.1)
    assert runs["high"] == pytest.approx(at[-9], abs=0.1)


def test_a_curve_tells_its_last_values_and_has_a_key_with_dashes(page):
    page.evaluate("""() => {
      window.curve = new v.CurveView(place, { label: "Learning", xLabel: "episode", yLabel: "return" });
      const sarsa = { name: "SARSA", x: [1, 2], y: [1, 2.5], band: [[0, 2], [2, 3]] };
      const series = [{ name: "Q-learning", x: [1, 2, 3], y: [0, NaN, 4] }, sarsa, { name: "Later", x: [], y: [] }];
      curve.draw({ series, marker: 2 });
    }""")
    assert page.get_by_role("img").get_attribute("aria-label") == (
        "Learning. Q-learning: 4.0 at episode 3. SARSA: 2.5 at episode 2. Later: nothing yet."
    )
    assert page.locator(".rl-keys li").all_inner_texts() == ["Q-learning", "SARSA", "Later"]
    dashes = page.evaluate("[...place.querySelectorAll('.rl-keys path')].map(p => p.getAttribute('stroke-dasharray'))")
    assert len(set(dashes)) == 3
    gap = page.locator("g path.rl-line").first.get_attribute("d")
    assert gap.count("M") == 2  # the missing number leaves a gap
    assert page.locator(".rl-band").count() == 1


def test_a_curve_of_strange_numbers_is_still_a_picture(page):
    strange = [[], [5], [3, 3, 3], [0, 0], [1e-9, 2e-9], [1e12, -1e12], ["NaN", "NaN"], [0, "Infinity"]]
    for y, log in itertools.product(strange, (False, True)):
        picture, texts = page.evaluate(
            """([y, log]) => {
              const curve = new v.CurveView(place, { label: "Strange", xLabel: "step", yLabel: "value" });
              curve.draw({ series: [{ x: y.map((_, i) => i), y: y.map(Number) }], log });
              const found = [curve.svg.outerHTML, curve.svg.querySelectorAll("text").length];
              curve.destroy();
              return found;
            }""",
            [y, log],
        )
        assert "NaN" not in picture, y
        assert "Infinity" not in picture, y
        assert 4 <= texts <= 40, y


def test_the_values_under_the_pointer_are_written_out(page):
    page.evaluate("""() => {
      window.curve = new v.CurveView(place, { label: "Learning", xLabel: "episode", yLabel: "return" });
      const x = [0, 50, 100];
      curve.draw({ series: [{ name: "A", x, y: [0, 1, 2] }, { name: "B", x, y: [5, 6, 7] }] });
    }""")
    box = page.get_by_role("img").bounding_box()
    inside = page.evaluate("curve.box")
    page.mouse.move(box["x"] + (inside["left"] + inside["right"]) / 2 + 3, box["y"] + 60)
    assert page.locator(".rl-readout").text_content() == "episode 50: A 1.0, B 6.0"
    page.mouse.move(0, 0)
    assert page.locator(".rl-readout").text_content() == ""


# ---------------------------------------------------------------------------------------------------------- diagrams

TREE = """(successors) => {
  const leaf = (a, i) => (_, k) => ({ id: `a${a}s${k}`, kind: "state", value: [8.12, -10, 6.9][k] - i,
    probability: [0.8, 0.1, 0.1][k], reward: k === 1 ? -10 : -0.1, terminal: k === 1 });
  const actions = [-90, -45, 0, 45, 90].map((a, i) => ({
    id: `a${a}`, kind: "action", label: `${a}°`, value: [-10, 4.2, 7.312, 6.81, -3.3][i],
    children: Array.from({ length: successors }, leaf(a, i)) }));
  return { id: "s", kind: "state", label: "v(s)", value: 7.312, children: actions };
}"""


def draw_diagram(page, successors=3, **more):
    page.evaluate(
        f"""([successors, more]) => {{
          window.picks = [];
          window.diagram = new v.DiagramView(place, {{ label: "Backup", onPick: node => picks.push(node.id) }});
          const words = {{ levels: ["s", "a", "s′"], edges: ["max", "p, r"] }};
          diagram.draw({{ root: ({TREE})(successors), max: true, ...words, ...more }});
        }}""",
        [successors, more],
    )


OVERLAPS = """() => {
  const boxes = [...place.querySelectorAll("text")].map(text => [text.textContent, text.getBoundingClientRect()]);
  const room = place.getBoundingClientRect();
  const touch = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
                       && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 4; // the air above letters may
  const touching = boxes.flatMap(([a, p], i) =>
    boxes.slice(i + 1).filter(([, q]) => touch(p, q)).map(([b]) => `${a} on ${b}`));
  const outside = boxes.filter(([, box]) => box.left < room.left - 1 || box.right > room.right + 1);
  return [...touching, ...outside.map(([a]) => `${a} outside`)];
}"""


@pytest.mark.parametrize("width", [290, 320, 358, 600, 900])
def test_numbers_of_a_diagram_never_touch_each_other(page, width):
    page.evaluate("width => { place.style.width = `${width}px`; }", width)
    for successors, picked in itertools.product((1, 3), (None, "s", "a-90", "a0", "a90s0")):
        draw_diagram(page, successors, picked=picked)
        assert page.evaluate(OVERLAPS) == [], picked
        texts = page.evaluate("[...place.querySelectorAll('text')].map(text => text.textContent)")
        assert {"v(s) = 7.31", "−10", "4.2", "7.31", "6.81", "−3.3"} <= set(texts)
        page.evaluate("diagram.destroy()")


def test_a_label_that_would_lie_across_another_branch_is_shortened(js):
    """Two branches 40 pixels apart; each label, 60 wide in full and 20 in short, stands beside its own at the right."""
    placed = js("""async () => {
      const { fitTexts } = await import("/views/diagram_layout.js");
      const branches = [100, 140].map(x => ({ x, y: 100, parent: { x, y: 0 } }));
      const wanted = branches.map(branch => ({
        words: "+45°, 0.2", wide: 60, short: { words: "+45°", wide: 20 }, tall: 10, branch, wanted: true,
        places: [{ x: branch.x + 5, y: 50, anchor: "start" }],
      }));
      return fitTexts(wanted, [], { x0: 0, x1: 300 }, branches).map(({ words, x }) => [words, x]);
    }""")
    assert placed == [["+45°", 105], ["+45°, 0.2", 145]]


def test_the_best_branch_is_marked_and_the_arc_spans_the_choice(page):
    draw_diagram(page, 1)
    assert page.locator(".rl-best").count() == 1
    assert page.locator(".rl-arc").count() == 1
    page.evaluate("diagram.draw({ ...diagram.data, max: false })")
    assert page.locator(".rl-best").count() == page.locator(".rl-arc").count() == 0


def test_arrow_keys_walk_through_the_tree(page):
    draw_diagram(page)
    page.keyboard.press("Tab")
    for key, focused in [("ArrowDown", "a0"), ("ArrowRight", "a45"), ("ArrowDown", "a45s0"), ("ArrowUp", "a45"),
                         ("ArrowLeft", "a0"), ("Home", "s"), ("ArrowUp", "s")]:  # fmt: skip
        page.keyboard.press(key)
        assert page.evaluate("document.activeElement.dataset.id") == focused
    assert page.evaluate("picks") == ["a0", "a45", "a45s0", "a45", "a0", "s"]
    assert page.locator("[tabindex='0']").count() == 1
    label = page.get_by_role("treeitem", selected=True).get_attribute("aria-label")
    assert label == "state v(s), value 7.31"


def test_a_tap_near_a_small_circle_picks_it(open_views):
    page = open_views("telephone", has_touch=True)
    draw_diagram(page)
    leaf = page.evaluate("(({ x, y }) => ({ x, y }))(diagram.all.find(({ node }) => node.id === 'a45s1'))")
    box = page.get_by_role("tree").bounding_box()
    page.touchscreen.tap(box["x"] + leaf["x"] + 4, box["y"] + leaf["y"] + 14)
    assert page.evaluate("picks") == ["a45s1"]


# ---------------------------------------------------------------------------------------------------------- everyone

EVERYTHING = """() => v.open(modelOf({}), place, stage => {
  const { root } = stage;
  const { button, choice, group, number, segmented, slider, toggle, toolbar } = v;
  const grid = new v.GridView(root, { label: "Map", onCell: () => {} });
  grid.draw(mapOf(10, { robot: { x: 1, y: 1, theta: 0 }, path: [{ x: 1, y: 1, theta: 0 }, { x: 2, y: 1, theta: 0 }] }));
  grid.describe("The robot is at (1, 1).");
  new v.Legend(root).draw({ low: 0, high: 10, label: "value", below: true });
  const blocked = button({ label: "Back", icon: "back", iconOnly: true });
  blocked.disabled("Nothing to take back yet.");
  const signs = v.iconNames().map(name => button({ label: name, icon: name, iconOnly: true }));
  const [train, pin] = [{ label: "Train", icon: "train", primary: true }, { label: "Pin", icon: "pin", pressed: true }];
  const summary = "alpha 0.2, epsilon 0.2 constant, 500 episodes, at most 200 steps, seed 0";
  root.append(
    toolbar({ label: "Run", children: [button(train), blocked, button(pin), ...signs] }).element,
    group({ title: "Learner", summary, open: true, children: [
      slider({ label: "Step size", min: 0, max: 1, step: 0.05, value: 0.2, help: "How far an estimate moves." }),
      number({ label: "Seed", min: 0, step: 1, value: 0 }),
      choice({ label: "Algorithm", options: [["q", "Q-learning"]], value: "q" }),
      toggle({ label: "Numbers", value: true }),
      segmented({ label: "Show", options: [["v", "Value"], ["n", "Visits"]], value: "v" })] }).element,
  );
  const field = root.querySelector(".rl-slider .rl-number");
  field.value = "7";
  field.dispatchEvent(new Event("change"));
  const curve = new v.CurveView(root, { label: "Learning", xLabel: "episode", yLabel: "return" });
  curve.draw({ series: [{ name: "A", x: [1, 2], y: [1, 2] }, { name: "B", x: [1, 2], y: [2, 1] }] });
  const diagram = new v.DiagramView(root, { label: "Backup" });
  diagram.draw({ root: TREE(3), max: true, picked: "a0", levels: ["s", "a", "s′"] });
  stage.message("`gamma` must be at most 1; got 2.");
  stage.message("The run is pinned.", "note");
  stage.message("`gamma` must be at most 1; got 2.");
})""".replace("TREE", f"({TREE})")


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", ["desk", "telephone"])
def test_axe_finds_nothing_in_any_view(open_views, width, theme):
    page = open_views(width)
    page.evaluate("theme => { document.documentElement.dataset.theme = theme; }", theme)
    page.evaluate(EVERYTHING)
    assert findings(page) == []


@pytest.mark.parametrize("width", [360, 390])
def test_on_a_telephone_all_that_is_touched_is_large_enough_and_nothing_is_wider_than_the_page(open_views, width):
    page = open_views("telephone", has_touch=True)
    page.set_viewport_size({"width": width, "height": 800})
    page.evaluate(EVERYTHING)
    small = page.evaluate("""() => [...place.querySelectorAll("button, select, summary, input")].flatMap(element => {
      const touched = ["checkbox", "radio"].includes(element.type) ? element.parentElement : element;
      const { height, width } = touched.getBoundingClientRect();
      return height < 43.9 || width < 43.9 ? [`${element.outerHTML.slice(0, 60)} ${width} x ${height}`] : [];
    })""")
    assert small == []
    assert page.evaluate("document.documentElement.scrollWidth") == width
