/**
 * The picture of a mixed reward: where the best policy leads from every pose, and the drive from one of them.
 */
import { FATES, placeAt } from "../scenario/mixer.js";
import { h } from "../views/dom.js";
import { DIVERGING, DIVERGING_ON_DARK } from "../views/theme.js";

const SHADE = 0.45; // of full color: the drive above it has to stand out
const WORDS = [["goal", "arrives"], ["circle", "circles for ever"], ["crash", "crashes"]];

/** Return what GridView draws after t steps of the drive, of which the last is done by the part `at`. */
export function drawn({ task, fates, drive, start, mdp }, t, at) {
  const { width, height, obstacles, goal } = task.world;
  const rings = new Float64Array(width * height * 8).fill(NaN);
  task.poses.forEach(({ x, y, theta }, s) => {
    if (!mdp.terminal[s]) rings[(y * width + x) * 8 + theta / 45] = SHADE * fates[s];
  });
  const place = placeAt(drive, t);
  const { crashed = false, ...now } = drive.poses[place];
  const from = t > 0 ? drive.poses[place - 1] : null;
  const scale = { low: -1, high: 1, diverging: true };
  const robot = { ...now, from, at, crashed };
  return { width, height, obstacles, goal, rings, scale, path: drive.poses, selected: plain(start), robot };
}

/** Return the key to the colors, with the share of poses that each of them has. */
export function fateKey({ fates, mdp }) {
  const live = fates.filter((_, s) => !mdp.terminal[s]);
  return WORDS.map(([fate, words]) => {
    const count = live.filter((one) => one === FATES[fate]).length;
    const k = Math.floor(((SHADE * FATES[fate] + 1) / 2) * DIVERGING.length);
    const background = `light-dark(${DIVERGING[k]}, ${DIVERGING_ON_DARK[k]})`;
    return h("span", {}, h("i", { style: { background } }), ` ${words} (${count} poses)`);
  });
}

function plain({ x, y, theta }) {
  return { x, y, theta };
}
