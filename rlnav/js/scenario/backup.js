/**
 * Where a value comes from: the backup diagram of one state or action as a tree with its numbers, the line of the
 * formula behind each node, and what a wrong answer to "which number is missing?" tells about how it was found.
 */
import { number } from "../check.js";
import { actionValues, checkPolicy, epsilonGreedy, TIE } from "../mdp.js";
import { solve } from "../planning.js";
import { evaluatePolicy } from "../prediction.js";

const EXACT = 1e-10;
const ROUNDED = 0.006; // what an answer may be off, as such and as a share: it is found from rounded numbers

/** The probabilities pi(a | s) of the policy that is asked for: "random", "epsilon_greedy", or the reader's `own`. */
export function policyOf(mdp, { policy, epsilon }, own = null) {
  if (policy === "epsilon_greedy") return epsilonGreedy(solve(mdp, { tol: EXACT }).Q, mdp.A, epsilon);
  return policy === "own" ? own : new Float64Array(mdp.S * mdp.A).fill(1 / mdp.A);
}

/** Find the exact values of a policy's probabilities [S * A], or, where `pi` is null, the optimal ones: { V, Q }. */
export function valuesOf(mdp, pi) {
  const V = pi === null ? solve(mdp, { tol: EXACT }).V : evaluatePolicy(mdp, checkPolicy(mdp, pi));
  return { V, Q: actionValues(mdp, V) };
}

/**
 * Grow the diagram of state `s`, or of action `a` in it, two levels deep. A node is { id, kind: "state" | "action",
 * s, a, value, children }; a state below an action has its probability and reward, an action below a state its
 * probability under the policy, or whether it is a best one where there is none (`pi` null: the max counts).
 */
export function backupTree({ mdp, pi, V, Q }, s, a = null) {
  const ofState = (state, id, deep, more = {}) => ({
    ...more, id, kind: "state", s: state, a: null, value: V[state], terminal: mdp.terminal[state] === 1,
    children: deep && !mdp.terminal[state] ? actions(state, id, deep - 1) : [],
  });
  const ofAction = (state, action, id, deep, more = {}) => ({
    ...more, id, kind: "action", s: state, a: action, value: Q[state * mdp.A + action], terminal: false,
    children: deep ? successors(mdp, state, action).map((to, k) => ofState(to.s, `${id}-${k}`, deep - 1, to)) : [],
  });
  const actions = (state, id, deep) => {
    const row = Array.from({ length: mdp.A }, (_, action) => state * mdp.A + action);
    const most = Math.max(...row.map((i) => Q[i]));
    return row.map((i, action) =>
      ofAction(state, action, `${id}-${action}`, deep, { probability: pi && pi[i], best: !pi && most - Q[i] <= TIE }));
  };
  return a === null ? ofState(s, "0", 2) : ofAction(s, a, "0", 2);
}

/** The nodes from the root to the one with this id, which tells the way: "0-3-1". */
export function levelsTo(root, id) {
  const [, ...way] = id.split("-").map(Number);
  return way.reduce((levels, k) => [...levels, levels.at(-1).children[k]], [root]);
}

/** List what may follow an action, { s, probability, reward, ks }: outcomes that are the same count together. */
export function successors({ A, K, nextState, prob, reward }, s, a) {
  const found = [];
  for (let j = (s * A + a) * K; j < (s * A + a + 1) * K; j++) {
    const same = found.find((to) => to.s === nextState[j] && to.reward === reward[j]);
    if (prob[j] === 0) continue;
    if (same) {
      same.probability += prob[j];
      same.ks.push(j % K);
    } else {
      found.push({ s: nextState[j], probability: prob[j], reward: reward[j], ks: [j % K] });
    }
  }
  return found;
}

/** How a node is made from its children: "max" or "mean" over actions, "ahead" to successors, "" at a leaf. */
export function ruleOf(node) {
  if (!node.children.length) return "";
  if (node.kind === "action") return "ahead";
  return node.children[0].probability === null ? "max" : "mean";
}

/** Compute the value of a node from those of its children, by its rule. */
export function backedUp(node, gamma) {
  const values = node.children.map((child) => child.value);
  if (ruleOf(node) === "max") return Math.max(...values);
  if (ruleOf(node) === "mean") return sum(node, (child) => child.probability * child.value);
  return sum(node, (child) => child.probability * (child.reward + gamma * child.value));
}

/** Say whether an answer is the node's number, and if not, which step may have gone wrong: { right, words }. */
export function judge(node, answer, gamma) {
  number("answer", answer);
  const near = (value) => Math.abs(answer - value) <= ROUNDED * (1 + Math.abs(value));
  if (near(node.value)) return { right: true, words: "Right." };
  const wrong = mistakes(node, gamma).find(({ value }) => near(value) && !nearly(value, node.value));
  if (wrong) return { right: false, words: wrong.words };
  return { right: false, words: `Not yet: it is ${answer > node.value ? "less" : "more"} than that.` };
}

/** Whether some mistake of the list would be told from the right answer: else a node is no good question. */
export function isTelling(node, gamma) {
  return mistakes(node, gamma).some(({ value }) => !nearly(value, node.value));
}

function nearly(x, y) {
  return Math.abs(x - y) <= 3 * ROUNDED * (1 + Math.abs(y));
}

/** List the usual ways to get a node's number wrong, the commonest first: what they give, and what to say. */
function mistakes(node, gamma) {
  const values = node.children.map((child) => child.value);
  const mean = values.reduce((all, v) => all + v, 0) / values.length;
  const most = Math.max(...values);
  const least = Math.min(...values);
  if (ruleOf(node) === "max") {
    return [
      [mean, "That is the mean. Here the robot takes the best action: only the largest number counts."],
      [least, "That is the smallest. The best action has the largest number."],
      [sum(node, ({ value }) => value), "That is the sum. Only the largest number counts."],
    ].map(told);
  }
  if (ruleOf(node) === "mean") {
    return [
      [most, "That is the maximum. This policy does not always take the best action: weigh each number by π(a | s)."],
      [mean, "That is the plain mean. This policy prefers some actions: weigh each number by its own π(a | s)."],
      [sum(node, ({ value }) => value), "That is the plain sum. Multiply each number by π(a | s) before you add."],
      [least, "That is the smallest. Weigh each number by π(a | s) and add."],
    ].map(told);
  }
  const likeliest = node.children.reduce((best, child) => (child.probability > best.probability ? child : best));
  const ahead = ({ reward, value }) => reward + gamma * value;
  return [
    [sum(node, (c) => c.probability * (c.reward + c.value)), "The discount is missing: what follows counts γ times."],
    [sum(node, (c) => c.probability * gamma * c.value), "The reward of the step is missing: add r before you go on."],
    [sum(node, (c) => c.probability * c.value), "Reward and discount are missing: it is r + γ times what follows."],
    [sum(node, (c) => c.probability * c.reward), "That is the reward alone. Add γ times the value of what follows."],
    [sum(node, (c) => c.probability * gamma * (c.reward + c.value)),
      "The reward is discounted as well. It is paid on this very step: only what follows counts γ times."],
    [sum(node, (c) => c.probability * (gamma * c.value - c.reward)), "The reward has the wrong sign."],
    [ahead(likeliest), "Only the likeliest successor is in it. The others count too, each by its probability."],
    [Math.max(...node.children.map(ahead)), "That is the best case. The world does not choose: weigh each case by p."],
    [sum(node, ahead), "The probabilities are missing: weigh each case by p."],
    [sum(node, ahead) / values.length, "That is the plain mean. The cases are not equally likely: weigh each by p."],
  ].map(told);
}

function told([value, words]) {
  return { value, words };
}

function sum(node, term) {
  return node.children.reduce((all, child) => all + term(child), 0);
}
