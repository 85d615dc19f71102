/**
 * A policy that is painted, as a text with one sign for each state: the number of an action, or "r" for any of them.
 */
import { distance } from "../designs.js";
import { fail, show } from "../check.js";

export const ANY = "r";
export const FILLS = ["straight", "goal", "random"];
const Z95 = 1.96; // standard errors to each side that hold 95 % of a normal distribution
export const FEW = 30; // drives: below, an interval of this kind promises too much

/** Fill a whole policy: "straight" on, towards the "goal" as the crow flies, or "random". */
export function filled(task, fill) {
  return [...task.poses.map((pose) => signOf(task, pose, fill)), ANY].join("");
}

/** The sign of one pose for a brush: the number of an action, or a kind of FILLS. */
export function signOf(task, pose, brush) {
  if (brush === "random") return ANY;
  const { steering } = task.robot;
  if (brush === "goal") return String(nearest(task, pose));
  if (brush !== "straight") return brush;
  return String(steering.reduce((best, a, i) => (Math.abs(a) < Math.abs(steering[best]) ? i : best), 0));
}

/** The action that leads nearest to the goal, walls or not; of equally good ones that which turns least. */
function nearest({ robot, world }, pose) {
  const { steering } = robot;
  const far = steering.map((a) => distance(robot.move(pose, a), world.goal));
  const better = (i, j) => far[i] < far[j] || (far[i] === far[j] && Math.abs(steering[i]) < Math.abs(steering[j]));
  return steering.reduce((best, _, i) => (better(i, best) ? i : best), 0);
}

/** Paint one state. */
export function painted(signs, s, sign) {
  return signs.slice(0, s) + sign + signs.slice(s + 1);
}

/** The probabilities pi(a | s) [S * A] of a painted policy. */
export function chancesOf(signs, { S, A }) {
  if (typeof signs !== "string" || signs.length !== S) {
    fail("policy", `one sign for each of the ${S} states`, `${signs?.length} of them`);
  }
  const pi = new Float64Array(S * A);
  [...signs].forEach((sign, s) => {
    if (sign === ANY) pi.fill(1 / A, s * A, (s + 1) * A);
    else if (/^\d$/.test(sign) && Number(sign) < A) pi[s * A + Number(sign)] = 1;
    else fail("policy", `signs from 0 to ${A - 1}, or ${ANY}`, `${show(sign)} in state ${s}`);
  });
  return pi;
}

/** Mean, standard deviation and standard error of some numbers, and the half width of a 95 % interval of the mean. */
export function statistics(G) {
  const n = G.length;
  const mean = G.reduce((sum, g) => sum + g, 0) / n;
  const sd = n > 1 ? Math.sqrt(G.reduce((sum, g) => sum + (g - mean) ** 2, 0) / (n - 1)) : NaN;
  return { n, mean, sd, se: sd / Math.sqrt(n), half: (Z95 * sd) / Math.sqrt(n) };
}

/** Compare the values of two policies, state by state, in those where the episode is not over. */
export function compared(mdp, V, W) {
  const count = { better: 0, worse: 0, same: 0 };
  V.forEach((v, s) => {
    if (mdp.terminal[s]) return;
    const near = Math.abs(v - W[s]) <= 1e-7 * Math.max(1, Math.abs(v));
    count[near ? "same" : v > W[s] ? "better" : "worse"] += 1;
  });
  return count;
}
