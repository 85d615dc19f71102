/**
 * The robot: a cell, a heading, and a steering that turns it while it drives one cell ahead.
 * Mirrors rlnav/robot.py; the motion is eq-kinematics.
 */
import { fail, instance, integer, items, number } from "./check.js";

export const HEADINGS = Object.freeze([0, 45, 90, 135, 180, 225, 270, 315]);
const FARTHEST = 1_000_000; // cells from the origin

/** Hold where the robot is and where it looks: degrees, counter-clockwise from east. */
export class Pose {
  constructor(x, y, theta) {
    integer("theta", theta);
    if (theta % 45) fail("theta", "a multiple of 45 degrees", String(theta));
    this.x = integer("x", x, -FARTHEST, FARTHEST);
    this.y = integer("y", y, -FARTHEST, FARTHEST);
    this.theta = ((theta % 360) + 360) % 360;
    Object.freeze(this);
  }

  toString() {
    return `Pose(x=${this.x}, y=${this.y}, theta=${this.theta})`;
  }
}

/** Describe a robot that drives one cell a step and can only choose how it turns. */
export class Robot {
  constructor({ steering = [-90, -45, 0, 45, 90], slip = 0 } = {}) {
    this.steering = Object.freeze(steeringSet(steering));
    this.slip = number("slip", slip, 0, 1);
    Object.freeze(this);
  }

  /** Drive one cell while turning by `a` degrees, and snap to the grid. */
  move(pose, a) {
    instance("pose", pose, Pose);
    if (!this.steering.includes(a)) {
      fail("a", `one of the steerings (${this.steering.join(", ")})`, `${a} degrees`);
    }
    // cos and sin may differ between languages in the last bit; no multiple of 22.5 degrees comes near a half, though
    const direction = ((pose.theta + a / 2) * Math.PI) / 180;
    const x = Math.floor(pose.x + Math.cos(direction) + 0.5);
    const y = Math.floor(pose.y + Math.sin(direction) + 0.5);
    return new Pose(x, y, pose.theta + a);
  }

  /** List what may come of action `a` (an index): pairs of the action that is applied and its probability. */
  outcomes(a) {
    const last = this.steering.length - 1;
    integer("a", a, 0, last);
    if (this.slip === 0) return [[a, 1]];
    return [
      [a, 1 - this.slip],
      [Math.max(a - 1, 0), this.slip / 2],
      [Math.min(a + 1, last), this.slip / 2],
    ];
  }
}

function steeringSet(steering) {
  const expected = "a set of different multiples of 45 degrees from -180 to 180, such as (-45, 0, 45)";
  const turns = items("steering", steering, expected).map((a) => integer("steering", a));
  if (!turns.length) fail("steering", expected, "an empty set");
  turns.forEach((a, i) => {
    if (a % 45 || Math.abs(a) > 180) fail("steering", expected, `${a} at place ${i}`);
    if (turns.indexOf(a) < i) fail("steering", expected, `${a} twice`);
  });
  return turns.sort((a, b) => a - b);
}
