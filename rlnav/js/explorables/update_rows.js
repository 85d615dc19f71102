/**
 * The two rows of the table that an update reads: the one with the entry that it changes, and the next one.
 */
import { h } from "../views/dom.js";
import { exact } from "./look_ahead.js";
import { poseText, symbol, turnText, written } from "./naming.js";

const ENDS = { goal: "the goal", crash: "crashed" };

export class UpdateRows {
  constructor(parent) {
    this.own = h("th", { scope: "col" });
    this.next = h("th", { scope: "col" });
    this.body = h("tbody");
    const head = h("thead", {}, h("tr", {}, h("th", { scope: "col", text: "turn" }), this.own, this.next));
    const caption = h("caption", { text: "Both rows, before the update" });
    this.table = h("table", { class: "rl-numbers rl-two-rows" }, caption, head, this.body);
    const scrolls = { tabindex: 0, role: "group", "aria-label": "Both rows" };
    this.element = h("div", { class: "rl-numbers-scroll", ...scrolls }, this.table);
    parent.append(this.element);
  }

  /** Show both rows of an update (partsOf in scenario/update.js). */
  draw(parts, algorithm, task) {
    this.element.hidden = parts === null;
    if (!parts) return;
    const place = ENDS[parts.end] ?? poseText(task.pose(parts.sNext));
    this.own.replaceChildren(symbol("S", "t"), ` = ${poseText(task.pose(parts.s))}`);
    this.next.replaceChildren(symbol("S", "t+1"), ` = ${place}`);
    const silent = parts.gamma === 0; // nothing of the next row is used
    this.body.replaceChildren(...task.robot.steering.map((turn, a) => {
      const own = a === parts.a;
      const share = silent ? 0 : parts.share[a];
      const chosen = own ? [tag(symbol("A", "t")), " "] : [];
      const left = h("td", { class: own ? "rl-used rl-entry" : null }, chosen, exact(parts.row[a], 3));
      const mark = share > 0 ? [tag(MARKS[algorithm](share)), " "] : [];
      const look = share > 0 ? "rl-used rl-next" : silent ? "rl-silent" : null;
      const right = h("td", { class: look }, mark, exact(parts.nextRow[a], 3));
      return h("tr", {}, h("th", { scope: "row", text: turnText(turn) }), left, right);
    }));
  }
}

const MARKS = {
  q_learning: () => "max",
  sarsa: () => symbol("A", "t+1"),
  expected_sarsa: (share) => `π ${written(share, 3)}`,
};

function tag(words) {
  return h("span", { class: "rl-tag" }, words);
}
