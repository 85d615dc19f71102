/**
 * Two drives and two judges: a reward is right where both of them prefer the same drive.
 */
import { h } from "../views/dom.js";
import { signed } from "./mixer_words.js";

const DRIVES = ["drive that this reward asks for", "drive that the task asks for"];
const JUDGES = ["worth by this reward", "worth by the task"];

export class MixerTable {
  constructor(parent) {
    const head = h("tr", {}, h("td"), DRIVES.map((text) => h("th", { scope: "col", text })));
    this.body = h("tbody");
    const caption = h("caption", { text: "Two drives, two judges" });
    const table = h("table", { class: "rl-numbers rl-judges" }, caption, h("thead", {}, head), this.body);
    parent.append(h("div", { class: "rl-numbers-scroll" }, table));
  }

  /** Show what both drives are worth, [judge][drive]; the better one of each row stands out. */
  draw(worth) {
    const cell = (value, row) => {
      const best = value >= Math.max(...row) - 1e-9;
      return h("td", { class: best ? "rl-used" : null }, h("data", { value: String(value) }, signed(value)));
    };
    const rows = worth.map((row, j) => [h("th", { scope: "row", text: JUDGES[j] }), row.map((v) => cell(v, row))]);
    this.body.replaceChildren(...rows.map((cells) => h("tr", {}, ...cells)));
  }
}
