/**
 * Policy iteration step by step, with all that was before kept: sweeps of evaluation and improvements, in any order.
 */
import { fail, integers, number } from "../check.js";
import { actionValues, TIE, underPolicy } from "../mdp.js";
import { improve, solve } from "../planning.js";
import { evaluatePolicy, expectationSweep } from "../prediction.js";
import { largest } from "../sampling.js";

export const SWEEP = "s";
export const IMPROVE = "i";
export const MOST_STEPS = 2000;
const MOST_VALUES = 5_000_000; // kept of all steps: 40 MB
const EXACT = 1e-12;

/** Remember what a planner and a policy are worth in a model: it is asked for again and again. */
export class Truth {
  constructor(mdp) {
    this.mdp = mdp;
    this.live = Array.from(mdp.terminal.keys()).filter((s) => !mdp.terminal[s]);
    this.star = solve(mdp, { tol: EXACT }).V;
    this.Q = actionValues(mdp, this.star);
    this.known = new Map(); // v_pi of the policies that were asked for
  }

  /** v_pi, exactly. */
  of(pi) {
    if (!this.known.has(pi)) this.known.set(pi, evaluatePolicy(this.mdp, pi));
    return this.known.get(pi);
  }

  /** How many states have an action that no other one beats. */
  right(pi) {
    const { Q, mdp, live } = this;
    return live.reduce((count, s) => count + (largest(Q, s, mdp.A) - Q[s * mdp.A + pi[s]] <= TIE ? 1 : 0), 0);
  }
}

/**
 * Hold the steps of a run: `steps[k]` is { kind, V, pi, chain, change, better, changed, since, work }, `kind` one of
 * "" (the beginning), SWEEP and IMPROVE. `change` is the largest change of a value in the last sweep, `better` flags the
 * states in which the last improvement has changed the action, `changed` counts them, `since` counts the sweeps since
 * then, and `work` the products of numbers so far.
 */
export class Rounds {
  #errors = new WeakMap(); // of the steps that were asked for

  constructor(mdp, pi, tol, truth = new Truth(mdp)) {
    this.mdp = mdp;
    this.tol = number("tol", tol, 0, Infinity, { above: true });
    this.truth = truth;
    const first = Int32Array.from(integers("pi", pi, mdp.S, "one action a state", 0, mdp.A - 1));
    const nothing = { change: NaN, better: null, changed: NaN, since: 0, work: 0 };
    const V = new Float64Array(mdp.S);
    this.steps = [{ kind: "", V, pi: first, chain: underPolicy(mdp, first), ...nothing }];
    this.limit = Math.min(MOST_STEPS, Math.floor(MOST_VALUES / mdp.S));
  }

  get now() {
    return this.steps.at(-1);
  }

  /** The number of steps that were taken. */
  get length() {
    return this.steps.length - 1;
  }

  get full() {
    return this.length >= this.limit;
  }

  /** The steps as letters. */
  get moves() {
    return this.steps.map(({ kind }) => kind).join("");
  }

  count(kind) {
    return this.steps.reduce((n, step) => n + (step.kind === kind ? 1 : 0), 0);
  }

  /** Do one sweep of evaluation, eq-policy-evaluation. */
  sweep() {
    const { mdp, now } = this;
    const V = new Float64Array(mdp.S);
    const { change } = expectationSweep(now.chain, mdp.gamma, now.V, V);
    this.#keep({ ...now, kind: SWEEP, V, change, since: now.since + 1, work: now.work + mdp.S * mdp.K });
  }

  /** Improve the policy, eq-policy-improvement; where no turn is better the old one stays. */
  improve() {
    const { mdp, now } = this;
    const { pi, better } = improve(mdp, now.pi, now.V);
    const changed = better.reduce((sum, flag) => sum + flag, 0);
    const next = changed ? { pi, chain: underPolicy(mdp, pi) } : {};
    const work = now.work + mdp.S * mdp.A * mdp.K;
    this.#keep({ ...now, ...next, kind: IMPROVE, better, changed, since: 0, work });
  }

  /** Take the steps that letters stand for. */
  replay(moves) {
    for (const letter of moves) {
      if (![SWEEP, IMPROVE].includes(letter)) fail("moves", `letters "${SWEEP}" and "${IMPROVE}"`, `"${letter}"`);
      if (letter === SWEEP) this.sweep();
      else this.improve();
    }
  }

  back() {
    if (this.length) this.steps.pop();
  }

  /** Whether an improvement found nothing to change, and the values had settled before it. */
  get done() {
    return this.now.kind === IMPROVE && this.now.changed === 0 && this.now.change <= this.tol;
  }

  /** Take the next step of a run with `n` sweeps between two improvements, null: until they settle; false at its end. */
  advance(n) {
    const { since, change } = this.now;
    if (this.done || this.full) return false;
    const settled = since > 0 && change <= this.tol;
    if (n === null ? settled : since >= n) this.improve();
    else this.sweep();
    return !this.done && !this.full;
  }

  #keep(step) {
    if (this.full) fail("moves", `at most ${this.limit} steps`, "one more", "Start again.");
    this.steps.push(step);
  }

  /** How far the values of step k are from v_pi of its policy. */
  offPolicy(k) {
    return this.#errorsOf(this.steps[k]).offPolicy;
  }

  /** How far the values of step k are from v_*. */
  offBest(k) {
    return this.#errorsOf(this.steps[k]).offBest;
  }

  #errorsOf(step) {
    const { truth } = this;
    if (!this.#errors.has(step)) {
      const offPolicy = distance(step.V, truth.of(step.pi));
      this.#errors.set(step, { offPolicy, offBest: distance(step.V, truth.star) });
    }
    return this.#errors.get(step);
  }

  /** How much the policy of step k falls short of the best one, where that is most. */
  gap(k) {
    return distance(this.truth.of(this.steps[k].pi), this.truth.star);
  }
}

/** Run to the end with `n` sweeps between two improvements: { sweeps, improvements, work, gap }, or null if it is long. */
export function wholeRun(mdp, pi, tol, n, truth) {
  const run = new Rounds(mdp, pi, tol, truth);
  while (run.advance(n));
  if (!run.done) return null;
  return { sweeps: run.count(SWEEP), improvements: run.count(IMPROVE), work: run.now.work, gap: run.gap(run.length) };
}

function distance(V, W) {
  return V.reduce((most, v, s) => Math.max(most, Math.abs(v - W[s])), 0);
}
