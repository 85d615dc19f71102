/**
 * Forecasts as bars: one for a robot without a past, and one for each thing that it may have perceived before.
 */
import { h } from "../views/dom.js";
import { SERIES } from "../views/theme.js";
import { percent } from "./aliasing_words.js";

const MOST = 9; // rows; what is rarer is counted together
const WRITTEN = 0.085; // parts of a bar that have room for their name

export class ForecastBars {
  /** `onPick(h)` hears the row that is pressed. */
  constructor(parent, { onPick }) {
    this.onPick = onPick;
    this.first = h("th", { scope: "col" });
    const words = [this.first, h("th", { scope: "col", text: "forecast" }), h("th", { scope: "col", text: "tried" })];
    this.rows = h("tbody");
    this.table = h("table", { class: "rl-numbers rl-forecast" }, h("thead", {}, h("tr", {}, words)), this.rows);
    this.rest = h("p", { class: "rl-help" });
    parent.append(h("div", { class: "rl-forecast-box" }, this.table, this.rest));
  }

  /** `name(o)` gives { short, words }; `tried` maps an earlier observation to a map of counts; `before` is picked. */
  draw({ forecast, name, tried, before, title }) {
    const { all, rows } = forecast;
    this.first.textContent = title;
    const order = [...all.next.keys()].sort((o, p) => all.next.get(p) - all.next.get(o) || o - p);
    const together = new Map();
    for (const counts of tried.values()) for (const [o, n] of counts) together.set(o, (together.get(o) ?? 0) + n);
    const shown = rows.slice(0, MOST);
    const bar = (next, counts) => [barOf(next, order, name), triedOf(counts, order)];
    const lines = shown.map(({ h: one, next }) => {
      return [this.button(one, name(one).words, one === before), bar(next, tried.get(one))];
    });
    const focused = this.rows.contains(document.activeElement) ? document.activeElement.dataset.h : null;
    this.rows.replaceChildren(
      rowOf(h("span", { text: "not known" }), bar(all.next, together), "rl-forecast-all"),
      ...lines.map(([head, cells]) => rowOf(head, cells)),
    );
    if (focused !== null) this.rows.querySelector(`[data-h="${focused}"]`)?.focus();
    const more = rows.length - shown.length;
    this.rest.textContent = more > 0 ? `And ${more} more that are as likely or less.` : "";
  }

  /** The head of a row, which picks what was perceived before. */
  button(before, words, pressed) {
    const onClick = () => this.onPick(pressed ? null : before);
    const look = { type: "button", class: "rl-button", "aria-pressed": pressed, dataset: { h: before } };
    return h("button", { ...look, onClick }, words);
  }
}

function rowOf(head, [bar, count], kind = null) {
  const cells = [h("td", {}, bar), h("td", { class: "rl-tried" }, count)];
  return h("tr", { class: kind }, h("th", { scope: "row" }, head), cells);
}

function barOf(next, order, name) {
  const parts = order.filter((o) => next.get(o) > 0);
  const words = parts.map((o) => `${name(o).words} ${percent(next.get(o))}`).join(", ");
  const piece = (o) => {
    const p = next.get(o);
    const text = p >= WRITTEN ? h("b", { text: name(o).short }) : null;
    const chance = p >= 2 * WRITTEN ? h("span", { text: percent(p) }) : null;
    const style = { flexGrow: p, borderColor: SERIES[order.indexOf(o) % SERIES.length] };
    const title = `${name(o).words}: ${percent(p)}`;
    return h("span", { class: "rl-part", style, title, dataset: { o, p } }, text, chance);
  };
  return h("div", { class: "rl-bar", role: "img", "aria-label": words }, parts.map(piece));
}

/** How many drives there were, and how they ended, as a thin bar of the same order. */
function triedOf(counts, order) {
  const total = counts ? [...counts.values()].reduce((sum, n) => sum + n, 0) : 0;
  if (total === 0) return [h("span", { text: "–" })];
  const thin = order.filter((o) => counts.get(o)).map((o) => {
    const style = { flexGrow: counts.get(o), background: SERIES[order.indexOf(o) % SERIES.length] };
    return h("i", { style, dataset: { o, n: counts.get(o) } });
  });
  const number = h("span", { text: total.toLocaleString("en-US") });
  return [number, h("div", { class: "rl-thin", "aria-hidden": "true" }, thin)];
}
