/**
 * Designs: what the robot is paid for (rewards) and what it perceives (state features).
 * Mirrors rlnav/designs.py; its classes Payment, Progress, Shaped (eq-shaping) and Total are functions here that return
 * a reward, a function of a Transition, and Nearness one that returns a potential, a function of a Pose.
 */
import { callable, called, cellOf, fail, instance, integer, items, number, show } from "./check.js";
import { Pose } from "./robot.js";

/** Hold what a reward designer sees of one step. */
export class Transition {
  constructor(s, a, sNext, crash, goal) {
    this.s = s;
    this.a = a; // the steering that was applied, in degrees
    this.sNext = sNext; // the pose that the robot drove at if it crashed
    this.crash = crash;
    this.goal = goal;
  }

  toString() {
    const { s, a, sNext, crash, goal } = this;
    return `Transition(s=${s}, a=${a}, sNext=${sNext}, crash=${crash}, goal=${goal})`;
  }
}

// ---------------------------------------------------------------- rewards
/** Pay for how a step ends: the reward of the book unless a chapter says otherwise. */
export function payment({ goal = 10, crash = -10, step = -0.1, turn = 0 } = {}) {
  for (const [name, value] of Object.entries({ goal, crash, step, turn })) number(name, value);
  return (t) => (t.goal ? goal : t.crash ? crash : step) + (turn * Math.abs(t.a)) / 90;
}

/** Pay for every cell by which the robot comes closer, and charge for every cell by which it goes away. */
export function progress(goal, { weight = 1, onlyCloser = false } = {}) {
  const there = cellOf("goal", goal);
  number("weight", weight);
  return (t) => {
    const gain = distance(t.s, there) - distance(t.sNext, there);
    return weight * (onlyCloser && gain < 0 ? 0 : gain);
  };
}

/** Add potential-based shaping to a reward: r + gamma Phi(s') - Phi(s), where an ended episode has no potential. */
export function shaped(reward, potential, gamma) {
  callable("reward", reward, "reward(transition)");
  callable("potential", potential, "potential(pose)");
  number("gamma", gamma, 0, 1);
  return (t) => reward(t) + gamma * (t.crash || t.goal ? 0 : potential(t.sNext)) - potential(t.s);
}

/** A potential that grows towards the goal: minus the straight distance, times the weight. */
export function nearness(goal, weight = 1) {
  const there = cellOf("goal", goal);
  number("weight", weight);
  return (pose) => -weight * distance(pose, there);
}

/** Pay the sum of several rewards. */
export function total(...rewards) {
  for (const reward of rewards) callable("rewards", reward, "reward(transition)");
  return (t) => exactSum(rewards.map((reward) => reward(t)));
}

/** Straight distance from a pose to a cell, in cells. */
export function distance(pose, goal) {
  return Math.sqrt((goal[0] - pose.x) ** 2 + (goal[1] - pose.y) ** 2);
}

/**
 * Sum without rounding on the way, as Python's math.fsum.
 * J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.
 */
export function exactSum(terms) {
  let parts = []; // of ascending size, without common bits: their sum is exact
  for (let x of terms) {
    const next = [];
    for (let y of parts) {
      if (Math.abs(x) < Math.abs(y)) [x, y] = [y, x];
      const high = x + y;
      const low = y - (high - x);
      if (low) next.push(low);
      x = high;
    }
    parts = [...next, x];
  }
  let sum = parts.pop() ?? 0;
  while (parts.length) {
    const x = sum;
    const y = parts.pop();
    sum = x + y;
    const low = y - (sum - x);
    if (!low) continue;
    // half-way cases are rounded by the sign of what is left
    const rest = parts.length ? parts.pop() : 0;
    const up = 2 * low;
    if (rest * low > 0 && up === sum + up - sum) sum += up;
    break;
  }
  return sum;
}

// ---------------------------------------------------------------- state features
/** Name one thing that the robot perceives: a whole number from 0 to levels - 1 at each pose. */
export class Feature {
  constructor(name, levels, of) {
    if (typeof name !== "string") fail("name", "a text", show(name), "", TypeError);
    this.name = name;
    this.levels = typeof levels === "function" ? levels : integer("levels", levels, 1); // levels(world, robot)
    this.of = callable("of", of, "of(pose, world, robot)");
    Object.freeze(this);
  }

  toString() {
    return `Feature('${this.name}')`;
  }

  /** Return the number of levels for this world and robot. */
  size(world, robot) {
    if (typeof this.levels === "number") return this.levels;
    const name = `levels of '${this.name}'`;
    return integer(name, called(name, this.levels, world, robot), 1);
  }

  /** Return the level at a pose, checked. */
  level(pose, world, robot) {
    const level = called(this.name, this.of, pose, world, robot);
    const last = this.size(world, robot) - 1;
    const fits = Number.isInteger(level) && level >= 0 && level <= last;
    return fits ? level : integer(`${this.name} at ${pose}`, level, 0, last);
  }
}

/** Perceive the absolute cell, without the heading. */
export function cell() {
  return new Feature("cell", (world) => world.width * world.height, (pose, world) => pose.y * world.width + pose.x);
}

/** Perceive the heading, eight levels. */
export function heading() {
  return new Feature("heading", 8, (pose) => pose.theta / 45);
}

/** Perceive the signs of dx and dy to the goal: nine levels. */
export function goalDirection() {
  const of = ({ x, y }, world) => 3 * (Math.sign(world.goal[1] - y) + 1) + Math.sign(world.goal[0] - x) + 1;
  return new Feature("goal direction", 9, of);
}

/** Perceive where the goal is as seen from the robot, in equal sectors around it; sector 0 is straight ahead. */
export function goalBearing(sectors = 8) {
  integer("sectors", sectors, 2, 360);
  return new Feature("goal bearing", sectors, (pose, world) => {
    const ahead = degrees(world.goal[0] - pose.x, world.goal[1] - pose.y) - pose.theta;
    const sector = Math.floor(ahead / (360 / sectors) + 0.5) % sectors;
    return sector < 0 ? sector + sectors : sector + 0; // + 0 makes -0 plain
  });
}

/** Perceive in which bin the straight distance to the goal lies; `bins` are the ascending limits, in cells. */
export function goalDistance(bins = [1.5, 3, 6]) {
  const limits = items("bins", bins, "ascending distances").map((limit) => number("bins", limit, 0));
  if (!limits.length || limits.some((limit, i) => i > 0 && limit <= limits[i - 1])) {
    fail("bins", "ascending distances", show(bins));
  }
  const of = (pose, world) => limits.filter((limit) => distance(pose, world.goal) > limit).length;
  return new Feature("goal distance", limits.length + 1, of);
}

/** Perceive which of the moves would crash: one bit an action. */
export function movesAhead() {
  const crashes = (pose, world, robot) =>
    robot.steering.reduce((bits, a, i) => {
      const target = robot.move(pose, a);
      return bits + (world.crash(pose.x, pose.y, target.x, target.y) ? 2 ** i : 0);
    }, 0);
  return new Feature("moves ahead", (_, robot) => 2 ** robot.steering.length, crashes);
}

/** Count the situations that features can tell apart on paper: the product of their levels. */
export function tableRows(features, world, robot) {
  return features.reduce((rows, feature) => rows * feature.size(world, robot), 1);
}

/**
 * Direction of (dx, dy) in degrees, from -180 to 180.
 * Multiples of 45 are exact, and only they can lie on the border of two sectors: no other rational number of degrees
 * has a rational tangent (Niven's theorem).  All others keep a distance that the last bit of atan2 cannot bridge.
 */
function degrees(dx, dy) {
  if (dy === 0) return dx < 0 ? 180 : 0;
  if (dx === 0) return dy < 0 ? -90 : 90;
  if (Math.abs(dx) === Math.abs(dy)) return Math.sign(dy) * (dx < 0 ? 135 : 45);
  return Math.atan2(dy, dx) * (180 / Math.PI);
}
