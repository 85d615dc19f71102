/**
 * The steering bandit: one pose, a few turns, each pays with noise; strategies that play it, and what they lose.
 *
 * As an MDP it has one state and an end behind every turn. A pull is an episode of one step, and draws what such an
 * episode draws in Python (start, explore?, which; explore?, which, successor), so that a strategy of the library makes
 * the same choices here. Whatever a strategy chooses, every pull draws the same numbers: all play on the same luck.
 */
import { number } from "../check.js";
import { MDP } from "../mdp.js";
import { Generator } from "../rng.js";
import { drawAction, drawSuccessor } from "../sampling.js";

const ODDS = [1, 4, 6, 4, 1].map((n) => n / 16); // of the noise -2, -1, 0, 1 and 2 standard deviations
const DRAWS = 6; // numbers that an episode of one step draws
const CONFIDENT = 1.96; // standard errors that hold the truth in 95 of 100 cases

/** A one-step world: turn a pays values[a] plus noise, and then all is over. */
export class Bandit {
  constructor(values, noise) {
    this.values = Array.from(values);
    this.noise = number("noise", noise, 0);
    this.A = this.values.length;
    this.best = Math.max(...this.values);
    const K = ODDS.length;
    const pays = this.values.flatMap((value) => ODDS.map((_, k) => value + this.noise * (k - 2)));
    this.mdp = new MDP({
      S: 2, A: this.A, K, nextState: new Int32Array(2 * this.A * K).fill(1), terminal: [0, 1], start: [0], gamma: 1,
      prob: Float64Array.from({ length: 2 * this.A * K }, (_, j) => ODDS[j % K]),
      reward: Float64Array.from({ length: 2 * this.A * K }, (_, j) => pays[j] ?? 0),
    });
  }

  /** What turn a pays, by chance v. */
  pay(a, v) {
    return this.mdp.reward[drawSuccessor(this.mdp, 0, a, v)];
  }

  /** What is lost on average by choosing a instead of the best turn. */
  regret(a) {
    return this.best - this.values[a];
  }
}

/** The luck of so many pulls: three numbers for each, explore? which? and what it pays. */
export function luckOf(seed, pulls) {
  const rng = new Generator(seed);
  const luck = new Float64Array(3 * pulls);
  for (let t = 0; t < pulls; t++) {
    const drawn = Array.from({ length: DRAWS }, () => rng.random());
    luck.set([drawn[1], drawn[2], drawn[5]], 3 * t);
  }
  return luck;
}

/** The strategies: `choose(memory, parameter, u, w)` of a memory { Q, N, t, A }; `parameter` names its number. */
export const STRATEGIES = Object.freeze({
  greedy: { name: "Greedy", parameter: "Q0", choose: ({ Q, A }, _, u, w) => drawAction(Q, 0, A, 0, u, w) },
  epsilon: { name: "ε-greedy", parameter: "epsilon", choose: ({ Q, A }, e, u, w) => drawAction(Q, 0, A, e, u, w) },
  softmax: { name: "Softmax", parameter: "tau", choose: softmax },
  ucb: { name: "UCB", parameter: "c", choose: upperBound },
});

/** eq-softmax: chances in proportion to exp(Q / tau). */
function softmax({ Q, A }, tau, _, w) {
  const most = Math.max(...Q);
  const weights = Array.from(Q, (q) => Math.exp((q - most) / tau));
  let left = w * weights.reduce((sum, x) => sum + x, 0);
  for (let a = 0; a < A; a++) {
    left -= weights[a];
    if (left < 0) return a;
  }
  return Q.indexOf(most); // w lay in the gap that rounding leaves
}

/** eq-ucb: the largest of what a turn may be worth; one that was never tried may be worth anything. */
function upperBound({ Q, N, t, A }, c, _, w) {
  const bounds = Q.map((q, a) => (N[a] ? q + c * Math.sqrt(Math.log(t + 1) / N[a]) : Infinity));
  return drawAction(bounds, 0, A, 0, 1, w);
}

/** Let a strategy play on a luck: { chosen, Q, N }; `alpha` null averages, with the step size 1 / N. */
export function play(bandit, { choose, parameter }, settings, luck, pulls) {
  const { alpha, Q0 } = settings;
  const first = parameter === "Q0" ? Q0 : 0;
  const { A } = bandit;
  const memory = { Q: new Float64Array(A).fill(first), N: new Uint32Array(A), t: 0, A };
  const { Q, N } = memory;
  const chosen = new Uint8Array(pulls);
  for (let t = 0; t < pulls; t++) {
    memory.t = t;
    const a = choose(memory, settings[parameter], luck[3 * t], luck[3 * t + 1]);
    const r = bandit.pay(a, luck[3 * t + 2]);
    N[a] += 1;
    Q[a] += (alpha ?? 1 / N[a]) * (r - Q[a]);
    chosen[t] = a;
  }
  return { chosen, Q, N };
}

/** What choices by hand have shown: for each turn how often, the mean, and how far it may be from the truth. */
export function seen(bandit, turns, luck) {
  const rewards = Array.from(turns, (a, t) => bandit.pay(a, luck[3 * t + 2]));
  const arms = bandit.values.map((value, a) => {
    const own = rewards.filter((_, t) => turns[t] === a);
    const n = own.length;
    const mean = n ? own.reduce((sum, r) => sum + r, 0) / n : NaN;
    return { value, n, mean, off: n ? (CONFIDENT * bandit.noise) / Math.sqrt(n) : NaN };
  });
  return { rewards, arms, regret: summedUp(bandit, turns) };
}

/** The regret after every choice, eq-regret. */
export function summedUp(bandit, chosen) {
  let sum = 0;
  return Float64Array.from(chosen, (a) => (sum += bandit.regret(a)));
}

/** Many robots that play the same strategies, robot i of each on the luck of seed i; a few at a time. */
export class Crowd {
  constructor(bandit, names, settings, { robots, pulls }) {
    Object.assign(this, { bandit, settings, robots, pulls, done: 0 });
    const empty = () => ({ sum: new Float64Array(pulls), squares: new Float64Array(pulls), best: 0 });
    this.rows = names.map((name) => ({ name, strategy: STRATEGIES[name], ...empty() }));
  }

  /** Let the next robots play for so long; return whether there are more. */
  runFor(milliseconds) {
    const end = performance.now() + milliseconds;
    while (this.rows.length && this.done < this.robots) {
      this.#next();
      if (performance.now() > end) break;
    }
    return this.rows.length > 0 && this.done < this.robots;
  }

  #next() {
    const { bandit, settings, pulls } = this;
    const luck = luckOf(this.done, pulls);
    for (const row of this.rows) {
      const { chosen } = play(bandit, row.strategy, settings, luck, pulls);
      summedUp(bandit, chosen).forEach((regret, t) => {
        row.sum[t] += regret;
        row.squares[t] += regret * regret;
      });
      row.best += bandit.regret(chosen[pulls - 1]) === 0 ? 1 : 0;
    }
    this.done += 1;
  }

  /** The mean regret of a row after every pull, and the half width of its confidence band. */
  curve({ sum, squares }) {
    const n = this.done;
    const mean = sum.map((x) => x / n);
    const off = squares.map((x, t) => {
      const variance = Math.max(0, x / n - mean[t] * mean[t]) * (n / Math.max(n - 1, 1));
      return CONFIDENT * Math.sqrt(variance / n);
    });
    return { mean, off };
  }
}

/** Poses at which the choice is worth a game: every turn counts, none is hopeless. */
export function games(mdp, Q) {
  const all = Array.from({ length: mdp.S }, (_, s) => s).filter((s) => !mdp.terminal[s]);
  const good = all.filter((s) => {
    const [first, second, ...rest] = Array.from(Q.subarray(s * mdp.A, (s + 1) * mdp.A)).sort((a, b) => b - a);
    const spread = first - (rest.at(-1) ?? second);
    return first - second > 0.25 && spread > 1 && spread < 5;
  });
  return good.length ? good : all;
}
