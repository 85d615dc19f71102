/**
 * A robot with hidden buttons in a hidden world, driven by hand; rlnav/widgets/_mystery_robot.py hides the same.
 */
import { fail, integer, items, show } from "../check.js";
import { endsOf } from "../evaluation.js";
import { randomWorld } from "../maps.js";
import { solve } from "../planning.js";
import { Robot } from "../robot.js";
import { generator } from "../rng.js";
import { rollout } from "../rollouts.js";
import { drawSuccessor } from "../sampling.js";
import { finish } from "../slices.js";
import { Task } from "../task.js";
import { GridWorld } from "../world.js";
import { posesOf } from "./trial.js";

export const BUTTONS = "ABCDE";
export const LEVELS = Object.freeze({ free: [0, 0], obstacles: [0.15, 0], slip: [0.1, 0.2] }); // density, slip
export const SEEN = Object.freeze(["map", "numbers"]);
export const SIDE = 7; // cells along one side
export const MOST_DRIVES = 200;
const MOST_STEPS = 200;
const NEAR = 9.55; // a start from which the best score is higher is too near: the goal is less than six steps away

/** Return the state, checked; the drives themselves are checked where they are made again. */
export function checkMystery({ seed, level, see, drives, revealed, max_steps: maxSteps }) {
  integer("seed", seed, 0);
  integer("max_steps", maxSteps, 1, MOST_STEPS);
  oneOf("level", level, Object.keys(LEVELS));
  oneOf("see", see, SEEN);
  if (typeof revealed !== "boolean") fail("revealed", "true or false", show(revealed), "", TypeError);
  const letters = items("drives", drives, "texts of the letters A to E");
  const odd = letters.find((drive) => typeof drive !== "string" || !/^[A-E]*$/.test(drive));
  if (odd !== undefined) fail("drives", "texts of the letters A to E", show(odd));
  if (letters.length > MOST_DRIVES) fail("drives", `at most ${MOST_DRIVES} drives`, String(letters.length));
}

export class Mystery {
  #chance;
  #solved = null;

  /** Hide everything, and press again what was pressed before. */
  constructor({ seed, level, drives = [], max_steps: maxSteps }) {
    const { task, turns, names, luck } = hide(level, seed);
    Object.assign(this, { task, mdp: task.mdp(), turns, names, maxSteps });
    this.start = this.mdp.start[0];
    this.#chance = generator(luck);
    this.drives = [];
    drives.forEach((letters, i) => {
      this.begin();
      for (const letter of letters) if (!this.press(letter)) this.#tooLong(letters, i + 1);
    });
    if (!drives.length) this.begin();
  }

  #tooLong(letters, number) {
    const got = `${letters.length} presses in drive ${number}, which ended after ${this.drive.rewards.length}`;
    fail("drives", "drives of which each stops where the robot does", got);
  }

  /** Put the robot back on its start. */
  begin() {
    this.drives.push({ letters: "", states: [this.start], actions: [], rewards: [], score: 0, end: "" });
  }

  /** The drive that is under way, or was the last. */
  get drive() {
    return this.drives.at(-1);
  }

  get s() {
    return this.drive.states.at(-1);
  }

  get over() {
    return this.drive.end !== "";
  }

  /** Press a button; return whether the robot was still under way. */
  press(letter) {
    if (this.over) return false;
    const { mdp, drive } = this;
    const a = this.turns[BUTTONS.indexOf(letter)];
    const place = drawSuccessor(mdp, this.s, a, this.#chance.random());
    drive.letters += letter;
    drive.states.push(mdp.nextState[place]);
    drive.actions.push(a);
    drive.rewards.push(mdp.reward[place]);
    drive.score += mdp.reward[place];
    drive.end = this.#endOf(drive);
    return true;
  }

  #endOf({ rewards }) {
    if (this.mdp.goal[this.s]) return "goal";
    if (this.s === this.task.crashed) return "crash";
    return rewards.length >= this.maxSteps ? "time" : "";
  }

  /** Drives that have ended. */
  get finished() {
    return this.drives.filter(({ end }) => end !== "");
  }

  /** The number of the drive with the best score, counted from 0, or -1. */
  get bestNumber() {
    const scores = this.drives.map(({ end, score }) => (end === "" ? -Infinity : score));
    const best = Math.max(...scores);
    return best === -Infinity ? -1 : scores.indexOf(best);
  }

  /** The poses of a drive; the last is the one that the robot drove at if it crashed. */
  posesOf({ states, actions }) {
    return posesOf(this.task, states, actions.at(-1));
  }

  /** What a reader with a good memory knows: cells that were seen, the last crashes, whether the goal was found. */
  get memory() {
    const seen = new Uint8Array(SIDE * SIDE);
    const crashes = [];
    for (const drive of this.drives) {
      const poses = this.posesOf(drive);
      if (drive.end === "crash") crashes.push([poses.at(-2), poses.pop()]);
      for (const { x, y } of poses) seen[y * SIDE + x] = 1;
    }
    const [x, y] = this.task.world.goal;
    return { seen, crashes, goal: seen[y * SIDE + x] === 1 };
  }

  /** What the last press of a button in a state has led to: a state, or null where it was never tried. */
  outcome(s, letter) {
    let found = null;
    for (const { states, letters } of this.drives) {
      for (let t = 0; t < letters.length; t++) if (states[t] === s && letters[t] === letter) found = states[t + 1];
    }
    return found;
  }

  /** What is revealed: the steering of each button, the best score, its drive when nothing slips, and chance's. */
  get answer() {
    this.#solved ??= solved(this);
    return this.#solved;
  }
}

function solved({ task, mdp, start, turns, maxSteps }) {
  const { V, pi } = solve(mdp, { tol: 1e-10 });
  const sure = new Task(task.world, { gamma: 1 });
  const { states, actions } = rollout(sure.mdp(), pi, { start, rng: 0 });
  const atRandom = new Float64Array(mdp.S * mdp.A).fill(1 / mdp.A);
  return {
    steering: turns.map((a) => task.robot.steering[a]),
    score: V[start],
    steps: actions.length,
    poses: posesOf(sure, states, actions.at(-1)),
    byChance: finish(endsOf(mdp, atRandom, maxSteps)).success,
  };
}

/** Hide a goal, obstacles and the meaning of the buttons, by chance. */
function hide(level, seed) {
  const levels = Object.keys(LEVELS);
  const chance = generator(levels.length * seed + levels.indexOf(level)); // each level has its own
  const [density, slip] = LEVELS[level];
  let world = null;
  let starts = [];
  while (!starts.length) {
    world = randomWorld(SIDE, SIDE, { density, rng: chance });
    starts = fairStarts(new Task(world, { gamma: 1 }));
  }
  const start = starts[Math.floor(chance.random() * starts.length)];
  const obstacles = [];
  world.obstacles.forEach((wall, i) => wall && obstacles.push([i % SIDE, Math.floor(i / SIDE)]));
  const hidden = new GridWorld(SIDE, SIDE, { goal: world.goal, obstacles, starts: [start] });
  const task = new Task(hidden, { robot: new Robot({ slip }), gamma: 1 });
  const turns = shuffled(BUTTONS.length, chance);
  const names = shuffled(task.poses.length + 1, chance);
  return { task, turns, names, luck: Math.floor(chance.random() * 2 ** 32) };
}

/** Poses from which the goal is not near, and can still be reached after any first press. */
function fairStarts(task) {
  const mdp = task.mdp();
  const { V } = solve(mdp);
  const worst = (s) => Math.min(...Array.from({ length: mdp.A }, (_, a) => V[mdp.nextState[s * mdp.A + a]]));
  return task.poses.filter((_, s) => V[s] > 0 && V[s] < NEAR && worst(s) > 0); // a crashed robot is worth 0
}

/** Return 0 ... n - 1 in an order by chance (Fisher and Yates). */
function shuffled(n, chance) {
  const order = Array.from({ length: n }, (_, i) => i);
  for (let i = n - 1; i > 0; i--) {
    const j = Math.floor(chance.random() * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

function oneOf(name, value, options) {
  if (!options.includes(value)) fail(name, `one of ${options.join(", ")}`, show(value));
}
