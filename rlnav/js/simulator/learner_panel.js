/**
 * The learner's settings: which algorithm, how it moves its table, how it explores, and for how long.
 */
import { MOST_EPISODES, MOST_STEPS } from "../scenario/scenario.js";
import { scheduleOf } from "../scenario/schedule.js";
import { button, choice, group, number, slider } from "../views/controls.js";
import { h, svg } from "../views/dom.js";
import { ALGORITHM_NAMES, inBrief } from "./brief.js";
import { changes, Fields } from "./fields.js";

const ALGORITHMS = {
  q_learning: "Its target takes the best next action, whatever the robot does next.",
  sarsa: "Its target takes the action that the robot really does next, exploration included.",
  expected_sarsa: "Its target is the mean over all next actions, as likely as it takes them.",
  double_q_learning: "One table picks the best action, another rates it: luck deceives it less.",
  monte_carlo: "It waits for the end of the episode, then learns from the whole return.",
};
const SCHEDULES = [
  ["constant", "stays the same"],
  ["linear", "falls evenly"],
  ["harmonic", "falls fast, then slowly"],
  ["exponential", "falls by equal factors"],
];
const POINTS = 48; // of a sparkline

/** Build the group "Learner". */
export function learnerPanel(app) {
  const fields = new Fields(app);
  const set = (key) => (value) => fields.change({ [key]: value });
  const algorithm = choice({
    label: "Algorithm",
    options: Object.entries(ALGORITHM_NAMES),
    value: app.scenario.algorithm,
    onChange: set("algorithm"),
  });
  const explained = h("p", { class: "rl-help", role: "status" });
  const alpha = scheduled(fields, "alpha", {
    symbol: "α",
    label: "Step size α",
    help: "How much of the error one update corrects.",
    min: 0.001,
    log: true,
  });
  const epsilon = scheduled(fields, "epsilon", {
    symbol: "ε",
    label: "Exploration ε",
    help: "Chance of a random action instead of the best one.",
    min: 0,
    step: 0.01,
  });
  const panel = group({
    title: "Learner",
    children: [
      h("div", { class: "rl-stack" }, fields.add("algorithm", algorithm).element, explained),
      alpha.element,
      epsilon.element,
      h("div", { class: "rl-fields" }, amounts(fields)),
    ],
  });
  const changed = changes();
  return {
    element: panel.element,
    refresh() {
      fields.refresh();
      const { scenario } = app;
      if (!changed(scenario)) return;
      explained.textContent = ALGORITHMS[scenario.algorithm];
      alpha.refresh(scenario);
      epsilon.refresh(scenario);
      panel.summary(inBrief("learner", scenario, app.session.own));
    },
  };
}

/** Fields for how long and from where: episodes, step limit, initial table, seed. */
function amounts(fields) {
  const set = (key) => (value) => fields.change({ [key]: value });
  const { scenario } = fields.app;
  const field = (key, options) => {
    const control = number({ value: scenario[key], step: 1, onChange: set(key), ...options });
    return fields.add(key, control).element;
  };
  const seed = field("seed", {
    label: "Seed",
    min: 0,
    max: Number.MAX_SAFE_INTEGER,
    help: "The same seed gives the same run, to the last bit.",
  });
  const next = button({
    label: "Next seed",
    title: "The same settings with other chance",
    onClick: () => fields.edit((now) => ({ ...now, seed: now.seed + 1 })),
  });
  seed.append(next.element);
  return [
    field("episodes", { label: "Episodes", ...upTo(MOST_EPISODES), help: "From a start to goal, crash or step limit." }),
    field("max_steps", { label: "Step limit", ...upTo(MOST_STEPS), help: "An episode of so many steps is stopped." }),
    field("Q0", { label: "Initial Q", step: "any", help: "A high value makes the robot try everything once." }),
    seed,
  ];
}

function upTo(max) {
  return { min: 1, max };
}

/** A number between 0 and 1 with its schedule over the episodes. */
function scheduled(fields, key, options) {
  const { app } = fields;
  const keys = { kind: `${key}_schedule`, end: `${key}_end` };
  const start = slider({ max: 1, value: app.scenario[key], onChange: (v) => fields.change({ [key]: v }), ...options });
  const kind = choice({
    label: `${options.symbol} over the episodes`,
    options: SCHEDULES,
    value: app.scenario[keys.kind],
    onChange: (value) => fields.change({ [keys.kind]: value }),
  });
  const end = number({
    label: `${options.symbol} at the end`,
    min: options.min,
    max: 1,
    step: 0.01,
    value: app.scenario[keys.end],
    onChange: (value) => fields.change({ [keys.end]: value }),
  });
  const line = svg("polyline", { class: "rl-spark-line" });
  const drawn = svg("svg", { class: "rl-spark", viewBox: "0 0 96 28", "aria-hidden": true }, line);
  const falling = h("div", { class: "rl-falling" }, fields.add(keys.end, end).element, drawn);
  const over = h("div", { class: "rl-over" }, fields.add(keys.kind, kind).element, falling);
  return {
    element: h("div", { class: "rl-stack" }, fields.add(key, start).element, over),
    refresh(scenario) {
      falling.hidden = scenario[keys.kind] === "constant";
      if (falling.hidden) return;
      const values = scheduleOf(scenario[keys.kind], scenario[key], scenario[keys.end], scenario.episodes);
      line.setAttribute("points", sparkline(values).join(" "));
    },
  };
}

/** Points of a schedule on a field of 96 by 28, from 0 at the bottom to 1 or its highest value at the top. */
function sparkline(values) {
  const high = Math.max(values[0], values[values.length - 1]) || 1;
  return Array.from({ length: POINTS }, (_, i) => {
    const value = values[Math.round((i / (POINTS - 1)) * (values.length - 1))];
    return `${(2 + (92 * i) / (POINTS - 1)).toFixed(1)},${(25 - (22 * value) / high).toFixed(1)}`;
  });
}
