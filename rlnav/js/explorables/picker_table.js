/**
 * The reader's tries: which features, how large a table, and what came of it.
 */
import { h } from "../views/dom.js";
import { grouped, percent } from "./picker_words.js";

const SHORT = {
  cell: "cell",
  heading: "heading",
  goal_direction: "goal on the map",
  goal_bearing: "goal bearing",
  goal_distance: "distance",
  moves_ahead: "moves ahead",
};
const MOST = 8; // tries that are kept

/** Name features in a few words: "goal bearing (8), moves ahead". */
export function inShort(features) {
  if (!features) return "whole pose";
  const name = (feature) => (Array.isArray(feature) ? `${SHORT[feature[0]]}${argument(feature)}` : SHORT[feature]);
  return features.map(name).join(", ");
}

function argument([name, value]) {
  return name === "goal_bearing" && value !== undefined ? ` (${value})` : "";
}

/** Add a try to the list, the latest first; the same one again takes the place of the old. */
export function remember(tried, one) {
  const key = ({ features, variety, seed }) => JSON.stringify([features, variety, seed]);
  return [one, ...tried.filter((other) => key(other) !== key(one))].slice(0, MOST);
}

export class TriesTable {
  constructor(parent) {
    this.body = h("tbody");
    const heads = ["perceives", "learned on", "seed", "rows met", "mixed", "here", "unseen"];
    const head = h("tr", {}, heads.map((text) => h("th", { scope: "col", text })));
    const caption = h("caption", { text: "Your tries: share of poses from which it reaches the goal" });
    const table = h("table", { class: "rl-numbers rl-tries" }, caption, h("thead", {}, head), this.body);
    const label = { role: "region", "aria-label": "Your tries", tabindex: 0 };
    this.element = h("div", { class: "rl-numbers-scroll", ...label }, table);
    parent.append(this.element);
  }

  draw(tried) {
    this.element.hidden = tried.length === 0;
    this.body.replaceChildren(...tried.map(({ features, variety, seed, met, mixed, home, away }) => {
      const how = [variety === "many" ? "20 maps" : "this map", String(seed), grouped(met), grouped(mixed)];
      const scores = [percent(home), away === null ? "–" : percent(away)];
      const all = [...how, ...scores].map((text) => h("td", { text }));
      return h("tr", {}, h("th", { scope: "row", text: inShort(features) }), all);
    }));
  }
}
