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
  const { pairs } = mixedRows(mdp, phi, Q);
  const [first] = pairs;
  if (!first || first.loss <= 0) return { count: pairs.length, pair: null, turns: null };
  return { count: pairs.length, ...inWorld(task, mdp, Q, first) };
}

/** Give two states of a row as poses, with the best turn of each: { pair, turns }. */
export function inWorld({ robot, poses }, { A }, Q, { states }) {
  const turns = states.map((s) => robot.steering[Math.log2(lowest(bestActions(Q, s, A)))]);
  return { pair: states.map((s) => poses[s]), turns };
}

/**
 * Look at every row that the robot can meet: `met` of them there are, in `mixed` of them no action is best for all of
 * the row's poses, and `pairs` holds, for each row with two poses that have none in common, those that lose most by
 * sharing it, { loss, states }; the row that loses most comes first.
 */
export function mixedRows(mdp, phi, Q) {
  const { A } = mdp;
  const rows = kindsOf(mdp, phi, Q);
  const all = (1 << A) - 1;
  const kinds = [...rows.values()];
  const mixed = kinds.filter((kind) => [...kind.keys()].reduce((common, bits) => common & bits, all) === 0).length;
  const pairs = kinds.flatMap((kind) => {
    const apart = disjoint([...kind]).map((states) => ({ loss: lossOf(Q, A, states), states }));
    return apart.length ? [apart.reduce((worst, one) => (one.loss > worst.loss ? one : worst))] : [];
  });
  return { met: rows.size, mixed, pairs: pairs.sort((a, b) => b.loss - a.loss) };
}

/** The rows that the robot can meet: row -> best actions, as bits -> the first state with them. */
function kindsOf({ start, S, A, K, nextState, prob, terminal }, phi, Q) {
  const rows = new Map();
  const reached = reachedFrom(start, S, A * K, nextState, prob); // by whatever it does
  for (let s = 0; s < S; s++) {
    if (!reached[s] || terminal[s]) continue;
    const kinds = rows.get(phi[s]) ?? rows.set(phi[s], new Map()).get(phi[s]);
    const bits = bestActions(Q, s, A);
    if (!kinds.has(bits)) kinds.set(bits, s);
  }
  return rows;
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
