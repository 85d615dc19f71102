/**
 * A question for a number: the reader types it, and is told what may have gone wrong, or asks to be shown.
 */
import { button } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";

export class Guess {
  /** `judge(number)` returns { right, words }; `onSolved()` is called when the number is found or shown. */
  constructor(parent, { label, judge, onSolved }) {
    Object.assign(this, { judge, onSolved });
    const id = uniqueId("guess");
    this.verdict = h("p", { class: "rl-verdict", role: "status" });
    this.input = h("input", { type: "text", inputmode: "text", class: "rl-number", id, autocomplete: "off" });
    const check = h("button", { type: "submit", class: "rl-button rl-primary", text: "Check" });
    const show = button({ label: "Show it", onClick: () => this.onSolved() });
    const onSubmit = (event) => {
      event.preventDefault();
      this.check();
    };
    const row = h("div", { class: "rl-guess-row" }, this.input, check, show.element);
    const words = h("label", { for: id, class: "rl-label", text: label });
    this.element = h("form", { class: "rl-guess", onSubmit }, words, row, this.verdict);
    parent.append(this.element);
  }

  /** Ask anew, or take the question away. */
  ask(visible) {
    this.element.hidden = !visible;
    this.input.value = "";
    this.verdict.textContent = "";
  }

  check() {
    const guess = Number(this.input.value.trim().replace("−", "-").replace(",", "."));
    if (this.input.value.trim() === "" || !Number.isFinite(guess)) {
      this.verdict.textContent = "Type a number, such as −0.05.";
      return;
    }
    const { right, words } = this.judge(guess);
    if (right) this.onSolved();
    else this.verdict.textContent = words;
  }
}
