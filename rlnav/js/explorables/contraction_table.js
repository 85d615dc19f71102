/**
 * One backup of two guesses at one pose: each turn seen from both, and what the maximum or the mean makes of them.
 */
import { h } from "../views/dom.js";
import { exact } from "./look_ahead.js";
import { poseText, timed, turnText, written } from "./naming.js";

const WAIT = "After a backup its numbers stand here: those of the pose at which V and W differ most, or of one that " +
  "you point at.";

export class BackupTable {
  constructor(parent) {
    this.title = h("caption");
    this.head = h("tr");
    this.rows = h("tbody");
    this.table = h("table", { class: "rl-numbers" }, this.title, h("thead", {}, this.head), this.rows);
    this.note = h("p", { class: "rl-help" });
    const scrolls = { tabindex: 0, role: "group", "aria-label": "The backup of one pose" };
    this.element = h("div", { class: "rl-numbers-scroll", ...scrolls }, this.table, this.note);
    parent.append(this.element);
  }

  /** Show backup k of a pair at state `s`, which is `pose`; `worst` says that they differ most there. */
  draw({ pair, k, s, pose, steering, worst }) {
    this.element.style.minHeight = `${1.9 * (steering.length + 4)}em`; // what stands below does not jump
    this.table.hidden = k === 0;
    this.note.textContent = k === 0 ? WAIT : promise(pair, k);
    if (k === 0) return;
    const mean = pair.pi !== null;
    this.title.textContent = `Backup ${k} at ${poseText(pose)}${worst ? ", where V and W differ most" : ""}`;
    const from = ["V", "W"].map((letter) => `from ${timed(letter, k - 1)}`);
    const words = ["turn", ...(mean ? ["π(a | s)"] : []), ...from, "apart"];
    this.head.replaceChildren(...words.map((word) => h("th", { scope: "col", text: word })));
    const turns = pair.rowsAt(s, k).reverse().map((row) => rowOf(row, steering, mean)); // left turns first
    this.rows.replaceChildren(...turns, this.resultOf(pair, k, s, mean));
  }

  resultOf(pair, k, s, mean) {
    const [v, w] = [pair.V[k][s], pair.W[k][s]];
    const name = h("th", { scope: "row", text: mean ? "mean" : "max" });
    const cells = [v, w, Math.abs(v - w)].map((value) => h("td", { class: "rl-used" }, exact(value)));
    return h("tr", { class: "rl-result" }, name, mean ? h("td") : null, cells);
  }
}

/** Why the result cannot be further apart than gamma allows. */
function promise(pair, k) {
  const { gamma } = pair.mdp;
  const before = pair.distances[k - 1];
  const product = `${written(gamma, 2)} × ${written(before, 2)} = ${written(gamma * before, 2)}`;
  return `Before, V and W were ${written(before, 2)} apart at most. So no two numbers in a row can be more than ` +
    `${product} apart, nor can their ${pair.pi ? "means" : "maxima"}.`;
}

function rowOf({ a, probability, v, w, bestV, bestW }, steering, mean) {
  const tag = () => [h("span", { class: "rl-tag", text: "max" }), " "];
  const number = (value, best) => h("td", {}, best ? tag() : [], exact(value));
  const chance = mean ? h("td", {}, exact(probability)) : null;
  const turn = h("th", { scope: "row", text: turnText(steering[a]) });
  return h("tr", {}, turn, chance, number(v, bestV), number(w, bestW), h("td", {}, exact(Math.abs(v - w))));
}
