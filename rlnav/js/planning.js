/**
 * Planning: from the model p(s', r | s, a) to values and an optimal policy.
 * Mirrors rlnav/planning.py: value_iteration (eq-value-iteration), solve, and the improvement of policy_iteration.
 * For gamma < 1, when a sweep changes no value by more than `tol`, every value is within gamma / (1 - gamma) * tol of
 * the fixed point.
 */
import { fail, instance, integer, number } from "./check.js";
import { actionValues, greedy, MDP, TIE } from "./mdp.js";
import { largest } from "./sampling.js";
import { finish } from "./slices.js";

const EVALUATIONS = 10; // policy sweeps of `solve` between two greedy ones, at most
const ENOUGH = 0.1; // ... and they stop early once they change values by less than this share of the greedy sweep's
const MOST_SWEEPS = 200_000; // where neither the reader nor the contraction sets a lower limit

/** Apply the max backup to all states at once until nothing moves; the result is { V, Q, pi, residuals, converged }. */
export function valueIteration(mdp, { tol = 1e-8, maxSweeps = null } = {}) {
  const limit = stoppingRule(mdp, tol, maxSweeps);
  let V = new Float64Array(mdp.S);
  const residuals = [];
  while (residuals.length < limit) {
    const following = bestValues(mdp, V);
    residuals.push(following.reduce((most, v, s) => Math.max(most, Math.abs(v - V[s])), 0));
    V = following;
    if (residuals.at(-1) <= tol) break;
  }
  return solution(mdp, V, residuals, tol, maxSweeps);
}

/** One sweep of value iteration: the best action's value in every state, one look-ahead from V. */
export function bestValues(mdp, V) {
  const Q = actionValues(mdp, V);
  return Float64Array.from({ length: mdp.S }, (_, s) => largest(Q, s, mdp.A));
}

/**
 * Improve a policy by one look-ahead from V (eq-policy-improvement), as in every round of Python's policy_iteration at
 * gamma < 1: an action gives way to a strictly better one only. `better` flags the states in which it did.
 */
export function improve(mdp, pi, V) {
  const Q = actionValues(mdp, V);
  const margin = TIE * V.reduce((most, v) => Math.max(most, Math.abs(v)), 1);
  const better = Uint8Array.from(pi, (a, s) => (largest(Q, s, mdp.A) - Q[s * mdp.A + a] > margin ? 1 : 0));
  const best = greedy(Q, mdp.A);
  return { pi: Int32Array.from(pi, (a, s) => (better[s] ? best[s] : a)), better };
}

/**
 * Find v* and pi* by modified policy iteration with Gauss-Seidel sweeps of alternating direction: a greedy sweep is
 * followed by a few cheap sweeps of the policy that it found.  `residuals` belong to greedy sweeps.
 */
export function solve(mdp, options) {
  return finish(solving(mdp, options));
}

/** `solve`, a sweep at a time; yields the values as they stand. */
export function* solving(mdp, { tol = 1e-8, maxSweeps = null } = {}) {
  const limit = stoppingRule(mdp, tol, maxSweeps);
  const r = meanRewards(mdp);
  const V = new Float64Array(mdp.S);
  const pi = new Int32Array(mdp.S);
  const residuals = [];
  let forward = false;
  while (residuals.length < limit) {
    residuals.push(greedySweep(mdp, r, pi, V, forward));
    forward = !forward;
    if (residuals.at(-1) <= tol) break;
    yield V;
    for (let i = 0; i < EVALUATIONS; i++) {
      const change = policySweep(mdp, r, pi, V, forward);
      forward = !forward;
      if (change <= ENOUGH * residuals.at(-1)) break;
    }
  }
  return solution(mdp, V, residuals, tol, maxSweeps);
}

function greedySweep(mdp, r, pi, V, forward) {
  const { S, A } = mdp;
  let change = 0;
  for (let i = 0; i < S; i++) {
    const s = forward ? i : S - 1 - i;
    let best = -Infinity;
    for (let a = 0; a < A; a++) {
      const q = lookAhead(mdp, r, V, s * A + a);
      if (q > best) {
        best = q;
        pi[s] = a;
      }
    }
    change = Math.max(change, Math.abs(best - V[s]));
    V[s] = best;
  }
  return change;
}

function policySweep(mdp, r, pi, V, forward) {
  const { S, A } = mdp;
  let change = 0;
  for (let i = 0; i < S; i++) {
    const s = forward ? i : S - 1 - i;
    const q = lookAhead(mdp, r, V, s * A + pi[s]);
    change = Math.max(change, Math.abs(q - V[s]));
    V[s] = q;
  }
  return change;
}

/** Value of the state and action at s * A + a, one look-ahead from V. */
function lookAhead({ K, nextState, prob, gamma }, r, V, sa) {
  let v = 0;
  for (let j = sa * K; j < (sa + 1) * K; j++) v += prob[j] * V[nextState[j]];
  return r[sa] + gamma * v;
}

/** r(s, a): what every state and action pays on average. */
function meanRewards({ S, A, K, prob, reward }) {
  const r = new Float64Array(S * A);
  for (let j = 0; j < prob.length; j++) r[Math.floor(j / K)] += prob[j] * reward[j];
  return r;
}

/** Check the arguments; without a limit of sweeps, take one that the contraction guarantees to be enough. */
function stoppingRule(mdp, tol, maxSweeps) {
  instance("mdp", mdp, MDP);
  number("tol", tol, 0, Infinity, { above: true });
  if (maxSweeps !== null) return integer("maxSweeps", maxSweeps, 1);
  if (mdp.gamma === 1) return 10_000 + 10 * mdp.S;
  if (mdp.gamma === 0) return 2;
  const largestReward = mdp.reward.reduce((most, r) => Math.max(most, Math.abs(r)), tol);
  const sweeps = Math.ceil(Math.log(tol / largestReward) / Math.log(mdp.gamma));
  return Math.min(MOST_SWEEPS, 2 + Math.max(0, sweeps));
}

function solution(mdp, V, residuals, tol, maxSweeps) {
  const converged = residuals.at(-1) <= tol;
  if (maxSweeps === null && !converged && (mdp.gamma === 1 || residuals.length === MOST_SWEEPS)) {
    const got = `values that still move by ${residuals.at(-1)} after ${residuals.length} sweeps`;
    if (mdp.gamma < 1) {
      const advice = "Take a smaller gamma or a larger tol.";
      fail("mdp", `a problem that ${MOST_SWEEPS} sweeps can solve`, got, advice);
    }
    const advice = "Some policy collects reward without end, or none ends. Take gamma < 1, or mend rewards or ends.";
    fail("mdp", "a problem whose optimal values are finite at gamma = 1", got, advice);
  }
  const Q = actionValues(mdp, V);
  return { V, Q, pi: greedy(Q, mdp.A), residuals: Float64Array.from(residuals), converged };
}
