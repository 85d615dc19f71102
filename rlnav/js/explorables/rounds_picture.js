/**
 * The pictures of policy iteration: the map after a step, and the errors of all steps up to it.
 */
import { IMPROVE } from "../scenario/rounds.js";
import { NONE } from "../views/grid_values.js";

const LEAST = 1e-4; // errors below are not drawn: a logarithmic axis has no end

/** Choose one scale for all policies, bad ones included: from the worst reward to the best value. */
export function scaleOf({ mdp, star }) {
  const low = mdp.reward.reduce((least, r) => Math.min(least, r), 0);
  const high = star.reduce((most, v) => Math.max(most, v), 0);
  return low < high ? { low, high } : { low: low - 1, high };
}

/** Return what GridView draws of the present step: values or errors, and the policy's needles. */
export function mapOf({ rounds, task, scale, truth }, { heading, show }) {
  const { width, height, obstacles, goal } = task.world;
  const { V, pi, better } = rounds.now;
  const exact = show === "errors" ? truth.of(pi) : null;
  const each = heading === null ? 8 : 1;
  const shades = new Float64Array(width * height * each).fill(NaN);
  const needles = new Int8Array(width * height * 8).fill(NONE);
  task.poses.forEach(({ x, y, theta }, s) => {
    if (rounds.mdp.terminal[s] || (heading !== null && theta !== heading)) return;
    if (show === "changed" && !better?.[s]) return;
    const cell = y * width + x;
    shades[cell * each + (each === 8 ? theta / 45 : 0)] = exact ? Math.abs(V[s] - exact[s]) : V[s];
    needles[cell * 8 + theta / 45] = task.robot.steering[pi[s]] / 45;
  });
  const label = exact ? "values off from those of the policy" : "value";
  const shown = { ...(each === 8 ? { rings: shades } : { cells: shades }), needles, needlesAt: heading };
  return { width, height, obstacles, goal, label, scale: exact ? { low: 0, high: scale.high } : scale, ...shown };
}

/** Return what CurveView draws: both errors after every step, and where the policy was improved. */
export function curvesOf(rounds) {
  const x = Array.from(rounds.steps.keys());
  const seen = (v) => Math.max(v, LEAST);
  const offPolicy = x.map((k) => seen(rounds.offPolicy(k)));
  const offBest = x.map((k) => seen(rounds.offBest(k)));
  const most = 2 * Math.max(...offPolicy, ...offBest, 1);
  const improved = x.filter((k) => rounds.steps[k].kind === IMPROVE);
  const bars = { x: improved.flatMap((k) => [k, k, k]), y: improved.flatMap(() => [LEAST, most, NaN]) };
  return {
    series: [
      { name: "off from the policy's values", x, y: offPolicy },
      { name: "off from the best values", x, y: offBest },
      { name: "improved here", ...bars, dash: "1 3", color: "var(--rl-muted)" },
    ],
    log: true,
    marker: rounds.length,
    xRange: [0, Math.max(20, rounds.length)],
    yRange: [LEAST, most],
  };
}
