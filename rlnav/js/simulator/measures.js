/**
 * What can be measured of a run, and how its numbers are told: names, units and one line on what each means.
 */

// the curves over the episodes; the keys are those of scenario/metrics.js
export const CURVES = [
  {
    key: "returns",
    name: "Return",
    axis: "return",
    meaning: "Discounted sum of the rewards of an episode, with its exploration.",
  },
  {
    key: "success",
    name: "Success",
    axis: "share of episodes",
    meaning: "Episodes that reached the goal, among the last ones.",
    yRange: [0, 1],
  },
  { key: "steps", name: "Steps", axis: "steps", meaning: "Length of an episode, whatever its end." },
  {
    key: "tdErrors",
    name: "TD error",
    axis: "mean |TD error|",
    meaning: "How much the updates of an episode surprised the table.",
    log: true,
  },
  {
    key: "coverage",
    name: "Coverage",
    axis: "share of entries",
    meaning: "Entries of the table that have been tried, among those of poses.",
    yRange: [0, 1],
  },
];

// the exact scores of the greedy policy
export const SCORES = [
  { key: "success", name: "Success", tell: percent, meaning: "ends on the goal" },
  { key: "crash", name: "Crashes", tell: percent, meaning: "ends at an obstacle or the border" },
  { key: "timeout", name: "Time-outs", tell: percent, meaning: "still under way at the step limit" },
  { key: "steps", name: "Steps", tell: decimals, meaning: "mean length of a drive" },
  { key: "value", name: "Value", tell: decimals, meaning: "expected return, exact" },
  { key: "gap", name: "Gap", tell: decimals, meaning: "how much more the best policy is worth" },
];

/** 0.5 -> "50 %"; nearly all is not all. */
export function percent(share) {
  const text = (100 * share).toFixed(1);
  if (text === "100.0" && share < 1 - 1e-9) return "> 99.9 %";
  if (text === "0.0" && share > 1e-9) return "< 0.1 %";
  return `${text.replace(/\.0$/, "")} %`;
}

/** Two decimals, without a minus before zero. */
export function decimals(value) {
  if (!Number.isFinite(value)) return "none";
  return (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace("-", "−");
}

/** 1234 -> "1,234". */
export function grouped(n) {
  return n.toLocaleString("en-US");
}
