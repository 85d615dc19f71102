/**
 * What every explorable does in the same way: it shows a state, changes it, begins again, and goes. The state may come
 * from the page, from Python or from the reader; the figure has to know only how to prepare one and how to show it.
 */
import { h } from "../views/dom.js";
import { frame } from "./frame.js";

export class Figure {
  /** A figure has `build()`, which makes its parts, and `prepare(state)`, which throws for a state that cannot be. */
  constructor(stage, question) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.frame = frame(stage, { question, onReset: () => this.reset() });
  }

  open() {
    this.build();
    this.adopt(this.stage.state);
    this.stage.onState((state) => this.adopt(state));
  }

  /** Make a view or a player a part of the figure: it goes when the figure goes. */
  part(made) {
    this.stage.onCleanup(() => made.destroy());
    return made;
  }

  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.prepare(state);
    this.showAll();
  }

  /** Show the present state, controls included. */
  showAll() {
    this.draw();
  }

  /** Change what is prepared; what cannot be becomes a message, and the last good state stays. */
  change(patch) {
    const worked = this.stage.attempt(() => this.prepare({ ...this.stage.state, ...patch }));
    if (worked) {
      this.stage.message("");
      this.stage.update(patch);
      this.showAll();
    }
    return worked;
  }

  /** Change what is only shown. */
  set(patch) {
    this.stage.update(patch);
    this.draw();
  }

  reset() {
    this.player?.pause();
    this.stage.message("");
    this.stage.update(this.first);
    this.adopt(this.first);
  }
}

/** Two columns side by side, or one below the other where there is no room: { element, left, right }. */
export function pair(name = "") {
  const [left, right] = [0, 1].map(() => h("div", { class: "rl-column" }));
  return { left, right, element: h("div", { class: `rl-pair ${name}`.trim() }, left, right) };
}
