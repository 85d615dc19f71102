/**
 * The last update as the formula of its algorithm: a line of symbols and below it the same line in numbers.
 */
import { h } from "../views/dom.js";
import { changes } from "./fields.js";
import { decimals } from "./measures.js";
import { headingInWords, turnInWords } from "./words.js";

const NAMES = {
  after: "new entry",
  before: "old entry",
  alpha: "step size",
  reward: "reward",
  gamma: "discount",
  next: "value of what comes next",
  target: "target",
};

/** Build the part "Last update". */
export function lastUpdate(app) {
  const title = h("h3", { class: "rl-subtitle", text: "Last update" });
  const where = h("p", { class: "rl-help" });
  const formula = h("div", { class: "rl-formula", role: "img" });
  const note = h("p", { class: "rl-help" });
  const element = h("div", { class: "rl-stack" }, title, where, formula, note);
  element.dataset.key = "update";
  const changed = changes();
  return {
    element,
    refresh() {
      const { session } = app;
      if (!changed(session, session.updates)) return;
      const found = session.formula();
      formula.hidden = !found || found.waits;
      where.textContent = found ? placeOf(session) : unknown(session);
      note.textContent = found?.note ?? "";
      if (formula.hidden) return;
      formula.replaceChildren(...lineOf(found));
      formula.setAttribute("aria-label", inWords(found));
    },
  };
}

function unknown({ isPlayback }) {
  if (isPlayback) return "A run from Python keeps its tables, not its single updates.";
  return "Take one update to see its formula filled with its numbers.";
}

/** Say where the robot was, what it did, and what it was paid. */
function placeOf({ learner, task }) {
  const { s, a } = learner.last;
  const { x, y, theta } = task.pose(s);
  return `At (${x}, ${y}), looking ${headingInWords(theta)}, it steered ${turnInWords(task.robot.steering[a])}.`;
}

/** The line in pieces: what stands before the bracket, and in it the error, with the target named within. */
function lineOf({ tokens, target, tdError }) {
  const opens = tokens.findIndex(({ text }) => text === "[");
  const minus = tokens.findLastIndex(({ text }) => text === "−");
  const piece = (from, to) => tokens.slice(from, to).map(tokenOf);
  const aim = named("target", "target", target, piece(opens + 1, minus));
  const bracket = (text) => h("span", { class: "rl-token-sign rl-bracket", text });
  const error = named("error", "TD error", tdError, [aim, ...piece(minus, -1)]);
  return [...piece(0, opens), h("span", { class: "rl-bracketed" }, bracket("["), error, bracket("]"))];
}

/** A symbol above its number, both with the color and the line of their role. */
function tokenOf({ text, role, symbol, value }) {
  if (text) return h("span", { class: "rl-token-sign", text });
  const symbolic = h("span", { class: "rl-token-symbol", text: symbol });
  const numeric = h("span", { class: "rl-token-number", text: short(value, role) });
  return h("span", { class: `rl-token rl-role-${role}`, title: NAMES[role] }, symbolic, numeric);
}

/** Tokens that have a name together, above a brace. */
function named(role, name, value, tokens) {
  const label = h("span", { class: "rl-brace-name", text: `${name} ${decimals(value)}` });
  return h("span", { class: `rl-brace rl-role-${role}` }, h("span", { class: "rl-brace-tokens" }, tokens), label);
}

function inWords({ tokens, target, tdError }) {
  const signs = { "←": "becomes", "·": "times", "−": "minus", "[": "times the difference of", "]": "" };
  const word = ({ text, role, value }) => (text ? (signs[text] ?? text) : `${NAMES[role]} ${short(value, role)}`);
  const words = tokens.map(word);
  return `${words.join(" ").trim()}. Target ${decimals(target)}, TD error ${decimals(tdError)}.`;
}

/** Step size and discount as they were set, values with three decimals. */
function short(value, role) {
  const given = role === "alpha" || role === "gamma";
  const text = given ? String(Number(value.toPrecision(3))) : String(Number(value.toFixed(3)));
  return text.replace("-", "−");
}
