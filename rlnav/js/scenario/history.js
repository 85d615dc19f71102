/**
 * Is what the robot perceives enough? The forecast of the next observation, without and with what was perceived before:
 * where the two differ, the past helps, and the present is no state. The robot begins in any pose and steers at random.
 */
import { drawSuccessor } from "../sampling.js";

export const SAME = 1e-9; // forecasts that differ by less are equal
export const PERCEPTIONS = ["cell", "heading", "pose"];

export class History {
  /** `perceive` is one of PERCEPTIONS; ended episodes are perceived as what they are, in every case. */
  constructor(task, mdp, perceive) {
    Object.assign(this, { task, mdp });
    this.live = Array.from({ length: mdp.S }, (_, s) => s).filter((s) => !mdp.terminal[s]);
    const { width, height } = task.world;
    this.goal = width * height * 8; // the observation of a robot that has arrived ...
    this.crash = this.goal + 1; // ... and of one that has crashed
    const of = ({ x, y, theta }) => {
      const cell = y * width + x;
      return perceive === "cell" ? cell : perceive === "heading" ? theta / 45 : cell * 8 + theta / 45;
    };
    const seen = (pose, s) => (mdp.terminal[s] ? this.goal : of(pose));
    this.phi = Int32Array.from([...task.poses.map(seen), this.crash]);
    this.steps = this.#firstSteps();
    this.groups = new Map(); // observation -> the first steps that lead to it
    for (const step of this.steps) {
      const o = this.phi[step.s];
      (this.groups.get(o) ?? this.groups.set(o, []).get(o)).push(step);
    }
  }

  /** All first steps that do not end the episode: { before, s, weight }, from any pose by any action. */
  #firstSteps() {
    const { A, K, nextState, prob, terminal } = this.mdp;
    const steps = [];
    for (const before of this.live) {
      const weights = new Map();
      for (let j = before * A * K; j < (before + 1) * A * K; j++) {
        const s = nextState[j];
        if (!terminal[s] && prob[j] > 0) weights.set(s, (weights.get(s) ?? 0) + prob[j]);
      }
      for (const [s, weight] of weights) steps.push({ before, s, weight: weight / (this.live.length * A) });
    }
    return steps;
  }

  /** The poses that look like state s. */
  alike(s) {
    return this.live.filter((other) => this.phi[other] === this.phi[s]);
  }

  /**
   * Forecast what follows action `a` where the robot perceives what it perceives in state s: { all, rows, most }. `all`
   * and each row, one for each earlier observation `h`, have { weight, poses: state -> chance, next: observation ->
   * chance, apart }; `apart` is how far the row is from `all`, and `most` the largest of these: 0 where the past is of
   * no use.
   */
  forecast(s, a) {
    const steps = this.groups.get(this.phi[s]) ?? [];
    const parts = new Map();
    for (const step of steps) {
      const h = this.phi[step.before];
      (parts.get(h) ?? parts.set(h, []).get(h)).push(step);
    }
    const anywhere = this.alike(s).map((one) => ({ s: one, weight: 1 })); // where no step leads, it can only begin
    const all = this.#mixture(steps.length ? steps : anywhere, a);
    const rows = [...parts].map(([h, part]) => ({ h, ...this.#mixture(part, a) }));
    for (const row of rows) row.apart = apart(row.next, all.next);
    rows.sort((p, q) => q.weight - p.weight || p.h - q.h);
    return { all, rows, most: rows.reduce((most, row) => Math.max(most, row.apart), 0) };
  }

  #mixture(steps, a) {
    const { A, K, nextState, prob } = this.mdp;
    const weight = steps.reduce((sum, step) => sum + step.weight, 0);
    const [poses, next] = [new Map(), new Map()];
    for (const step of steps) add(poses, step.s, step.weight / weight);
    for (const [s, chance] of poses) {
      for (let j = (s * A + a) * K; j < (s * A + a + 1) * K; j++) {
        if (prob[j] > 0) add(next, this.phi[nextState[j]], chance * prob[j]);
      }
    }
    return { weight, poses, next, apart: 0 };
  }

  /** Count the situations, an observation with an action, and those of them in which the past helps. */
  count() {
    const first = new Map(this.live.map((s) => [this.phi[s], s]).reverse());
    let helped = 0;
    for (const s of first.values()) {
      for (let a = 0; a < this.mdp.A; a++) helped += this.forecast(s, a).most > SAME ? 1 : 0;
    }
    return { helped, of: first.size * this.mdp.A };
  }

  /** Draw two steps, of which the first leads to where state s is perceived: { before, s, next, h }, or null. */
  draw(s, a, chance) {
    const steps = this.groups.get(this.phi[s]) ?? [];
    const total = steps.reduce((sum, step) => sum + step.weight, 0);
    const [u, luck] = [chance.random(), chance.random()];
    let left = u * total;
    const found = steps.find((step) => (left -= step.weight) < 0) ?? steps.at(-1);
    if (!found) return null;
    const next = this.mdp.nextState[drawSuccessor(this.mdp, found.s, a, luck)];
    return { ...found, next, h: this.phi[found.before] };
  }
}

/** How far two distributions are from each other: the largest difference that they give to any event. */
function apart(p, q) {
  let sum = 0;
  for (const o of new Set([...p.keys(), ...q.keys()])) sum += Math.abs((p.get(o) ?? 0) - (q.get(o) ?? 0));
  return sum / 2;
}

function add(map, key, amount) {
  map.set(key, (map.get(key) ?? 0) + amount);
}
