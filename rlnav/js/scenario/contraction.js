/**
 * Two guesses that are backed up together, with all that was before kept: how far apart they are, and what the factor
 * gamma promises (chapter 6). A backup is that of the Bellman equations: with the maximum, or with a policy's mean.
 */
import { actionValues, TIE } from "../mdp.js";
import { bestValues } from "../planning.js";
import { generator } from "../rng.js";
import { valuesOf } from "./backup.js";

export const REACH = 20; // how high and how low a guess may be
const MOST_BACKUPS = 300;
const AGREED = 1e-9; // as good as equal

/** Make a guess: "zeros", "high", "low", "random", or the "answer" itself; ended episodes are worth 0 in each. */
export function guessOf(name, mdp, pi, seed) {
  if (name === "answer") return valuesOf(mdp, pi).V;
  const luck = generator(seed);
  const guess = { zeros: () => 0, high: () => REACH, low: () => -REACH, random: () => REACH * (2 * luck.random() - 1) };
  const V = Float64Array.from({ length: mdp.S }, guess[name]); // one number a state, whatever the map
  return V.map((value, s) => (mdp.terminal[s] ? 0 : value));
}

/** Apply the right side of a Bellman equation to all states: with `pi` null the maximum, else the mean under `pi`. */
export function backedUpAll(mdp, pi, V) {
  if (pi === null) return bestValues(mdp, V);
  const Q = actionValues(mdp, V);
  return Float64Array.from({ length: mdp.S }, (_, s) => meanOf(Q, pi, s, mdp.A));
}

function meanOf(Q, pi, s, A) {
  let mean = 0;
  for (let i = s * A; i < (s + 1) * A; i++) mean += pi[i] * Q[i];
  return mean;
}

/** Hold V_0 ... V_k and W_0 ... W_k as far as they were run; for each k, how far apart they are at most, and where. */
export class Pair {
  constructor(mdp, pi, V, W) {
    Object.assign(this, { mdp, pi, V: [V], W: [W], distances: [], places: [], bounds: [] });
    this.measure();
  }

  /** The number of backups that were run. */
  get length() {
    return this.V.length - 1;
  }

  get agreed() {
    return this.distances.at(-1) <= AGREED;
  }

  get done() {
    return this.agreed || this.length >= MOST_BACKUPS;
  }

  /** Note the largest difference, where it is, and the bound: gamma for each backup, times the first difference. */
  measure() {
    const [V, W] = [this.V.at(-1), this.W.at(-1)];
    let place = 0;
    for (let s = 1; s < V.length; s++) if (Math.abs(V[s] - W[s]) > Math.abs(V[place] - W[place])) place = s;
    const distance = Math.abs(V[place] - W[place]);
    this.distances.push(distance);
    this.places.push(place);
    this.bounds.push(this.bounds.length ? this.bounds.at(-1) * this.mdp.gamma : distance);
  }

  /** Back both up until `k` backups are done or they agree; return how many of them there are. */
  run(k) {
    while (this.length < k && !this.done) {
      this.V.push(backedUpAll(this.mdp, this.pi, this.V.at(-1)));
      this.W.push(backedUpAll(this.mdp, this.pi, this.W.at(-1)));
      this.measure();
    }
    return Math.min(k, this.length);
  }

  /** Backup k at state s, for both: { a, probability, v, w, bestV, bestW } for each action. */
  rowsAt(s, k) {
    const { mdp, pi } = this;
    const rowOf = (V) => actionValues(mdp, V).subarray(s * mdp.A, (s + 1) * mdp.A);
    const [v, w] = [rowOf(this.V[k - 1]), rowOf(this.W[k - 1])];
    const isBest = (row, a) => pi === null && Math.max(...row) - row[a] <= TIE;
    return Array.from({ length: mdp.A }, (_, a) => ({
      a, probability: pi && pi[s * mdp.A + a], v: v[a], w: w[a], bestV: isBest(v, a), bestW: isBest(w, a),
    }));
  }
}
