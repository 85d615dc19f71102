/**
 * Curves: one or a few lines over steps or episodes, with bands, as crisp SVG.
 */
import { makeScale, pathOf, rangeOf, thinned, ticksOf } from "./chart_scale.js";
import { h, svg } from "./dom.js";
import { short } from "./legend.js";
import { DASHES, SERIES } from "./theme.js";

export class CurveView {
  /** `height` in pixels; by default it follows the width. */
  constructor(parent, { label, xLabel = "", yLabel = "", height = null }) {
    Object.assign(this, { label, xLabel, yLabel, height });
    this.keys = h("ul", { class: "rl-keys" });
    this.axes = svg("g");
    this.lines = svg("g");
    this.marker = svg("line", { class: "rl-marker" });
    this.pointed = svg("line", { class: "rl-marker", style: { display: "none" } });
    this.readout = svg("text", { class: "rl-readout", "text-anchor": "end" });
    const parts = [this.axes, this.lines, this.marker, this.pointed, this.readout];
    this.svg = svg("svg", { role: "img", "aria-label": label }, parts);
    this.svg.addEventListener("pointermove", (event) => this.read(event.clientX));
    this.svg.addEventListener("pointerleave", () => this.read(NaN));
    this.element = h("div", { class: "rl-curve" }, this.keys, this.svg);
    parent.append(this.element);
    this.data = null;
    this.resizes = new ResizeObserver(() => this.data && this.draw(this.data));
    this.resizes.observe(this.element);
  }

  destroy() {
    this.resizes.disconnect();
    this.element.remove();
  }

  /** Draw `series`: [{ name, x, y, band: [low, high], dash, color }]; `marker` is an x at which a line stands. */
  draw(data) {
    this.data = data;
    const { series, log = false, marker = null, xRange = null, yRange = null } = data;
    const width = this.element.clientWidth;
    if (!width) return;
    const em = parseFloat(getComputedStyle(this.element).fontSize) * 0.82;
    const height = this.height ?? Math.min(Math.max(0.5 * width, 9 * em), 19 * em);
    const box = { left: 3.6 * em, right: width - 1.5 * em, top: 1.9 * em, bottom: height - 2.6 * em };
    const [low, high] = yRange ?? rangeOf(series.flatMap((s) => [s.y, ...(s.band ?? [])]), log);
    const [first, last] = xRange ?? ends(series);
    const x = makeScale(first, last > first ? last : first + 1, box.left, box.right);
    const y = makeScale(low, high, box.bottom, box.top, log);
    this.drawAxes(width, height, box, x, y, em);
    this.lines.replaceChildren(...series.flatMap((one, k) => drawSeries(one, k, x, y)));
    Object.assign(this, { x, box });
    place(this.marker, marker === null ? NaN : x.at(marker), box);
    this.drawKeys(series);
    this.svg.setAttribute("aria-label", `${this.label}. ${series.map((one) => told(one, this.xLabel)).join(" ")}`);
  }

  drawAxes(width, height, box, x, y, em) {
    const key = JSON.stringify([width, height, em, x.low, x.high, y.low, y.high, y.log]);
    if (key === this.axesKey) return;
    this.axesKey = key;
    for (const [name, value] of [["width", width], ["height", height], ["viewBox", `0 0 ${width} ${height}`]]) {
      this.svg.setAttribute(name, value);
    }
    const text = (tx, ty, anchor, words, strong) =>
      svg("text", { x: tx, y: ty, "text-anchor": anchor, class: strong ? "rl-strong" : null, text: words });
    const across = ticksOf(y, 2.2 * em).flatMap(({ at, text: words }) => [
      svg("line", { class: "rl-rule", x1: box.left, x2: box.right, y1: crisp(at), y2: crisp(at) }),
      text(box.left - 0.5 * em, at + 0.35 * em, "end", words),
    ]);
    const along = ticksOf(x, 5 * em).map(({ at, text: words }) => text(at, box.bottom + 1.2 * em, "middle", words));
    const base = crisp(box.bottom);
    this.axes.replaceChildren(
      ...across,
      svg("line", { class: "rl-axis", x1: box.left, x2: box.right, y1: base, y2: base }),
      ...along,
      text(0, 0.95 * em, "start", this.yLabel, true),
      text(box.right, height - 0.25 * em, "end", this.xLabel, true),
    );
  }

  /** Tell the values under the pointer; a place outside takes them away. */
  read(clientX) {
    if (!this.x) return;
    const { x, box } = this;
    const px = clientX - this.svg.getBoundingClientRect().left;
    const inside = px >= box.left && px <= box.right;
    const here = x.low + ((px - x.from) / (x.to - x.from)) * (x.high - x.low);
    const found = inside ? this.data.series.map((one) => valueNear(one, here)).filter(Boolean) : [];
    place(this.pointed, found.length ? x.at(found[0].x) : NaN, box);
    const values = found.map(({ name, y }) => `${name ? `${name} ` : ""}${short(y, Math.abs(y))}`);
    this.readout.textContent = found.length ? `${this.xLabel} ${found[0].x}: ${values.join(", ")}` : "";
    this.readout.setAttribute("x", box.right);
    this.readout.setAttribute("y", box.top - 6);
  }

  /** Name the lines above the picture, if there is more than one. */
  drawKeys(series) {
    const named = series.map((one, k) => [one, k]).filter(([one]) => one.name);
    const key = JSON.stringify(named.map(([{ name, color, dash }, k]) => [name, color, dash, k]));
    if (key === this.keysKey) return;
    this.keysKey = key;
    const sample = (one, k) => {
      const line = svg("path", { class: "rl-line", d: "M1 5h26", ...look(one, k) });
      if (isBand(one)) line.setAttribute("class", "rl-band-key");
      return svg("svg", { viewBox: "0 0 28 10", "aria-hidden": true }, line);
    };
    this.keys.hidden = named.length < 2;
    this.keys.replaceChildren(...named.map(([one, k]) => h("li", {}, sample(one, k), h("span", { text: one.name }))));
  }
}

/** Return how a line looks: its own color and dashes, or those of its place. */
function look({ color, dash }, k) {
  const n = SERIES.length;
  return { style: { stroke: color ?? SERIES[k % n] }, "stroke-dasharray": dash ?? DASHES[k % n] };
}

function drawSeries(one, k, x, y) {
  const line = svg("path", { class: "rl-line", d: pathOf(thinned(one.x, one.y, x, y)), ...look(one, k) });
  if (!one.band) return [line];
  const [low, high] = one.band.map((edge) => thinned(one.x, edge, x, y));
  const outline = low.map((run, i) => [...run, ...(high[i] ?? []).toReversed()]);
  const fill = one.color ?? SERIES[k % SERIES.length];
  const area = svg("path", { class: "rl-band", d: pathOf(outline), style: { fill } });
  return [area, line];
}

/** Return the first and the last x of all lines. */
function ends(series) {
  const filled = series.filter((one) => one.x.length);
  if (!filled.length) return [0, 1];
  return [Math.min(...filled.map((one) => one.x[0])), Math.max(...filled.map((one) => one.x.at(-1)))];
}

/** Stand a line at a place in the box, or hide it. */
function place(line, at, { left, right, top, bottom }) {
  const inside = at >= left - 1 && at <= right + 1;
  line.style.display = inside ? "" : "none";
  if (!inside) return;
  const places = { x1: crisp(at), x2: crisp(at), y1: top, y2: bottom };
  for (const [name, value] of Object.entries(places)) line.setAttribute(name, value);
}

/** Return the point of a line that is nearest to an x; null where it has none. */
function valueNear({ name, x, y }, wanted) {
  let [low, high] = [0, x.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= wanted) low = middle;
    else high = middle;
  }
  const i = high >= 0 && Math.abs(x[high] - wanted) < Math.abs(x[low] - wanted) ? high : low;
  return Number.isFinite(y[i]) ? { name, x: x[i], y: y[i] } : null;
}

/** Put a line on the middle of a pixel. */
function crisp(at) {
  return Math.round(at) + 0.5;
}

/** Whether it is a band without a line in it. */
function isBand({ band, y }) {
  return Boolean(band) && !Array.prototype.some.call(y, Number.isFinite);
}

/** Tell the last value of a line in words. */
function told({ name, x, y, band }, xLabel) {
  if (!y.length) return `${name || "Line"}: nothing yet.`;
  const word = (edge) => (Number.isFinite(edge.at(-1)) ? short(edge.at(-1), Math.abs(edge.at(-1))) : "unknown");
  const text = isBand({ band, y }) ? band.map(word).join(" to ") : word(y);
  return `${name ? `${name}: ` : ""}${text} at ${xLabel || "x"} ${x.at(-1)}.`;
}
