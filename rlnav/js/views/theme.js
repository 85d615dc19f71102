/**
 * Colors: those of the page's theme, and the color maps of rlnav/plot/_look.py.
 */
import { h } from "./dom.js";

const NAMES = [
  "ground", "ink", "muted", "line", "wall", "wall-edge", "floor", "goal", "goal-edge", "robot", "robot-ink", "crash",
  "path", "ghost", "accent", "halo", "series-1", "series-2", "series-3",
];

// Okabe and Ito's colors and dashes for curves, in the order of rl.plot: never the color alone.
export const SERIES = Object.freeze([1, 2, 3, 4, 5, 6, 7].map((k) => `var(--rl-series-${k})`));
export const DASHES = Object.freeze(["", "8 3", "2 3", "9 3 2 3", "5 2 2 2 2 2", "12 3", "4 4"]);

export const UNDER = "#17111f"; // below the range: so far away that it belongs to another story
const VIRIDIS = unpack(
  "481d6f482374482677472c7a46307e453581443983433e854142873f47883e4a893c4f8a3a538b38588c375b8d355f8d" +
    "33638d31678e306a8e2e6e8e2c718e2b748e2a788e287c8e27808e26828e24868e238a8d218e8d21918c1f948c1f988b" +
    "1e9c891f9f881fa28721a68524aa8326ad812ab07f2fb47c35b7793aba7640bd7248c16e4ec36b56c6675ec96267cc5c" +
    "6ece5877d15381d34d8bd64693d7419dd93ba8db34b2dd2dbade28c5e021d0e11cdae319e2e418ece51bf6e620fde725",
);
const BLUE_TO_VERMILION = blend(["#8a3800", "#d55e00", "#f2b48c", "#eeeeee", "#8fc1e3", "#0072b2", "#00416b"], 65);

// The colors of a scale, lowest first; a color is named by its place, so that a view can remember what it drew.
export const SEQUENTIAL = Object.freeze([...VIRIDIS]);
export const DIVERGING = Object.freeze([...BLUE_TO_VERMILION]);
// On a dark ground what is near nothing has to be dark, or it would outshine all that counts.
export const DIVERGING_ON_DARK = Object.freeze(
  blend(["#ffc49a", "#ff8a4a", "#93532f", "#434b54", "#2f6f9c", "#56b4e9", "#c4e6ff"], 65),
);

/** Return the color for t in [0, 1], dark violet to yellow; what is lower is nearly black. */
export function sequential(t) {
  return t < 0 ? UNDER : SEQUENTIAL[place(t, SEQUENTIAL.length)];
}

/** Return the color for t in [0, 1], vermilion over white (at 0.5) to blue. */
export function diverging(t) {
  return DIVERGING[place(t, DIVERGING.length)];
}

/** Return which of n colors stands for t. */
function place(t, n) {
  return Math.min(Math.max(Math.floor(t * n), 0), n - 1);
}

/** Return black or white, whichever is easier to read on a color (#rrggbb or rgb(...)). */
export function readableOn(color) {
  const [red, green, blue] = channels(color).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue < 0.18 ? "#ffffff" : "#000000";
}

function channels(color) {
  if (color.startsWith("#")) return [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16) / 255);
  return color.match(/[\d.]+/g).slice(0, 3).map((c) => Number(c) / 255);
}

function unpack(digits) {
  return digits.match(/.{6}/g).map((color) => `#${color}`);
}

/** Mix n colors from evenly spaced ones. */
function blend(stops, n) {
  const hex = (c) => Math.round(c * 255).toString(16).padStart(2, "0");
  return Array.from({ length: n }, (_, k) => {
    const at = (k / (n - 1)) * (stops.length - 1);
    const i = Math.min(Math.floor(at), stops.length - 2);
    const [from, to] = [channels(stops[i]), channels(stops[i + 1])];
    return `#${from.map((c, j) => hex(c + (to[j] - c) * (at - i))).join("")}`;
  });
}

/** Read the theme's colors where an element stands: { ink: "rgb(31, 41, 51)", ... }. */
export function colorsOf(element) {
  const probe = h("span", { style: { display: "none", forcedColorAdjust: "none" } });
  element.append(probe);
  const read = (name) => {
    probe.style.color = `var(--rl-${name})`;
    return getComputedStyle(probe).color;
  };
  const camel = (name) => name.replace(/-(.)/, (_, letter) => letter.toUpperCase());
  const colors = Object.fromEntries(NAMES.map((name) => [camel(name), read(name)]));
  probe.remove();
  return Object.freeze(colors);
}

/** Call `fn` when the page, JupyterLab or the system goes dark or light, or a print begins or ends. */
export function onThemeChange(element, fn) {
  let before = JSON.stringify(colorsOf(element));
  const look = () => {
    const now = JSON.stringify(colorsOf(element));
    if (now !== before) fn();
    before = now;
  };
  const watcher = new MutationObserver(look);
  const attributeFilter = ["data-theme", "data-jp-theme-light", "class", "style"];
  for (const target of [document.documentElement, document.body]) watcher.observe(target, { attributeFilter });
  const media = ["(prefers-color-scheme: dark)", "(forced-colors: active)", "print"].map((query) => matchMedia(query));
  for (const list of media) list.addEventListener("change", look);
  return () => {
    watcher.disconnect();
    for (const list of media) list.removeEventListener("change", look);
  };
}
