/**
 * Exact answers in slices: the best that is possible, and what the greedy policy of a table is worth.
 */
import { actionValues, greedy } from "../mdp.js";
import { solving } from "../planning.js";
import { Slices } from "../slices.js";
import { scoring } from "./trial.js";

const AT_ONCE = 40; // milliseconds that a question may take before it gets a preliminary answer
const MOST_SWEEPS = 5000; // of the planner: a problem that needs more has no best policy
const CLOSE = 1e-13; // how exact the planner is, as a share of what rewards can add up to
const FAR = 1000; // steps ahead that count for that, at most

/** Find the best that is possible, a sweep at a time; `converged` is false if there is no best. */
export function planning(mdp) {
  const largest = mdp.reward.reduce((most, r) => Math.max(most, Math.abs(r)), 1);
  const horizon = Math.min(FAR, 1 / (1 - mdp.gamma));
  return solving(mdp, { tol: CLOSE * largest * horizon, maxSweeps: MOST_SWEEPS });
}

export class Exact {
  #planner;
  #job = null; // { slices, pi, updates } while scores are being computed

  /** `knowledge` says what the table's policy is. */
  constructor(mdp, knowledge, maxSteps) {
    Object.assign(this, { mdp, knowledge, maxSteps });
    this.#planner = new Slices(planning(mdp));
    this.scores = null; // of the policy `pi`, with `updates`, the moment at which it was the table's
    this.pi = null;
  }

  /** Whether the best that is possible is known; until then, `best` holds it as it stands. */
  get solved() {
    return this.#planner.done;
  }

  solve(milliseconds) {
    return this.#planner.run(milliseconds);
  }

  /** { V, Q, pi, converged } */
  get best() {
    if (!this.solved) this.solve(AT_ONCE);
    if (this.solved) return this.#planner.value;
    const V = this.#planner.value.slice();
    const Q = actionValues(this.mdp, V);
    return { V, Q, pi: greedy(Q, this.mdp.A), converged: false };
  }

  get stale() {
    return this.scores?.updates !== this.knowledge.learner.updates;
  }

  /** Score the policy of the table for a while; return whether there is more to do. */
  score(milliseconds) {
    if (!this.solved && this.solve(milliseconds)) return true;
    if (this.#job === null && this.stale) this.#begin();
    if (this.#job === null) return false;
    if (this.#job.slices.run(milliseconds)) return true;
    const { slices, pi, updates } = this.#job;
    this.scores = Object.freeze({ ...slices.value, updates });
    this.pi = pi;
    this.#job = null;
    return false;
  }

  #begin() {
    const pi = this.knowledge.policy();
    const { updates } = this.knowledge.learner;
    if (this.pi?.every((a, s) => a === pi[s])) this.scores = Object.freeze({ ...this.scores, updates });
    else this.#job = { slices: new Slices(scoring(this.mdp, pi, this.best, this.maxSteps)), pi, updates };
  }
}
