/**
 * Drives as dots that fall on an axis of returns, beside the exact value; below them the mean and its uncertainty.
 */
import { makeScale, ticksOf } from "../views/chart_scale.js";
import { h, svg } from "../views/dom.js";
import { written } from "./naming.js";

const BINS = 44; // heaps along the axis
const KEYS = Object.entries({
  one: "one drive",
  mean: "mean, 95 % interval",
  sd: "mean ± standard deviation",
  exact: "exact value",
});

export class DotAxis {
  constructor(parent) {
    const keys = KEYS.map(([kind, text]) => h("li", {}, sample(kind), h("span", { text })));
    this.svg = svg("svg", { role: "img" });
    this.element = h("div", { class: "rl-dots" }, this.svg, h("ul", { class: "rl-keys" }, keys));
    parent.append(this.element);
    this.data = null;
    this.resizes = new ResizeObserver(() => this.data && this.draw(this.data));
    this.resizes.observe(this.element);
  }

  destroy() {
    this.resizes.disconnect();
  }

  /** Draw returns `G`, their `statistics` and the exact value `v` on [low, high]; the last `fresh` dots fall. */
  draw(data) {
    this.data = { ...data, fresh: 0 }; // drawn again for another width, nothing falls
    const { G, statistics, v, low, high, fresh = 0, label } = data;
    const width = this.element.clientWidth;
    if (!width) return;
    const em = parseFloat(getComputedStyle(this.element).fontSize);
    const box = { left: 0.9 * em, right: width - 0.9 * em, top: 1.7 * em, floor: 13 * em, bottom: 15.6 * em };
    const height = box.bottom + 2.8 * em;
    const bin = (high - low) / BINS;
    const x = makeScale(low - bin / 2, high + bin / 2, box.left, box.right);
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` })) {
      this.svg.setAttribute(name, value);
    }
    this.svg.setAttribute("aria-label", label);
    const size = { dot: Math.min((0.46 * (box.right - box.left)) / BINS, 0.42 * em), bin, low };
    this.svg.replaceChildren(...axis(x, box, em), ...dots(G, x, box, size, fresh), ...summary(statistics, x, box, em),
      ...exactLine(v, x, box, em));
  }
}

function axis(x, box, em) {
  const ticks = ticksOf(x, 3.2 * em).flatMap(({ at, text }) => [
    svg("line", { class: "rl-rule", x1: at, x2: at, y1: box.floor, y2: box.floor + 0.35 * em }),
    svg("text", { x: at, y: box.bottom + 1.1 * em, "text-anchor": "middle", text }),
  ]);
  const base = svg("line", { class: "rl-axis", x1: box.left, x2: box.right, y1: box.floor, y2: box.floor });
  const place = { x: box.right, y: box.bottom + 2.4 * em, "text-anchor": "end" };
  return [base, ...ticks, svg("text", { ...place, class: "rl-strong", text: "return G of a drive" })];
}

/** Heaps of dots; where a heap would be too high, its dots overlap. */
function dots(G, x, box, { dot, bin, low }, fresh) {
  const heaps = new Map();
  const places = G.map((g) => {
    const heap = Math.round((g - low) / bin);
    heaps.set(heap, (heaps.get(heap) ?? 0) + 1);
    return [heap, heaps.get(heap)];
  });
  const apart = Math.min(2 * dot, (box.floor - box.top - 2 * dot) / Math.max(1, ...heaps.values()));
  return places.map(([heap, n], i) => {
    const at = { cx: x.at(low + heap * bin), cy: box.floor - dot - (n - 1) * apart, r: dot };
    return svg("circle", { ...at, class: i >= G.length - fresh ? "rl-dot rl-fall" : "rl-dot" });
  });
}

function summary({ n, mean, sd, half }, x, box, em) {
  if (n < 2) return [];
  const y = box.floor + 1.3 * em;
  const clipped = (v) => Math.min(Math.max(x.at(v), box.left), box.right);
  const span = (reach, kind) => {
    const [x1, x2] = [clipped(mean - reach), clipped(mean + reach)];
    return svg("line", { class: kind, x1, x2, y1: y, y2: y });
  };
  const r = 0.38 * em;
  const diamond = `M${x.at(mean)} ${y - r}l${r} ${r}l${-r} ${r}l${-r} ${-r}z`;
  return [span(sd, "rl-sd"), span(half, "rl-ci"), svg("path", { class: "rl-mean", d: diamond })];
}

function exactLine(v, x, box, em) {
  const at = x.at(v);
  const side = at > (box.left + box.right) / 2 ? "end" : "start";
  const line = svg("line", { class: "rl-exact", x1: at, x2: at, y1: 0.3 * em, y2: box.floor + 2.1 * em });
  const text = { x: at + (side === "end" ? -0.4 : 0.4) * em, y: 1.05 * em, "text-anchor": side, class: "rl-strong" };
  return [line, svg("text", { ...text, text: `exact value ${written(v, 2)}` })];
}

function sample(kind) {
  const parts = {
    one: [svg("circle", { class: "rl-dot", cx: 14, cy: 5, r: 4 })],
    mean: [
      svg("line", { class: "rl-ci", x1: 3, x2: 25, y1: 5, y2: 5 }),
      svg("path", { class: "rl-mean", d: "M14 0l5 5l-5 5l-5 -5z" }),
    ],
    sd: [svg("line", { class: "rl-sd", x1: 0, x2: 28, y1: 5, y2: 5 })],
    exact: [svg("line", { class: "rl-exact", x1: 14, x2: 14, y1: 0, y2: 10 })],
  };
  return svg("svg", { viewBox: "0 0 28 10", "aria-hidden": true }, parts[kind]);
}
