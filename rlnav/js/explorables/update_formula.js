/**
 * The update as a formula with its numbers below: each symbol stands over the number that it has in this step.
 */
import { h } from "../views/dom.js";
import { exact } from "./look_ahead.js";
import { symbol } from "./naming.js";

const DIGITS = 3;
const entry = () => [h("i", {}, "Q"), "(", symbol("S", "t"), ", ", symbol("A", "t"), ")"];
const nextEntry = (action) => [h("i", {}, "Q"), "(", symbol("S", "t+1"), ", ", action, ")"];
const anyAction = () => h("i", {}, "a′");

/** What each algorithm makes of the next row: the one term in which they differ. */
const NEXT = {
  q_learning: () => ["max", h("sub", {}, anyAction()), " ", ...nextEntry(anyAction())],
  sarsa: () => nextEntry(symbol("A", "t+1")),
  expected_sarsa: () => [
    "Σ", h("sub", {}, anyAction()), " π(", anyAction(), " | ", symbol("S", "t+1"), ") ", ...nextEntry(anyAction()),
  ],
};

export class UpdateFormula {
  constructor(parent) {
    this.line = h("div", { class: "rl-formula", role: "group", "aria-label": "The update, with its numbers" });
    this.sums = h("p", { class: "rl-sums" });
    this.element = h("div", {}, this.line, this.sums);
    parent.append(this.element);
  }

  /** Show an update (partsOf in scenario/update.js); `hidden` keeps back what the reader shall work out. */
  draw(parts, algorithm, hidden) {
    const { before, after, alpha, r, gamma, next, target, tdError } = parts ?? {};
    const value = (x, digits = DIGITS) => (parts ? exact(x, digits) : "");
    const unknown = h("span", { class: "rl-unknown", text: "?" });
    this.line.replaceChildren(
      term("entry", "after", entry(), hidden ? unknown : value(after)),
      sign("←"),
      term("entry", "before", entry(), value(before)),
      sign("+"),
      term("plain", "alpha", h("i", {}, "α"), value(alpha, 6)),
      times(),
      sign("["),
      term("reward", "reward", symbol("R", "t+1"), value(r, 6)),
      sign("+"),
      term("plain", "gamma", h("i", {}, "γ"), value(gamma, 6)),
      times(),
      term("next", "next", NEXT[algorithm](), value(next)),
      sign("−"),
      h("span", { class: "rl-together" }, term("entry", "before", entry(), value(before)), sign("]")),
    );
    this.line.classList.toggle("rl-over", gamma === 0);
    this.sums.replaceChildren(
      ...(parts && !hidden ? ["target ", part("target", target), " · TD error ", part("td-error", tdError)] : []),
    );
    this.sums.append(parts && hidden ? "What does the entry become?" : "");
  }
}

/** A symbol over its number. */
function term(look, name, above, below) {
  const lines = [h("span", { class: "rl-above" }, above), h("span", { class: "rl-below" }, below)];
  return h("span", { class: `rl-term rl-${look}`, dataset: { part: name } }, lines);
}

/** A dot between two numbers; symbols need none. */
function times() {
  return h("span", { class: "rl-sign" }, h("span"), h("span", { text: "·" }));
}

/** A sign of both lines. */
function sign(text) {
  const below = h("span", { "aria-hidden": true, text });
  return h("span", { class: "rl-sign" }, h("span", { text }), below);
}

function part(name, value) {
  return h("b", { dataset: { part: name } }, exact(value, DIGITS));
}
