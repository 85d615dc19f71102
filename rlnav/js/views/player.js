/**
 * Time: calls `tick` at a chosen speed and `draw` once a frame, and never so long that the page would freeze.
 */

const BUDGET = 8; // milliseconds of ticks in one frame of 16, at most ...
const LEAST = 2; // ... and at least
const FRAME = 12; // milliseconds that ticks and drawing may take together; the browser needs the rest for layout and paint
const CALM = 250; // milliseconds between two pictures for those who ask for less motion
const LONGEST = 100; // milliseconds: what a frame may make up for; a tab that slept has nothing to make up for

export class Player {
  /**
   * `tick(ms)` does one step and returns whether there is more to do; where `ms` is positive, it may do as many as fit.
   * `draw(at)` paints; `at` in [0, 1] is how far the time between the last tick and the next has run.
   * `onStop(error)` is told when the last tick was done or one failed; `speed` is in ticks a second, up to Infinity.
   */
  constructor({ tick, draw, speed = 4, onStop = null }) {
    Object.assign(this, { tick, draw, speed, onStop });
    this.playing = false;
    this.frame = 0;
    this.cost = 0; // milliseconds that the last picture took
    this.calm = matchMedia("(prefers-reduced-motion: reduce)");
    this.onFrame = (now) => this.advance(now);
    this.onVisible = () => this.wait();
    document.addEventListener("visibilitychange", this.onVisible);
  }

  play() {
    if (this.playing) return;
    this.playing = true;
    this.due = 1; // who presses play sees something happen at once
    this.drawn = -Infinity;
    this.wait();
  }

  pause() {
    this.playing = false;
    cancelAnimationFrame(this.frame);
  }

  destroy() {
    this.pause();
    document.removeEventListener("visibilitychange", this.onVisible);
  }

  /** Wait for the next frame, as if no time had passed before it. */
  wait() {
    cancelAnimationFrame(this.frame);
    this.last = null;
    if (this.playing && !document.hidden) this.frame = requestAnimationFrame(this.onFrame);
  }

  /** Do what is due in this frame. */
  advance(now) {
    const passed = this.last === null ? 0 : Math.min(now - this.last, LONGEST);
    this.last = now;
    let more = true;
    try {
      more = this.speed === Infinity ? this.rush() : this.walk(passed);
    } catch (error) {
      this.stop(error);
      return;
    }
    const wanted = !this.calm.matches || now - this.drawn >= CALM || !more;
    if (wanted) {
      this.drawn = now;
      const begin = performance.now();
      this.draw(this.calm.matches || this.speed === Infinity ? 1 : Math.min(this.due, 1));
      this.cost = performance.now() - begin;
    }
    if (!more) this.stop(null);
    else if (this.playing) this.frame = requestAnimationFrame(this.onFrame);
  }

  /** Milliseconds that ticks may take in this frame: the longer a picture takes, the fewer. */
  get budget() {
    return Math.max(LEAST, Math.min(BUDGET, FRAME - this.cost));
  }

  /** As fast as possible: ticks until the budget of the frame is spent. */
  rush() {
    const end = performance.now() + this.budget;
    for (let left = this.budget; left > 0; left = end - performance.now()) {
      if (!this.tick(left)) return false;
      if (!this.playing) break;
    }
    return true;
  }

  /** At a speed: the ticks that are due; what does not fit into the budget is dropped, not queued. */
  walk(passed) {
    this.due += (passed * this.speed) / 1000;
    const end = performance.now() + this.budget;
    while (this.due >= 1 && this.playing) {
      this.due -= 1;
      if (!this.tick(0)) return false;
      if (performance.now() > end) this.due = Math.min(this.due, 1);
    }
    return true;
  }

  stop(error) {
    this.pause();
    if (this.onStop) this.onStop(error);
    else if (error) throw error;
  }
}
