/**
 * A scenario: what a run is made of, as plain data that Python and the page share.  rlnav/widgets/_scenario.py is the
 * other side, with the same keys, defaults and limits.
 */
import { doubleQLearning, expectedSarsa, monteCarlo, qLearning, sarsa } from "../algorithms.js";
import { fail, integer, items, number, show } from "../check.js";
import { FREE_SPACE } from "../maps.js";
import { HEADINGS, Pose, Robot } from "../robot.js";
import { featuresOf } from "./named.js";
import { RATIOS, SCHEDULES } from "./schedule.js";

export const SIDES = Object.freeze({ least: 4, most: 30 }); // cells along one side that the page offers
export const MOST_EPISODES = 1_000_000;
export const MOST_STEPS = 10_000; // of one episode

// name in a scenario -> the function that learns
export const ALGORITHMS = deepFreeze({
  q_learning: qLearning,
  sarsa,
  expected_sarsa: expectedSarsa,
  double_q_learning: doubleQLearning,
  monte_carlo: monteCarlo,
});

export const DEFAULTS = deepFreeze({
  map: FREE_SPACE.trim().replaceAll("S", ".").split("\n"),
  starts: HEADINGS.map((theta) => [2, 2, theta]),
  steering: [-90, -45, 0, 45, 90],
  slip: 0,
  gamma: 0.95,
  reward: { goal: 10, crash: -10, step: -0.1, turn: 0, progress: 0, only_closer: false, shaping: 0 },
  features: null,
  algorithm: "q_learning",
  alpha: 0.2,
  alpha_schedule: "constant",
  alpha_end: 0.01,
  epsilon: 0.2,
  epsilon_schedule: "constant",
  epsilon_end: 0.01,
  episodes: 1000,
  max_steps: 200,
  Q0: 0,
  seed: 0,
});

const CHECKED = new WeakSet(); // scenarios that have passed: checked once, frozen, and passed on by reference

/**
 * Return the complete scenario, frozen; raise for a key or a value that cannot be.
 * Whether the goal can be reached is not asked here: who is drawing may wall it in for a moment (`whyNot` tells).
 */
export function checkScenario(raw) {
  if (CHECKED.has(raw)) return raw;
  onlyKeys("scenario", raw, DEFAULTS);
  const scenario = { ...DEFAULTS, ...raw };
  scenario.map = checkMap(scenario.map);
  scenario.starts = checkStarts(scenario.starts, scenario.map);
  const robot = new Robot({ steering: scenario.steering, slip: scenario.slip });
  scenario.steering = [...robot.steering];
  scenario.slip = robot.slip + 0; // + 0 makes -0 plain
  scenario.gamma = number("gamma", scenario.gamma, 0, 1) + 0;
  scenario.reward = checkReward(scenario.reward);
  scenario.features = scenario.features === null ? null : copy(scenario.features);
  featuresOf(scenario.features);
  checkLearner(scenario);
  CHECKED.add(deepFreeze(scenario));
  return scenario;
}

/** Return the goal's cell. */
export function goalOf({ map }) {
  const row = map.findIndex((text) => text.includes("G"));
  return [map[row].indexOf("G"), map.length - 1 - row];
}

/** Whether a cell lies inside the drawing. */
export function isInside({ map }, x, y) {
  return x >= 0 && y >= 0 && x < map[0].length && y < map.length;
}

function checkMap(rows) {
  const expected = `rows of '.', '#' and one 'G', all of one length, at most ${SIDES.most}`;
  const list = items("map", rows, expected);
  for (const row of list) {
    const fits = typeof row === "string" && /^[.#G]+$/.test(row) && row.length <= SIDES.most;
    if (!fits || row.length !== list[0].length) fail("map", expected, `the row ${show(row)}`);
  }
  if (!list.length || list.length > SIDES.most) fail("map", `1 to ${SIDES.most} rows`, String(list.length));
  const goals = list.join("").split("G").length - 1;
  if (goals !== 1) fail("map", "a map with one goal 'G'", `${goals} of them`);
  return list;
}

function checkStarts(starts, map) {
  if (starts === null) return null;
  const list = items("starts", starts, "poses [x, y, theta], or null for everywhere").map((start) => {
    const numbers = items("starts", start, "poses [x, y, theta]");
    if (numbers.length !== 3) fail("starts", "poses [x, y, theta]", show(start));
    const { x, y, theta } = new Pose(...numbers);
    checkStart(x, y, map);
    return [x + 0, y + 0, theta + 0];
  });
  const different = new Map(list.map((start) => [start.join(), start]));
  return different.size ? [...different.values()] : null;
}

function checkStart(x, y, map) {
  const symbol = isInside({ map }, x, y) ? map[map.length - 1 - y][x] : "outside the grid";
  if (symbol === ".") return;
  const what = { "#": "an obstacle", G: "the goal" }[symbol] ?? symbol;
  fail("starts", "free cells away from the goal", `(${x}, ${y}), ${what}`);
}

function checkReward(raw) {
  onlyKeys("reward", raw, DEFAULTS.reward);
  const reward = { ...DEFAULTS.reward, ...raw };
  for (const [name, value] of Object.entries(reward)) {
    if (name !== "only_closer") reward[name] = number(name, value) + 0;
    else if (typeof value !== "boolean") fail(name, "true or false", show(value), "", TypeError);
  }
  return reward;
}

function checkLearner(scenario) {
  oneOf("algorithm", scenario.algorithm, Object.keys(ALGORITHMS));
  for (const name of ["alpha", "epsilon"]) {
    const kind = scenario[`${name}_schedule`];
    oneOf(`${name}_schedule`, kind, SCHEDULES);
    for (const key of [name, `${name}_end`]) {
      scenario[key] = number(key, scenario[key], 0, 1, { above: name === "alpha" }) + 0;
      if (scenario[key] === 0 && RATIOS.includes(kind)) {
        fail(key, `above 0 with a schedule that is ${kind}`, "0", "Take a small number, or a linear schedule.");
      }
    }
  }
  scenario.Q0 = number("Q0", scenario.Q0) + 0;
  integer("episodes", scenario.episodes, 1, MOST_EPISODES);
  integer("max_steps", scenario.max_steps, 1, MOST_STEPS);
  integer("seed", scenario.seed, 0);
}

function onlyKeys(name, raw, known) {
  if (raw === null || typeof raw !== "object" || Array.isArray(raw)) fail(name, "an object", show(raw), "", TypeError);
  for (const key of Object.keys(raw)) {
    const keys = Object.keys(known).join(", ");
    if (!Object.hasOwn(known, key)) fail(name, `an object with the keys ${keys}`, `the key ${show(key)}`);
  }
}

function oneOf(name, value, options) {
  if (!options.includes(value)) fail(name, `one of ${options.join(", ")}`, show(value));
}

function copy(plain) {
  return Array.isArray(plain) ? plain.map(copy) : plain;
}

function deepFreeze(value) {
  if (value !== null && typeof value === "object") Object.values(Object.freeze(value)).forEach(deepFreeze);
  return value;
}
