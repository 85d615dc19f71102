/**
 * Ways out of the page: the clipboard and a file. Where the browser refuses them, as notebooks in a frame may, the text
 * is shown and selected, ready to be copied by hand.
 */
import { button } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";

const KEPT = 60_000; // milliseconds for which a file is held ready: browsers ask where to put it

export class Outlet {
  /** `say(text)` tells what has been done. */
  constructor(say) {
    this.say = say;
    this.label = h("label", { class: "rl-label", for: uniqueId("outlet") });
    const field = { class: "rl-text", id: this.label.htmlFor, readonly: true, rows: 6, spellcheck: "false" };
    this.text = h("textarea", field);
    this.done = h("p", { class: "rl-help", role: "status" });
    const close = button({ label: "Close", onClick: () => (this.shown.hidden = true) });
    this.shown = h("div", { class: "rl-stack", hidden: true }, this.label, this.text, close.element);
    this.element = h("div", { class: "rl-stack rl-outlet" }, this.done, this.shown);
  }

  /** Put text on the clipboard. */
  async copy(text, what) {
    try {
      await navigator.clipboard.writeText(text);
      this.tell(`${what} is on the clipboard.`);
    } catch {
      this.show(text, `${what}. The browser keeps its clipboard closed here: copy it from this field.`);
    }
  }

  /** Give text or a picture to the reader as a file. */
  async save(content, name, type) {
    const blob = content instanceof Blob ? content : new Blob([content], { type });
    const caged = globalThis.origin === "null"; // a frame that may not give files, and says nothing about it
    if (caged && typeof content === "string") {
      this.show(content, `${name}. Files cannot leave this frame: copy the text from this field.`);
      return;
    }
    const address = URL.createObjectURL(blob);
    const link = h("a", { href: address, download: name, hidden: true });
    this.element.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), KEPT);
    this.tell(`${name} is saved among your downloads.`);
  }

  /** Show text in a field, selected. */
  show(text, label) {
    this.done.textContent = "";
    this.label.textContent = label;
    this.text.value = text;
    this.shown.hidden = false;
    this.text.focus();
    this.text.select();
  }

  tell(words) {
    this.shown.hidden = true;
    this.done.textContent = words;
    this.say(words);
  }
}
