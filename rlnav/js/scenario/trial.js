/**
 * What a table is worth on a task: the way that its greedy policy takes, and its exact scores, computed in slices.
 */
import { endsOf, meanOver } from "../evaluation.js";
import { greedy, lift, MDP, underPolicy } from "../mdp.js";
import { evaluatingPolicy } from "../prediction.js";
import { rollout } from "../rollouts.js";

/** Read the greedy policy off a table, for the states of a model. */
export function policyOf(Q, A, phi) {
  return lift(greedy(Q, A), phi);
}

/**
 * Drive with a policy from a pose, always with the same luck; the result is { poses, crashed, goal, steps, total },
 * where total is the sum of the rewards. The last of the poses is the one that it drove at if it crashed.
 */
export function driveFrom(task, mdp, pi, start, maxSteps) {
  const { states, actions, rewards } = rollout(mdp, pi, { start: task.index(start), maxSteps, rng: 0 });
  const s = states.at(-1);
  return {
    poses: posesOf(task, states, actions.at(-1)),
    crashed: s === task.crashed,
    goal: mdp.goal[s] === 1,
    steps: actions.length,
    total: rewards.reduce((sum, r) => sum + r, 0),
  };
}

/** Turn states into poses; `a` is the last action, which says at what a robot that has crashed was driving. */
export function posesOf(task, states, a) {
  const poses = Array.from(states, (s) => plain(task.pose(s)));
  if (states.at(-1) !== task.crashed) return poses;
  const from = task.pose(states.at(-2));
  const turns = task.robot.outcomes(a).map(([applied]) => task.robot.steering[applied]);
  const hit = turns.map((turn) => task.transition(from, turn)).find(({ crash }) => crash);
  poses[poses.length - 1] = { ...plain(hit?.sNext ?? from), crashed: true };
  return poses;
}

/**
 * Score a policy, a sweep at a time: { success, crash, timeout, steps, value, optimal, gap, why }. At gamma = 1 a
 * policy that drives on for ever has no value, and there may be no best one: then `why` says so.
 */
export function* scoring(mdp, pi, best, maxSteps) {
  const ends = yield* endsOf(mdp, pi, maxSteps);
  const hasBest = best.converged || mdp.gamma < 1;
  const optimal = hasBest ? meanOver(mdp.start, best.V) : NaN;
  try {
    const chain = reachedBy(mdp, pi);
    const value = meanOver(mdp.start, yield* evaluatingPolicy(chain, new Int32Array(mdp.S)));
    const why = hasBest ? "" : "Some policy collects reward without end: at gamma = 1 there is no best one.";
    return { ...ends, value, optimal, gap: optimal - value, why };
  } catch (error) {
    if (mdp.gamma < 1) throw error;
    const why = "It may drive on for ever, and is paid on the way: at gamma = 1 its value has no end.";
    return { ...ends, value: NaN, optimal, gap: NaN, why };
  }
}

/** The chain of a policy as a model with one action, in which states that it never comes to are ends. */
function reachedBy(mdp, pi) {
  const { S, start, gamma, goal } = mdp;
  const { N, nextState, prob, r } = underPolicy(mdp, pi);
  const reached = reachedFrom(start, S, N, nextState, prob);
  const terminal = mdp.terminal.map((flag, s) => flag || !reached[s]);
  const at = (i) => Math.floor(i / N);
  const ended = nextState.map((to, i) => (terminal[at(i)] ? at(i) : to));
  const reward = Float64Array.from(prob, (_, i) => (terminal[at(i)] ? 0 : r[at(i)]));
  return new MDP({ S, A: 1, K: N, nextState: ended, prob, reward, gamma, terminal, start, goal });
}

/** Mark the states that a chain with N successors a state may come to. */
export function reachedFrom(start, S, N, nextState, prob) {
  const reached = new Uint8Array(S);
  const frontier = [...new Set(start)];
  frontier.forEach((s) => (reached[s] = 1));
  while (frontier.length) {
    const s = frontier.pop();
    for (let i = s * N; i < (s + 1) * N; i++) {
      if (!(prob[i] > 0) || reached[nextState[i]]) continue;
      reached[nextState[i]] = 1;
      frontier.push(nextState[i]);
    }
  }
  return reached;
}

function plain(pose) {
  return pose && { x: pose.x, y: pose.y, theta: pose.theta };
}
