/**
 * Situations that look alike to the robot but are not: they share a row of the table and need different turns.
 */
import { TIE } from "../mdp.js";
import { reachedFrom } from "./trial.js";

/**
 * Count the rows in which two poses, that the robot can come to, have no best action in common, and give the pair that
 * loses most by it: { count, pair: [pose, pose] or null, turns: the best turn of each }.
 */
export function aliasesOf(task, mdp, phi, Q) {
  const rows = new Map(); // row -> best actions, as bits -> the first state with them
  const { start, S, A, K } = mdp;
  const reached = reachedFrom(start, S, A * K, mdp.nextState, mdp.prob); // by whatever it does
  for (let s = 0; s < S; s++) {
    if (!reached[s] || mdp.terminal[s]) continue;
    const kinds = rows.get(phi[s]) ?? rows.set(phi[s], new Map()).get(phi[s]);
    const bits = bestActions(Q, s, A);
    if (!kinds.has(bits)) kinds.set(bits, s);
  }
  let count = 0;
  let worst = { loss: 0, states: null };
  for (const kinds of rows.values()) {
    const pairs = disjoint([...kinds]);
    if (pairs.length) count += 1;
    for (const states of pairs) {
      const loss = lossOf(Q, A, states);
      if (loss > worst.loss) worst = { loss, states };
    }
  }
  const { states } = worst;
  if (!states) return { count, pair: null, turns: null };
  const turns = states.map((s) => task.robot.steering[Math.log2(lowest(bestActions(Q, s, A)))]);
  return { count, pair: states.map((s) => task.pose(s)), turns };
}

/** The actions of a state that are as good as the best, as bits. */
function bestActions(Q, s, A) {
  let best = -Infinity;
  for (let i = s * A; i < (s + 1) * A; i++) best = Math.max(best, Q[i]);
  let bits = 0;
  for (let a = 0; a < A; a++) bits |= best - Q[s * A + a] <= TIE * Math.max(1, Math.abs(best)) ? 1 << a : 0;
  return bits;
}

/** Pairs of states without a common best action. */
function disjoint(kinds) {
  return kinds.flatMap(([bits, s], i) => kinds.slice(i + 1).flatMap(([more, t]) => (bits & more ? [] : [[s, t]])));
}

/** What two states lose together if both must take one action, the one that costs least. */
function lossOf(Q, A, states) {
  const best = states.map((s) => Math.max(...Q.subarray(s * A, (s + 1) * A)));
  const costs = Array.from({ length: A }, (_, a) => states.reduce((sum, s, i) => sum + best[i] - Q[s * A + a], 0));
  return Math.min(...costs);
}

function lowest(bits) {
  return bits & -bits;
}
