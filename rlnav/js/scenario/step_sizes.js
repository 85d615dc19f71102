/**
 * Step sizes that change with the number of updates: their two sums, what these say, and Q-learning that uses them.
 */
import { qLearning } from "../algorithms.js";
import { integer, number } from "../check.js";
import { Learner } from "../learning.js";
import { MDP } from "../mdp.js";
import { solve } from "../planning.js";

const EXACT = 1e-12;

/** The step size of the n-th update, counted from 1, for settings { kind, c, p, until }. */
export function stepSize({ kind, c, p, until }, n) {
  if (kind === "constant") return c;
  if (kind === "linear") return Math.max(0, c * (1 - (n - 1) / until));
  if (kind === "halving") return halved(c, Math.floor((n - 1) / until));
  return c / powerOf(n, p);
}

/** n ** p; by plain arithmetic where that is possible, because the last bit of Math.pow differs between machines. */
function powerOf(n, p) {
  return p === 0.5 ? Math.sqrt(n) : p === 1 ? n : p === 2 ? n * n : n ** p;
}

function halved(value, times) {
  let half = value;
  for (let i = 0; i < times && half > 0; i++) half /= 2;
  return half;
}

/**
 * Return what the first n updates add up to: { alpha, first, second, weight }, lists of the step sizes, both partial
 * sums, and the share of the very first target in the estimate.
 */
export function sumsOf(settings, n) {
  const lists = { alpha: [], first: [], second: [], weight: [] };
  let [first, second, weight] = [0, 0, 0];
  for (let k = 1; k <= n; k++) {
    const alpha = stepSize(settings, k);
    first += alpha;
    second += alpha * alpha;
    weight = k === 1 ? alpha : weight * (1 - alpha);
    for (const [name, value] of Object.entries({ alpha, first, second, weight })) lists[name].push(value);
  }
  return lists;
}

/** Judge both conditions by analysis, not by sums that end: { first, second }, whether each holds. */
export function verdictOf({ kind, p }) {
  if (kind === "constant") return { first: true, second: false };
  if (kind === "power") return { first: p <= 1, second: 2 * p > 1 };
  return { first: false, second: true }; // the steps become 0, or halve and halve: both sums end
}

/** One action with its outcomes, and what follows them exactly, as a problem of its own: one noisy entry to learn. */
export function entryOf(mdp, s, a) {
  const { V, Q } = solve(mdp, { tol: EXACT });
  const { K, A, nextState, prob, reward, gamma } = mdp;
  const i = (integer("s", s, 0, mdp.S - 1) * A + integer("a", a, 0, A - 1)) * K;
  const targets = Array.from({ length: K }, (_, k) => reward[i + k] + gamma * V[nextState[i + k]]);
  const chances = Array.from(prob.subarray(i, i + K));
  const entry = new MDP({
    S: 2, A: 1, K, gamma, terminal: [0, 1], start: [0],
    nextState: Array(2 * K).fill(1),
    prob: [...chances, 1, ...Array(K - 1).fill(0)],
    reward: [...targets, ...Array(K).fill(0)],
  });
  const noise = Math.sqrt(targets.reduce((sum, x, k) => sum + chances[k] * (x - Q[s * A + a]) ** 2, 0));
  return { mdp: entry, exact: Q[s * A + a], noise, targets };
}

/**
 * Several runs of Q-learning, all actions at random, each entry with its own count. `measure(Q)` is noted after every
 * `every` steps, `points` times.
 */
export class Study {
  constructor(mdp, settings, { seeds, seed, every, points, measure }) {
    number("c", settings.c, 0, 1, { above: true });
    Object.assign(this, { every, points, measure });
    const options = { episodes: points, alpha: 1, epsilon: 1 };
    const learn = counted(settings);
    this.learners = Array.from({ length: seeds }, (_, i) => new Learner(mdp, null, learn, { ...options, rng: seed + i }));
    this.curves = this.learners.map(({ Q }) => [measure(Q)]);
  }

  /** How many points all runs have, without the one at the beginning. */
  get ready() {
    return this.curves.at(-1).length - 1;
  }

  get done() {
    return this.ready === this.points;
  }

  /** Learn up to the next point in every run. */
  advance() {
    this.learners.forEach((learner, i) => {
      for (let left = this.every; left > 0; ) {
        if (learner.done) learner.extend(2 * learner.episodes);
        left -= learner.run(left);
      }
      this.curves[i].push(this.measure(learner.Q));
    });
  }

  /** Work for so long; return whether there is more to do. */
  runFor(milliseconds) {
    const end = performance.now() + milliseconds;
    while (!this.done && performance.now() < end) this.advance();
    return !this.done;
  }
}

/** Q-learning in which every entry counts its own updates; the count begins with 1, before it is used. */
function counted(settings) {
  const sizes = [NaN];
  return (learner, last) => {
    const n = learner.visits[last.z * learner.A + last.a] + 1;
    while (sizes.length <= n) sizes.push(stepSize(settings, sizes.length));
    learner.alphaNow = sizes[n];
    qLearning(learner, last);
  };
}
