/**
 * Exercise: a log without the heads of its columns. The reader says what each column is.
 */
import { generator } from "../rng.js";
import { button, choice } from "../views/controls.js";
import { h } from "../views/dom.js";
import { COLUMNS, heading } from "./loop_log.js";

// What may be chosen, right and wrong.
const NAMES = [
  ["", "?"], ["t", "t"], ["s", "Sₜ"], ["a", "Aₜ"], ["rBefore", "Rₜ"],
  ["r", "Rₜ₊₁"], ["sNext", "Sₜ₊₁"], ["aNext", "Aₜ₊₁"],
];
const WHY = {
  t: "It counts the steps from 0.",
  s: "It is where the step begins: the first line holds the start.",
  a: "It is what the agent chose in this step, having seen the state of this line.",
  r: "It was paid for this step's action and came with the state after it, so its index is t+1.",
  sNext: "It is where the step ended: the next line begins there.",
};

export class LabelLog {
  constructor(parent) {
    this.head = h("tr");
    this.body = h("tbody");
    const caption = h("caption", { class: "rl-hidden" }, "Log without names");
    const table = h("table", { class: "rl-log rl-label-log" }, caption, h("thead", {}, this.head), this.body);
    this.feedback = h("ul", { class: "rl-feedback", "aria-live": "polite" });
    const check = button({ label: "Check", primary: true, onClick: () => this.check() });
    const another = button({ label: "Another order", icon: "reset", onClick: () => this.ask(this.round + 1) });
    this.element = h("div", { class: "rl-label-exercise" },
      h("p", {}, "Another robot has left this log, with its columns in a strange order. What is each of them?"),
      h("div", { class: "rl-log-scroll", tabindex: 0, role: "group", "aria-label": "Log without names" }, table),
      h("div", { class: "rl-toolbar" }, check.element, another.element), this.feedback);
    parent.append(this.element);
    this.round = 0;
  }

  /** Take the rows of an episode to ask about. */
  show(rows, task) {
    Object.assign(this, { rows, task });
    this.ask(this.round);
  }

  /** Shuffle the columns, the same way for the same round, and leave their heads open. */
  ask(round) {
    this.round = round;
    const chance = generator(round);
    this.columns = [...COLUMNS];
    for (let i = this.columns.length - 1; i > 0; i--) {
      const j = Math.floor(chance.random() * (i + 1));
      [this.columns[i], this.columns[j]] = [this.columns[j], this.columns[i]];
    }
    this.answers = this.columns.map((_, i) =>
      choice({ label: `Column ${i + 1}`, hideLabel: true, options: NAMES, value: "", onChange: () => this.clear() }),
    );
    this.head.replaceChildren(...this.answers.map(({ element }) => h("th", { scope: "col" }, element)));
    this.body.replaceChildren(...this.rows.map((row) =>
      h("tr", {}, this.columns.map((column) => h("td", {}, column.write(row, this.task))))));
    this.feedback.replaceChildren();
  }

  clear() {
    this.feedback.replaceChildren();
    for (const { input } of this.answers) input.removeAttribute("aria-invalid");
  }

  check() {
    const open = this.answers.findIndex(({ value }) => value === "");
    if (open >= 0) {
      this.feedback.replaceChildren(h("li", {}, `Column ${open + 1} has no name yet.`));
      return;
    }
    const wrong = this.columns.flatMap(({ key }, i) => (this.answers[i].value === key ? [] : [{ key, i }]));
    this.answers.forEach(({ input }, i) => input.setAttribute("aria-invalid", wrong.some((one) => one.i === i)));
    const lines = wrong.map(({ key, i }) => h("li", {}, `Column ${i + 1} is something else. ${WHY[key]}`));
    this.feedback.replaceChildren(...(lines.length ? lines : [this.praise()]));
  }

  praise() {
    const reward = COLUMNS.find(({ key }) => key === "r");
    const name = heading(reward);
    return h("li", { class: "rl-right" }, "All five are right. The reward ", name, " comes with the next state.");
  }
}
