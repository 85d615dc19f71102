/**
 * Episodes played by a fixed policy, and their returns (eq-return).  Mirrors rlnav/rollouts.py.
 */
import { instance, integer, items, MOST_STEPS, number } from "./check.js";
import { checkPolicy, MDP } from "./mdp.js";
import { generator } from "./rng.js";
import { drawStart, drawSuccessor } from "./sampling.js";

/**
 * Play one episode; the result is { states [T + 1], actions [T], rewards [T], terminated }.
 * Chance gives one number for the start, and two in each step: action, successor.
 */
export function rollout(mdp, pi, { start = null, maxSteps = 200, rng = null } = {}) {
  instance("mdp", mdp, MDP);
  const policy = checkPolicy(mdp, pi);
  integer("maxSteps", maxSteps, 1, MOST_STEPS);
  const chance = generator(rng);
  const u = chance.random();
  let s = start === null ? drawStart(mdp, u) : integer("start", start, 0, mdp.S - 1);
  const states = [s];
  const actions = [];
  const rewards = [];
  while (actions.length < maxSteps && !mdp.terminal[s]) {
    const a = drawFrom(policy, s, mdp.A, chance.random());
    const place = drawSuccessor(mdp, s, a, chance.random());
    s = mdp.nextState[place];
    states.push(s);
    actions.push(a);
    rewards.push(mdp.reward[place]);
  }
  return {
    states: Int32Array.from(states),
    actions: Int32Array.from(actions),
    rewards: Float64Array.from(rewards),
    terminated: mdp.terminal[s] === 1,
  };
}

/** Compute the return from every step of an episode, backwards. */
export function returns(rewards, gamma) {
  const G = Float64Array.from(items("rewards", rewards, "one reward a step"), (r) => number("rewards", r));
  number("gamma", gamma, 0, 1);
  for (let t = G.length - 2; t >= 0; t--) G[t] += gamma * G[t + 1];
  return G;
}

/** The action of a policy in state s, where `which` decides between probabilities. */
export function drawFrom(policy, s, A, which) {
  if (policy instanceof Int32Array) return policy[s];
  let sum = 0;
  let likely = 0; // the last action with a chance, should the sum end below `which` by rounding
  for (let a = 0; a < A; a++) {
    const p = policy[s * A + a];
    sum += p;
    if (p > 0) likely = a;
    if (which < sum) return a;
  }
  return likely;
}
