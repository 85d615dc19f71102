/**
 * The same run with other seeds, one after another in spare time: how much of a curve is luck.
 */
import { Learner } from "../learning.js";
import { bandOf, logOf } from "./metrics.js";
import { algorithmOf, learnerOptions } from "./model.js";

export class Band {
  /** `seeds` further runs beside that of the session; those of an earlier band are kept. */
  constructor({ mdp, phi, scenario, entries }, seeds, before = null) {
    Object.assign(this, { mdp, phi, scenario, entries, seeds });
    this.logs = before?.logs.slice(0, seeds) ?? [];
    this.learner = null;
  }

  /** How many runs are done. */
  get done() {
    return this.logs.length;
  }

  /** Work for a while; return whether there is more to do. */
  run(milliseconds) {
    if (this.done >= this.seeds) return false;
    this.learner ??= this.next();
    this.learner.runFor(milliseconds);
    if (this.learner.done) {
      this.logs.push({ ...logOf(this.learner, this.entries) }); // made at once: the learner itself can go
      this.learner = null;
    }
    return this.done < this.seeds;
  }

  next() {
    const { mdp, phi, scenario } = this;
    const seed = scenario.seed + this.done + 1;
    return new Learner(mdp, phi, algorithmOf(scenario), learnerOptions({ ...scenario, seed }));
  }

  of(metric) {
    return bandOf(this.logs, metric, this.scenario.episodes);
  }
}
