/**
 * The color bar below a map: which color stands for which number.
 */
import { h } from "./dom.js";
import { DIVERGING, DIVERGING_ON_DARK, SEQUENTIAL, UNDER } from "./theme.js";

export class Legend {
  constructor(parent) {
    this.label = h("span", { class: "rl-legend-label" });
    this.below = h("span", { class: "rl-legend-below" }, h("i", { style: { background: UNDER } }), "lower");
    this.bar = h("i");
    this.ticks = h("span", { class: "rl-legend-ticks" });
    const scale = h("span", { class: "rl-legend-scale" }, this.bar, this.ticks);
    this.element = h("div", { class: "rl-legend" }, this.label, this.below, scale);
    parent.append(this.element);
  }

  destroy() {
    this.element.remove();
  }

  /** Show the scale; `below` says that some values lie under it, and are nearly black. */
  draw({ low, high, diverging = false, label = "value", below = false }) {
    const texts = [low, (low + high) / 2, high].map((value) => short(value, high - low));
    const shown = JSON.stringify([label, below, diverging, texts]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.label.textContent = label;
    this.below.hidden = !below;
    const colors = diverging ? DIVERGING.map((on, i) => `light-dark(${on}, ${DIVERGING_ON_DARK[i]})`) : SEQUENTIAL;
    this.bar.style.background = `linear-gradient(to right, ${colors.join(", ")})`;
    this.ticks.replaceChildren(...texts.map((text) => h("span", { text })));
  }
}

/** Write a number with as many decimals as the width of its scale asks for. */
export function short(value, span) {
  const digits = Math.min(Math.max(Math.ceil(1 - Math.log10(span || 1)), 0), 6);
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}
