/**
 * One way on the time line: its rewards as bars that can be dragged, and below them the returns, built backwards.
 */
import { MOST_REWARD } from "../scenario/return_line.js";
import { number } from "../views/controls.js";
import { h, svg, uniqueId } from "../views/dom.js";
import { timed, written } from "./naming.js";

const TALL = [5, 8.5]; // sizes of type: the room of the bars, at least and at most ...
const PART = 0.16; // ... and in parts of the window: both ways should be seen at once
const NARROWEST = 44; // pixels of a column: room for a finger
const STEP = 0.5; // of a reward that is dragged, or changed by a key
const KEYS = { ArrowUp: STEP, ArrowDown: -STEP, PageUp: 2, PageDown: -2 };
const SIDEWAYS = { ArrowLeft: -1, ArrowRight: 1 };

export class ReturnLane {
  /** `onReward(t, r)` hears of a reward R_{t+1} that the reader has changed to r, `onDrop()` of the end of a drag. */
  constructor(parent, { place, steps, columns, onReward, onDrop }) {
    Object.assign(this, { steps, columns, onReward, onDrop, picked: steps - 1, held: null });
    const title = h("p", { class: "rl-lane-title", id: uniqueId("lane") });
    this.title = title;
    const range = { min: -MOST_REWARD, max: MOST_REWARD, step: 0.1 };
    this.field = number({ label: "R", value: 0, ...range, onChange: (r) => onReward(this.picked, r) });
    this.bars = Array.from({ length: steps }, (_, t) => this.bar(t));
    this.zero = svg("line", { class: "rl-axis" });
    this.over = svg("text", { class: "rl-bar-over", text: steps < columns ? "Over: nothing follows." : "" });
    const bars = this.bars.map(({ g }) => g);
    this.svg = svg("svg", { role: "group", "aria-labelledby": title.id }, this.zero, this.over, bars);
    this.cells = Array.from({ length: steps }, (_, t) =>
      h("li", {}, h("span", { class: "rl-lane-name" }, timed("G", t)), h("data", {})));
    const list = h("ol", { class: "rl-lane-returns", "aria-label": "Returns" }, this.cells);
    this.formula = h("p", { class: "rl-lane-formula" });
    this.strip = h("div", { class: "rl-lane-strip" }, this.svg, list);
    const scroll = h("div", { class: "rl-lane-scroll" }, this.strip);
    const head = h("div", { class: "rl-lane-head" }, title, this.field.element);
    this.element = h("section", { class: `rl-lane rl-lane-${place + 1}` }, head, scroll, this.formula);
    this.strip.style.setProperty("--rl-columns", columns);
    parent.append(this.element);
    this.resizes = new ResizeObserver(() => this.lay());
    this.resizes.observe(this.strip);
  }

  destroy() {
    this.resizes.disconnect();
  }

  /** The bar of R_{t+1}: an outline for the reward, a filled part for what counts of it, and a handle. */
  bar(t) {
    const parts = { whole: svg("rect", { class: "rl-bar-whole" }), share: svg("rect", { class: "rl-bar-share" }) };
    parts.text = svg("text", { class: "rl-bar-text", "text-anchor": "middle" });
    parts.grip = svg("rect", { class: "rl-bar-grip", width: NARROWEST, height: NARROWEST });
    parts.knob = svg("circle", { class: "rl-bar-knob", r: 7 });
    const limits = { "aria-valuemin": -MOST_REWARD, "aria-valuemax": MOST_REWARD, "aria-orientation": "vertical" };
    const role = { role: "slider", tabindex: -1, ...limits };
    const drawn = [parts.whole, parts.share, parts.knob, parts.text, parts.grip];
    parts.g = svg("g", { class: "rl-bar", ...role, "aria-label": `Reward ${timed("R", t + 1)}` }, drawn);
    parts.g.addEventListener("focus", () => this.pick(t));
    parts.g.addEventListener("keydown", (event) => this.key(event, t));
    parts.grip.addEventListener("pointerdown", (event) => this.take(event, t));
    parts.grip.addEventListener("pointermove", (event) => this.drag(event, t));
    for (const end of ["pointerup", "pointercancel"]) parts.grip.addEventListener(end, () => this.drop());
    return parts;
  }

  // ---------------------------------------------------------------- changing
  /** Make a reward the one that the field of numbers speaks of, and the one that Tab comes to. */
  pick(t) {
    this.picked = t;
    this.mark();
  }

  key(event, t) {
    const next = this.bars[t + SIDEWAYS[event.key]];
    if (KEYS[event.key] === undefined && !next) return;
    event.preventDefault();
    if (next) next.g.focus();
    else this.change(t, this.data.rewards[t] + KEYS[event.key]);
  }

  take(event, t) {
    if (event.button > 0) return;
    event.preventDefault();
    this.bars[t].g.focus({ preventScroll: true });
    this.bars[t].grip.setPointerCapture(event.pointerId);
    this.held = { from: event.clientY, r: this.data.rewards[t] };
    this.element.classList.add("rl-dragging");
  }

  drag(event, t) {
    if (!this.held) return;
    const r = this.held.r + (this.held.from - event.clientY) / this.unit;
    this.change(t, Math.round(r / STEP) * STEP);
  }

  drop() {
    if (!this.held) return;
    this.held = null;
    this.element.classList.remove("rl-dragging");
    this.onDrop();
  }

  change(t, wanted) {
    const r = Number(Math.min(Math.max(wanted, -MOST_REWARD), MOST_REWARD).toPrecision(12));
    if (r !== this.data.rewards[t]) this.onReward(t, r);
  }

  // ---------------------------------------------------------------- drawing
  /** Draw a way: { name, rewards, gamma, G, from, shares, wins, known, range: [low, high] of the bars }. */
  draw(data) {
    this.data = data;
    const { name, rewards, G, from, known } = data;
    const total = from === 0 ? `: ${timed("G", 0)} = ${written(G[0], 3)}` : "";
    this.title.textContent = `The ${name}${total}`;
    this.element.classList.toggle("rl-wins", data.wins);
    this.cells.forEach((cell, t) => {
      const built = t >= from;
      cell.className = `${built ? "rl-built" : ""}${t === known ? " rl-now" : ""}`;
      cell.lastChild.textContent = built ? written(G[t], 2) : "?";
      cell.lastChild.value = built ? String(G[t]) : "";
    });
    this.formula.textContent = known < rewards.length ? formulaOf(data, known) : "\u00a0";
    this.lay();
    this.mark();
  }

  /** Put everything where it belongs for the width that there is. */
  lay() {
    const width = this.strip.clientWidth / this.columns;
    if (!width || !this.data) return;
    const em = parseFloat(getComputedStyle(this.element).fontSize);
    const [low, high] = this.data.range;
    const tall = Math.max(TALL[0] * em, Math.min(TALL[1] * em, PART * innerHeight));
    this.unit = tall / (high - low); // pixels that a reward of 1 is high
    const height = tall + 3 * em;
    const at = (r) => 2 * em + (high - r) * this.unit;
    const total = this.strip.clientWidth;
    for (const [key, value] of [["width", total], ["height", height], ["viewBox", `0 0 ${total} ${height}`]]) {
      this.svg.setAttribute(key, value);
    }
    set(this.zero, { x1: 0, x2: width * this.steps, y1: at(0), y2: at(0) });
    set(this.over, { x: width * this.steps + 0.5 * em, y: at(0) + 0.3 * em });
    this.bars.forEach((bar, t) => this.layBar(bar, t, { width, at, em }));
  }

  layBar(bar, t, { width, at, em }) {
    const [r, share] = [this.data.rewards[t], this.data.shares[t]];
    const middle = (t + 0.5) * width;
    const wide = Math.min(0.5 * width, 2.4 * em);
    const box = (v) => ({ x: middle - wide / 2, width: wide, y: at(Math.max(v, 0)), height: Math.abs(at(v) - at(0)) });
    set(bar.whole, box(r));
    const part = box(share ?? 0);
    set(bar.share, { x: part.x, width: part.width });
    Object.assign(bar.share.style, { y: `${part.y}px`, height: `${part.height}px` });
    set(bar.knob, { cx: middle, cy: at(r) });
    set(bar.grip, { x: middle - NARROWEST / 2, y: at(r) - NARROWEST / 2 });
    set(bar.text, { x: middle, y: r < 0 ? at(r) + 1.5 * em : at(r) - 0.8 * em });
    bar.text.textContent = written(r, 2);
    bar.g.setAttribute("aria-valuenow", r);
    const counts = share === null ? "" : `, counts ${written(share, 2)}`;
    bar.g.setAttribute("aria-valuetext", `${written(r, 2)}${counts}`);
  }

  /** Show which reward is picked. */
  mark() {
    this.bars.forEach(({ g }, t) => {
      g.classList.toggle("rl-picked", t === this.picked);
      g.setAttribute("tabindex", t === this.picked ? 0 : -1);
    });
    const label = this.field.element.querySelector(".rl-label");
    label.textContent = timed("R", this.picked + 1);
    if (!this.data) return;
    this.field.input.setAttribute("aria-label", `${label.textContent} of the ${this.data.name}`);
    this.field.value = this.data.rewards[this.picked];
  }
}

/** Write the step backwards that built G_t, with its numbers. */
function formulaOf({ rewards, G, gamma }, t) {
  const [now, next] = [timed("G", t), timed("G", t + 1)];
  const [r, worth] = [written(rewards[t], 2), written(G[t], 3)];
  if (t === rewards.length - 1) return `${now} = ${timed("R", t + 1)} = ${worth}: nothing follows.`;
  const sum = `${r} + ${written(gamma, 3)} · ${bracketed(G[t + 1])}`;
  return `${now} = ${timed("R", t + 1)} + γ ${next} = ${sum} = ${worth}`;
}

function bracketed(value) {
  const text = written(value, 3);
  return value < 0 ? `(${text})` : text;
}

function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
}
