/**
 * Two ways and what they are worth: the returns that are built backwards, and the discounts at which the ways tie.
 */
import { fail, integer, items, number } from "../check.js";
import { returns } from "../rollouts.js";

export const MOST_REWARD = 12; // either way: what the bars have room for
export const LONGEST_WAY = 16; // steps that stand side by side
const LEAST_RANGE = [-2, 6];
const GRID = 200; // pieces of [0, 1] in which a tie is looked for
const HALVINGS = 60;

/** Return the state in its complete form, or raise; `known` is the earliest t whose return is built. */
export function checkWays({ map, ways, gamma, known, curves }) {
  const pair = items("ways", ways, "two ways");
  if (pair.length !== 2) fail("ways", "two ways", `${pair.length} of them`);
  const checked = pair.map((way) => {
    const rewards = items("rewards", way.rewards, "numbers");
    if (!rewards.length || rewards.length > LONGEST_WAY) {
      fail("rewards", `1 to ${LONGEST_WAY} numbers`, `${rewards.length} of them`);
    }
    return { ...way, rewards: rewards.map((r) => number("rewards", r, -MOST_REWARD, MOST_REWARD)) };
  });
  const last = Math.max(...checked.map(({ rewards }) => rewards.length));
  return {
    map,
    ways: checked,
    gamma: number("gamma", gamma, 0, 1),
    known: Math.min(integer("known", known, 0), last),
    curves: Boolean(curves),
  };
}

/** Return the step after the last one of the longer way: nothing follows there. */
export function endOf(ways) {
  return Math.max(...ways.map(({ rewards }) => rewards.length));
}

/**
 * One way, seen from time `known`: its returns, which of them are built, and the share of each reward that counts
 * there. The shares of a way add up to its return: `G[from]`, where `from` is the first step that is built.
 */
export function seen({ rewards }, gamma, known) {
  const G = returns(rewards, gamma);
  const from = Math.min(known, rewards.length);
  const shares = rewards.map(() => null);
  let weight = 1;
  for (let t = from; t < rewards.length; t++) {
    shares[t] = weight * rewards[t];
    weight *= gamma;
  }
  return { G, from, shares };
}

/** Return the range [low, high] of rewards that the bars of both ways have room for. */
export function rangeOf(ways) {
  const all = ways.flatMap(({ rewards }) => rewards);
  return [Math.min(...all, LEAST_RANGE[0]), Math.max(...all, LEAST_RANGE[1])];
}

/** Return which way is worth more at the beginning: 0 or 1, or null where they tie to the last digit that is told. */
export function better(ways, gamma) {
  const [a, b] = ways.map(({ rewards }) => returns(rewards, gamma)[0]);
  if (Math.abs(a - b) < 0.005) return null;
  return a > b ? 0 : 1;
}

/** Return the discounts in [0, 1] at which two ways are worth the same, by bisection. */
export function ties(ways) {
  const gap = (gamma) => returns(ways[0].rewards, gamma)[0] - returns(ways[1].rewards, gamma)[0];
  const found = [];
  for (let k = 0; k <= GRID; k++) {
    const [low, high] = [k / GRID, (k + 1) / GRID];
    if (gap(low) === 0) found.push(low);
    else if (k < GRID && gap(low) * gap(high) < 0) found.push(between(gap, low, high));
  }
  return found.length > GRID ? [] : found; // ways that never differ do not tie anywhere in particular
}

/** Halve an interval until its ends are one number, as far as anybody can tell. */
function between(gap, low, high) {
  for (let k = 0; k < HALVINGS; k++) {
    const middle = (low + high) / 2;
    if (gap(low) * gap(middle) <= 0) high = middle;
    else low = middle;
  }
  return (low + high) / 2;
}

/** Return the worth of every way at 101 discounts from 0 to 1. */
export function curvesOf(ways) {
  const x = Array.from({ length: 101 }, (_, k) => k / 100);
  return ways.map(({ name, rewards }) => ({ name, x, y: x.map((gamma) => returns(rewards, gamma)[0]) }));
}
