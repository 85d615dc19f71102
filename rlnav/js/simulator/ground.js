/**
 * The drawing of a scenario as the map wants it.
 */
import { goalOf } from "../scenario/scenario.js";

/** Whether a cell of the drawing is an obstacle. */
export function isWall({ map }, x, y) {
  return map[map.length - 1 - y][x] === "#";
}

/** Read the drawing as arrays: { width, height, obstacles, goal, starts }. */
export function groundOf(scenario) {
  const { map, starts } = scenario;
  const [width, height] = [map[0].length, map.length];
  const wall = (_, i) => (isWall(scenario, i % width, Math.floor(i / width)) ? 1 : 0);
  return {
    width,
    height,
    obstacles: Uint8Array.from({ length: width * height }, wall),
    goal: goalOf(scenario),
    starts: starts && starts.map(([x, y, theta]) => ({ x, y, theta })),
  };
}
