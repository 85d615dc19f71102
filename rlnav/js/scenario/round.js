/**
 * A drive with one and the same turn in every step; rlnav/widgets/_control_tour.py has the same map and limits.
 */
import { fail, integer, items, show } from "../check.js";
import { Pose } from "../robot.js";
import { Task } from "../task.js";
import { GridWorld } from "../world.js";

export const KINDS = Object.freeze([
  "step", "back", "play", "slider", "number", "menu", "box", "map", "again", "lecture",
]);
export const MOST_STEPS = 16;
const MAP = `
.......
.....G.
.##....
.......
....#..
.......
.......
`;

/** The robot's world. */
export function roundTask() {
  return new Task(GridWorld.fromAscii(MAP));
}

/** Return the state, checked. */
export function checkTour({ pose, turn, steps, trail, tried }, task) {
  const place = new Pose(...items("pose", pose, "a pose [x, y, theta]"));
  task.index(place);
  if (task.world.isGoal(place.x, place.y)) fail("pose", "on a free cell away from the star", `${place}`);
  const { steering } = task.robot;
  if (!steering.includes(turn)) fail("turn", `one of ${steering.join(", ")}`, show(turn));
  integer("steps", steps, 0, MOST_STEPS);
  if (typeof trail !== "boolean") fail("trail", "true or false", show(trail), "", TypeError);
  const odd = items("tried", tried, "kinds of controls").find((kind) => !KINDS.includes(kind));
  if (odd !== undefined) fail("tried", `kinds of controls (${KINDS.join(", ")})`, show(odd));
}

/** Drive from a pose, always turning by `turn` degrees, to the end or for a while: the poses, first to last. */
export function drive(task, [x, y, theta], turn) {
  let pose = new Pose(x, y, theta);
  const poses = [plain(pose)];
  while (poses.length <= MOST_STEPS) {
    const { sNext, crash, goal } = task.transition(pose, turn);
    poses.push(crash ? { ...plain(sNext), crashed: true } : plain(sNext));
    if (crash || goal) break;
    pose = sNext;
  }
  return poses;
}

function plain({ x, y, theta }) {
  return { x, y, theta };
}
