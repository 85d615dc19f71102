/**
 * A run that Python has sent, as tables after some of its episodes: a learner that jumps from one to the next.
 */
import { fail } from "../check.js";
import { unpackAll } from "../views/arrays.js";

export class Playback {
  /** Raises if the tables have another shape than this model and state design need. */
  constructor(training, mdp, phi, Q0 = 0) {
    const { episodes, snapshots, returns, steps, success } = unpackAll(training);
    const size = (phi.reduce((most, z) => Math.max(most, z), 0) + 1) * mdp.A;
    if (!episodes.length || snapshots.length !== episodes.length * size) {
      fail("training", `tables of ${size} numbers, as this task needs`, `${snapshots.length / episodes.length}`);
    }
    Object.assign(this, { mdp, phi, A: mdp.A, Q0, snapshots, success });
    this.after = [0, ...episodes]; // episodes that were over when the table was kept; first, none was
    this.returns = Float64Array.from(returns);
    this.steps = steps;
    this.episodes = returns.length;
    this.learned = [0]; // updates up to each of those moments
    for (let i = 1; i < this.after.length; i++) {
      const taken = steps.subarray(this.after[i - 1], this.after[i]).reduce((sum, n) => sum + n, 0);
      this.learned.push(this.learned[i - 1] + taken);
    }
    this.Q = new Float64Array(size);
    this.visits = new Uint32Array(size); // 1 where an entry has been learned: how often is not known
    this.s = mdp.start[0];
    this.way = Int32Array.of(this.s);
    this.t = 0;
    this.over = false;
    this.last = null;
    this.goTo(0);
  }

  get episode() {
    return this.after[this.at];
  }

  get updates() {
    return this.learned[this.at];
  }

  get done() {
    return this.at === this.after.length - 1;
  }

  /** The share of the table that has been learned. */
  get covered() {
    return this.visits.reduce((sum, n) => sum + n, 0);
  }

  step() {
    if (this.done) return false;
    this.goTo(this.at + 1);
    return true;
  }

  run(n = Infinity) {
    let taken = 0;
    while (taken < n && this.step()) taken += 1;
    return taken;
  }

  /** One table a frame: all of them at once would show the last one only. */
  runFor() {
    return this.run(1);
  }

  back(k = 1) {
    this.goTo(Math.max(0, this.at - k));
  }

  /** Go to the last table that was there after n updates. */
  seek(n) {
    this.goTo(this.learned.findLastIndex((updates) => updates <= n));
  }

  goTo(at) {
    this.at = at;
    const size = this.Q.length;
    if (at === 0) this.Q.fill(this.Q0);
    else this.Q.set(this.snapshots.subarray((at - 1) * size, at * size));
    this.Q.forEach((q, i) => (this.visits[i] = q === Math.fround(this.Q0) || q === this.Q0 ? 0 : 1));
  }
}
