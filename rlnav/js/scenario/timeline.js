/**
 * A learner with a time machine: all updates so far can be gone through, back and forth, and searched.
 */
import { integer } from "../check.js";
import { Learner } from "../learning.js";

export const SURPRISE = 1; // a TD error of more than this, either way, is news
export const MOST_UPDATES = 500_000; // that can be gone through: each is written down
const CLOSE = 256; // updates between two looks at the clock

/** What can be searched for: whether update n (the n-th, counted from 1) is one of them. */
const KINDS = {
  update: () => true,
  episode: (timeline, n) => timeline.ends[n] !== undefined,
  goal: (timeline, n) => timeline.ends[n] === "goal",
  surprise: (timeline, n) => Math.abs(timeline.errors[n]) > SURPRISE,
  never: () => false,
};

/**
 * Wrap a learner that has not taken a step. `now` updates lie behind the moment that is shown, `reached` is how many
 * there ever were; `errors[n]` is the TD error of update n, and `ends[n]` says how an episode ended with it, if one did.
 */
export class Timeline {
  constructor(learner) {
    this.learner = learner;
    this.errors = [NaN];
    this.ends = {};
  }

  get now() {
    return this.learner.updates;
  }

  get reached() {
    return this.errors.length - 1;
  }

  /** Whether no update is left: all episodes are over, or there is no room for more. */
  get done() {
    return this.learner.done || this.now >= MOST_UPDATES;
  }

  /** Take one step, and write down what it was; return whether there was one left. */
  step() {
    const { learner } = this;
    if (this.done || !learner.step()) return false;
    const n = learner.updates;
    if (n <= this.reached) return true;
    this.errors.push(learner.last.tdError);
    if (learner.over) this.ends[n] = endOf(learner);
    return true;
  }

  /** Go to the moment after n updates, or to the last one there is. */
  seek(n) {
    integer("n", n, 0);
    if (n < this.now) this.learner.seek(n);
    while (this.now < n && this.step());
  }

  /** Search back: return the update of a kind before this one, or null. */
  before(kind) {
    for (let n = this.now - 1; n > 0; n--) {
      if (KINDS[kind](this, n)) return n;
    }
    return null;
  }

  /** Learn on towards the next update of a kind for so many milliseconds; return "found", "more" or "end". */
  advance(kind, milliseconds) {
    const end = performance.now() + milliseconds;
    for (let taken = 1; this.step(); taken++) {
      if (KINDS[kind](this, this.now)) return "found";
      if (taken % CLOSE === 0 && performance.now() > end) return "more";
    }
    return "end";
  }

  /** The states of the present episode so far, the one in which the robot is now included. */
  get path() {
    const { way, t } = this.learner;
    return Array.from(way.subarray(0, t + 1));
  }
}

/** Return how the episode of the last step has ended: "goal", "crash", "time", or "" if it goes on. */
export function endOf({ mdp, s, over }) {
  if (!over) return "";
  return mdp.goal[s] ? "goal" : mdp.terminal[s] ? "crash" : "time";
}

/** Make the timeline of a new run. */
export function timelineOf(mdp, phi, algorithm, options) {
  return new Timeline(new Learner(mdp, phi, algorithm, options));
}
