/**
 * The list of all kinds of controls: what each does, and which of them the reader has tried.
 */
import { KINDS } from "../scenario/round.js";
import { button } from "../views/controls.js";
import { h } from "../views/dom.js";

const ABOUT = {
  step: ["One step", "one step forward. The button in color is the one to begin with."],
  back: ["Back", "one step back. Look twice: nothing is lost."],
  play: ["Play", "by itself to the end. The same button makes a pause."],
  slider: ["Slider", "drag it, or press the arrow keys. Home and End go to its ends."],
  number: ["Number", "type another one beside the slider and press Enter. Try 99 as well."],
  menu: ["Menu", "one of a few choices. Arrow keys work too."],
  box: ["Box", "on or off. The space bar works too."],
  map: ["Map", "click or touch a cell to put the robot there, and again to turn it. Keys: arrows, Enter, R."],
  again: ["Start again", "back to the settings of the page. The ticks stay, in this figure."],
  lecture: ["Lecture view", "large type on the whole screen. Escape leaves it."],
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
  return { mark, element: h("li", {}, mark, h("b", {}, `${name}:`), ` ${words}`) };
}
