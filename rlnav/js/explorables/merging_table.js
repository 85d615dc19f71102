/**
 * What both tables say about the start of each road, beside how its drives went.
 */
import { h } from "../views/dom.js";

const HEAD = ["start of the", "drives", "goals", "Monte Carlo", "TD(0)", "exact"];

/** Write a number with two decimals, and behind it the exact one for whoever takes the page apart. */
function exact(value) {
  return h("data", { value: String(value), text: value.toFixed(2).replace("-", "−") });
}

export class RoadTable {
  constructor(parent) {
    const head = h("thead", {}, h("tr", {}, HEAD.map((text) => h("th", { scope: "col", text }))));
    this.rows = h("tbody");
    const table = h("table", { class: "rl-numbers" }, h("caption", { text: "Value of the start" }), head, this.rows);
    const scrolls = { tabindex: 0, role: "group", "aria-label": "Values of the starts" };
    parent.append(h("div", { class: "rl-numbers-scroll", ...scrolls }, table));
  }

  draw({ merging, moments, k, names }) {
    const { mc, td } = moments[k];
    const drives = moments.slice(1, k + 1).map(({ drive }) => drive);
    const rowOf = (name, road) => {
      const own = drives.filter((drive) => drive.road === road);
      const goals = own.filter(({ states }) => merging.mdp.goal[states.at(-1)]);
      const s = merging.roads[road];
      const numbers = [mc, td, merging.exact].map((V) => h("td", {}, exact(V[s])));
      const name_ = h("th", { scope: "row", text: name });
      return h("tr", {}, name_, h("td", { text: own.length }), h("td", { text: goals.length }), numbers);
    };
    this.rows.replaceChildren(...names.map(rowOf));
  }
}
