/**
 * The loop of agent and environment taken apart: an episode as a row of moments, six to a step.
 * Chance is that of `rollout`: with the same seed and policy this is the same episode, to the last bit.
 */
import { integer, integers, MOST_STEPS } from "../check.js";
import { generator } from "../rng.js";
import { drawFrom } from "../rollouts.js";
import { drawStart, drawSuccessor } from "../sampling.js";

// What happens in a step, in this order: the agent reads S_t and chooses A_t; the environment moves, pays R_{t+1} and
// shows S_{t+1}; then the clock moves on.
export const MOMENTS = Object.freeze(["read", "choose", "move", "pay", "show", "tick"]);

export class Loop {
  #chance;
  #drawn = []; // the numbers that chance has given so far: one for the start, two for each step

  /** Begin an episode, or come back to a place in one: the actions so far, and how many moments have passed. */
  constructor(mdp, { seed = 0, maxSteps = 200, start = null, actions = [], position = 0 } = {}) {
    this.mdp = mdp;
    this.maxSteps = integer("maxSteps", maxSteps, 1, MOST_STEPS);
    this.#chance = generator(integer("seed", seed, 0));
    const first = start === null ? drawStart(mdp, this.#number(0)) : integer("start", start, 0, mdp.S - 1);
    this.first = first;
    this.steps = []; // { s, a, place, r, sNext } of every step whose action is chosen
    this.position = 0;
    const chosen = integers("actions", actions, actions.length, "actions", 0, mdp.A - 1);
    const last = integer("position", position, 0, MOMENTS.length * MOST_STEPS);
    while (this.position < last && (!this.waits || this.t < chosen.length)) {
      if (!this.forward(chosen[this.t])) break;
    }
  }

  /** The time step t that the present moment belongs to. */
  get t() {
    return Math.floor(this.position / MOMENTS.length);
  }

  /** S_t. */
  get s() {
    return this.t ? this.steps[this.t - 1].sNext : this.first;
  }

  /** What happens now: one of MOMENTS, or "terminated" or "truncated" once the episode is over. */
  get moment() {
    const now = MOMENTS[this.position % MOMENTS.length];
    return (now === "read" && this.end) || now;
  }

  /** How the episode has ended before S_t was read, or "". */
  get end() {
    if (this.mdp.terminal[this.s]) return "terminated";
    return this.t >= this.maxSteps ? "truncated" : "";
  }

  /** Whether the next moment is the choice of an action. */
  get waits() {
    return this.moment === "read";
  }

  /** Whether the episode is over. */
  get over() {
    return this.moment === "terminated" || this.moment === "truncated";
  }

  /** Actions that have been chosen up to now. */
  get actions() {
    return this.steps.map(({ a }) => a);
  }

  /** The action that a policy chooses now. */
  choice(pi) {
    return drawFrom(pi, this.s, this.mdp.A, this.#number(1 + 2 * this.t));
  }

  /** Go on by one moment; `a` is the action if one is to be chosen. Return whether anything was left to happen. */
  forward(a = null) {
    if (this.over) return false;
    if (this.waits) {
      const { s, mdp } = this;
      integer("a", a, 0, mdp.A - 1);
      const place = drawSuccessor(mdp, s, a, this.#number(2 + 2 * this.t));
      this.steps.push({ s, a, place, r: mdp.reward[place], sNext: mdp.nextState[place] });
    }
    this.position += 1;
    return true;
  }

  /** Go back by one moment; an action that is not yet chosen then is forgotten. Return whether there was one. */
  back() {
    if (this.position === 0) return false;
    this.position -= 1;
    if (this.waits) this.steps.length = this.t;
    return true;
  }

  /** What is known of every step by now: what has not happened yet is null. */
  get rows() {
    const passed = this.position % MOMENTS.length;
    return Array.from({ length: this.t + (this.over ? 0 : 1) }, (_, t) => {
      const known = (moment) => t < this.t || MOMENTS.indexOf(moment) <= passed;
      const step = this.steps[t];
      const s = t ? this.steps[t - 1].sNext : this.first;
      return {
        t,
        s,
        a: known("choose") ? step.a : null,
        place: known("move") ? step.place : null,
        r: known("pay") ? step.r : null,
        sNext: known("show") ? step.sNext : null,
        end: known("tick") ? this.#endAfter(t) : null,
      };
    });
  }

  #endAfter(t) {
    if (this.mdp.terminal[this.steps[t].sNext]) return "terminated";
    return t + 1 >= this.maxSteps ? "truncated" : "";
  }

  #number(i) {
    while (this.#drawn.length <= i) this.#drawn.push(this.#chance.random());
    return this.#drawn[i];
  }
}
