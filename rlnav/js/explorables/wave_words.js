/**
 * What a sweep of value iteration has brought, in words.
 */
import { written } from "./naming.js";

export const HEARABLE = 1e-11; // errors below are noise of rounding

/** Tell what sweep k of a wave has brought. */
export function sentence(wave, k) {
  if (k === 0) return "Sweep 0: every value is 0. No pose has heard of the goal yet.";
  const change = `The largest change was ${rounded(wave.residuals[k])}`;
  if (k < wave.length || !wave.converged) return `${news(wave, k)} ${change}; the sweeps stop at ${rounded(wave.tol)}.`;
  const promise = `No value can be off by more than ${rounded(wave.promise(k))}`;
  return `${news(wave, k)} ${change}, so the sweeps stop. ${promise}; in truth none is off by more than ` +
    `${rounded(wave.error(k))}.`;
}

/** Tell how far the news of the goal has come. */
function news({ heard, mdp }, k) {
  if (heard[k] === heard[k - 1]) return `Sweep ${k}: all ${heard[k]} poses that can get to the goal have heard of it.`;
  const poses = mdp.terminal.reduce((count, over) => count + (over ? 0 : 1), 0);
  const steps = k === 1 ? "1 step" : `${k} steps`;
  return `Sweep ${k}: ${heard[k]} of ${poses} poses have heard of the goal, those within ${steps} of it.`;
}

/** Write a number with two digits that count. */
function rounded(value) {
  return value < HEARABLE ? "0" : written(Number(value.toPrecision(2)), 12);
}
