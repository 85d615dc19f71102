/**
 * A drive with what the robot has learned so far, from one start after another: what it would do if it had to go now.
 */
import { Player } from "../views/player.js";

const PACE = 6; // cells a second
const LONGEST = 40; // cells of a drive that gets nowhere
const REST = 4; // cells' worth of rest at the end

export class Tour {
  constructor(app) {
    this.app = app;
    this.number = 0; // of the drive: which start is next
    this.drive = null; // { poses, crashed }
    this.at = 0; // cells driven
    this.last = 0;
    this.player = new Player({
      tick: () => this.more(),
      draw: () => this.app.draw(1),
      speed: 2 * PACE,
      onStop: () => this.app.refresh(),
    });
  }

  destroy() {
    this.player.destroy();
  }

  get watching() {
    return this.player.playing;
  }

  /** Show one drive by itself, when the learning is over; the next time from another start. */
  watch() {
    this.next();
    if (!this.app.stage.reducedMotion) this.player.play();
    this.app.refresh();
  }

  stop() {
    this.player.pause();
    this.drive = null;
  }

  more() {
    return this.at < this.length;
  }

  get length() {
    return this.drive.poses.length - 1;
  }

  next() {
    this.number += 1;
    this.plan();
  }

  /** Plan a drive with the table as it is now. */
  plan() {
    const { session } = this.app;
    const { starts } = session.world;
    const apart = Math.max(1, Math.floor(starts.length / 5)); // far from the last one
    this.drive = session.greedyPath(starts[(this.number * (apart + 1)) % starts.length]);
    this.updates = session.updates;
    this.at = 0;
    this.last = performance.now();
  }

  /** Go on by the time that has passed; return { path, robot } as the map shows them. */
  shown() {
    const { playing, session } = this.app;
    const now = performance.now();
    if (!this.drive || (!playing && !this.watching && this.updates !== session.updates)) this.plan();
    if (playing && this.at > Math.min(this.length, LONGEST) + REST) this.next();
    this.at = playing || this.watching ? this.at + (Math.min(now - this.last, 100) * PACE) / 1000 : this.length;
    this.last = now;
    const { poses, crashed } = this.drive;
    const k = Math.min(Math.ceil(this.at), this.length);
    const robot = { ...poses[k], from: poses[Math.max(k - 1, 0)], at: k < this.at ? 1 : this.at - k + 1 };
    return { path: poses, robot: { ...robot, crashed: crashed && k === this.length } };
  }
}
