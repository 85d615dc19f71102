/**
 * The turns as a table that is played: a button for each, how often it was taken, and what it seems to be worth.
 */
import { button } from "../views/controls.js";
import { h, svg } from "../views/dom.js";
import { turnInWords, turnText, written } from "./naming.js";

const MARGIN = 2.2; // standard deviations of noise that the scale holds beyond the values

export class ArmsView {
  /** `onPick(a)` hears which turn is taken. */
  constructor(parent, steering, { onPick }) {
    const words = ["turn", "tried", "mean so far", "what it paid"];
    const head = h("thead", {}, h("tr", {}, words.map((text) => h("th", { scope: "col", text }))));
    this.rows = steering.map((turn, a) => this.row(turn, a, onPick));
    const caption = h("caption", { class: "rl-hidden", text: "The turns: press one to take it" });
    const body = h("tbody", {}, this.rows.map(({ element }) => element));
    this.table = h("table", { class: "rl-numbers rl-arms" }, caption, head, body);
    this.key = h("p", { class: "rl-help" });
    this.element = h("div", {}, this.table, this.key);
    parent.append(this.element);
  }

  row(turn, a, onPick) {
    const title = `${turnInWords(turn)} (key ${a + 1})`;
    const pick = button({ label: turnText(turn), primary: true, title, onClick: () => onPick(a) });
    pick.element.setAttribute("aria-label", `Take turn ${turnText(turn)}: ${turnInWords(turn)}`);
    pick.element.setAttribute("aria-keyshortcuts", String(a + 1));
    const parts = { tried: h("td"), mean: h("td", { class: "rl-arm-mean" }), bar: svg("svg", { class: "rl-arm-bar" }) };
    parts.bar.setAttribute("aria-hidden", "true");
    const bar = h("td", { class: "rl-arm-cell" }, parts.bar);
    const name = h("th", { scope: "row" }, pick.element);
    return { pick, ...parts, element: h("tr", {}, name, parts.tried, parts.mean, bar) };
  }

  /** Draw arms [{ value, n, mean, off }] and the rewards of all choices; `shown` tells the truth. */
  draw({ arms, rewards, turns, noise, shown, blocked }) {
    const values = arms.map(({ value }) => value);
    const pad = MARGIN * noise || 1;
    const [low, high] = [Math.min(...values) - pad, Math.max(...values) + pad];
    const place = (v) => (100 * (v - low)) / (high - low);
    const best = Math.max(...values);
    arms.forEach((arm, a) => {
      const { pick, tried, mean, bar, element } = this.rows[a];
      pick.disabled(blocked);
      tried.replaceChildren(h("data", { value: String(arm.n), text: String(arm.n) }));
      mean.replaceChildren(...meanOf(arm, shown));
      element.classList.toggle("rl-arm-best", shown && arm.value === best);
      const paid = rewards.filter((_, t) => turns[t] === a);
      bar.replaceChildren(...barOf(arm, paid, place, { shown, last: turns.at(-1) === a ? paid.at(-1) : null }));
    });
    const truth = shown ? " The upright mark is that mean." : "";
    this.key.textContent = `Dots are what a turn has paid, the ring is the last one. The line is a 95 % interval for its true mean.${truth}`;
  }
}

function meanOf({ n, mean, off, value }, shown) {
  const number = n ? [h("data", { value: String(mean), text: written(mean, 2) }), ` ± ${written(off, 1)}`] : ["–"];
  const truth = h("data", { class: "rl-arm-truth", value: String(value), text: written(value, 2) });
  return shown ? [...number, h("span", { class: "rl-arm-true" }, " true ", truth)] : number;
}

/** Draw one turn's bar in percent of its width: what it paid, the interval of its mean, and perhaps the truth. */
function barOf({ n, mean, off, value }, paid, place, { shown, last }) {
  const at = (v) => `${place(v)}%`;
  const dots = paid.map((r) => svg("circle", { cx: at(r), cy: "50%", r: 4, class: "rl-arm-paid" }));
  const ends = [Math.max(place(mean - off), 0), Math.min(place(mean + off), 100)];
  const line = n ? [
    svg("line", { x1: `${ends[0]}%`, x2: `${ends[1]}%`, y1: "50%", y2: "50%", class: "rl-arm-line" }),
    svg("circle", { cx: at(mean), cy: "50%", r: 4.5, class: "rl-arm-dot" }),
  ] : [];
  const ring = last === null ? [] : [svg("circle", { cx: at(last), cy: "50%", r: 7, class: "rl-arm-last" })];
  const truth = shown ? [svg("line", { x1: at(value), x2: at(value), y1: "8%", y2: "92%", class: "rl-arm-value" })] : [];
  const axis = svg("line", { x1: "0%", x2: "100%", y1: "50%", y2: "50%", class: "rl-arm-axis" });
  return [axis, ...dots, ...line, ...ring, ...truth];
}
