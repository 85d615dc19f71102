/**
 * Value iteration sweep by sweep, with all that was before kept: how the news of the goal travels over the map.
 */
import { number } from "../check.js";
import { TIE } from "../mdp.js";
import { bestValues, solve } from "../planning.js";

const MOST_SWEEPS = 2000;
const MOST_VALUES = 5_000_000; // kept of all sweeps: 40 MB
const EXACT = 1e-12;
const FAR_OUT = 3; // quartile distances, as in rl.plot: Tukey's word for values that belong to another story

/**
 * Hold V_0 ... V_k of value iteration (eq-value-iteration) as far as it was run; `residuals[k]` is the largest change
 * in sweep k, and `steps[s]` the number of moves after which a robot in state s can be on the goal: the sweep in which
 * s hears of it, 0 for the goal, -1 as long as it has not.
 */
export class Wave {
  constructor(mdp, tol, star = null) {
    this.mdp = mdp;
    this.tol = number("tol", tol, 0, Infinity, { above: true });
    this.values = [new Float64Array(mdp.S)];
    this.residuals = [NaN];
    this.steps = Int32Array.from(mdp.goal, (goal) => (goal ? 0 : -1));
    this.heard = [0]; // states that have heard after each sweep
    this.limit = Math.min(MOST_SWEEPS, Math.floor(MOST_VALUES / mdp.S));
    this.star = star; // v*, where it is known already
  }

  /** The number of sweeps that were run. */
  get length() {
    return this.values.length - 1;
  }

  get converged() {
    return this.residuals.at(-1) <= this.tol;
  }

  get done() {
    return this.converged || this.length >= this.limit;
  }

  /** Do one sweep, unless the last one has changed next to nothing; return whether there is more to do. */
  sweep() {
    if (this.done) return false;
    const before = this.values.at(-1);
    const V = bestValues(this.mdp, before);
    this.values.push(V);
    this.residuals.push(V.reduce((most, v, s) => Math.max(most, Math.abs(v - before[s])), 0));
    this.heard.push(this.heard.at(-1) + this.#tellNeighbors(this.length));
    return !this.done;
  }

  /** Sweep until `k` sweeps are done or nothing is left to do; return how many of them there are. */
  run(k) {
    while (this.length < k && this.sweep());
    return Math.min(k, this.length);
  }

  /** Sweep for so many milliseconds; return whether there is more to do. */
  runFor(milliseconds) {
    const end = performance.now() + milliseconds;
    while (performance.now() < end) {
      if (!this.sweep()) return false;
    }
    return true;
  }

  /** Mark the states from which one move may lead to those that heard in sweep k - 1; return how many they are. */
  #tellNeighbors(k) {
    const { S, A, K, nextState, prob, terminal } = this.mdp;
    let news = 0;
    for (let s = 0; s < S; s++) {
      if (this.steps[s] >= 0 || terminal[s]) continue;
      for (let j = s * A * K; j < (s + 1) * A * K; j++) {
        if (this.steps[nextState[j]] !== k - 1 || prob[j] === 0) continue;
        this.steps[s] = k;
        news += 1;
        break;
      }
    }
    return news;
  }

  /** The exact values v*, as good as numbers are. */
  get best() {
    this.star ??= solve(this.mdp, { tol: EXACT }).V;
    return this.star;
  }

  /** How far V_k is from v* at most. */
  error(k) {
    const { best } = this;
    return this.values[k].reduce((most, v, s) => Math.max(most, Math.abs(v - best[s])), 0);
  }

  /** What the residual of sweep k promises: V_k is off by no more than gamma / (1 - gamma) times it. */
  promise(k) {
    return (this.mdp.gamma / (1 - this.mdp.gamma)) * this.residuals[k];
  }

  /** Look one step ahead from state s in sweep k: for each action mean reward, mean value that follows, their sum. */
  lookAhead(s, k) {
    const { A, K, nextState, prob, reward, gamma } = this.mdp;
    const V = this.values[k - 1];
    const rows = Array.from({ length: A }, (_, a) => {
      const row = { a, reward: 0, next: 0, sum: 0, sNext: nextState[(s * A + a) * K] };
      for (let j = (s * A + a) * K; j < (s * A + a + 1) * K; j++) {
        row.reward += prob[j] * reward[j];
        row.next += prob[j] * V[nextState[j]];
        row.sum += prob[j] * (reward[j] + gamma * V[nextState[j]]);
      }
      return row;
    });
    const most = Math.max(...rows.map((row) => row.sum));
    return rows.map((row) => ({ ...row, best: most - row.sum <= TIE }));
  }
}

/**
 * Choose a color scale for all moments on the way to these values, of states that are not terminal: as rl.plot does,
 * it holds all but those far below the others; and it holds 0, where all begin.
 */
export function scaleOf(values) {
  const { low, high } = limits(values);
  const scale = { low: Math.min(low, -0.2 * high), high: Math.max(high, 0) };
  return { ...scale, below: values.some((v) => v < scale.low) };
}

function limits(values) {
  const sorted = Float64Array.from(values).sort();
  const at = (share) => {
    const place = share * (sorted.length - 1);
    const i = Math.floor(place);
    return sorted[i] + (place - i) * ((sorted[i + 1] ?? sorted[i]) - sorted[i]);
  };
  const [lower, upper] = [at(0.25), at(0.75)];
  const low = upper > lower ? sorted.find((v) => v >= lower - FAR_OUT * (upper - lower)) : sorted[0];
  const high = sorted.at(-1);
  return low < high ? { low, high } : { low: low - 0.5, high: high + 0.5 };
}
