/**
 * What an episode leaves behind: the time line S_0 A_0 R_1 S_1 ..., the log with one line a step, and the program.
 */
import { MOMENTS } from "../scenario/loop.js";
import { h } from "../views/dom.js";
import { poseInWords, poseText, symbol, timed, turnInWords, turnText, written } from "./naming.js";
import { lineOf, PROGRAM } from "./loop_words.js";

// The columns of the log: a key, its symbol with the index, and how a value is written.
export const COLUMNS = Object.freeze([
  { key: "t", letter: "t", index: "", write: (row) => String(row.t) },
  { key: "s", letter: "S", index: "t", write: (row, task) => poseText(task.pose(row.s)) },
  { key: "a", letter: "A", index: "t", write: (row, task) => turnText(task.robot.steering[row.a]) },
  { key: "r", letter: "R", index: "t+1", write: (row) => written(row.r) },
  { key: "sNext", letter: "S", index: "t+1", write: (row, task) => poseText(task.pose(row.sNext)) },
]);

/** Set a column's symbol as mathematics is set. */
export function heading({ letter, index }) {
  return index ? symbol(letter, index) : h("i", {}, letter);
}

/** A table with one line a step; what has not happened yet is empty. */
export class LogView {
  constructor(parent) {
    this.body = h("tbody");
    const names = [...COLUMNS.map(heading), "end"].map((name) => h("th", { scope: "col" }, name));
    const caption = h("caption", { class: "rl-hidden" }, "Log");
    const table = h("table", { class: "rl-log" }, caption, h("thead", {}, h("tr", {}, names)), this.body);
    const place = { class: "rl-log-scroll", tabindex: 0, role: "group", "aria-label": "Log of the steps" };
    this.element = h("div", place, table);
    parent.append(this.element);
  }

  draw(rows, task, fresh) {
    this.body.replaceChildren(...rows.map((row, i) => this.line(row, task, i === rows.length - 1 ? fresh : [])));
    this.element.scrollTop = this.element.scrollHeight;
  }

  line(row, task, fresh) {
    const cells = COLUMNS.map((column) => {
      const known = row[column.key] !== null;
      return h("td", { class: fresh.includes(column.key) ? "rl-fresh" : null }, known ? column.write(row, task) : "");
    });
    const kind = `${row.end ? "rl-end-word" : ""}${fresh.includes("end") ? " rl-fresh" : ""}`;
    const end = h("td", { class: kind }, row.end === null ? "" : row.end || "no");
    return h("tr", {}, cells, end);
  }
}

/** The episode as one line of symbols with their values below; a press on one goes back to when it was new. */
export class TimeLine {
  /** `onPick(position)` hears the moment of the symbol that is pressed. */
  constructor(parent, { onPick }) {
    this.onPick = onPick;
    this.list = h("ol", { class: "rl-line" });
    const place = { class: "rl-line-scroll", tabindex: 0, role: "group", "aria-label": "Time line" };
    this.element = h("div", place, this.list);
    parent.append(this.element);
  }

  /** `fresh` names what has just come: the action, the reward or the next state of the last row, or the last state. */
  draw(rows, task, fresh) {
    const parts = [this.state(rows[0].s, 0, 0, task), ...rows.flatMap((row) => this.step(row, task))];
    const known = parts.filter(Boolean);
    if (fresh.some((key) => key !== "end")) known.at(-1).classList.add("rl-fresh");
    this.list.replaceChildren(...known);
    this.element.scrollLeft = this.element.scrollWidth;
  }

  /** A_t, R_{t+1} and S_{t+1}, as far as they are known. */
  step({ t, a, r, sNext }, task) {
    const turn = a === null ? null : task.robot.steering[a];
    const at = (moment) => MOMENTS.length * t + MOMENTS.indexOf(moment);
    return [
      a === null ? null : this.item("action", "A", t, at("choose"), turnText(turn), turnInWords(turn)),
      r === null ? null : this.item("reward", "R", t + 1, at("pay"), written(r), `reward ${written(r)}`),
      sNext === null ? null : this.state(sNext, t + 1, at("show"), task),
    ];
  }

  state(s, t, position, task) {
    const pose = task.pose(s);
    return this.item("state", "S", t, position, poseText(pose), poseInWords(pose));
  }

  /** A symbol with its value, and over both the button, which Tab leaves out: the keyboard has "Back". */
  item(kind, letter, t, position, text, words) {
    const value = h("span", { class: "rl-item-value" }, text);
    const label = `Go to ${timed(letter, t)}: ${words}`;
    const onClick = () => this.onPick(position);
    const names = { class: "rl-item-go", "aria-label": label, title: label };
    const go = h("button", { type: "button", tabindex: -1, ...names, onClick });
    return h("li", { class: `rl-item rl-item-${kind}` }, symbol(letter, t), value, go);
  }
}

/** The program of the loop; the present line is marked. */
export class ProgramView {
  constructor(parent) {
    this.lines = PROGRAM.map((text) => h("li", {}, h("code", {}, text)));
    this.element = h("ol", { class: "rl-program", "aria-label": "The loop as a program" }, this.lines);
    parent.append(this.element);
  }

  draw(moment) {
    this.lines.forEach((line, i) => {
      if (i === lineOf(moment)) line.setAttribute("aria-current", "step");
      else line.removeAttribute("aria-current");
    });
  }
}
