/**
 * How poses, actions and numbers are written and told.
 */
import { h } from "../views/dom.js";

export const ARROWS = "→↗↑↖←↙↓↘"; // the headings 0, 45, ... 315 degrees
const LOW = "₀₁₂₃₄₅₆₇₈₉";

/** Write a number with a true minus sign, with at most `digits` decimals. */
export function written(value, digits = 3) {
  const text = String(Number(value.toFixed(digits)));
  return (text === "-0" ? "0" : text).replace("-", "−");
}

/** Write a pose as short as a table needs it: "(2, 3) ↗"; the crashed robot has none. */
export function poseText(pose) {
  return pose ? `(${pose.x}, ${pose.y}) ${ARROWS[pose.theta / 45]}` : "crashed";
}

/** Tell a pose: "cell (2, 3), heading 45°". */
export function poseInWords(pose) {
  return pose ? `cell (${pose.x}, ${pose.y}), heading ${pose.theta}°` : "crashed";
}

/** Write a steering: "+45°", "0°", "−90°". */
export function turnText(a) {
  return `${a > 0 ? "+" : a < 0 ? "−" : ""}${Math.abs(a)}°`;
}

/** Tell a steering: "turn 45° to the left", "straight on". */
export function turnInWords(a) {
  return a === 0 ? "straight on" : `turn ${Math.abs(a)}° to the ${a > 0 ? "left" : "right"}`;
}

/** Write a symbol with its time in plain text: "S₃". */
export function timed(letter, t) {
  return `${letter}${String(t).replace(/\d/g, (digit) => LOW[digit])}`;
}

/** Set a symbol with its index as mathematics is set: S with t + 1 below. */
export function symbol(letter, index) {
  return h("span", { class: "rl-symbol" }, h("i", {}, letter), h("sub", {}, String(index)));
}
