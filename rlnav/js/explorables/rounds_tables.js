/**
 * The numbers of policy iteration: of the present step, and of the whole runs that the reader has tried.
 */
import { h } from "../views/dom.js";
import { rounded } from "./rounds_words.js";

export class StepTable {
  constructor(parent) {
    this.rows = h("tbody");
    const caption = h("caption", { class: "rl-hidden", text: "The present step in numbers" });
    this.element = h("table", { class: "rl-numbers rl-rounds-numbers" }, caption, this.rows);
    parent.append(this.element);
  }

  draw(rounds) {
    const { now, length, truth } = rounds;
    const all = truth.live.length;
    const right = truth.right(now.pi);
    this.rows.replaceChildren(
      row("changed by the last improvement", "changed", now.changed, now.better ? `${now.changed}` : "–"),
      row("poses with a best turn", "right", right, `${right} of ${all}`),
      row("values off from the policy’s", "off-policy", rounds.offPolicy(length)),
      row("values off from the best", "off-best", rounds.offBest(length)),
      row("policy short of the best", "gap", rounds.gap(length)),
      row("products so far", "work", now.work, now.work.toLocaleString("en-US")),
    );
  }
}

export class RunsTable {
  constructor(parent) {
    const words = ["sweeps each", "sweeps", "improve", "products"];
    const head = h("thead", {}, h("tr", {}, words.map((word) => h("th", { scope: "col", text: word }))));
    this.rows = h("tbody");
    const caption = h("caption", { text: "Whole runs from the first policy" });
    this.table = h("table", { class: "rl-numbers" }, caption, head, this.rows);
    this.hint = h("p", { class: "rl-help" });
    const scrolls = { tabindex: 0, role: "group", "aria-label": "Whole runs" };
    this.element = h("div", { class: "rl-numbers-scroll rl-rounds-runs", ...scrolls }, this.table, this.hint);
    parent.append(this.element);
  }

  /** Show runs: [{ n, run }], n null for sweeps until the values settle. */
  draw(runs) {
    const few = runs.length < 2;
    this.table.hidden = !runs.length;
    this.hint.textContent = few ? "Run to the end with different numbers of sweeps, and compare the products." : "";
    const least = Math.min(...runs.map(({ run }) => run?.work ?? Infinity));
    this.rows.replaceChildren(...runs.map(({ n, run }) => {
      const name = h("th", { scope: "row", text: n === null ? "to the end" : String(n) });
      if (!run) return h("tr", {}, name, h("td", { colspan: 3, text: "does not end in 2000 steps" }));
      const cheapest = run.work === least && !few;
      const tag = cheapest ? [h("span", { class: "rl-tag", text: "least" }), " "] : [];
      const work = h("td", { class: cheapest ? "rl-used" : null }, tag, data(run.work, run.work.toLocaleString("en-US")));
      return h("tr", {}, name, h("td", {}, data(run.sweeps)), h("td", {}, data(run.improvements)), work);
    }));
  }
}

function row(name, key, value, text = rounded(value)) {
  return h("tr", {}, h("th", { scope: "row", text: name }), h("td", {}, data(value, text, { class: `rl-is-${key}` })));
}

/** Write a number to be read, and behind it the exact one for whoever takes the page apart. */
function data(value, text = String(value), attributes = {}) {
  return h("data", { value: String(value), ...attributes }, text);
}
