/**
 * What the two sums say about a schedule, by analysis, and what they have come to so far.
 */
import { verdictOf } from "../scenario/step_sizes.js";
import { h } from "../views/dom.js";
import { written } from "./naming.js";
import { because } from "./step_words.js";

const CONDITIONS = [["first", "Σ αₙ = ∞"], ["second", "Σ αₙ² < ∞"]];

export class Verdict {
  constructor(parent) {
    this.list = h("ul", { class: "rl-verdict" });
    parent.append(this.list);
  }

  draw(settings) {
    const verdict = verdictOf(settings);
    const reasons = because(settings);
    const shown = JSON.stringify([verdict, reasons]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.list.replaceChildren(...CONDITIONS.map(([name, formula]) => {
      const holds = verdict[name];
      const sign = h("span", { class: holds ? "rl-holds" : "rl-fails", text: holds ? "✓ holds" : "✗ fails" });
      return h("li", {}, h("span", { class: "rl-condition", text: formula }), sign, h("span", { text: reasons[name] }));
    }));
  }
}

export class SumTable {
  constructor(parent) {
    this.cells = ["alpha", "first", "second", "weight"].map((name) => [name, h("td")]);
    const heads = ["αₙ", "Σ α", "Σ α²", "share of the first target"];
    const head = h("thead", {}, h("tr", {}, heads.map((text) => h("th", { scope: "col", text }))));
    const body = h("tbody", {}, h("tr", {}, this.cells.map(([, cell]) => cell)));
    const scrolls = { tabindex: 0, role: "group", "aria-label": "Sums so far" };
    const table = h("table", { class: "rl-numbers" }, head, body);
    parent.append(h("div", { class: "rl-numbers-scroll", ...scrolls }, table));
  }

  draw(totals, n) {
    for (const [name, cell] of this.cells) {
      const value = n ? totals[name][n - 1] : NaN;
      cell.replaceChildren(n ? h("data", { value: String(value), text: short(value) }) : "–");
    }
  }
}

/** Write a number with three digits that count. */
function short(value) {
  if (value !== 0 && value < 0.0005) return value.toExponential(0).replace("-", "−");
  return written(Number(value.toPrecision(3)), 4);
}
