/**
 * Prediction from experience: what an episode of `rollout` teaches about the values of the policy that has driven it.
 * Mirrors the boxes of rlnav/estimation.py; the table V [S] is changed in place.
 */
import { instance, number, numbers } from "./check.js";
import { MDP } from "./mdp.js";

/** Learn from an episode by TD(0), eq-td: after each step, towards what it paid and led to. */
export function tdPrediction(mdp, V, { states, rewards }, alpha = 0.1) {
  check(mdp, V, alpha);
  for (let t = 0; t < rewards.length; t++) {
    const [s, next] = [states[t], states[t + 1]];
    const gamma = mdp.terminal[next] ? 0 : mdp.gamma; // nothing follows an end
    V[s] += alpha * (rewards[t] + gamma * V[next] - V[s]);
  }
}

/**
 * Learn from an episode by Monte Carlo, eq-mc-prediction: every visit, towards its return, the last one first.
 * An episode that ran out of steps has no return yet: the value of the last state stands for the rest.
 */
export function mcPrediction(mdp, V, { states, rewards }, alpha = 0.1) {
  check(mdp, V, alpha);
  const last = states[rewards.length];
  let G = mdp.terminal[last] ? 0 : V[last];
  for (let t = rewards.length - 1; t >= 0; t--) {
    G = rewards[t] + mdp.gamma * G;
    V[states[t]] += alpha * (G - V[states[t]]);
  }
}

function check(mdp, V, alpha) {
  numbers("V", V, instance("mdp", mdp, MDP).S, "one value a state");
  number("alpha", alpha, 0, 1, { above: true });
}
