/**
 * The strategies: which of them play, with which parameter, and what each has lost.
 */
import { STRATEGIES } from "../scenario/bandit.js";
import { slider, toggle } from "../views/controls.js";
import { h } from "../views/dom.js";
import { DASHES, SERIES } from "../views/theme.js";
import { written } from "./naming.js";

const PARAMETERS = {
  greedy: { label: "first guess Q₀", min: -20, max: 20, step: 1 },
  epsilon: { label: "ε", min: 0, max: 1, step: 0.01 },
  softmax: { label: "temperature τ", min: 0.05, max: 10, log: true },
  ucb: { label: "c", min: 0, max: 20, step: 0.1 },
};
export const NAMES = Object.keys(STRATEGIES);

/** How the curve of a strategy looks: always the same, whoever else plays. */
export function lookOf(name) {
  const k = NAMES.indexOf(name);
  return { color: SERIES[k], dash: DASHES[k] };
}

export class RivalsView {
  /** `onToggle(name, on)` and `onChange(parameter, value)` hear the reader. */
  constructor(parent, { onToggle, onChange }) {
    this.rows = NAMES.map((name) => {
      const { name: label, parameter } = STRATEGIES[name];
      const plays = toggle({ label, value: false, onChange: (on) => onToggle(name, on) });
      const range = PARAMETERS[name];
      const number = slider({ ...range, label: `${label}: ${range.label}`, value: range.min, onInput: (v) => onChange(parameter, v) });
      const result = h("p", { class: "rl-help rl-rival-result" });
      const element = h("div", { class: "rl-rival" }, plays.element, number.element, result);
      return { name, parameter, plays, number, result, element };
    });
    this.element = h("div", { class: "rl-rivals" }, this.rows.map((row) => row.element));
    parent.append(this.element);
  }

  /** Show the settings of a state. */
  adopt(state) {
    for (const { name, parameter, plays, number } of this.rows) {
      plays.value = state.playing.includes(name);
      number.value = state[parameter];
      number.show(plays.value);
    }
  }

  /** Tell what each has lost: { name: { mine, n, mean, off, best } }, `mine` on the luck of the game by hand. */
  draw(results, { robots, pulls, hand }) {
    for (const { name, result } of this.rows) {
      const found = results[name];
      result.hidden = !found;
      if (!found) continue;
      const own = hand ? [`On your luck, after ${hand} pulls: `, data(found.mine, "rl-mine"), ". "] : [];
      const many = [`${robots} robots, ${pulls} pulls: `, data(found.mean, "rl-mean"), ` ± ${written(found.off, 1)}`];
      result.replaceChildren(...own, ...many, `; ${Math.round(100 * found.best)} % end on the best turn.`);
    }
  }
}

function data(value, name) {
  return h("data", { value: String(value), class: name, text: written(value, 1) });
}
