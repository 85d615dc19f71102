/**
 * A learned table on another map: exact scores and the way that it takes there, without any further learning.
 */
import { fail } from "../check.js";
import { Slices } from "../slices.js";
import { planning } from "./exact.js";
import { taskOf, whyNot } from "./model.js";
import { checkScenario } from "./scenario.js";
import { driveFrom, policyOf, scoring } from "./trial.js";

const ADVICE = "Choose features that mean the same on any map: the goal as seen from the robot, the moves ahead.";

export class Carried {
  /** Raises if the rows of the table mean something else on the other map. */
  constructor(session, other) {
    const { map, starts } = other;
    this.scenario = checkScenario({ ...session.scenario, map, starts });
    checkThatItFits(session, this.scenario);
    this.task = taskOf(this.scenario);
    this.world = this.task.world;
    this.mdp = this.task.mdp();
    const phi = this.task.phi();
    this.pi = policyOf(session.learner.Q, session.mdp.A, phi);
    this.path = driveFrom(this.task, this.mdp, this.pi, this.world.starts[0], this.scenario.max_steps);
    this.evaluation = null;
    this.work = new Slices(this.#scoring());
  }

  /** Compute the exact scores, in the end `evaluation`, as a session has it; return whether there is more to do. */
  slice(milliseconds) {
    if (this.work.run(milliseconds)) return true;
    this.evaluation = this.work.value;
    return false;
  }

  *#scoring() {
    const best = yield* planning(this.mdp);
    return yield* scoring(this.mdp, this.pi, best, this.scenario.max_steps);
  }
}

function checkThatItFits({ scenario, own }, other) {
  const trouble = whyNot(other);
  if (trouble) fail("map", "one on which the robot can reach the goal", "another", trouble);
  if (own.length) {
    const got = `${own.join(" and ")} of your own`;
    fail("table", "of designs that this page knows", got, "Carry it over in Python.");
  }
  const { features } = scenario;
  if (features === null) fail("table", "learned with features", "a row for each pose of its own map", ADVICE);
  const sameSize = other.map.length === scenario.map.length && other.map[0].length === scenario.map[0].length;
  if (features.flat().includes("cell") && !sameSize) {
    fail("table", "learned with features that fit there", "a row for each cell of its own map", ADVICE);
  }
}
