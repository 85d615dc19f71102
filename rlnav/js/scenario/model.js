/**
 * From a scenario to what runs: its world, its task, the model of the task, and the options of its learner.
 */
import { MDP } from "../mdp.js";
import { HEADINGS, Pose, Robot } from "../robot.js";
import { Task } from "../task.js";
import { unpackAll } from "../views/arrays.js";
import { GridWorld, reachable } from "../world.js";
import { featuresOf, rewardOf } from "./named.js";
import { ALGORITHMS, checkScenario, goalOf } from "./scenario.js";
import { scheduleOf } from "./schedule.js";

export const MOST_NUMBERS = 2_000_000; // in a table: a phone must hold it several times
const PART = ["map", "starts", "steering", "slip", "gamma"]; // what Python's tables are made for

/** Build the world of a scenario. */
export function worldOf(raw) {
  const { map, starts, ...rest } = checkScenario(raw);
  const [width, height] = [map[0].length, map.length];
  const obstacles = [...map].reverse().flatMap((row, y) => [...row].flatMap((c, x) => (c === "#" ? [[x, y]] : [])));
  const goal = goalOf({ map, ...rest });
  return new GridWorld(width, height, { goal, obstacles, starts: (starts ?? []).map((pose) => new Pose(...pose)) });
}

/** Build the task of a scenario. */
export function taskOf(raw) {
  const scenario = checkScenario(raw);
  const { steering, slip, features, gamma } = scenario;
  const world = worldOf(scenario);
  const robot = new Robot({ steering, slip });
  return new Task(world, { robot, reward: rewardOf(scenario, world), features: featuresOf(features), gamma });
}

/** Return { task, mdp, phi }; the arrays of a reader's own reward or features come from Python, as `tables`. */
export function modelOf(raw, tables = null) {
  const task = taskOf(raw);
  if (!isOwn(tables)) return { task, mdp: task.mdp(), phi: task.phi() };
  const { mdp, phi } = unpackAll(tables);
  return { task, mdp: new MDP(mdp), phi };
}

/** Return the function that learns. */
export function algorithmOf(scenario) {
  return ALGORITHMS[scenario.algorithm];
}

/** Return the options of the learner, as `Learner` takes them. */
export function learnerOptions(scenario) {
  const { episodes, max_steps: maxSteps, Q0, seed: rng } = scenario;
  const over = (name) => scheduleOf(scenario[`${name}_schedule`], scenario[name], scenario[`${name}_end`], episodes);
  return { episodes, alpha: over("alpha"), epsilon: over("epsilon"), maxSteps, Q0, rng };
}

/** Say in a plain sentence why a scenario cannot run; "" if it can. */
export function whyNot(raw, tables = null) {
  const scenario = checkScenario(raw);
  return noWay(scenario) || (isOwn(tables) ? notCurrent(scenario, tables) : tooLarge(scenario));
}

/** Count the rows of the table and its columns, beside the rows that it would have for the whole pose. */
export function tableSizeOf(raw) {
  const { map, steering, features, slip } = checkScenario(raw);
  const free = map.join("").replaceAll("#", "").length;
  const poseRows = free * HEADINGS.length + 1; // and one for the robot that has crashed
  const sizes = { world: { width: map[0].length, height: map.length }, robot: new Robot({ steering, slip }) };
  const levels = (featuresOf(features) ?? []).map((feature) => feature.size(sizes.world, sizes.robot));
  const rows = features ? levels.reduce((product, n) => product * n, 1) + 1 : poseRows;
  return { rows, actions: steering.length, poseRows };
}

/** Whether Python has sent the model of a reader's own reward or features. */
export function isOwn(tables) {
  return Boolean(tables?.own?.length);
}

function noWay({ map, starts }) {
  const [width, height] = [map[0].length, map.length];
  const goal = goalOf({ map });
  const walls = Uint8Array.from([...map].reverse().join(""), (symbol) => (symbol === "#" ? 1 : 0));
  const near = reachable(goal, width, height, walls);
  if (near.reduce((sum, flag) => sum + flag, 0) === 1) {
    return "No free cell leads to the goal. Remove an obstacle beside it.";
  }
  const lost = starts?.find(([x, y]) => !near[y * width + x]);
  if (!lost) return "";
  return `There is no way from the start at (${lost[0]}, ${lost[1]}) to the goal. Remove an obstacle between them.`;
}

function tooLarge(scenario) {
  const { rows, actions } = tableSizeOf(scenario);
  if (rows * actions <= MOST_NUMBERS) return "";
  const [now, most] = [rows * actions, MOST_NUMBERS].map((n) => n.toLocaleString("en-US"));
  return `The table would have ${now} numbers; this page can hold ${most}. Let the robot perceive less.`;
}

function notCurrent(scenario, tables) {
  const part = (whole) => JSON.stringify(PART.map((key) => whole[key]));
  if (part(tables.task) === part(scenario)) return tables.error ?? "";
  const own = tables.own.join(" and the ");
  return `The ${own} of this task ${tables.own.length > 1 ? "are" : "is"} computed in Python, for another setting. ` +
    "With a running notebook the new model comes by itself; without one, take this change back.";
}
