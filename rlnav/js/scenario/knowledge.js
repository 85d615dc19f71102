/**
 * What a table says about every pose: one number for each at (y * width + x) * 8 + theta / 45, NaN on obstacles.
 * Computed once, until the table moves on.
 */
import { greedy } from "../mdp.js";
import { HEADINGS } from "../robot.js";
import { firstBest, largest } from "../sampling.js";
import { policyOf } from "./trial.js";

export class Knowledge {
  #known = new Map(); // name -> { updates, value }
  #exact = null; // the exact values with which errors were computed

  constructor(task, mdp, phi, learner) {
    Object.assign(this, { task, mdp, phi, learner });
    const { width, height } = task.world;
    this.states = new Int32Array(width * height * HEADINGS.length).fill(-1);
    task.poses.forEach((pose, s) => (this.states[this.#place(pose)] = s));
  }

  /** The greedy policy, for the states of the model. */
  policy() {
    return this.now("policy", () => policyOf(this.learner.Q, this.mdp.A, this.phi));
  }

  /** max_a Q: what the robot expects. */
  values() {
    return this.#perPose("values", (z) => largest(this.learner.Q, z, this.mdp.A));
  }

  /** How often an action was tried there; with features, at all poses that look alike. */
  visits() {
    const { learner, mdp } = this;
    return this.#perPose("visits", (z) => {
      let sum = 0;
      for (let i = z * mdp.A; i < (z + 1) * mdp.A; i++) sum += learner.visits[i];
      return sum;
    });
  }

  /** The best turn, in degrees. */
  turns() {
    const best = this.now("best", () => greedy(this.learner.Q, this.mdp.A));
    return this.#perPose("turns", (z) => this.task.robot.steering[best[z]]);
  }

  /** max_a |Q - q*|: how far the table is from exact values [S * A]. */
  errors(exact) {
    const { learner, mdp } = this;
    if (this.#exact !== exact) this.#known.delete("errors");
    this.#exact = exact;
    return this.#perPose("errors", (z, s) => {
      let most = 0;
      for (let a = 0; a < mdp.A; a++) most = Math.max(most, Math.abs(learner.Q[z * mdp.A + a] - exact[s * mdp.A + a]));
      return most;
    });
  }

  /** All about one pose, with one number for each action: { s, z, Q, exact, visits, best }; null on an obstacle. */
  inspect(pose, exact) {
    const s = this.task.world.blocked(pose.x, pose.y) ? -1 : this.states[this.#place(pose)];
    if (s < 0) return null;
    const { A } = this.mdp;
    const z = this.phi[s];
    const row = (array, at) => Array.from(array.subarray(at * A, (at + 1) * A));
    const { Q, visits } = this.learner;
    return { s, z, Q: row(Q, z), exact: row(exact, s), visits: row(visits, z), best: firstBest(Q, z, A) };
  }

  /** Compute something once, until the table moves on. */
  now(name, compute) {
    const { updates } = this.learner;
    if (this.#known.get(name)?.updates !== updates) this.#known.set(name, { updates, value: compute() });
    return this.#known.get(name).value;
  }

  #perPose(name, of) {
    return this.now(name, () => {
      const { states, phi } = this;
      const numbers = new Float64Array(states.length).fill(NaN);
      for (let i = 0; i < states.length; i++) if (states[i] >= 0) numbers[i] = of(phi[states[i]], states[i]);
      return numbers;
    });
  }

  #place({ x, y, theta }) {
    return (y * this.task.world.width + x) * HEADINGS.length + theta / 45;
  }
}
