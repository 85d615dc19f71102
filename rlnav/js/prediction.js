/**
 * Prediction: what a given policy is worth.  Mirrors rlnav/prediction.py (eq-linear-system).
 */
import { fail, instance } from "./check.js";
import { MDP, underPolicy } from "./mdp.js";
import { finish } from "./slices.js";

const EXACT = 1e-10; // relative error
const SLOW = 0.999; // beyond this gamma ...
const SMALL = 4000; // ... up to so many states, the linear system is solved directly
const MOST_EXPECTATIONS = 1_000_000; // sweeps

/** Find the values of a policy, v = r_pi + gamma P_pi v; `pi` is [S] actions or [S * A] probabilities. */
export function evaluatePolicy(mdp, pi) {
  return finish(evaluatingPolicy(mdp, pi));
}

/** `evaluatePolicy`, a sweep at a time. */
export function* evaluatingPolicy(mdp, pi) {
  instance("mdp", mdp, MDP);
  const chain = underPolicy(mdp, pi);
  if (mdp.gamma === 1) checkThatItEnds(mdp, chain);
  if (mdp.gamma > SLOW && mdp.S <= SMALL) return yield* eliminate(mdp, chain);
  let V = new Float64Array(mdp.S);
  let following = new Float64Array(mdp.S);
  for (let sweep = 0; sweep < MOST_EXPECTATIONS; sweep++) {
    const { change, size } = expectationSweep(chain, mdp.gamma, V, following);
    [V, following] = [following, V];
    if (change * mdp.gamma <= (1 - Math.min(mdp.gamma, SLOW)) * EXACT * size) return V;
    yield;
  }
  return fail("pi", "a policy whose episodes end sooner", `values that move after ${MOST_EXPECTATIONS} sweeps`);
}

/** One sweep (eq-policy-evaluation): write r + gamma P V into `following`; return the largest change and value. */
export function expectationSweep({ N, nextState, prob, r }, gamma, V, following) {
  let change = 0;
  let size = 0;
  for (let s = 0; s < V.length; s++) {
    let v = 0;
    for (let n = s * N; n < (s + 1) * N; n++) v += prob[n] * V[nextState[n]];
    following[s] = r[s] + gamma * v;
    change = Math.max(change, Math.abs(following[s] - V[s]));
    size = Math.max(size, Math.abs(following[s]));
  }
  return { change, size };
}

/**
 * Solve (I - gamma P) v = r by elimination, for the states from which a reward may come; the others are worth 0.
 * No pivots are looked for: the diagonal is at least as large as the rest of its row.  A robot moves to near cells,
 * which are near in the order of states, so a row has few numbers left and right of the diagonal.
 */
function* eliminate(mdp, { N, nextState, prob, r }) {
  const paid = reaching(r.map((x) => (x !== 0 ? 1 : 0)), N, nextState, prob);
  const states = Array.from(paid.keys()).filter((s) => paid[s]);
  const row = new Int32Array(mdp.S).fill(-1);
  states.forEach((s, i) => (row[s] = i));
  const links = states.flatMap((s, i) =>
    Array.from({ length: N }, (_, n) => ({ i, j: row[nextState[s * N + n]], p: prob[s * N + n] })),
  ).filter(({ j, p }) => j >= 0 && p > 0);
  const band = links.reduce((most, { i, j }) => Math.max(most, Math.abs(i - j)), 0);
  const width = 2 * band + 1; // the coefficient of v[j] in row i is at i * width + j - i + band
  const M = new Float64Array(states.length * width);
  const v = Float64Array.from(states, (s) => r[s]);
  states.forEach((_, i) => (M[i * width + band] = 1));
  links.forEach(({ i, j, p }) => (M[i * width + j - i + band] -= mdp.gamma * p));
  for (let i = 0; i < v.length; i++) {
    const pivot = M[i * width + band];
    if (!(pivot > 0)) {
      const advice = "Take a smaller gamma, or a larger chance of an end.";
      fail("pi", "a policy that ends", "one whose chance to end is lost in rounding", advice);
    }
    for (let below = i + 1; below <= Math.min(i + band, v.length - 1); below++) {
      const factor = M[below * width + i - below + band] / pivot;
      if (factor === 0) continue;
      for (let d = 0; d <= band; d++) M[below * width + i + d - below + band] -= factor * M[i * width + d + band];
      v[below] -= factor * v[i];
    }
    yield;
  }
  for (let i = v.length - 1; i >= 0; i--) {
    for (let d = 1; d <= band && i + d < v.length; d++) v[i] -= M[i * width + d + band] * v[i + d];
    v[i] /= M[i * width + band];
  }
  return Float64Array.from(row, (i) => (i < 0 ? 0 : v[i]));
}

/** Widen a set of states by all those from which the chain may come into it. */
function reaching(set, N, nextState, prob) {
  const reached = Uint8Array.from(set);
  for (let wider = true; wider; ) {
    wider = false;
    for (let s = reached.length - 1; s >= 0; s--) {
      for (let n = s * N; n < (s + 1) * N && !reached[s]; n++) {
        if (reached[nextState[n]] && prob[n] > 0) wider = reached[s] = 1;
      }
    }
  }
  return reached;
}

function checkThatItEnds(mdp, { N, nextState, prob, r }) {
  const ends = reaching(mdp.terminal, N, nextState, prob);
  const endless = ends.findIndex((end, s) => !end && r[s] !== 0);
  if (endless < 0) return;
  const got = `one that never ends from state ${endless}`;
  fail("pi", "a policy that ends when gamma = 1", got, "Its value is infinite. Take gamma < 1 or mend it.");
}
