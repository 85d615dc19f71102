/**
 * A run as Python: the lines that give the same table, to the last bit.  What is the library's default is left out.
 */
import { GridWorld } from "../world.js";
import { presetOf } from "./edits.js";
import { worldOf } from "./model.js";
import { checkScenario, DEFAULTS } from "./scenario.js";
import { factorOf } from "./schedule.js";

const WIDEST = 100; // characters of a line
const MAX_STEPS = 200; // the library's default
const OWN = "own"; // a design that is a function of the reader's own

/** Write the lines for a scenario; `own` names designs that are functions of the reader's own: "reward", "features". */
export function asPython(raw, own = []) {
  const scenario = checkScenario(raw);
  const task = taskLines(scenario, own);
  const learner = learnerLines(scenario, own);
  const numpy = learner.some((line) => line.includes("np.")) ? ["import numpy as np", ""] : [];
  const lines = [...numpy, "import rlnav as rl", "", ...task, "", ...learner, "", ...resultLines(scenario, own), ""];
  return lines.join("\n");
}

// ---------------------------------------------------------------- the task
function taskLines(scenario, own) {
  const { steering, slip, gamma, features } = scenario;
  const turns = same(steering, DEFAULTS.steering) ? "" : tuple(steering);
  const robot = call("rl.Robot", [turns, slip ? `slip=${slip}` : ""]);
  const reward = own.includes("reward") ? OWN : rewardOf(scenario);
  const designs = own.includes("features") ? OWN : featuresOf(features);
  const given = [
    "world",
    robot === "rl.Robot()" ? "" : robot,
    reward ? "reward=reward" : "",
    designs ? "features=features" : "",
    gamma === DEFAULTS.gamma ? "" : `gamma=${gamma}`,
  ];
  return [
    ...worldLines(scenario),
    ...designLines("reward", reward),
    ...designLines("features", designs),
    ...wrapped(`task = ${call("rl.Task", given)}`),
    isWhole(scenario, own) ? "mdp = task.mdp()" : "mdp, phi = task.mdp(), task.phi()",
  ];
}

/** The world as its drawing; starts that a drawing cannot show are put into it. */
function worldLines(scenario) {
  const preset = presetOf(scenario);
  if (preset) return [`world = rl.GridWorld.from_ascii(rl.maps.${preset.toUpperCase()})`];
  const world = worldOf(scenario);
  const drawn = GridWorld.fromAscii(String(world));
  if (same(drawn.starts, world.starts)) return drawingLines("world", String(world));
  const starts = world.starts.map(({ x, y, theta }) => `rl.Pose(${x}, ${y}, ${theta})`);
  return [
    ...drawingLines("drawn", scenario.map.join("\n")),
    ...wrapped(`starts = [${starts.join(", ")}]`),
    "world = rl.GridWorld(drawn.width, drawn.height, drawn.goal, drawn.obstacles, starts)",
  ];
}

function drawingLines(name, drawing) {
  return [`${name} = rl.GridWorld.from_ascii("""`, ...drawing.split("\n"), '""")'];
}

/** "" for the default reward. */
function rewardOf({ reward, gamma }) {
  const terms = ["goal", "crash", "step", "turn"].filter((name) => reward[name] !== DEFAULTS.reward[name]);
  const payment = call("rl.designs.Payment", terms.map((name) => `${name}=${reward[name]}`));
  const progress = call("rl.designs.Progress", [
    "world.goal",
    reward.progress === 1 ? "" : `weight=${reward.progress}`,
    reward.only_closer ? "only_closer=True" : "",
  ]);
  const played = reward.progress ? `rl.designs.Total(${payment}, ${progress})` : payment;
  if (!reward.shaping) return played === "rl.designs.Payment()" ? "" : played;
  const nearness = call("rl.designs.Nearness", ["world.goal", reward.shaping === 1 ? "" : `weight=${reward.shaping}`]);
  return `rl.designs.Shaped(${played}, ${nearness}, gamma=${gamma})`;
}

/** "" for the whole pose. */
function featuresOf(features) {
  if (features === null) return "";
  const made = features.map((feature) => {
    const [name, ...given] = typeof feature === "string" ? [feature] : feature;
    return `rl.designs.${name}(${given.map(tuple).join(", ")})`;
  });
  return `[${made.join(", ")}]`;
}

/** The line that makes a design: none for the default, a remark for a function of the reader's own. */
function designLines(name, design) {
  if (design === OWN) return [`# ${name} is a function of your own, defined above`];
  return design ? wrapped(`${name} = ${design}`) : [];
}

// ---------------------------------------------------------------- the learner
function learnerLines(scenario, own) {
  const { algorithm, episodes, max_steps, Q0, seed } = scenario;
  const rates = ["alpha", "epsilon"].map((name) => scheduleOf(scenario, name));
  const given = [
    "mdp",
    isWhole(scenario, own) ? "" : "phi",
    `episodes=${episodes}`,
    ...rates.map(({ given: text }) => text),
    max_steps === MAX_STEPS ? "" : `max_steps=${max_steps}`,
    `rng=${seed}`,
    Q0 ? `Q0=${Q0}` : "",
  ];
  return [...rates.flatMap(({ lines }) => lines), ...wrapped(`run = ${call(`rl.${algorithm}`, given)}`)];
}

/** A rate as an argument, and the line that makes its schedule: the same operations in the same order as scheduleOf. */
function scheduleOf(scenario, name) {
  const { [name]: start, [`${name}_end`]: end, [`${name}_schedule`]: kind, episodes } = scenario;
  const last = episodes - 1;
  if (kind === "constant" || last === 0) return { lines: [], given: `${name}=${start}` };
  const rate = {
    linear: () => `np.linspace(${start}, ${end}, ${episodes})`,
    harmonic: () => `${start} / (1 + (${start} / ${end} - 1) * np.arange(${episodes}) / ${last})`,
    exponential: () => `np.cumprod([${start}] + ${last} * [${factorOf(start, end, episodes)}])`,
  }[kind]();
  return { lines: [`${name} = ${end > start ? `np.minimum(${rate}, 1)` : rate}`], given: `${name}=${name}` };
}

// ---------------------------------------------------------------- the result
function resultLines(scenario, own) {
  const [pi, V] = isWhole(scenario, own) ? ["run.pi", "run.Q.max(axis=1)"] : ["run.pi[phi]", "run.Q.max(axis=1)[phi]"];
  const limit = scenario.max_steps === MAX_STEPS ? "" : `, max_steps=${scenario.max_steps}`;
  // without a discount, a policy that drives on for ever has no value
  const score = scenario.gamma < 1 ? `rl.evaluate(mdp, ${pi}${limit})` : "run";
  return [
    `print(${score})`,
    `ax = rl.plot.values(task, ${V})`,
    `rl.plot.path(task, rl.rollout(mdp, ${pi}${limit}, rng=0), ax)`,
  ];
}

/** Whether the table has one row for each pose. */
function isWhole({ features }, own) {
  return features === null && !own.includes("features");
}

function call(name, args) {
  return `${name}(${args.filter(Boolean).join(", ")})`;
}

/** A line, or as many as it takes: what the outermost brackets hold on a line of its own, or each piece of it. */
function wrapped(line, indent = "") {
  const open = line.search(/[[(]/);
  if (indent.length + line.length <= WIDEST || open < 0) return [indent + line];
  const [head, tail] = [indent + line.slice(0, open + 1), indent + line.slice(line.endsWith(",") ? -2 : -1)];
  const inside = line.slice(open + 1, line.endsWith(",") ? -2 : -1);
  const deeper = `${indent}    `;
  if (deeper.length + inside.length <= WIDEST) return [head, deeper + inside, tail];
  return [head, ...pieces(inside).flatMap((piece) => wrapped(`${piece},`, deeper)), tail];
}

/** Write a list as Python's tuple; what is no list, as it is. */
function tuple(x) {
  return Array.isArray(x) ? `(${x.join(", ")}${x.length > 1 ? "" : ","})` : `${x}`;
}

/** Cut at the commas that no brackets hold together. */
function pieces(text) {
  const parts = [""];
  let depth = 0;
  for (const letter of text) {
    depth += "[(".includes(letter) ? 1 : "])".includes(letter) ? -1 : 0;
    if (letter === "," && depth === 0) parts.push("");
    else parts[parts.length - 1] += letter;
  }
  return parts.map((part) => part.trim());
}

function same(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
