/**
 * A navigation task: this robot in that world, with a reward and features by design, as an MDP.
 * Mirrors rlnav/task.py.  States are the poses on free cells, cell by cell from the bottom left, eight headings each,
 * and one last state, "crashed".
 */
import { callable, called, fail, instance, integer, items, number } from "./check.js";
import { Feature, payment, tableRows, Transition } from "./designs.js";
import { MDP } from "./mdp.js";
import { HEADINGS, Pose, Robot } from "./robot.js";
import { GridWorld } from "./world.js";

const MOST_ROWS = 10_000_000;

/** Put a robot into a world and say what it is paid for and what it perceives. */
export class Task {
  #index; // the state of each pose, at (y * width + x) * 8 + theta / 45, or -1

  constructor(world, { robot = new Robot(), reward = payment(), features = null, gamma = 0.95 } = {}) {
    this.world = instance("world", world, GridWorld);
    this.robot = instance("robot", robot, Robot);
    this.reward = callable("reward", reward, "reward(transition)");
    this.features = featuresOf(features);
    this.gamma = number("gamma", gamma, 0, 1);
    this.poses = Object.freeze(world.free.flatMap(([x, y]) => HEADINGS.map((theta) => new Pose(x, y, theta))));
    this.crashed = this.poses.length; // the state of a robot that has crashed
    this.#index = new Int32Array(world.width * world.height * HEADINGS.length).fill(-1);
    this.poses.forEach((pose, s) => (this.#index[this.#place(pose)] = s));
    Object.freeze(this);
  }

  /** Return the pose of state `s`, or null for the crashed robot, which has none. */
  pose(s) {
    return this.poses[integer("s", s, 0, this.crashed)] ?? null;
  }

  /** Return the state of a pose on a free cell. */
  index(pose) {
    instance("pose", pose, Pose);
    if (this.world.blocked(pose.x, pose.y)) {
      fail("pose", "on a free cell", `${pose}`, "The cell is an obstacle or outside the grid.");
    }
    return this.#index[this.#place(pose)];
  }

  /** Return what happens when the steering of `a` degrees is applied at a pose. */
  transition(pose, a) {
    const target = this.robot.move(pose, a);
    const crash = this.world.crash(pose.x, pose.y, target.x, target.y);
    return new Transition(pose, a, target, crash, !crash && this.world.isGoal(target.x, target.y));
  }

  /** Build the exact model over poses (eq-dynamics), with one successor an action, or three if the robot slips. */
  mdp() {
    const [S, A, K] = [this.crashed + 1, this.robot.steering.length, this.robot.outcomes(0).length];
    const { to, gain } = this.#applied();
    const outcomes = this.robot.steering.flatMap((_, a) => this.robot.outcomes(a));
    const nextState = new Int32Array(S * A * K);
    const prob = new Float64Array(S * A * K);
    const reward = new Float64Array(S * A * K);
    for (let i = 0; i < nextState.length; i++) {
      const [applied, p] = outcomes[i % (A * K)];
      const from = Math.floor(i / (A * K)) * A + applied;
      nextState[i] = to[from];
      prob[i] = p;
      reward[i] = gain[from];
    }
    const goal = this.#ended();
    const terminal = goal.slice();
    terminal[this.crashed] = 1;
    const start = this.world.starts.map((pose) => this.index(pose));
    return new MDP({ S, A, K, nextState, prob, reward, gamma: this.gamma, terminal, start, goal });
  }

  /** Tabulate what the learner perceives, z = phi[s]; with features, the last row stands for ended episodes. */
  phi() {
    if (this.features === null) return Int32Array.from({ length: this.crashed + 1 }, (_, s) => s);
    const own = typeof this.features === "function";
    const rows = this.poses.map((pose) => (own ? this.#ownRow(pose) : this.#row(pose)));
    const over = own ? rows.reduce((most, z) => Math.max(most, z), 0) + 1 : this.#tableRows();
    const ended = this.#ended();
    return Int32Array.from([...rows, over], (z, s) => (ended[s] ? over : z));
  }

  #tableRows() {
    const rows = tableRows(this.features, this.world, this.robot);
    if (rows > MOST_ROWS) fail("features", `a table of at most ${MOST_ROWS} rows`, `${rows}`, "Perceive less.");
    return rows;
  }

  /** Mixed-radix number of the features' levels. */
  #row(pose) {
    const { world, robot } = this;
    return this.features.reduce((z, f) => z * f.size(world, robot) + f.level(pose, world, robot), 0);
  }

  #ownRow(pose) {
    return integer(`features at ${pose}`, called("features", this.features, pose), 0, MOST_ROWS);
  }

  /** Next state and reward of each steering that is applied, [S * A]. */
  #applied() {
    const A = this.robot.steering.length;
    const to = new Int32Array((this.crashed + 1) * A).fill(this.crashed);
    const gain = new Float64Array(to.length);
    this.poses.forEach((pose, s) => {
      if (this.world.isGoal(pose.x, pose.y)) {
        to.fill(s, s * A, (s + 1) * A);
        return;
      }
      this.robot.steering.forEach((a, i) => {
        const t = this.transition(pose, a);
        to[s * A + i] = t.crash ? this.crashed : this.#index[this.#place(t.sNext)];
        const r = called("reward", this.reward, t);
        gain[s * A + i] = Number.isFinite(r) ? r : number(`reward at ${t}`, r);
      });
    });
    return { to, gain };
  }

  /** 1 in the states on the goal. */
  #ended() {
    const at = new Uint8Array(this.crashed + 1);
    this.poses.forEach(({ x, y }, s) => (at[s] = this.world.isGoal(x, y) ? 1 : 0));
    return at;
  }

  #place({ x, y, theta }) {
    return (y * this.world.width + x) * HEADINGS.length + theta / 45;
  }
}

function featuresOf(features) {
  if (features === null || typeof features === "function") return features;
  const expected = "features(pose), a Feature or a list of Features";
  const list = features instanceof Feature ? [features] : items("features", features, expected);
  list.forEach((feature) => instance("features", feature, Feature));
  if (!list.length) fail("features", "at least one Feature, or null for the whole pose", "none");
  return Object.freeze(list);
}
