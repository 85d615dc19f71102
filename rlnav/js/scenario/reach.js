/**
 * Where a robot can be next, and after a few steps: the fan of its moves, and all poses that it can reach.
 */
import { endsOf } from "../evaluation.js";
import { MDP } from "../mdp.js";
import { Robot } from "../robot.js";
import { finish } from "../slices.js";
import { Task } from "../task.js";

const DEGREE = Math.PI / 180;

/** Where the exact arc of a drive is after a `part` of it: the robot turns evenly by `a` degrees on a way of 1. */
export function arcAt({ x, y, theta }, a, part) {
  const [from, turn] = [theta * DEGREE, a * DEGREE];
  if (a === 0) return [x + part * Math.cos(from), y + part * Math.sin(from)];
  const now = from + turn * part;
  return [x + (Math.sin(now) - Math.sin(from)) / turn, y - (Math.cos(now) - Math.cos(from)) / turn];
}

/**
 * The moves of a robot from a pose: { a, point, to, crash, goal } for each turn. `point` is where the formula puts it
 * before it is snapped to the grid; `crash` says what it hits: "edge", "obstacle", "corner", or "".
 */
export function fanOf({ world, robot }, pose) {
  return robot.steering.map((a) => {
    const to = robot.move(pose, a);
    const direction = (pose.theta + a / 2) * DEGREE;
    const point = [pose.x + Math.cos(direction), pose.y + Math.sin(direction)];
    const crash = whatIsHit(world, pose, to);
    return { a, point, to, crash, goal: !crash && world.isGoal(to.x, to.y) };
  });
}

function whatIsHit(world, from, to) {
  if (!world.crash(from.x, from.y, to.x, to.y)) return "";
  if (!world.blocked(to.x, to.y)) return "corner";
  return to.x < 0 || to.y < 0 || to.x >= world.width || to.y >= world.height ? "edge" : "obstacle";
}

/** The chance of each turn if the robot is told to take the one with index `a`: as many numbers as there are turns. */
export function chancesOf(robot, a) {
  const chances = robot.steering.map(() => 0);
  for (const [applied, p] of robot.outcomes(a)) chances[applied] += p;
  return chances;
}

/** All poses that can be reached from one; slips change nothing here, for a slip is another turn of the same set. */
export class Reach {
  constructor({ world, robot }, pose) {
    this.task = new Task(world, { robot: new Robot({ steering: robot.steering }) });
    this.mdp = this.task.mdp();
    this.start = this.task.index(pose);
    this.steps = new Int32Array(this.mdp.S).fill(-1); // in which step a state is reached first; -1: never
    this.before = new Int32Array(this.mdp.S).fill(-1); // the state from which that was
    this.counts = []; // { poses, cells } that are reached within k steps
    this.#spread();
  }

  /** Go on from the poses that were reached last, until nothing is new: breadth first. */
  #spread() {
    const { A, nextState, terminal } = this.mdp;
    const order = Array.from({ length: A }, (_, a) => a).sort((a, b) => this.#turn(a) - this.#turn(b));
    const cells = new Set();
    let [frontier, poses] = [[this.start], 0];
    this.steps[this.start] = 0;
    for (let k = 1; frontier.length; k++) {
      for (const s of frontier) cells.add(Math.floor(s / 8));
      poses += frontier.length;
      this.counts.push({ poses, cells: cells.size });
      const next = [];
      for (const s of frontier) {
        for (const a of terminal[s] ? [] : order) {
          const to = nextState[s * A + a];
          if (this.steps[to] >= 0 || to === this.task.crashed) continue;
          [this.steps[to], this.before[to]] = [k, s];
          next.push(to);
        }
      }
      frontier = next;
    }
  }

  /** How sharp a turn is: of several shortest ways the one that goes straight on is found first. */
  #turn(a) {
    return Math.abs(this.task.robot.steering[a]);
  }

  /** { poses, cells } that are reached within k steps, the first pose included. */
  within(k) {
    return this.counts[Math.min(k, this.counts.length - 1)];
  }

  /** Steps to the goal; Infinity if it cannot be reached. */
  get toGoal() {
    return this.steps.reduce((least, k, s) => (this.mdp.goal[s] && k >= 0 ? Math.min(least, k) : least), Infinity);
  }

  /** The states at the goal that are reached first. */
  get arrival() {
    return this.steps.findIndex((k, s) => this.mdp.goal[s] && k === this.toGoal);
  }

  /** A shortest way to a state, as poses; null if there is none. */
  wayTo(s) {
    if (s < 0 || this.steps[s] < 0) return null;
    const way = [];
    for (let here = s; here >= 0; here = this.before[here]) way.unshift(this.task.pose(here));
    return way;
  }

  /** How all ways to steer k times end: { success, crash, timeout } as shares, as of a robot that steers at random. */
  ends(k) {
    const { S, A } = this.mdp;
    const mdp = new MDP({ ...this.mdp, start: [this.start] });
    return finish(endsOf(mdp, new Float64Array(S * A).fill(1 / A), k));
  }

  /** The crashes of step k: moves { from, to } out of poses that are first reached in step k - 1. */
  crashes(k) {
    const { task, mdp, steps } = this;
    const found = new Map();
    steps.forEach((when, s) => {
      if (when !== k - 1 || mdp.terminal[s]) return;
      for (const { to, crash } of fanOf(task, task.pose(s))) {
        const { x, y } = task.pose(s);
        if (crash) found.set(`${x} ${y} ${to.x} ${to.y}`, { from: task.pose(s), to });
      }
    });
    return [...found.values()];
  }
}
