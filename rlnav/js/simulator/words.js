/**
 * The map in words, for those who listen to it.
 */
import { goalOf } from "../scenario/scenario.js";
import { isWall } from "./ground.js";

/** Say how a turn is called: "45° to the left", "straight on". */
export function turnInWords(a) {
  if (a === 0) return "straight on";
  return `${Math.abs(a)}° to the ${a > 0 ? "left" : "right"}`;
}

const COMPASS = ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];

/** Say where a heading points: "north-east, 45°". */
export function headingInWords(theta) {
  return `${COMPASS[theta / 45]}, ${theta}°`;
}

/** Describe the whole map in a few sentences. */
export function ofMap({ scenario, session, trouble }) {
  const rows = scenario.map;
  const walls = rows.join("").split("#").length - 1;
  const [gx, gy] = goalOf(scenario);
  const size = `${rows[0].length} by ${rows.length} cells, ${walls} of them obstacles, the goal at (${gx}, ${gy}).`;
  if (trouble) return `${size} ${trouble}`;
  const { x, y, theta } = session.pose;
  return `${size} The robot is at (${x}, ${y}) and looks ${headingInWords(theta)}.`;
}

/** Describe the cell and heading that the keyboard's cursor is on. */
export function atCursor({ scenario, session, arena }, { x, y, theta }) {
  const where = `(${x}, ${y})`;
  if (isWall(scenario, x, y)) return `${where}: obstacle`;
  if (String(goalOf(scenario)) === `${x},${y}`) return `${where}: goal`;
  if (!arena.isPose({ x, y })) return `${where}: free`;
  const i = (y * session.world.width + x) * 8 + theta / 45;
  const visits = session.visitsPerPose()[i];
  const pose = `${where}, heading ${headingInWords(theta)}`;
  if (!visits) return `${pose}: never visited`;
  const value = session.valuesPerPose()[i].toFixed(2);
  return `${pose}: value ${value}, best turn ${turnInWords(session.turnsPerPose()[i])}`;
}
