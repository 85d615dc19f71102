/**
 * A finite Markov decision process as arrays, and the look-ahead on which everything rests (eq-q-from-v):
 *
 *     Q[s, a] = sum_k prob[s, a, k] * (reward[s, a, k] + gamma * V[nextState[s, a, k]])
 *
 * Mirrors rlnav/mdp.py.  Arrays [S, A, K] lie flat: the entry of s, a, k is at (s * A + a) * K + k.
 */
import { fail, instance, integer, integers, items, number, numbers } from "./check.js";

export const TIE = 1e-9; // actions whose values differ by less are equally good when a policy is read off
const SUM = 1e-9; // how far the probabilities of one (s, a) may be from summing to one

/** Hold the model p(s', r | s, a) as successor arrays (eq-dynamics), checked once; terminal states are self-loops. */
export class MDP {
  constructor({ S, A, K, nextState, prob, reward, gamma, terminal, start, goal = terminal }) {
    this.S = integer("S", S, 1);
    this.A = integer("A", A, 1);
    this.K = integer("K", K, 1);
    this.nextState = integers("nextState", nextState, S * A * K, "states", 0, S - 1);
    this.prob = numbers("prob", prob, S * A * K, "probabilities");
    this.reward = numbers("reward", reward, S * A * K, "rewards");
    this.gamma = number("gamma", gamma, 0, 1);
    this.terminal = flags("terminal", terminal, S);
    this.start = integers("start", start, start?.length, "states", 0, S - 1);
    this.goal = flags("goal", goal, S);
    this.#checkDistributions();
    this.#checkEnds();
    Object.freeze(this);
  }

  #checkDistributions() {
    const { A, K, prob } = this;
    for (let row = 0; row < prob.length; row += K) {
      let sum = 0;
      for (let i = row; i < row + K; i++) {
        if (prob[i] < 0) fail("prob", "probabilities of at least 0", `${prob[i]} at ${place(i, A, K)}`);
        sum += prob[i];
      }
      if (Math.abs(sum - 1) > SUM) {
        const at = `s=${Math.floor(row / K / A)}, a=${(row / K) % A}`;
        fail("prob", "probabilities that sum to 1", `the sum ${sum} at ${at}`);
      }
    }
  }

  #checkEnds() {
    const { A, K, nextState, prob, reward, terminal, start, goal } = this;
    for (let i = 0; i < prob.length; i++) {
      const s = Math.floor(i / (A * K));
      if (!terminal[s]) continue;
      if (nextState[i] !== s && prob[i] > 0) {
        const got = `a way out to state ${nextState[i]} at ${place(i, A, K)}`;
        fail("terminal", "states that lead only to themselves", got, "Let nextState[s] = s there.");
      }
      if (reward[i] !== 0) {
        const got = `reward ${reward[i]} at ${place(i, A, K)}`;
        fail("terminal", "states without reward", got, "Pay on the step that enters the terminal state.");
      }
    }
    if (!start.length) fail("start", "at least one state", "none");
    const over = start.find((s) => terminal[s]);
    if (over !== undefined) fail("start", "states in which the episode is not over", `the terminal state ${over}`);
    const living = goal.findIndex((flag, s) => flag && !terminal[s]);
    if (living >= 0) fail("goal", "flags of terminal states only", `state ${living}, which is not terminal`);
  }
}

/** Look one step ahead from every state and action: Q [S * A]. */
export function actionValues(mdp, V) {
  const { S, A, K, nextState, prob, reward, gamma } = instance("mdp", mdp, MDP);
  const values = numbers("V", V, S, "one value a state");
  const Q = new Float64Array(S * A);
  for (let i = 0; i < Q.length; i++) {
    let q = 0;
    for (let j = i * K; j < (i + 1) * K; j++) q += prob[j] * (reward[j] + gamma * values[nextState[j]]);
    Q[i] = q;
  }
  return Q;
}

/** Choose the best action of every row of Q [Z * A] (eq-greedy); of equally good ones (within 1e-9) the first. */
export function greedy(Q, A) {
  integer("A", A, 1);
  const pi = new Int32Array(Q.length / A);
  for (let z = 0; z < pi.length; z++) {
    let best = -Infinity;
    for (let i = z * A; i < (z + 1) * A; i++) best = Math.max(best, Q[i]);
    while (best - Q[z * A + pi[z]] > TIE) pi[z]++;
  }
  return pi;
}

/** Give the probabilities pi(a | z) [Z * A] of the epsilon-greedy policy of a table. */
export function epsilonGreedy(Q, A, epsilon) {
  number("epsilon", epsilon, 0, 1);
  const pi = new Float64Array(Q.length).fill(epsilon / A);
  greedy(Q, A).forEach((a, z) => (pi[z * A + a] += 1 - epsilon));
  return pi;
}

/** Lift a policy over designed states back to the states of an MDP: Python's `pi[phi]`. */
export function lift(pi, phi) {
  const beyond = phi.findIndex((z) => !(z in pi));
  if (beyond >= 0) {
    const got = `row ${phi[beyond]} in state ${beyond}`;
    fail("phi", `rows of a policy with ${pi.length} rows`, got, "Take the features with which it was learned.");
  }
  return Int32Array.from(phi, (z) => pi[z]);
}

/** Check a policy: a Float64Array holds probabilities [S * A], any other array actions [S]. */
export function checkPolicy(mdp, pi) {
  const { S, A } = instance("mdp", mdp, MDP);
  if (!(pi instanceof Float64Array)) {
    const list = items("pi", pi, "one action a state");
    const advice = "A policy over designed states is lifted by `lift(pi, phi)`.";
    if (list.length !== S) fail("pi", `one action for each of the ${S} states`, `${list.length} actions`, advice);
    return integers("pi", list, S, "one action a state", 0, A - 1);
  }
  const chances = numbers("pi", pi, S * A, "probabilities");
  for (let s = 0; s < S; s++) {
    const row = chances.subarray(s * A, (s + 1) * A);
    const sum = row.reduce((before, p) => before + p, 0);
    if (row.some((p) => p < 0) || Math.abs(sum - 1) > SUM) {
      fail("pi", "a distribution over actions in every state", `[${row.join(", ")}] in state ${s}`);
    }
  }
  return chances;
}

/** Reduce the MDP to the Markov chain of a policy: N successors and probabilities [S * N], rewards [S]. */
export function underPolicy(mdp, pi) {
  const { S, A, K } = mdp;
  const policy = checkPolicy(mdp, pi);
  const mixed = policy instanceof Float64Array;
  const N = mixed ? A * K : K;
  const chain = { N, nextState: new Int32Array(S * N), prob: new Float64Array(S * N), r: new Float64Array(S) };
  for (let s = 0; s < S; s++) {
    for (let n = 0; n < N; n++) {
      const j = mixed ? s * N + n : (s * A + policy[s]) * K + n;
      const p = mixed ? policy[s * A + Math.floor(n / K)] * mdp.prob[j] : mdp.prob[j];
      chain.nextState[s * N + n] = mdp.nextState[j];
      chain.prob[s * N + n] = p;
      chain.r[s] += p * mdp.reward[j];
    }
  }
  return chain;
}

function flags(name, value, length) {
  const list = Array.from(value);
  if (list.length !== length) fail(name, `one flag a state, of shape (${length})`, `shape (${list.length})`);
  const odd = list.findIndex((flag) => ![0, 1, false, true].includes(flag));
  if (odd >= 0) fail(name, "one flag a state", `${list[odd]} in state ${odd}`, "", TypeError);
  return Uint8Array.from(list);
}

function place(i, A, K) {
  return `s=${Math.floor(i / K / A)}, a=${Math.floor(i / K) % A}, k=${i % K}`;
}
