/**
 * Exercise: one number of a backup diagram is hidden. The reader finds it, and hears which step went wrong.
 */
import { generator } from "../rng.js";
import { isTelling, judge } from "../scenario/backup.js";
import { button, group } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";
import { written } from "./naming.js";

export class FillNumber {
  /** `ask()` gives { root, gamma } of the present diagram; `onChange(id)` hears which node is hidden, or null. */
  constructor({ ask, onChange }) {
    Object.assign(this, { ask, onChange, target: null, round: 0 });
    this.input = h("input", { class: "rl-number", id: uniqueId("answer"), inputmode: "decimal", autocomplete: "off" });
    const label = h("label", { class: "rl-label", for: this.input.id }, "The number at the question mark");
    const check = button({ label: "Check", primary: true });
    check.element.type = "submit";
    this.show = button({ label: "Show it", onClick: () => this.reveal() });
    const parts = [label, this.input, check.element, this.show.element];
    this.form = h("form", { class: "rl-fill", onSubmit: (event) => this.check(event) }, parts);
    this.words = h("p", { class: "rl-fill-words", "aria-live": "polite" });
    this.next = button({ label: "Hide a number", onClick: () => this.begin() });
    this.group = group({
      title: "Fill in the missing number",
      onToggle: (open) => open || this.stop(),
      children: [this.next, this.form, this.words],
    });
    this.element = this.group.element;
    this.stop();
  }

  /** Hide a number of the present diagram: that of the root, or of a node on the level below it. */
  begin() {
    const { root, gamma } = this.ask();
    const nodes = [root, ...root.children].filter((node) => node.children.length);
    const good = nodes.filter((node) => isTelling(node, gamma));
    const list = good.length ? good : nodes;
    if (!list.length) {
      this.tell("The episode is over at this pose: there is nothing to compute. Pick another one.", "");
      return;
    }
    // the root every other time, for it is the formula of the diagram
    const others = list.filter((node) => node !== root);
    const among = list.includes(root) && (this.round % 2 === 0 || !others.length) ? [root] : others;
    this.target = among[Math.floor(generator(this.round).random() * among.length)];
    this.gamma = gamma;
    this.round += 1;
    this.input.value = "";
    this.form.hidden = false;
    this.next.label = "Another one";
    this.tell("Find it from the numbers below it in the diagram. A small error of rounding does not matter.", "");
    this.onChange(this.target.id);
    this.input.focus({ preventScroll: true });
  }

  /** Give the diagram its number back, such as when another one is shown. */
  stop() {
    const had = this.target !== null;
    this.target = null;
    this.form.hidden = true;
    this.next.label = "Hide a number";
    this.tell("", "");
    if (had) this.onChange(null);
  }

  check(event) {
    event.preventDefault();
    const typed = this.input.value.trim().replace("−", "-").replace(",", ".");
    const answer = typed === "" ? NaN : Number(typed);
    if (!Number.isFinite(answer) || Math.abs(answer) > 1e9) {
      this.tell("Type a number, such as 4.2.", "wrong");
      return;
    }
    const { right, words } = judge(this.target, answer, this.gamma);
    if (right) this.finish(`Right: it is ${written(this.target.value)}.`, "right");
    else this.tell(words, "wrong");
  }

  reveal() {
    this.finish(`It is ${written(this.target.value)}. Point at it to see how it is found.`, "");
  }

  finish(words, kind) {
    this.target = null;
    this.form.hidden = true;
    this.onChange(null);
    this.tell(words, kind);
    this.next.element.focus({ preventScroll: true });
  }

  tell(words, kind) {
    this.words.textContent = words;
    this.words.className = `rl-fill-words${kind ? ` rl-${kind}` : ""}`;
  }
}
