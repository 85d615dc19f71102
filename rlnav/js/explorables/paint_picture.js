/**
 * The map of a painted policy: the value of every pose, or how it differs from that of the kept policy, and the turns.
 */
import { ANY } from "../scenario/painted.js";
import { NONE } from "../views/grid_values.js";

/** Return what GridView draws; with `W`, the values of the kept policy, the colors are differences. */
export function mapOf({ task, mdp, V }, W, { policy, heading, pose: [x, y, theta] }) {
  const { width, height, obstacles, goal } = task.world;
  const each = heading === null ? 8 : 1;
  const shades = new Float64Array(width * height * each).fill(NaN);
  const needles = new Int8Array(width * height * 8).fill(NONE);
  task.poses.forEach((pose, s) => {
    if (mdp.terminal[s]) return;
    const cell = pose.y * width + pose.x;
    const wedge = cell * 8 + pose.theta / 45;
    if (policy[s] !== ANY) needles[wedge] = task.robot.steering[policy[s]] / 45;
    if (heading === null || pose.theta === heading) shades[each === 8 ? wedge : cell] = V[s] - (W ? W[s] : 0);
  });
  const values = each === 8 ? { rings: shades } : { cells: shades };
  const scale = W ? signedScale(shades) : scaleOf(mdp);
  const selected = { x, y, theta };
  return { width, height, obstacles, goal, ...values, needles, needlesAt: heading, scale, selected };
}

/** The same colors for every policy: from the worst reward to the best. */
export function scaleOf({ reward }) {
  return { low: Math.min(...reward), high: Math.max(...reward) };
}

function signedScale(shades) {
  const reach = Math.max(1e-9, ...shades.filter((v) => !Number.isNaN(v)).map(Math.abs));
  return { low: -reach, high: reach, diverging: true };
}
