/**
 * Driving the robot by hand: the same model and the same reward, and nothing is learned from it.
 */
import { integer } from "../check.js";
import { Generator } from "../rng.js";
import { drawStart, drawSuccessor } from "../sampling.js";
import { posesOf } from "./trial.js";

export class Hand {
  constructor(task, mdp, maxSteps) {
    Object.assign(this, { task, mdp, maxSteps });
    this.chance = new Generator(0);
    this.begin();
  }

  /** Put the robot on a start. */
  begin() {
    this.states = [drawStart(this.mdp, this.chance.random())];
    this.a = null;
    this.steps = 0;
    this.reward = 0; // of the last step
    this.total = 0; // of all of them
  }

  /** Steer by the action with this number; return whether the robot was still under way. */
  drive(a) {
    integer("a", a, 0, this.mdp.A - 1);
    if (this.over) return false;
    const place = drawSuccessor(this.mdp, this.states.at(-1), a, this.chance.random());
    this.states.push(this.mdp.nextState[place]);
    this.a = a;
    this.steps += 1;
    this.reward = this.mdp.reward[place];
    this.total += this.reward;
    return true;
  }

  get s() {
    return this.states.at(-1);
  }

  get goal() {
    return this.mdp.goal[this.s] === 1;
  }

  get crashed() {
    return this.s === this.task.crashed;
  }

  get over() {
    return this.mdp.terminal[this.s] === 1 || this.steps >= this.maxSteps;
  }

  /** The poses so far; the last is the one that the robot drove at if it crashed. */
  get path() {
    return posesOf(this.task, this.states, this.a);
  }
}
