/**
 * Long work in slices, in the time that a page has to spare: a few milliseconds at once, never a frame that is missed.
 */

const SLICE = 6; // milliseconds

export class Chores {
  /** `onError(error)` is told when a chore fails; it is not tried again. */
  constructor(onError) {
    this.onError = onError;
    this.list = [];
    this.waiting = 0;
  }

  /** Add `fn(ms)`, which does some of its work and returns whether there is more; one that is there stays as it is. */
  add(fn) {
    if (this.list.includes(fn)) return;
    this.list.push(fn);
    this.wait();
  }

  clear() {
    this.list = [];
    (globalThis.cancelIdleCallback ?? clearTimeout)(this.waiting);
    this.waiting = 0;
  }

  wait() {
    if (this.waiting || !this.list.length) return;
    const later = globalThis.requestIdleCallback ?? ((fn) => setTimeout(fn, 16));
    this.waiting = later(() => this.work(), { timeout: 200 });
  }

  /** Do one slice of the chore whose turn it is. */
  work() {
    this.waiting = 0;
    const chore = this.list.shift();
    try {
      if (chore(SLICE)) this.list.push(chore);
    } catch (error) {
      this.onError(error);
    }
    this.wait();
  }
}
