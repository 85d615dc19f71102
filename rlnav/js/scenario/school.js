/**
 * A school for tables: learning on one map or on many, one after the other, and an exam on maps never seen before.
 */
import { endsOf } from "../evaluation.js";
import { Learner } from "../learning.js";
import { generator } from "../rng.js";
import { finish, Slices } from "../slices.js";
import { Task } from "../task.js";
import { randomMap } from "./edits.js";
import { planning } from "./exact.js";
import { algorithmOf, learnerOptions, taskOf } from "./model.js";
import { driveFrom, policyOf } from "./trial.js";

export const MAPS = 20; // to learn on, and as many for the exam
const EXAM = 1000; // the seed of its first map
const SIDE = 10;
const DENSITY = 0.2;
const AT_A_TIME = 512; // steps of learning between two looks at the clock

/** A map with its model and the best that is possible on it; what does not depend on features is made once. */
class Ground {
  #best = null;

  constructor(scenario) {
    this.scenario = scenario;
    this.task = taskOf({ ...scenario, features: null });
    this.mdp = this.task.mdp();
  }

  /** { V, Q, pi } */
  get best() {
    this.#best ??= finish(planning(this.mdp));
    return this.#best;
  }

  /** How drives from all starts end with a policy: { success, crash, timeout, steps }. */
  *ends(pi) {
    return yield* endsOf(this.mdp, pi, this.scenario.max_steps);
  }

  /** How many of all drives can arrive. */
  get possible() {
    this.reachable ??= finish(this.ends(this.best.pi)).success;
    return this.reachable;
  }

  /** The rows that the robot perceives in its states; null for the whole pose. */
  phi(features) {
    const { world, robot } = this.task;
    return new Task(world, { robot, features }).phi();
  }

  /** Starts from which the goal can be reached, from the farthest to the nearest. */
  get starts() {
    const { V } = this.best;
    const good = Array.from(this.mdp.start).filter((s) => V[s] > 0);
    return (good.length ? good : [this.mdp.start[0]]).sort((s, t) => V[s] - V[t]);
  }

  /** The drive of a policy from one of these starts: 0 is the farthest, and each next one is a good deal nearer. */
  drive(pi, i) {
    const { starts, task, mdp } = this;
    const s = starts[Math.floor((starts.length * ((i * 0.381966) % 1)))]; // the golden ratio spreads them
    return driveFrom(task, mdp, pi, task.pose(s), this.scenario.max_steps);
  }
}

/** All maps of a school: home, those to learn on, and those of the exam. */
export class Grounds {
  #made = new Map();

  /** `scenario` gives the home map, the robot and its reward. */
  constructor(scenario) {
    this.scenario = { ...scenario, starts: null };
    this.home = new Ground(this.scenario);
  }

  /** The random map with a seed, as `rl.maps.random(10, density=0.2, rng=seed)` draws it. */
  random(seed) {
    const { map } = randomMap({ width: SIDE, density: DENSITY, seed });
    if (!this.#made.has(seed)) this.#made.set(seed, new Ground({ ...this.scenario, map }));
    return this.#made.get(seed);
  }

  /** The maps to learn on. */
  lesson(i) {
    return this.random(i);
  }

  /** The maps of the exam. */
  unseen(i) {
    return this.random(EXAM + i);
  }
}

/** One robot that goes to school: it learns, and is then examined at home and on the unseen maps. */
export class School {
  /** `variety` is "one", to learn at home, or "many"; `features` perceive, null the whole pose, which stays at home. */
  constructor(scenario, features, grounds, variety) {
    Object.assign(this, { scenario, features, grounds, variety });
    this.episode = 0; // episodes that are over
    this.Q = null; // the table, once it is learned
    this.home = null; // { success, crash, timeout, steps } of the exam at home
    this.away = null; // mean success on the unseen maps
    this.work = new Slices(this.#attend());
  }

  get done() {
    return this.work.done;
  }

  /** Go on for a while; return whether there is more to do. */
  slice(milliseconds) {
    return this.work.run(milliseconds);
  }

  /** The greedy policy of the table on a map. */
  policy(ground) {
    return policyOf(this.Q, ground.mdp.A, ground.phi(this.features));
  }

  *#attend() {
    const { scenario, grounds, variety } = this;
    const many = variety === "many";
    const rng = generator(scenario.seed);
    const episodes = many ? Math.max(1, Math.floor(scenario.episodes / MAPS)) : scenario.episodes;
    let Q0 = scenario.Q0;
    for (let i = 0; i < (many ? MAPS : 1); i++) {
      const ground = many ? grounds.lesson(i) : grounds.home;
      const options = { ...learnerOptions({ ...scenario, episodes }), rng, Q0 };
      const learner = new Learner(ground.mdp, ground.phi(this.features), algorithmOf(scenario), options);
      const before = this.episode;
      while (!learner.done) {
        learner.run(AT_A_TIME);
        this.episode = before + learner.episode;
        yield;
      }
      Q0 = learner.Q.slice();
    }
    this.Q = Q0;
    this.home = yield* grounds.home.ends(this.policy(grounds.home));
    if (this.features) this.away = yield* this.#exam();
  }

  *#exam() {
    const { grounds } = this;
    let [sum, possible] = [0, 0];
    for (let i = 0; i < MAPS; i++) {
      const ground = grounds.unseen(i);
      yield;
      sum += (yield* ground.ends(this.policy(ground))).success;
      yield;
      possible += ground.possible;
      yield;
    }
    return { success: sum / MAPS, possible: possible / MAPS };
  }
}
