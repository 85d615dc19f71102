/**
 * What the picture of the loop shows at a moment: who is at work, which signal passes, where the robot is.
 */
import { appliedAt } from "./loop_words.js";

const AGENT = { read: "reads the state", choose: "chooses an action" };
const WORLD = {
  move: "moves the robot", pay: "pays the reward", show: "shows the new state", tick: "waits; the clock ticks",
};

/** Gather the scene; `chance` is pi(a | S_t), or null where the reader chooses, who may now if `free`. */
export function sceneOf(loop, task, { free, whyNot, chance, moving }) {
  const { moment, t, over } = loop;
  const now = over ? { t, s: loop.s, a: null, place: null, r: null, sNext: null } : loop.rows.at(-1);
  const lit = (near, far) => ({ near: moment === near, far: moment === far });
  return {
    row: { ...now, rBefore: t ? loop.steps[t - 1].r : null },
    active: {
      agent: moment in AGENT, world: moment in WORLD && moment !== "tick",
      a: lit("", "choose"), r: lit("", "pay"), s: lit("read", "show"), clock: moment === "tick",
    },
    agentWords: AGENT[moment] ?? (over ? "has nothing left to do" : "waits"),
    worldWords: WORLD[moment] ?? (over ? `the episode is ${moment}` : "waits"),
    moving: moving && moment === "move",
    free, whyNot, chance, over,
    ...wayOf(loop, task, now.place !== null),
  };
}

/** The robot and the poses that it has passed; after a crash it stands half way to what it ran into. */
function wayOf({ mdp, first, steps, t }, task, moved) {
  const passed = steps.slice(0, t + (moved ? 1 : 0));
  const path = [first, ...passed.map(({ sNext }) => sNext)].map((s) => task.pose(s)).filter(Boolean);
  const last = passed.at(-1);
  if (!last) return { path, robot: { ...path[0] } };
  const from = task.pose(last.s);
  const { x, y, theta } = task.robot.move(from, task.robot.steering[appliedAt(mdp, task, last.a, last.place)]);
  return { path, robot: { x, y, theta, from, crashed: last.sNext === task.crashed } };
}

/** The probabilities pi(a | s) of a policy: actions [S] or probabilities [S * A]. */
export function chancesAt(pi, s, A) {
  if (pi instanceof Float64Array) return pi.subarray(s * A, (s + 1) * A);
  return Float64Array.from({ length: A }, (_, a) => (a === pi[s] ? 1 : 0));
}
