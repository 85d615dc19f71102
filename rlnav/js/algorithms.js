/**
 * The line in which the learners differ.  Mirrors the boxes of rlnav/learning.py and rlnav/montecarlo.py; the loop
 * around it is in learning.js.
 *
 * Each algorithm is a function of the learner and its last step (z, a, r, gamma, zNext, aNext, ...), where gamma is 0
 * if the episode is over.  It changes the table, adds to the episode's surprise, and writes down what it did: next (the
 * value of what follows), target, tdError, before, after.
 */
import { expected, firstBest, largest } from "./sampling.js";

/** Learn off-policy, towards the best next action (eq-q-learning). */
export function qLearning(learner, last) {
  const { Q, A } = learner;
  last.next = largest(Q, last.zNext, A);
  moveTowards(learner, Q, last.z * A + last.a, last.r + last.gamma * last.next, last);
}

/** Learn on-policy, towards the action that is really taken next (eq-sarsa). */
export function sarsa(learner, last) {
  const { Q, A } = learner;
  last.next = Q[last.zNext * A + last.aNext];
  moveTowards(learner, Q, last.z * A + last.a, last.r + last.gamma * last.next, last);
}

/** Learn towards the mean over the next actions (eq-expected-sarsa). */
export function expectedSarsa(learner, last) {
  const { Q, A } = learner;
  last.next = expected(Q, last.zNext, A, learner.epsilonNow);
  moveTowards(learner, Q, last.z * A + last.a, last.r + last.gamma * last.next, last);
}

/** Learn two tables: one chooses the best next action, the other values it (eq-double-q); a coin says which learns. */
export function doubleQLearning(learner, last) {
  const { Q, A, tables } = learner;
  const i = last.z * A + last.a;
  last.table = last.coin < 0.5 ? 0 : 1;
  const own = tables[last.table];
  const other = tables[1 - last.table];
  last.next = other[last.zNext * A + firstBest(own, last.zNext, A)];
  moveTowards(learner, own, i, last.r + last.gamma * last.next, last);
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
  last.next = mdp.terminal[last.sNext] ? 0 : Q[last.zNext * A + last.aNext];
  let G = last.next;
  let played = 0;
  for (let i = t - 1; i >= 0; i--) {
    G = path.rewards[i] + mdp.gamma * G;
    played = path.rewards[i] + mdp.gamma * played;
    const at = path.visits[i];
    if (i === t - 1) {
      moveTowards(learner, Q, at, G, last); // the step that is shown
    } else {
      learner.surprise += Math.abs(G - Q[at]);
      Q[at] += alphaNow * (G - Q[at]);
    }
  }
  learner.G = played;
}

function moveTowards(learner, table, i, target, last) {
  last.target = target;
  last.before = table[i];
  last.tdError = target - table[i];
  table[i] += learner.alphaNow * last.tdError;
  last.after = table[i];
  learner.surprise += Math.abs(last.tdError);
}

function nothingLearned(last) {
  last.next = last.target = last.before = last.after = last.tdError = NaN;
}
