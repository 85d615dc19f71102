/**
 * The state of the simulator as text, there and back: as the end of an address, `#map=maze&algorithm=sarsa&lecture=1`,
 * which holds only what differs from the defaults, and as JSON.  Any text can be read: what cannot be used becomes a
 * plain message, and the rest counts.
 */
import { fail, show } from "../check.js";
import { checkView } from "../simulator/view.js";
import { readMap, readStarts, writeMap, writeStarts } from "./drawn.js";
import { PRESETS, presetOf } from "./edits.js";
import { checkScenario, DEFAULTS } from "./scenario.js";

const VERSION = 1; // of the JSON
const LONGEST_ADDRESS = 20_000; // characters: a map of 30 x 30 in its longest form has some 1,800
const LONGEST_FILE = 1_000_000;
const MOST_MESSAGES = 4;
const VIEW = checkView({});
const TEXTS = ["algorithm", "alpha_schedule", "epsilon_schedule"];
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

// ---------------------------------------------------------------- the address

/** Write a state as the end of an address, "" if it is the default. */
export function toAddress({ scenario: raw, view: seen = {} }) {
  const scenario = checkScenario(raw);
  const parts = [...worldParts(scenario)];
  for (const [key, standard] of Object.entries({ ...DEFAULTS, ...DEFAULTS.reward })) {
    if (["map", "starts", "reward"].includes(key)) continue;
    const value = Object.hasOwn(DEFAULTS, key) ? scenario[key] : scenario.reward[key];
    if (!same(value, standard)) parts.push([key, key === "features" ? writeFeatures(value) : write(value)]);
  }
  for (const [key, value] of Object.entries(checkView(seen))) {
    if (!same(value, VIEW[key])) parts.push([key, key === "panels" ? JSON.stringify(value) : write(value)]);
  }
  return parts.length ? `#${parts.map(([key, text]) => `${key}=${escaped(text)}`).join("&")}` : "";
}

/** Read the end of an address; the result is { state: { scenario, view }, messages }. */
export function fromAddress(hash) {
  if (hash.length > LONGEST_ADDRESS) return { state: complete({}), messages: ["This address is too long to be read."] };
  const messages = [];
  const state = { scenario: {}, view: {} };
  for (const [key, text] of inOrder(hash.replace(/^#/, "").split("&").filter(Boolean))) {
    try {
      take(state, key, unescaped(text));
    } catch (error) {
      messages.push(error.message);
    }
  }
  return { state: complete(state), messages: few(messages) };
}

/** A map before its starts, and what belongs to a schedule before its kind: nothing is refused because of the order. */
function inOrder(parts) {
  const rank = (key) => (key === "map" ? 0 : key.endsWith("_schedule") ? 2 : 1);
  const pairs = parts.map((part) => [part.split("=", 1)[0], part.slice(part.indexOf("=") + 1 || part.length)]);
  return pairs.sort(([a], [b]) => rank(a) - rank(b));
}

/** Take one part of an address into a state; raises, and leaves the state, if it cannot be. */
function take(state, key, text) {
  if (Object.hasOwn(VIEW, key)) {
    state.view = { ...checkView({ ...state.view, [key]: readView(key, text) }) };
    return;
  }
  const patch = readPart(key, text, state.scenario);
  checkScenario({ ...state.scenario, ...patch });
  Object.assign(state.scenario, patch);
}

function readPart(key, text, { reward }) {
  if (key === "map") return readWorld(text);
  if (key === "starts") return { starts: readStarts(text) };
  if (key === "steering") return { steering: text.split(",").map((a) => readNumber(key, a)) };
  if (key === "features") return { features: readFeatures(text) };
  if (key === "only_closer") return { reward: { ...reward, only_closer: readFlag(key, text) } };
  if (Object.hasOwn(DEFAULTS.reward, key)) return { reward: { ...reward, [key]: readNumber(key, text) } };
  if (TEXTS.includes(key)) return { [key]: text };
  if (Object.hasOwn(DEFAULTS, key) && key !== "reward") return { [key]: readNumber(key, text) };
  return fail("address", "made of settings of the simulator", show(key), "This part is left out.");
}

function readView(key, text) {
  if (typeof VIEW[key] === "boolean") return readFlag(key, text);
  if (key === "hide") return text.split(",").filter(Boolean);
  if (key !== "panels") return text;
  try {
    return JSON.parse(text);
  } catch {
    return fail(key, "whole JSON", show(text), "A part of it was cut off or changed on its way.");
  }
}

/** The map and the starts: the name of a preset if they are its own. */
function worldParts({ map, starts }) {
  const name = presetOf({ map, starts });
  if (name) return same(PRESETS[name].map, DEFAULTS.map) ? [] : [["map", name]];
  const sameMap = Object.keys(PRESETS).find((preset) => same(PRESETS[preset].map, map));
  return [["map", sameMap ?? writeMap(map)], ["starts", writeStarts(starts)]];
}

function readWorld(text) {
  return Object.hasOwn(PRESETS, text) ? { ...PRESETS[text] } : { map: readMap(text), starts: null };
}

/** `goal_bearing:8,goal_distance:1.5:3,moves_ahead`; `pose` stands for the whole pose. */
function writeFeatures(features) {
  return features === null ? "pose" : features.map((feature) => [feature].flat(2).join(":")).join(",");
}

function readFeatures(text) {
  if (text === "pose") return null;
  return text.split(",").map((feature) => {
    const [name, ...given] = feature.split(":");
    if (!given.length) return name;
    const numbers = given.map((n) => readNumber("features", n));
    return [name, name === "goal_distance" ? numbers : numbers.length === 1 ? numbers[0] : numbers];
  });
}

function write(value) {
  return typeof value === "boolean" ? String(Number(value)) : String(value);
}

function readNumber(key, text) {
  return NUMBER.test(text) ? Number(text) : fail(key, "a number", show(text));
}

function readFlag(key, text) {
  return ["0", "1"].includes(text) ? text === "1" : fail(key, "0 or 1", show(text));
}

function escaped(text) {
  return encodeURIComponent(text).replaceAll("%2C", ",").replaceAll("%3A", ":");
}

function unescaped(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return fail("address", "whole", show(text), "A part of it was cut off or changed on its way.");
  }
}

// ---------------------------------------------------------------- JSON

/** Write a state as JSON, to be kept in a file. */
export function toText({ scenario, view = {} }) {
  return `${JSON.stringify({ rlnav: VERSION, scenario: checkScenario(scenario), view: checkView(view) }, null, 2)}\n`;
}

/** Read a state from JSON; raises one plain error for a text that is no state. */
export function fromText(text) {
  if (text.length > LONGEST_FILE) fail("settings", `at most ${LONGEST_FILE} characters`, `${text.length} of them`);
  const { rlnav, ...state } = parsed(text);
  if (rlnav !== VERSION) {
    const got = rlnav === undefined ? "no version" : `version ${show(rlnav)}`;
    fail("settings", `of version ${VERSION}`, got, "They come from another program or version.");
  }
  const strange = Object.keys(state).find((key) => !["scenario", "view"].includes(key));
  if (strange !== undefined) fail("settings", "a scenario and a view", show(strange));
  return complete(state);
}

function parsed(text) {
  let value = null;
  try {
    value = JSON.parse(text);
  } catch {
    fail("settings", "whole JSON, as this page saves it", show(text.trim()), "It was cut off or changed on its way.");
  }
  if (value === null || typeof value !== "object" || Array.isArray(value)) {
    fail("settings", "a JSON object, as this page saves it", show(value));
  }
  return value;
}

// ---------------------------------------------------------------- both
function complete({ scenario = {}, view = {} }) {
  return { scenario: checkScenario(scenario), view: checkView(view) };
}

function few(messages) {
  const more = messages.length - MOST_MESSAGES;
  if (more <= 0) return messages;
  return [...messages.slice(0, MOST_MESSAGES), `${more} more parts of the address could not be read.`];
}

function same(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
