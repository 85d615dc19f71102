/**
 * One update from close by: its parts with their numbers, and what a wrong guess tells about how it was found.
 */
import { expectedSarsa, qLearning, sarsa } from "../algorithms.js";
import { number } from "../check.js";
import { firstBest } from "../sampling.js";
import { endOf } from "./timeline.js";

const ROUNDED = 0.006; // what a guess may be off, in absolute terms and as a share: it is found from rounded numbers

/**
 * The algorithms whose updates differ in one term only: what they make of the next row of the table.
 * `share(row, aNext, epsilon)` says how much each of its entries counts.
 */
export const ALGORITHMS = {
  q_learning: {
    name: "Q-learning",
    rule: qLearning,
    share: (row) => row.map((_, a) => (a === firstBest(row, 0, row.length) ? 1 : 0)),
  },
  sarsa: {
    name: "SARSA",
    rule: sarsa,
    share: (row, aNext) => row.map((_, a) => (a === aNext ? 1 : 0)),
  },
  expected_sarsa: {
    name: "Expected SARSA",
    rule: expectedSarsa,
    share: (row, _, epsilon) => {
      const best = firstBest(row, 0, row.length);
      return row.map((_q, a) => epsilon / row.length + (a === best ? 1 - epsilon : 0));
    },
  },
};

/** Return the rule of an algorithm; a careless one goes on counting after the end of an episode. */
export function ruleOf(algorithm, endHasValue) {
  const { rule } = ALGORITHMS[algorithm];
  if (!endHasValue) return rule;
  return (learner, last) => {
    last.gamma = learner.mdp.gamma; // it should be 0 at an end
    rule(learner, last);
  };
}

/**
 * Take the last update of a learner apart: what `last` holds, and both rows of the table as they were before it.
 * `share` says how much each entry of the next row counts, and `end` how the episode has ended, if it has.
 */
export function partsOf(learner, algorithm) {
  const { Q, A, last, mdp } = learner;
  const rowOf = (z) => {
    const row = Array.from(Q.subarray(z * A, (z + 1) * A));
    if (z === last.z) row[last.a] = last.before;
    return row;
  };
  const nextRow = rowOf(last.zNext);
  const share = ALGORITHMS[algorithm].share(nextRow, last.aNext, learner.epsilonNow);
  const rates = { alpha: learner.alphaNow, fullGamma: mdp.gamma };
  return { ...last, ...rates, row: rowOf(last.z), nextRow, share, end: endOf(learner) };
}

/** Say whether a guess is the entry after the update, and if not, which step may have gone wrong: { right, words }. */
export function judge(parts, guess) {
  number("guess", guess);
  const near = (value) => Math.abs(guess - value) <= ROUNDED * (1 + Math.abs(value));
  const { before, after } = parts;
  if (near(after)) return { right: true, words: "Right." };
  const wrong = mistakes(parts).find(([value]) => near(value));
  if (wrong) return { right: false, words: wrong[1] };
  const side = after === before ? "it stays as it was" : after > before ? "it rises" : "it falls";
  return { right: false, words: `Not yet. The entry was ${Number(before.toFixed(3))}, and ${side}.` };
}

/** List the usual ways to get an update wrong, the commonest first: what they give, and what to say. */
function mistakes({ before, alpha, gamma, fullGamma, r, next, nextRow, target, tdError }) {
  const towards = (aim) => before + alpha * (aim - before);
  return [
    [target, "That is the whole target. The entry moves only the part α of the way to it."],
    [alpha * tdError, "That is the change. Add it to the old entry."],
    [before - alpha * tdError, "That is the wrong way: the entry moves towards the target."],
    [before + alpha * target, "The bracket ends with − Q(S, A): the target is compared with the old entry first."],
    [alpha * target, "That is α times the target. The old entry keeps its part: 1 − α of it."],
    [towards(r + fullGamma * next), "Nothing follows an end: there γ is 0, and the target is the reward alone."],
    [towards(r + next), "The discount is missing: the next value counts γ times."],
    [towards(gamma * next), "The reward is missing from the target."],
    [towards(r), "The next row is missing from the target: this episode was not over."],
    [towards(r + gamma * Math.max(...nextRow)), "That takes the best next entry. This algorithm takes another value."],
    ...nextRow.map((q) => [towards(r + gamma * q), "That takes another entry of the next row."]),
    [before, "That is the old entry."],
  ];
}
