/**
 * Drawing walls on the map of a figure: a box to tick, strokes of the pointer, and a key.
 */
import { paint } from "../scenario/edits.js";
import { toggle } from "../views/controls.js";

export class Walls {
  /** `figure` has a map, a task and `change`; `whyNot(x, y)` tells why no wall can be in a cell, if so. */
  constructor(figure, whyNot = () => "") {
    Object.assign(this, { figure, whyNot });
    this.stroke = null; // whether walls are built or taken away, while they are drawn
    this.box = toggle({ label: "Draw walls", onChange: (on) => (figure.map.touch = on ? "paint" : "scroll") });
    this.element = this.box.element;
  }

  /** Draw with a press, if the box is ticked; return whether it is. */
  press({ type, x, y }) {
    if (type === "down") this.stroke = !this.at(x, y);
    if (this.box.value && (type === "down" || type === "move")) this.paint(x, y, this.stroke);
    return this.box.value;
  }

  /** Set a wall, or take it away. */
  flip({ x, y }) {
    this.paint(x, y, !this.at(x, y));
  }

  at(x, y) {
    return this.figure.task.world.blocked(x, y);
  }

  paint(x, y, wall) {
    const { stage } = this.figure;
    if (this.at(x, y) === wall) return;
    const why = this.whyNot(x, y);
    if (why) stage.message(why);
    else stage.attempt(() => this.figure.change({ scenario: paint(stage.state.scenario, x, y, wall) }));
  }
}
