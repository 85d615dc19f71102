/**
 * The list of all kinds of controls: what each does, and which of them the reader has tried.
 */
import { KINDS } from "../scenario/round.js";
import { button } from "../views/controls.js";
import { h } from "../views/dom.js";

const ABOUT = {
  step: ["One step", "goes on by one step. A strong color marks the button to begin with."],
  back: ["Back", "takes the last step back. Look twice: nothing is lost."],
  play: ["Play", "runs by itself. The same button makes a pause."],
  slider: ["Slider", "drag it, or press the arrow keys. Home and End go to its ends."],
  number: ["Number", "stands beside each slider. Type another one and press Enter; try one that cannot be."],
  menu: ["Menu", "offers a few choices. With the keyboard: arrow keys."],
  box: ["Box", "switches something on or off. With the keyboard: space bar."],
  map: ["Map", "click or touch a cell: the robot is put there. Once more: it turns. Keys: arrows, Enter, R."],
  again: ["Start again", "brings the settings of the page back. In this figure the ticks stay."],
  lecture: ["Lecture view", "fills the screen in large type. Escape leaves it."],
};

export class ControlList {
  /** `onClear()` is called when the reader wants to begin anew. */
  constructor(parent, onClear) {
    this.count = h("p", { class: "rl-tour-count" });
    this.items = Object.fromEntries(KINDS.map((kind) => [kind, item(...ABOUT[kind])]));
    const list = h("ul", { class: "rl-tour-list" }, KINDS.map((kind) => this.items[kind].element));
    this.clear = button({ label: "Clear the ticks", onClick: onClear });
    parent.append(this.count, list, this.clear.element);
  }

  /** Show which kinds were tried, and which of them just now. */
  draw(tried, now) {
    for (const kind of KINDS) {
      const { element, mark } = this.items[kind];
      const done = tried.includes(kind);
      element.classList.toggle("rl-done", done);
      element.classList.toggle("rl-now", kind === now);
      mark.textContent = done ? "tried: " : "to try: ";
    }
    this.count.textContent = `You have tried ${tried.length} of ${KINDS.length} controls.`;
    this.clear.show(tried.length > 0);
  }
}

/** One line; the tick itself is drawn by the style, and told in words. */
function item(name, words) {
  const mark = h("span", { class: "rl-hidden" });
  return { mark, element: h("li", {}, mark, h("b", {}, name), ` ${words}`) };
}
