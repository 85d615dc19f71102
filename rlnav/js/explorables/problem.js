/**
 * The task that an explorable shows, as a model: of its scenario, or of the arrays that Python has sent because the
 * reward is a function of the reader's own.
 */
import { MDP } from "../mdp.js";
import { taskOf } from "../scenario/model.js";
import { unpackAll } from "../views/arrays.js";

/** Build { task, mdp, policy }; `policy` is the reader's own, as probabilities [S * A], or null. */
export function problemOf(scenario, tables) {
  const task = taskOf(scenario);
  const sent = unpackAll(tables ?? {});
  const mdp = sent.mdp ? adapted(new MDP(sent.mdp), task) : task.mdp();
  return { task, mdp, policy: sent.policy ?? null };
}

/** Remember the last problem: most of what a reader changes in a figure leaves the task as it is. */
export function rememberedProblem() {
  let [key, sent, problem] = ["", null, null];
  return ({ map, starts, steering, slip, gamma, reward, features }, tables) => {
    const part = { map, starts, steering, slip, gamma, reward, features };
    const now = JSON.stringify(part);
    if (now !== key || tables !== sent) problem = problemOf(part, tables);
    [key, sent] = [now, tables];
    return problem;
  };
}

/**
 * Bring a model that Python has sent to the slip and discount that the reader has set since. The first outcome of an
 * action is the one without a slip, so what every applied steering leads to and pays is known.
 */
function adapted(sent, { robot, gamma }) {
  const { S, A, K } = sent;
  const outcomes = Array.from({ length: A }, (_, a) => robot.outcomes(a));
  const N = outcomes[0].length;
  const nextState = new Int32Array(S * A * N);
  const prob = new Float64Array(nextState.length);
  const reward = new Float64Array(nextState.length);
  for (let i = 0; i < nextState.length; i++) {
    const s = Math.floor(i / (A * N));
    const [applied, p] = outcomes[Math.floor(i / N) % A][i % N];
    const from = (s * A + applied) * K;
    nextState[i] = sent.nextState[from];
    prob[i] = p;
    reward[i] = sent.reward[from];
  }
  return new MDP({ ...sent, K: N, nextState, prob, reward, gamma });
}
