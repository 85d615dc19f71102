/**
 * How the simulator is looked at, as plain data: nothing here changes what is learned.
 */
import { fail, show } from "../check.js";

// key -> what it may be, with its words in the menus
export const CHOICES = Object.freeze({
  color: [
    ["value", "Value"],
    ["visits", "Visits"],
    ["error", "Error of Q"],
    ["none", "Nothing"],
  ],
  glyph: [
    ["ring", "Rings"],
    ["needles", "Best turns"],
    ["none", "Whole cells"],
  ],
  path: [
    ["auto", "Shown"],
    ["learned", "Learned"],
    ["episode", "This episode"],
    ["none", "Hidden"],
  ],
  speed: [
    ["auto", "Ever faster"],
    ["1", "1 step/s"],
    ["4", "4 steps/s"],
    ["15", "15 steps/s"],
    ["100", "100 steps/s"],
    ["2000", "2,000 steps/s"],
    ["max", "Full speed"],
  ],
});

const DEFAULTS = Object.freeze({
  color: "value",
  glyph: "ring",
  path: "auto",
  speed: "auto",
  numbers: false,
  lecture: false,
  hide: Object.freeze([]),
  panels: Object.freeze({}),
});
const FIRST = 8; // steps a second at which the robot begins
const DOUBLES = 0.62; // seconds in which it becomes twice as fast
const RUSH = 60_000; // steps a second from which on there is no use in counting them

/** Return the complete view; raise for a setting that does not exist. */
export function checkView(raw) {
  if (raw === null || typeof raw !== "object" || Array.isArray(raw)) {
    fail("view", "an object of settings", show(raw), "", TypeError);
  }
  for (const [key, value] of Object.entries(raw)) {
    const known = Object.keys(DEFAULTS);
    if (!known.includes(key)) fail("view", `made of ${known.join(", ")}`, `the key ${show(key)}`);
    checkSetting(key, value);
  }
  return Object.freeze({ ...DEFAULTS, ...raw });
}

function checkSetting(key, value) {
  const allowed = CHOICES[key]?.map(([name]) => name);
  if (allowed && !allowed.includes(value)) fail(key, `one of ${allowed.join(", ")}`, show(value));
  if (typeof DEFAULTS[key] === "boolean" && typeof value !== "boolean") fail(key, "true or false", show(value));
  const names = Array.isArray(value) && value.every((name) => typeof name === "string" && /^[\w-]+$/.test(name));
  if (key === "hide" && !names) fail(key, "a list of names of parts", show(value));
  if (key === "panels" && !isFlat(value)) fail(key, "an object of texts, numbers and flags", show(value));
}

/** Whether a value is an object that holds plain values only. */
function isFlat(value) {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return false;
  return Object.values(value).every((item) => ["string", "number", "boolean"].includes(typeof item));
}

/** Return how many steps a second a speed means, some seconds after the start. */
export function rateOf(speed, seconds) {
  if (speed === "max") return Infinity;
  if (speed !== "auto") return Number(speed);
  const rate = FIRST * 2 ** Math.min(seconds / DOUBLES, 30);
  return rate > RUSH ? Infinity : rate;
}
