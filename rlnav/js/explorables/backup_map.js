/**
 * The map beside a backup diagram: the value of every pose, to pick one, and the places that a node speaks of.
 */
import { scaleOf } from "../scenario/wave.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { keysOf } from "./map_cursor.js";
import { poseInWords } from "./naming.js";

export class BackupMap {
  /** `onPose({ x, y, theta }, first)` hears the poses of a press, `onTurn(by)` a turn by so many degrees. */
  constructor(parent, { onPose, onTurn }) {
    this.onPose = onPose;
    const keys = keysOf({
      enter: ({ x, y }) => onPose({ x, y, theta: this.pose.theta }, true),
      l: () => onTurn(45),
      r: () => onTurn(-45),
    });
    this.grid = new GridView(parent, {
      label: "Map with the value of every pose. Arrow keys move, Enter picks the cell, L and R turn.",
      onCell: (event) => this.press(event),
      onKey: (event) => keys(event, this.grid),
    });
    this.legend = new Legend(parent);
  }

  destroy() {
    this.grid.destroy();
  }

  /** Take the values of a policy. */
  show(task, V, label) {
    this.task = task;
    this.rings = ringsOf(task, V);
    this.scale = scaleOf(this.rings.filter((v) => !Number.isNaN(v)));
    this.legend.draw({ ...this.scale, label });
  }

  /** A press picks the cell, and the heading of the sector that is pressed. */
  press({ type, x, y, theta, button }) {
    if ((type !== "down" && type !== "move") || button > 0) return;
    this.grid.cursor = [x, y];
    this.onPose({ x, y, theta }, type === "down");
  }

  /** Draw the root's pose, and light up the place of a node: the way to it and all that may follow. */
  draw(node, levels, pose) {
    const { width, height, obstacles, goal } = this.task.world;
    if (!this.pose) this.grid.cursor = [pose.x, pose.y];
    this.pose = pose;
    const ways = this.waysTo(node, levels);
    const marks = ways.map((way) => way.at(-1)).map((end) => ({ ...end, kind: end.crashed ? "cross" : "ring" }));
    this.grid.draw({
      width, height, obstacles, goal, rings: this.rings, scale: this.scale, path: ways[0] ?? null, marks,
      robot: { x: pose.x, y: pose.y, theta: pose.theta },
    });
    this.grid.describe(`The robot is at ${poseInWords(pose)}.`);
  }

  /** The poses along the branches to a node, and on to what may follow an action; the likeliest first. */
  waysTo(node, levels) {
    const passed = levels.slice(1).filter(({ kind }) => kind === "state");
    const begun = [this.pose, ...passed.map((state) => this.placeOf(state, levels))];
    if (node.kind === "state") return begun.length > 1 ? [begun] : [];
    const likely = node.children.toSorted((a, b) => b.probability - a.probability);
    return likely.map((child) => [...begun, this.placeOf(child, [...levels, child])]);
  }

  /** The pose of a state; for the crashed robot, half the way to what it ran into. */
  placeOf(state, levels) {
    const pose = this.task.pose(state.s);
    if (pose) return { x: pose.x, y: pose.y, theta: pose.theta };
    const { robot } = this.task;
    const action = levels[levels.indexOf(state) - 1];
    const from = this.task.pose(action.s);
    const [applied] = robot.outcomes(action.a)[state.ks[0]];
    const to = robot.move(from, robot.steering[applied]);
    return { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2, theta: to.theta, crashed: true };
  }
}

/** The values of all poses, by cell and heading; nothing at the goal, where the episode is over. */
function ringsOf({ world, poses }, V) {
  const rings = new Float64Array(world.width * world.height * 8).fill(NaN);
  poses.forEach(({ x, y, theta }, s) => {
    if (!world.isGoal(x, y)) rings[(y * world.width + x) * 8 + theta / 45] = V[s];
  });
  return rings;
}
