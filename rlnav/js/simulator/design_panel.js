/**
 * The design of the task: what the robot perceives, how it can steer, what it is paid for, and how far it looks ahead.
 */
import { choice, button, group, number, slider, toggle } from "../views/controls.js";
import { h } from "../views/dom.js";
import { inBrief } from "./brief.js";
import { changes, Fields } from "./fields.js";
import { perception } from "./perception.js";

const TURNS = [-180, -135, -90, -45, 0, 45, 90, 135, 180];
const SETS = [
  ["-45,0,45", "3: −45 to 45°"],
  ["-90,-45,0,45,90", "5: −90 to 90°"],
  ["-135,-90,-45,0,45,90,135", "7: −135 to 135°"],
  ["own", "your own choice"],
];
const PAYMENTS = [
  ["goal", "Goal", "Paid once, for reaching the goal."],
  ["crash", "Crash", "Paid once, for hitting a wall."],
  ["step", "Step", "Paid for every other step."],
  ["turn", "Turn", "Added for each 90° of a turn."],
  ["progress", "Progress", "Added for each cell that it comes closer, taken off for each that it goes away."],
];

/** Build the group "Design". */
export function designPanel(app) {
  const fields = new Fields(app);
  const perceives = perception(app, fields);
  const steers = steering(fields);
  const pays = payments(fields);
  const looks = discount(fields);
  const panel = group({
    title: "Design",
    children: [
      part("state", "What it perceives", perceives.element),
      part("actions", "How it steers", steers.element),
      part("reward", "What it is paid for", pays.element),
      part("discount", "How far it looks ahead", looks.element),
    ],
  });
  const changed = changes();
  return {
    element: panel.element,
    refresh() {
      fields.refresh();
      perceives.refresh(panel.open);
      if (!changed(app.scenario, app.session)) return;
      steers.refresh();
      pays.refresh();
      looks.refresh(app.scenario.gamma);
      panel.summary(inBrief("design", app.scenario, app.session.own));
    },
  };
}

function part(key, title, ...children) {
  const head = h("h4", { class: "rl-subtitle", text: title });
  return h("section", { class: "rl-part", dataset: { key } }, head, ...children);
}

/** Choose a steering set, or its turns one by one. */
function steering(fields) {
  const { app } = fields;
  const nameOf = (turns) => (SETS.some(([key]) => key === turns.join()) ? turns.join() : "own");
  const choose = (key) => {
    if (key === "own") turns[0].input.focus();
    else fields.change({ steering: key.split(",").map(Number) });
  };
  const set = choice({
    label: "Turns to choose from in each step",
    options: SETS,
    value: nameOf(app.scenario.steering),
    onChange: choose,
  });
  const flip = (a) => {
    const now = app.scenario.steering;
    const next = now.includes(a) ? now.filter((turn) => turn !== a) : [...now, a].sort((p, q) => p - q);
    fields.change({ steering: next });
  };
  const turns = TURNS.map((a) => button({ label: degrees(a), pressed: false, onClick: () => flip(a) }));
  const buttons = turns.map((turn) => turn.element);
  const single = h("div", { class: "rl-turns", role: "group", "aria-label": "Single turns" }, buttons);
  single.dataset.key = "turns";
  const help = h("p", { class: "rl-help", text: "To the left is positive. The robot drives one cell in every step." });
  fields.add("steering", set, (scenario) => nameOf(scenario.steering));
  return {
    element: h("div", { class: "rl-stack" }, set.element, single, help),
    refresh() {
      const now = app.scenario.steering;
      turns.forEach((turn, i) => {
        turn.pressed = now.includes(TURNS[i]);
        turn.disabled(turn.pressed && now.length === 1 ? "The robot needs at least one turn." : "");
      });
    },
  };
}

function degrees(a) {
  return `${a < 0 ? "−" : a > 0 ? "+" : ""}${Math.abs(a)}°`;
}

/** Set the terms of the reward. */
function payments(fields) {
  const { app } = fields;
  const set = (key) => (value) => fields.edit((s) => ({ ...s, reward: { ...s.reward, [key]: value } }));
  const field = (key, label, help) => {
    const step = key === "step" ? 0.1 : 1;
    const control = number({ label, help, step, value: app.scenario.reward[key], onChange: set(key) });
    return fields.add(`reward_${key}`, control, (s) => s.reward[key]).element;
  };
  const onlyCloser = toggle({
    label: "Forget to charge for going away",
    help: "A classic mistake: the robot can earn without end by driving to and fro.",
    value: false,
    onChange: set("only_closer"),
  });
  const mistake = h("div", {}, fields.add("reward_only_closer", onlyCloser, (s) => s.reward.only_closer).element);
  const shaping = field(
    "shaping",
    "Potential shaping",
    "Adds γΦ(s′) − Φ(s); Φ is minus this weight times the distance to the goal. The best policy stays the same.",
  );
  const fixed = PAYMENTS.map((payment) => field(...payment));
  const terms = h("div", { class: "rl-fields" }, ...fixed, mistake, shaping);
  const note = h("p", { class: "rl-help", text: "The reward is a function of your own, in Python." });
  return {
    element: h("div", {}, note, terms),
    refresh() {
      mistake.hidden = app.scenario.reward.progress === 0 && !app.scenario.reward.only_closer;
      terms.hidden = app.session.own.includes("reward");
      note.hidden = !terms.hidden;
    },
  };
}

/** Set gamma, with its horizon in words. */
function discount(fields) {
  const words = h("p", { class: "rl-help", role: "status" });
  const tell = (gamma) => (words.textContent = horizon(gamma));
  const gamma = slider({
    label: "Discount γ",
    min: 0,
    max: 1,
    step: 0.01,
    value: fields.app.scenario.gamma,
    onInput: tell,
    onChange: (value) => fields.change({ gamma: value }),
  });
  return { element: h("div", { class: "rl-stack" }, fields.add("gamma", gamma).element, words), refresh: tell };
}

function horizon(gamma) {
  if (gamma === 1) return "All that is to come counts in full, however late.";
  if (gamma === 0) return "Only the very next reward counts.";
  const steps = Number((1 / (1 - gamma)).toPrecision(3));
  return `Looks about ${steps} steps ahead: 1 / (1 − ${gamma}).`;
}
