/**
 * Long work in slices, so that a page never freezes: the loops of rlnav/planning.py, rlnav/prediction.py and
 * rlnav/evaluation.py are generators here, which yield after every sweep.
 */
/** Do all of it at once, and return its result. */
export function finish(work) {
  let step = work.next();
  while (!step.done) step = work.next();
  return step.value;
}

/** Hold work that is done a few milliseconds at a time; `value` is its result, or the last that it has yielded. */
export class Slices {
  constructor(work) {
    this.work = work;
    this.done = false;
    this.value = null;
  }

  /** Work for so long, at least one piece; return whether there is more to do. */
  run(milliseconds) {
    const end = performance.now() + milliseconds;
    while (!this.done) {
      const { done, value } = this.work.next();
      this.done = done === true;
      this.value = value ?? this.value;
      if (performance.now() >= end) break;
    }
    return !this.done;
  }
}
