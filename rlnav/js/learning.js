/**
 * Learning control: a table Q[z, a] from experience alone, one step at a time and back again.
 * Mirrors rlnav/learning.py, rlnav/montecarlo.py and rlnav/_training.py; an algorithm is a function of algorithms.js.
 *
 * An episode draws three uniform numbers to begin (start, explore?, which action) and three in each step (explore?,
 * which action or which of the tied best, which successor; Double Q-learning a fourth: which table), whatever happens.
 * The same seed gives the same bits as in Python.
 */
import { doubleQLearning, monteCarlo } from "./algorithms.js";
import { callable, fail, instance, integer, integers, MOST_STEPS, number, numbers } from "./check.js";
import { greedy, MDP } from "./mdp.js";
import { generator } from "./rng.js";
import { drawAction, drawStart, drawSuccessor } from "./sampling.js";

const MOST_EPISODES = 10_000_000;
const MOST_ENTRIES = 50_000_000; // of a table: 400 MB
const CLOSE = 1024; // steps between two checkpoints, at least
const KEPT = 4; // checkpoints at each spacing
const NOWHERE = { s: -1, a: -1, r: NaN, gamma: NaN, sNext: -1, aNext: -1, z: -1, zNext: -1, coin: NaN, table: 0 };
const NOTHING = { next: NaN, target: NaN, tdError: NaN, before: NaN, after: NaN };
const NO_STEP = Object.freeze({ ...NOWHERE, ...NOTHING });

/**
 * Learn step by step, as the page asks for it.
 *
 * `Q` is the table [Z * A], `visits` counts how often each entry was tried, and `last` describes the last step:
 * s, a, r, sNext, aNext, the rows z and zNext, gamma (0 at an end), the value `next` of what follows, target, tdError,
 * and the entry before and after. `returns`, `steps` and `stops` hold the return, the length and the last state of each
 * episode that is over, `tdErrors` the mean size of its TD errors and `coverage` how many entries had been visited by
 * then; there are `episode` of them.  The robot stays at `s`, where an episode ended, until the next step begins
 * another; `way` holds the states of the episode so far.
 */
export class Learner {
  #checkpoints = [];

  constructor(mdp, phi, algorithm, options = {}) {
    const { episodes, alpha = 0.1, epsilon = 0.1, maxSteps = 200, rng = null, Q0 = 0 } = options;
    this.mdp = instance("mdp", mdp, MDP);
    this.phi = phi === null ? Int32Array.from({ length: mdp.S }, (_, s) => s) : checkPhi(mdp, phi);
    this.algorithm = callable("algorithm", algorithm, "algorithm(learner, last)");
    this.episodes = integer("episodes", episodes, 1, MOST_EPISODES);
    this.alpha = schedule("alpha", alpha, episodes, { above: true });
    this.epsilon = schedule("epsilon", epsilon, episodes);
    this.maxSteps = integer("maxSteps", maxSteps, 1, MOST_STEPS);
    this.rng = generator(rng);
    this.A = mdp.A;
    this.Q = initialTable(Q0, this.phi.reduce((most, z) => Math.max(most, z), 0) + 1, mdp.A);
    this.tables = algorithm === doubleQLearning ? [this.Q.slice(), this.Q.slice()] : []; // of which Q is the mean
    this.visits = new Uint32Array(this.Q.length);
    this.covered = 0; // entries that have been visited
    this.updates = 0; // steps so far, in all episodes
    this.episode = 0; // episodes that are over
    this.returns = new Float64Array(episodes);
    this.steps = new Int32Array(episodes);
    this.stops = new Int32Array(episodes);
    this.tdErrors = new Float64Array(episodes);
    this.coverage = new Uint32Array(episodes);
    const room = algorithm === monteCarlo ? this.maxSteps : 0;
    this.path = { visits: new Uint32Array(room), rewards: new Float64Array(room) };
    this.way = new Int32Array(this.maxSteps + 1); // states of this episode: way[0] ... way[t]
    this.last = { ...NO_STEP };
    this.#begin();
    this.#keep();
  }

  /** Whether all episodes are over. */
  get done() {
    return this.episode === this.episodes;
  }

  /** Take one step and learn from it; return whether there was one left to take. */
  step() {
    if (this.done) return false;
    if (this.over) this.#begin();
    const { mdp, phi, rng, last, A, Q } = this;
    const explore = rng.random();
    const which = rng.random();
    const place = drawSuccessor(mdp, this.s, this.a, rng.random());
    last.coin = this.tables.length ? rng.random() : 0;
    last.s = this.s;
    last.a = this.a;
    last.r = mdp.reward[place];
    last.sNext = mdp.nextState[place];
    last.gamma = mdp.terminal[last.sNext] ? 0 : mdp.gamma; // nothing follows an end
    last.z = phi[last.s];
    last.zNext = phi[last.sNext];
    last.aNext = drawAction(Q, last.zNext, A, this.epsilonNow, explore, which);
    this.t += 1;
    this.over = mdp.terminal[last.sNext] === 1 || this.t === this.maxSteps;
    this.G += this.discount * last.r;
    this.discount *= mdp.gamma;
    this.algorithm(this, last);
    if (this.visits[last.z * A + last.a]++ === 0) this.covered += 1;
    this.s = last.sNext;
    this.way[this.t] = this.s;
    this.a = last.aNext;
    if (this.over) this.#record();
    this.updates += 1;
    if (this.updates % this.#spacing === 0) this.#keep();
    return true;
  }

  /** Take up to `n` steps; return how many there were left to take. */
  run(n = Infinity) {
    let taken = 0;
    while (taken < n && this.step()) taken += 1;
    return taken;
  }

  /** Take steps for so long, so that a page can draw in between; return how many. */
  runFor(milliseconds) {
    const end = performance.now() + number("milliseconds", milliseconds, 0);
    let taken = this.run(64);
    while (performance.now() < end && !this.done) taken += this.run(64);
    return taken;
  }

  /** Go to the moment after `n` steps: forward by taking them, back by taking them again from a checkpoint. */
  seek(n) {
    integer("n", n, 0);
    if (n < this.updates) {
      while (this.#checkpoints.length > 1 && this.#checkpoints.at(-1).updates >= n) this.#checkpoints.pop();
      this.#restore(this.#checkpoints.at(-1));
    }
    if (n === 0) Object.assign(this.last, NO_STEP);
    this.run(n - this.updates);
  }

  /** Take back the last `k` steps. */
  back(k = 1) {
    this.seek(Math.max(0, this.updates - integer("k", k, 0)));
  }

  /** Allow more episodes, learned with the step size and exploration of the last one that was allowed before. */
  extend(episodes) {
    integer("episodes", episodes, this.episodes, MOST_EPISODES);
    const longer = (array, rest) => {
      const grown = new array.constructor(episodes).fill(rest);
      grown.set(array);
      return grown;
    };
    for (const name of ["alpha", "epsilon"]) this[name] = longer(this[name], this[name].at(-1));
    for (const name of ["returns", "steps", "stops", "tdErrors", "coverage"]) this[name] = longer(this[name], 0);
    this.episodes = episodes;
  }

  /** Return what was learned in the episodes that are over, with the names that Python uses. */
  training() {
    const { Q, A, mdp, episode } = this;
    const flagsOf = (flags) => Uint8Array.from(this.stops.subarray(0, episode), (s) => flags[s]);
    return {
      Q: Q.slice(),
      pi: greedy(Q, A),
      returns: this.returns.slice(0, episode),
      steps: this.steps.slice(0, episode),
      terminated: flagsOf(mdp.terminal),
      success: flagsOf(mdp.goal),
    };
  }

  #begin() {
    const { mdp, phi, rng, Q, A, episode } = this;
    this.alphaNow = this.alpha[episode];
    this.epsilonNow = this.epsilon[episode];
    this.s = drawStart(mdp, rng.random());
    this.a = drawAction(Q, phi[this.s], A, this.epsilonNow, rng.random(), rng.random());
    this.t = 0;
    this.way[0] = this.s;
    this.G = 0; // the return so far
    this.discount = 1;
    this.surprise = 0; // the sizes of the TD errors so far, summed up
    this.over = false;
  }

  #record() {
    this.returns[this.episode] = this.G;
    this.steps[this.episode] = this.t;
    this.stops[this.episode] = this.s;
    this.tdErrors[this.episode] = this.surprise / this.t;
    this.coverage[this.episode] = this.covered;
    this.episode += 1;
  }

  /** Steps between two checkpoints: the larger the table, the more it costs to copy. */
  get #spacing() {
    return Math.max(CLOSE, this.Q.length >> 2);
  }

  /** Remember this moment, and forget old ones: the older, the wider their spacing, so that few are kept. */
  #keep() {
    const { updates, episode, covered, s, a, t, G, discount, surprise, over, alphaNow, epsilonNow } = this;
    const path = { visits: this.path.visits.slice(0, t), rewards: this.path.rewards.slice(0, t) };
    const way = this.way.slice(0, t + 1);
    const values = { updates, episode, covered, s, a, t, G, discount, surprise, over, alphaNow, epsilonNow };
    const arrays = [this.rng.state, this.Q, this.visits, ...this.tables].map((array) => array.slice());
    this.#checkpoints.push({ updates, values, arrays, path, way });
    const age = (kept) => (updates - kept.updates) / this.#spacing;
    const roundness = (kept) => largestPowerOfTwo(kept.updates / this.#spacing);
    this.#checkpoints = this.#checkpoints.filter((kept) => age(kept) <= KEPT * roundness(kept));
  }

  #restore({ values, arrays, path, way }) {
    Object.assign(this, values);
    [this.rng.state, this.Q, this.visits, ...this.tables].forEach((array, i) => array.set(arrays[i]));
    this.path.visits.set(path.visits);
    this.path.rewards.set(path.rewards);
    this.way.set(way);
  }
}

/** Learn in one go; the result has the names of Python's Training. */
export function train(mdp, phi, algorithm, options) {
  const learner = new Learner(mdp, phi, algorithm, options);
  learner.run();
  return learner.training();
}

/** The largest power of two that divides a whole number; all of them divide 0. */
function largestPowerOfTwo(n) {
  if (n === 0) return Infinity;
  let power = 1;
  while (n % (2 * power) === 0) power *= 2;
  return power;
}

function checkPhi(mdp, phi) {
  return integers("phi", phi, mdp.S, "one row for each state", 0, MOST_ENTRIES);
}

function schedule(name, value, episodes, { above = false } = {}) {
  if (typeof value !== "object") return new Float64Array(episodes).fill(number(name, value, 0, 1, { above }));
  const values = numbers(name, value, episodes, "one number, or one for each episode");
  values.forEach((x, e) => number(`${name}[${e}]`, x, 0, 1, { above }));
  return values;
}

function initialTable(Q0, Z, A) {
  if (Z * A > MOST_ENTRIES) {
    fail("phi", `the design of a table of at most ${MOST_ENTRIES} numbers`, `${Z} rows of ${A}`);
  }
  if (typeof Q0 !== "object") return new Float64Array(Z * A).fill(number("Q0", Q0));
  return numbers("Q0", Q0, Z * A, "one number, or an initial table");
}
