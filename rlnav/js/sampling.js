/**
 * What chance decides in an episode, each as a function of uniform numbers in [0, 1).
 * Mirrors rlnav/_sampling.py.  A row z of a table Q [Z * A] begins at z * A.
 */

/** Choose one of the start states. */
export function drawStart(mdp, u) {
  return mdp.start[Math.floor(u * mdp.start.length)];
}

/** Choose a successor of (s, a); return its place in nextState and reward. */
export function drawSuccessor(mdp, s, a, u) {
  const { K, prob } = mdp;
  const first = (s * mdp.A + a) * K;
  let left = u;
  let likeliest = first;
  for (let j = first; j < first + K; j++) {
    left -= prob[j];
    if (left < 0) return j;
    if (prob[j] > prob[likeliest]) likeliest = j;
  }
  return likeliest; // the probabilities sum to one only within rounding, and u lay in the gap
}

/** max_a Q[z, a]. */
export function largest(Q, z, A) {
  let best = Q[z * A];
  for (let i = z * A + 1; i < (z + 1) * A; i++) best = Q[i] > best ? Q[i] : best;
  return best;
}

/** argmax_a Q[z, a], the first of equals. */
export function firstBest(Q, z, A) {
  let best = 0;
  for (let a = 1; a < A; a++) best = Q[z * A + a] > Q[z * A + best] ? a : best;
  return best;
}

/** Epsilon-greedy: `u` decides whether to explore, `w` which action or which of the tied best. */
export function drawAction(Q, z, A, epsilon, u, w) {
  if (u < epsilon) return Math.floor(w * A);
  const best = largest(Q, z, A);
  let ties = 0;
  for (let i = z * A; i < (z + 1) * A; i++) ties += Q[i] === best ? 1 : 0;
  let skip = Math.floor(w * ties);
  let a = 0;
  while (a < A - 1 && (Q[z * A + a] !== best || skip-- > 0)) a++;
  return a;
}

/** sum_a pi(a | z) Q[z, a] under the epsilon-greedy policy; tied best actions have equal values. */
export function expected(Q, z, A, epsilon) {
  let sum = 0;
  for (let i = z * A; i < (z + 1) * A; i++) sum += Q[i];
  return (1 - epsilon) * largest(Q, z, A) + (epsilon * sum) / A;
}
