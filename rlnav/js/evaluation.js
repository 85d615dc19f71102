/**
 * How good is a policy?  Exact answers, without sampling: no seeds, no error bars.  Mirrors rlnav/evaluation.py.
 */
import { instance, integer, MOST_STEPS } from "./check.js";
import { MDP, underPolicy } from "./mdp.js";
import { solving } from "./planning.js";
import { evaluatingPolicy } from "./prediction.js";
import { finish } from "./slices.js";

/**
 * Score a policy by following the distribution over states from step to step.
 * The result is { success, crash, timeout, steps, value, optimal, gap }.  Whoever scores many policies of one MDP gives
 * its optimal values, `best`, as found by `solve(mdp, { tol: 1e-10 }).V`.
 */
export function evaluate(mdp, pi, options) {
  return finish(evaluating(mdp, pi, options));
}

/** `evaluate`, a sweep at a time. */
export function* evaluating(mdp, pi, { maxSteps = 200, best = null } = {}) {
  instance("mdp", mdp, MDP);
  integer("maxSteps", maxSteps, 1, MOST_STEPS);
  const value = meanOver(mdp.start, yield* evaluatingPolicy(mdp, pi));
  const optimal = meanOver(mdp.start, best ?? (yield* solving(mdp, { tol: 1e-10 })).V);
  return { ...(yield* endsOf(mdp, pi, maxSteps)), value, optimal, gap: optimal - value };
}

/** How episodes end: { success, crash, timeout, steps }, a step of all episodes at a time. */
export function* endsOf(mdp, pi, maxSteps) {
  const { where, steps } = yield* follow(mdp, underPolicy(mdp, pi), maxSteps);
  const share = (counts) => where.reduce((sum, p, s) => (counts(s) ? sum + p : sum), 0);
  return {
    success: share((s) => mdp.goal[s]),
    crash: share((s) => mdp.terminal[s] && !mdp.goal[s]),
    timeout: share((s) => !mdp.terminal[s]),
    steps,
  };
}

/** Return the distribution over states after `maxSteps`, and the mean number of steps that were taken. */
function* follow(mdp, { N, nextState, prob }, maxSteps) {
  let where = new Float64Array(mdp.S);
  mdp.start.forEach((s) => (where[s] += 1));
  where.forEach((n, s) => (where[s] = n / mdp.start.length));
  let steps = 0;
  for (let t = 0; t < maxSteps; t++) {
    const underWay = where.reduce((sum, p, s) => (mdp.terminal[s] ? sum : sum + p), 0);
    if (underWay === 0) break;
    steps += underWay;
    const following = new Float64Array(mdp.S);
    for (let i = 0; i < prob.length; i++) following[nextState[i]] += where[Math.floor(i / N)] * prob[i];
    where = following;
    yield;
  }
  return { where, steps };
}

/** Mean of V over the start states. */
export function meanOver(states, V) {
  return states.reduce((sum, s) => sum + V[s], 0) / states.length;
}
