/**
 * One backup with its numbers: what each turn pays now, what follows on average, and which sum is the largest.
 */
import { h } from "../views/dom.js";
import { poseText, timed, turnText, written } from "./naming.js";

/** Write a number to be read, and behind it the exact one for whoever takes the page apart. */
export function exact(value, digits = 2, attributes = {}) {
  return h("data", { value: String(value), ...attributes }, written(value, digits));
}

export class LookAhead {
  constructor(parent) {
    this.title = h("caption");
    const words = ["turn", "reward", "γ × next value", "sum"];
    const head = h("thead", {}, h("tr", {}, words.map((word) => h("th", { scope: "col", text: word }))));
    this.rows = h("tbody");
    this.table = h("table", { class: "rl-numbers" }, this.title, head, this.rows);
    this.hint = h("p", { class: "rl-help" });
    const scrolls = { tabindex: 0, role: "group", "aria-label": "Look-ahead of a pose" };
    this.element = h("div", { class: "rl-look-ahead rl-numbers-scroll", ...scrolls }, this.table, this.hint);
    parent.append(this.element);
  }

  /** Show the backup of state `s` at `pose` in sweep k of a wave; `pose` null asks for one. */
  draw({ wave, k, pose, s, steering }) {
    const none = pose === null ? "Point at a wedge of the map, or tap it, to see the numbers behind its color." : "";
    const over = pose !== null && wave.mdp.terminal[s] ? "The goal: nothing follows, so its value stays 0." : "";
    const zero = k === 0 ? "Before the first sweep every value is 0." : "";
    this.hint.textContent = none || over || zero || "The largest sum is the new value of the pose.";
    this.element.style.minHeight = `${1.8 * (steering.length + 2.5)}em`; // what stands below does not jump
    this.table.hidden = Boolean(none || over || zero);
    if (this.table.hidden) return;
    const value = exact(wave.values[k][s], 2, { class: "rl-new-value" });
    this.title.replaceChildren(`Sweep ${k} at ${poseText(pose)}: ${timed("V", k)} = `, value);
    this.rows.replaceChildren(...wave.lookAhead(s, k).map((row) => rowOf(row, steering, wave.mdp.gamma)));
  }
}

function rowOf({ a, reward, next, sum, best }, steering, gamma) {
  const turn = h("th", { scope: "row", text: turnText(steering[a]) });
  const follows = h("td", {}, `+ ${written(gamma, 3)} × `, exact(next));
  const largest = best ? [h("span", { class: "rl-tag", text: "max" }), " "] : [];
  const total = h("td", { class: best ? "rl-used" : null }, largest, "= ", exact(sum));
  return h("tr", {}, turn, h("td", {}, exact(reward)), follows, total);
}
