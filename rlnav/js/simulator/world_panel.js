/**
 * The world: which map, how large, where the robot starts, the tools that draw on it, and how much the robot slips.
 */
import { moveStart, PRESETS, randomMap, resize } from "../scenario/edits.js";
import { SIDES } from "../scenario/scenario.js";
import { button, choice, group, number, segmented, slider } from "../views/controls.js";
import { h } from "../views/dom.js";
import { changes, Fields } from "./fields.js";

const TOOLS = [
  ["none", "Look"],
  ["wall", "Obstacle"],
  ["free", "Erase"],
  ["goal", "Goal"],
  ["start", "Start"],
];
const USES = {
  none: "Drag the star or the robot's start to move them; pick a tool to draw.",
  wall: "Press or drag on the map to put obstacles.",
  free: "Press or drag on the map to take obstacles away.",
  goal: "Press on the map where the goal is to be.",
  start: "Press on the map where the robot is to start.",
};
const HEADINGS = ["→ 0°", "↗ 45°", "↑ 90°", "↖ 135°", "← 180°", "↙ 225°", "↓ 270°", "↘ 315°"];
const DENSITY = 0.2;

/** Build the group "World". */
export function worldPanel(app) {
  const fields = new Fields(app);
  const map = maps(fields);
  const size = sides(fields);
  const takeUp = (tool) => app.setTool(tool);
  const tools = segmented({ label: "On the map", options: TOOLS, value: app.tool, onChange: takeUp });
  tools.element.dataset.key = "tool";
  const use = h("p", { class: "rl-help" });
  const start = starts(fields);
  const slip = slider({
    label: "Slip",
    min: 0,
    max: 1,
    step: 0.05,
    value: app.scenario.slip,
    help: "Chance that the robot turns one notch more or less than it wants to.",
    onChange: (value) => fields.change({ slip: value }),
  });
  const trouble = h("p", { class: "rl-sign", role: "alert" });
  const drawing = h("div", { class: "rl-stack" }, tools.element, use);
  const children = [trouble, map.element, size, drawing, start.element, fields.add("slip", slip)];
  const panel = group({ title: "World", children });
  const changed = changes();
  return {
    element: panel.element,
    refresh() {
      if (tools.value !== app.tool) tools.value = app.tool;
      if (use.textContent !== USES[app.tool]) use.textContent = USES[app.tool];
      fields.refresh();
      if (!changed(app.scenario, app.trouble)) return;
      trouble.hidden = app.trouble === "";
      trouble.textContent = app.trouble;
      start.refresh();
      map.refresh();
      const { map: rows, slip: slips } = app.scenario;
      panel.summary(`${map.name}, ${rows[0].length} × ${rows.length}${slips ? `, slip ${slips}` : ""}`);
    },
  };
}

const isMap = (rows, others) => rows.join() === others.join();

/** Choose a map of the book, or a random one by its density and seed. */
function maps(fields) {
  const { app } = fields;
  const presets = Object.entries(PRESETS);
  const chance = { density: DENSITY, seed: 0 };
  let random = null; // the rows that were drawn last
  const nameNow = () => {
    const { map } = app.scenario;
    if (random && isMap(map, random)) return "random";
    return presets.find(([, preset]) => isMap(map, preset.map))?.[0] ?? "own";
  };
  const scatter = (patch) => {
    Object.assign(chance, patch);
    fields.edit((scenario) => {
      const [width, height] = [scenario.map[0].length, scenario.map.length];
      const drawn = randomMap({ width, height, ...chance });
      random = drawn.map;
      return { ...scenario, ...drawn };
    });
  };
  const choose = (name) => {
    if (name === "random") scatter({});
    else if (name === "own") app.setTool("wall");
    else fields.change({ map: PRESETS[name].map, starts: PRESETS[name].starts });
    app.refresh();
  };
  const options = [...presets.map(([name]) => [name, inWords(name)]), ["random", "Random"], ["own", "Your own"]];
  const menu = choice({ label: "Map", options, value: nameNow(), onChange: choose });
  const density = slider({
    label: "Obstacles",
    min: 0,
    max: 0.6,
    step: 0.05,
    value: chance.density,
    help: "Share of the cells that are walls.",
    onChange: (value) => scatter({ density: value }),
  });
  const seed = number({
    label: "Map seed",
    min: 0,
    max: Number.MAX_SAFE_INTEGER,
    step: 1,
    value: chance.seed,
    onChange: (value) => scatter({ seed: value }),
  });
  const another = button({ label: "Another map", onClick: () => scatter({ seed: chance.seed + 1 }) });
  fields.add("density", density, () => chance.density);
  fields.add("map_seed", seed, () => chance.seed);
  const draw = h("div", { class: "rl-pair" }, seed.element, another.element);
  const dice = h("div", { class: "rl-stack" }, density.element, draw);
  return {
    element: h("div", { class: "rl-stack" }, fields.add("map", menu, nameNow).element, dice),
    get name() {
      return inWords(nameNow());
    },
    refresh: () => (dice.hidden = nameNow() !== "random"),
  };
}

/** "free space" or "free_space" -> "Free space". */
export function inWords(name) {
  const words = name.replaceAll("_", " ");
  return words === "own" ? "Your own" : words[0].toUpperCase() + words.slice(1);
}

/** Width and height, in cells. */
function sides(fields) {
  const { app } = fields;
  const side = (key, label, read, change) => {
    const limits = { min: SIDES.least, max: SIDES.most, step: 1 };
    const onChange = (n) => fields.edit((s) => change(s, n));
    const control = number({ label, ...limits, value: read(app.scenario), onChange });
    return fields.add(key, control, read).element;
  };
  const width = side("width", "Width", (s) => s.map[0].length, (s, n) => resize(s, n, s.map.length));
  const height = side("height", "Height", (s) => s.map.length, (s, n) => resize(s, s.map[0].length, n));
  return h("div", { class: "rl-pair" }, width, height);
}

/** Where the robot starts: anywhere, or in one place with one heading or any. */
function starts(fields) {
  const { app } = fields;
  const kindOf = ({ starts: poses }) => (poses ? "place" : "anywhere");
  const kind = segmented({
    label: "Every episode starts",
    options: [["anywhere", "Anywhere"], ["place", "In one place"]],
    value: kindOf(app.scenario),
    onChange: (value) => fields.edit((s) => moveStart(s, value === "anywhere" ? null : firstStart(app))),
  });
  const headingOf = ({ starts: poses }) => (poses?.length === 1 ? String(poses[0][2]) : "any");
  const turn = (value) =>
    fields.edit((s) => {
      const [x, y] = s.starts[0];
      return moveStart(s, { x, y, theta: value === "any" ? null : Number(value) });
    });
  const options = [["any", "Any heading"], ...HEADINGS.map((text, i) => [String(45 * i), text])];
  const heading = choice({ label: "Heading at the start", options, value: headingOf(app.scenario), onChange: turn });
  const which = h("div", {}, fields.add("heading", heading, headingOf).element);
  return {
    element: h("div", { class: "rl-stack" }, fields.add("start", kind, kindOf).element, which),
    refresh: () => (which.hidden = app.scenario.starts === null),
  };
}

/** A pose to begin with: where the robot stands now, or else the first that there is. */
function firstStart({ session }) {
  const { pose } = session.robot;
  return pose && !session.world.isGoal(pose.x, pose.y) ? pose : session.world.starts[0];
}
