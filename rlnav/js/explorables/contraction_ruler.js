/**
 * The ruler: how far apart two guesses were at first, how far apart they may be by now, and how far they are.
 */
import { h } from "../views/dom.js";
import { rounded } from "./contraction_words.js";
import { exact } from "./look_ahead.js";

const ROWS = [["first", "at first"], ["bound", "promised"], ["now", "now"]];

export class Ruler {
  constructor(parent) {
    this.bars = {};
    const rows = ROWS.map(([name, words]) => {
      const bar = h("span", { class: `rl-ruler-bar rl-ruler-${name}` });
      const number = h("td");
      this.bars[name] = { bar, number };
      const label = h("th", { scope: "row", text: words });
      return h("tr", {}, label, number, h("td", { class: "rl-ruler-track", "aria-hidden": true }, bar));
    });
    const title = h("caption", { text: "Largest difference |V − W|" });
    this.element = h("table", { class: "rl-numbers rl-ruler" }, title, h("tbody", {}, rows));
    parent.append(this.element);
  }

  /** Show backup k of a pair, to the scale of the first difference. */
  draw(pair, k) {
    const lengths = { first: pair.distances[0], bound: pair.bounds[k], now: pair.distances[k] };
    for (const [name, length] of Object.entries(lengths)) {
      const { bar, number } = this.bars[name];
      bar.style.width = `${pair.distances[0] ? (100 * length) / pair.distances[0] : 0}%`;
      number.replaceChildren(exact(length, 2, { title: rounded(length) }));
    }
  }
}
