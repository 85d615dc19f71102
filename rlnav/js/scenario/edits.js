/**
 * Drawing: functions from a scenario to a new one, or a plain error.  What cannot run for the moment may be drawn.
 */
import { fail, integer } from "../check.js";
import { CLIFF, CORRIDOR, FREE_SPACE, MAZE, OBSTACLES, randomWorld, ROOMS } from "../maps.js";
import { HEADINGS } from "../robot.js";
import { GridWorld } from "../world.js";
import { checkScenario, goalOf, isInside, SIDES } from "./scenario.js";

const DRAWINGS = {
  free_space: FREE_SPACE,
  obstacles: OBSTACLES,
  rooms: ROOMS,
  corridor: CORRIDOR,
  maze: MAZE,
  cliff: CLIFF,
};

// name -> { map, starts }, to be merged into a scenario
export const PRESETS = Object.freeze(
  Object.fromEntries(Object.entries(DRAWINGS).map(([name, drawing]) => [name, partOf(GridWorld.fromAscii(drawing))])),
);

/** Make a cell an obstacle, or free. */
export function paint(scenario, x, y, wall) {
  checkInside(scenario, x, y);
  if (wall) checkNeither(scenario, x, y);
  const [gx, gy] = goalOf(scenario);
  return gx === x && gy === y ? scenario : changed(scenario, { map: withSymbol(scenario.map, x, y, wall ? "#" : ".") });
}

/** Put the goal on a free cell. */
export function moveGoal(scenario, x, y) {
  checkInside(scenario, x, y);
  const [gx, gy] = goalOf(scenario);
  if (gx === x && gy === y) return scenario;
  checkFree("goal", scenario, x, y);
  if (isStart(scenario, x, y)) fail("goal", "a free cell", `(${x}, ${y}), the start`, "Move the start first.");
  return changed(scenario, { map: withSymbol(withSymbol(scenario.map, gx, gy, "."), x, y, "G") });
}

/** Let the robot start at { x, y, theta }, with any heading if `theta` is null; or anywhere, if there is no pose. */
export function moveStart(scenario, pose) {
  if (pose === null) return changed(scenario, { starts: null });
  const { x, y, theta = null } = pose;
  return changed(scenario, { starts: (theta === null ? HEADINGS : [theta]).map((heading) => [x, y, heading]) });
}

/** Change the size of the world; cells keep their places, and a goal or start that is cut off moves to the border. */
export function resize(scenario, width, height) {
  integer("width", width, SIDES.least, SIDES.most);
  integer("height", height, SIDES.least, SIDES.most);
  const inside = ([x, y]) => [Math.min(x, width - 1), Math.min(y, height - 1)];
  const [gx, gy] = inside(goalOf(scenario));
  const starts = scenario.starts?.map(([x, y, theta]) => [...inside([x, y]), theta]) ?? [];
  const kept = starts.filter(([x, y]) => x !== gx || y !== gy);
  const old = [...scenario.map].reverse(); // row y at place y
  const rows = Array.from({ length: height }, (_, y) => (old[y] ?? "").replace("G", ".").padEnd(width, "."));
  let map = withSymbol(rows.map((row) => row.slice(0, width)).reverse(), gx, gy, "G");
  for (const [x, y] of kept) map = withSymbol(map, x, y, ".");
  return changed(scenario, { map, starts: kept.length ? kept : null });
}

/** Draw a random world as { map, starts }: the same for the same seed, and as `rl.maps.random` draws it. */
export function randomMap({ width = 10, height = width, density = 0.2, seed = 0 } = {}) {
  integer("width", width, SIDES.least, SIDES.most);
  integer("height", height, SIDES.least, SIDES.most);
  return partOf(randomWorld(width, height, { density, rng: seed }));
}

/** Name the preset that a scenario shows, or null. */
export function presetOf({ map, starts }) {
  const same = (preset) => JSON.stringify(preset) === JSON.stringify({ map, starts });
  return Object.keys(PRESETS).find((name) => same(PRESETS[name])) ?? null;
}

function partOf(world) {
  const rows = String(world).replaceAll(/[S<>^v]/g, ".").split("\n");
  const everywhere = !/[S<>^v]/.test(String(world));
  const starts = everywhere ? null : world.starts.map(({ x, y, theta }) => [x, y, theta]);
  const checked = checkScenario({ map: rows, starts });
  return Object.freeze({ map: checked.map, starts: checked.starts });
}

function changed(scenario, patch) {
  return checkScenario({ ...scenario, ...patch });
}

function withSymbol(map, x, y, symbol) {
  const at = map.length - 1 - y;
  return map.map((row, i) => (i === at ? row.slice(0, x) + symbol + row.slice(x + 1) : row));
}

function isStart({ starts }, x, y) {
  return starts !== null && starts.some(([sx, sy]) => sx === x && sy === y);
}

function checkInside(scenario, x, y) {
  if (isInside(scenario, integer("x", x), integer("y", y))) return;
  fail("cell", `inside the ${scenario.map[0].length} x ${scenario.map.length} grid`, `(${x}, ${y})`);
}

function checkFree(name, { map }, x, y) {
  if (map[map.length - 1 - y][x] !== "#") return;
  fail(name, "a free cell", `(${x}, ${y}), an obstacle`, "Erase the obstacle first.");
}

function checkNeither(scenario, x, y) {
  const [gx, gy] = goalOf(scenario);
  const what = gx === x && gy === y ? "goal" : isStart(scenario, x, y) ? "start" : "";
  if (!what) return;
  fail("obstacle", "neither on the goal nor on the start", `(${x}, ${y}), the ${what}`, `Move the ${what} first.`);
}
