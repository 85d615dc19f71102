/**
 * Mixing a reward: the drive that is best by a reward, and what it is worth by another one, that of the task itself.
 * The robot does not slip here, so that a policy is one drive from each pose: it arrives, crashes, or closes a circle.
 */
import { fail, number } from "../check.js";
import { solve } from "../planning.js";
import { evaluatePolicy } from "../prediction.js";
import { Pose } from "../robot.js";
import { rollout } from "../rollouts.js";
import { taskOf } from "./model.js";
import { posesOf } from "./trial.js";

export const MOST_GAMMA = 0.99; // at 1, what a circle pays has no end
export const FATES = Object.freeze({ goal: 1, circle: 0, crash: -1 });
const EXACT = 1e-12;
const NONE = { goal: 0, crash: 0, step: 0, turn: 0, progress: 0, only_closer: false, shaping: 0 };
const BOOK = { ...NONE, goal: 10, crash: -10, step: -0.1 };

// name -> [words, the numbers of the reward]; those of the task come first, and are its own
export const RECIPES = Object.freeze({
  sparse: ["Only the goal pays", { ...NONE, goal: 10 }],
  closer: ["+1 for each cell closer, and nothing else", { ...NONE, progress: 1, only_closer: true }],
  bonus: ["+1.5 for each cell closer, and the goal", { ...BOOK, progress: 1.5, only_closer: true }],
  progress: ["Closer pays, away costs, and nothing else", { ...NONE, progress: 1 }],
  impatient: ["Every step costs 2", { ...BOOK, step: -2 }],
  living: ["Every step pays 0.6", { ...BOOK, step: 0.6 }],
  shaped: ["Potential shaping", { ...BOOK, shaping: 1 }],
});

/** Return the name of the recipe with these numbers, "task" for those of the task, or "own". */
export function recipeOf(reward, taskReward) {
  const same = (numbers) => Object.keys(NONE).every((key) => numbers[key] === reward[key]);
  if (same(taskReward)) return "task";
  return Object.keys(RECIPES).find((name) => same(RECIPES[name][1])) ?? "own";
}

/** Plan by two rewards, of which that of the task seldom changes. */
export class Mixer {
  #known = { key: "", mdp: null, best: null };

  /** Return all that is to be said about a state { scenario, task_reward, pose }; what cannot be raises. */
  mix({ scenario, task_reward: taskReward, pose }) {
    if (scenario.slip > 0) fail("slip", "0", `${scenario.slip}`, "With slips a policy is not one drive but many.");
    number("gamma", scenario.gamma, 0, MOST_GAMMA);
    const task = taskOf(scenario);
    const mdp = task.mdp();
    const own = this.#planned({ ...scenario, reward: taskReward });
    const start = startOf(task, pose);
    const s = task.index(start);
    if (mdp.terminal[s]) fail("pose", "a pose away from the goal", `${start}`);
    const best = solve(mdp, { tol: EXACT });
    const policies = [best.pi, own.best.pi];
    const worth = [mdp, own.mdp].map((model) => policies.map((pi) => evaluatePolicy(model, pi)[s]));
    const [drive, asked] = policies.map((pi) => driveOf(task, mdp, pi, s));
    return { task, mdp, ownMdp: own.mdp, start, best, worth, drive, asked, fates: fatesOf(mdp, best.pi) };
  }

  #planned(scenario) {
    const { map, starts, steering, gamma, reward } = scenario;
    const key = JSON.stringify([map, starts, steering, gamma, reward]);
    if (key !== this.#known.key) {
      const mdp = taskOf(scenario).mdp();
      this.#known = { key, mdp, best: solve(mdp, { tol: EXACT }) };
    }
    return this.#known;
  }
}

function startOf(task, pose) {
  return pose ? new Pose(...pose) : task.world.starts[0];
}

/**
 * Follow a policy until it ends or comes back to a state: { states, actions, rewards, poses, end, loop }.
 * `end` is "goal", "crash" or "circle"; a loop has { from, length, paid }: it begins with state number `from`.
 */
export function driveOf(task, mdp, pi, start) {
  const whole = rollout(mdp, pi, { start, maxSteps: mdp.S, rng: 0 });
  const seen = new Map();
  const again = whole.states.findIndex((s, t) => {
    if (seen.has(s)) return true;
    seen.set(s, t);
    return false;
  });
  const n = again < 0 ? whole.actions.length : again;
  const states = whole.states.slice(0, n + 1);
  const actions = whole.actions.slice(0, n);
  const rewards = whole.rewards.slice(0, n);
  const poses = posesOf(task, states, actions.at(-1));
  const last = states[n];
  if (mdp.terminal[last]) return { states, actions, rewards, poses, end: mdp.goal[last] ? "goal" : "crash", loop: null };
  const from = seen.get(last);
  const paid = rewards.slice(from).reduce((sum, r) => sum + r, 0);
  return { states, actions, rewards, poses, end: "circle", loop: { from, length: n - from, paid } };
}

/** Tell for every state where a policy leads: 1 to the goal, -1 to a crash, 0 to neither, in circles. */
export function fatesOf(mdp, pi) {
  const { S, A, K, nextState, terminal, goal } = mdp;
  const fates = Int8Array.from({ length: S }, (_, s) => (goal[s] ? FATES.goal : FATES.crash));
  const known = Uint8Array.from(terminal);
  for (let first = 0; first < S; first++) {
    const way = new Set();
    let s = first;
    while (!known[s] && !way.has(s)) {
      way.add(s);
      s = nextState[(s * A + pi[s]) * K];
    }
    const fate = known[s] ? fates[s] : FATES.circle;
    for (const visited of way) {
      known[visited] = 1;
      fates[visited] = fate;
    }
  }
  return fates;
}

/** The number of the state, and of the step that led to it, after t steps of a drive that may go round and round. */
export function placeAt({ states, loop }, t) {
  const last = states.length - 1;
  if (t <= last || !loop) return Math.min(t, last);
  return loop.from + 1 + ((t - loop.from - 1) % loop.length);
}
