/**
 * The line in which the learners differ.  Mirrors the boxes of rlnav/learning.py and rlnav/montecarlo.py; the loop
 * around it is in learning.js.
 *
 * Each algorithm is a function of the learner and its last step (z, a, r, gamma, zNext, aNext, ...), where gamma is 0
 * if the episode is over.  It changes the table and writes down what it did: target, tdError, before, after.
 */
import { expected, firstBest, largest } from "./sampling.js";

/** Learn off-policy, towards the best next action (eq-q-learning). */
export function qLearning({ Q, A, alphaNow }, last) {
  moveTowards(Q, last.z * A + last.a, last.r + last.gamma * largest(Q, last.zNext, A), alphaNow, last);
}

/** Learn on-policy, towards the action that is really taken next (eq-sarsa). */
export function sarsa({ Q, A, alphaNow }, last) {
  moveTowards(Q, last.z * A + last.a, last.r + last.gamma * Q[last.zNext * A + last.aNext], alphaNow, last);
}

/** Learn towards the mean over the next actions (eq-expected-sarsa). */
export function expectedSarsa({ Q, A, alphaNow, epsilonNow }, last) {
  const next = expected(Q, last.zNext, A, epsilonNow);
  moveTowards(Q, last.z * A + last.a, last.r + last.gamma * next, alphaNow, last);
}

/** Learn two tables: one chooses the best next action, the other values it (eq-double-q); a coin says which learns. */
export function doubleQLearning({ Q, A, alphaNow, tables }, last) {
  const i = last.z * A + last.a;
  last.table = last.coin < 0.5 ? 0 : 1;
  const own = tables[last.table];
  const other = tables[1 - last.table];
  const next = other[last.zNext * A + firstBest(own, last.zNext, A)];
  moveTowards(own, i, last.r + last.gamma * next, alphaNow, last);
  Q[i] = 0.5 * (tables[0][i] + tables[1][i]); // what the robot acts on
}

/**
 * Wait for the end, then learn every visit's return, backwards (eq-monte-carlo).
 * An episode that ran out of steps has no return yet: the value of the last state and action stands for the rest.
 */
export function monteCarlo(learner, last) {
  const { Q, A, alphaNow, path, t, mdp } = learner;
  path.visits[t - 1] = last.z * A + last.a;
  path.rewards[t - 1] = last.r;
  nothingLearned(last);
  if (!learner.over) return;
  let G = mdp.terminal[last.sNext] ? 0 : Q[last.zNext * A + last.aNext];
  let played = 0;
  for (let i = t - 1; i >= 0; i--) {
    G = path.rewards[i] + mdp.gamma * G;
    played = path.rewards[i] + mdp.gamma * played;
    if (i === t - 1) moveTowards(Q, path.visits[i], G, alphaNow, last); // the step that is shown
    else Q[path.visits[i]] += alphaNow * (G - Q[path.visits[i]]);
  }
  learner.G = played;
}

function moveTowards(table, i, target, alpha, last) {
  last.target = target;
  last.before = table[i];
  last.tdError = target - table[i];
  table[i] += alpha * last.tdError;
  last.after = table[i];
}

function nothingLearned(last) {
  last.target = last.before = last.after = last.tdError = NaN;
}
