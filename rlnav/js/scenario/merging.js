/**
 * Two roads that merge: recorded drives, one after the other, and what Monte Carlo and TD(0) make of them. Either each
 * drive teaches once, with a step size, or all drives so far are learned again and again until nothing changes.
 */
import { integer, integers } from "../check.js";
import { mcPrediction, tdPrediction } from "../estimation.js";
import { MDP, underPolicy } from "../mdp.js";
import { evaluatePolicy } from "../prediction.js";
import { returns, rollout } from "../rollouts.js";

export const MOST_DRIVES = 60;

export class Merging {
  #drives = []; // { road, states, rewards, terminated }

  /** Drive in `mdp` by the probabilities `policy`; drive i is rollout(mdp, policy, start = road, rng = seed + i). */
  constructor(mdp, policy, { seed = 0, maxSteps = 200 } = {}) {
    Object.assign(this, { mdp, policy, seed: integer("seed", seed, 0), maxSteps });
    this.roads = Array.from(mdp.start);
    this.exact = evaluatePolicy(mdp, policy);
    this.states = reached(mdp, policy);
  }

  /** The drive number i, counted from 0, on a road. */
  drive(i, road) {
    if (this.#drives[i]?.road !== road) {
      const { mdp, policy, seed, maxSteps } = this;
      const episode = rollout(mdp, policy, { start: this.roads[road], maxSteps, rng: seed + i });
      this.#drives[i] = { road, ...episode, G: returns(episode.rewards, mdp.gamma)[0] ?? 0 };
    }
    return this.#drives[i];
  }

  /** Return what is known after each drive: [{ drive, mc, td, mcError, tdError }], the first before all of them. */
  learn(roads, { alpha, batch }) {
    integers("drives", roads, roads.length, "roads", 0, this.roads.length - 1);
    const drives = Array.from(roads, (road, i) => this.drive(i, road));
    const { mdp } = this;
    let [mc, td] = [new Float64Array(mdp.S), new Float64Array(mdp.S)];
    const moments = [this.#moment(null, mc, td)];
    drives.forEach((drive, i) => {
      [mc, td] = batch ? batchOf(mdp, drives.slice(0, i + 1)) : [mc.slice(), td.slice()];
      if (!batch) mcPrediction(mdp, mc, drive, alpha);
      if (!batch) tdPrediction(mdp, td, drive, alpha);
      moments.push(this.#moment(drive, mc, td));
    });
    return moments;
  }

  #moment(drive, mc, td) {
    return { drive, mc, td, mcError: this.errorOf(mc), tdError: this.errorOf(td) };
  }

  /** Root of the mean squared error over all poses that the policy comes to. */
  errorOf(V) {
    const squares = this.states.map((s) => (V[s] - this.exact[s]) * (V[s] - this.exact[s]));
    return Math.sqrt(squares.reduce((sum, x) => sum + x, 0) / squares.length);
  }
}

/** Return where learning from the same drives again and again with small steps comes to rest: [mc, td]. */
export function batchOf(mdp, drives) {
  return [meanReturns(mdp, drives), evaluatePolicy(...modelSeen(mdp, drives))];
}

/** Monte Carlo: the mean of all returns that followed a state. */
function meanReturns(mdp, drives) {
  const [sums, counts] = [new Float64Array(mdp.S), new Float64Array(mdp.S)];
  for (const { states, rewards } of drives) {
    returns(rewards, mdp.gamma).forEach((G, t) => {
      sums[states[t]] += G;
      counts[states[t]] += 1;
    });
  }
  return sums.map((sum, s) => (counts[s] ? sum / counts[s] : 0));
}

/** TD(0): the values in the model that has been seen, as if the shares of what happened were the probabilities. */
function modelSeen(mdp, drives) {
  const seen = Array.from({ length: mdp.S }, () => []); // { next, r, n } of every state
  for (const { states, rewards } of drives) {
    rewards.forEach((r, t) => {
      const same = seen[states[t]].find((one) => one.next === states[t + 1] && one.r === r);
      if (same) same.n += 1;
      else seen[states[t]].push({ next: states[t + 1], r, n: 1 });
    });
  }
  const K = Math.max(...seen.map((row) => row.length), 1);
  const nextState = Int32Array.from({ length: mdp.S * K }, (_, i) => Math.floor(i / K));
  const [prob, reward] = [new Float64Array(mdp.S * K), new Float64Array(mdp.S * K)];
  seen.forEach((row, s) => {
    const total = row.reduce((sum, { n }) => sum + n, 0);
    row.forEach(({ next, r, n }, k) => {
      [nextState[s * K + k], prob[s * K + k], reward[s * K + k]] = [next, n / total, r];
    });
    if (!row.length) prob[s * K] = 1; // where nothing was seen, nothing follows
  });
  const terminal = Uint8Array.from(seen, (row) => (row.length ? 0 : 1));
  const start = [drives[0].states[0]];
  const model = new MDP({ ...mdp, A: 1, K, nextState, prob, reward, terminal, goal: terminal, start });
  return [model, new Int32Array(mdp.S)];
}

/** List the states, ends left out, that a policy comes to from the starts. */
function reached(mdp, policy) {
  const { N, nextState, prob } = underPolicy(mdp, policy);
  const found = new Set(mdp.start);
  for (const s of found) {
    for (let j = s * N; j < (s + 1) * N; j++) if (prob[j] > 0 && !mdp.terminal[nextState[j]]) found.add(nextState[j]);
  }
  return [...found].sort((i, j) => i - j);
}
