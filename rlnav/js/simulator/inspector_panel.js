/**
 * The inspector: the last update as a formula with its numbers, and what the table says about one pose.
 */
import { h } from "../views/dom.js";
import { changes, put } from "./fields.js";
import { lastUpdate } from "./last_update.js";
import { decimals, grouped } from "./measures.js";
import { headingInWords } from "./words.js";

/** Build the section "Inspector". */
export function inspectorPanel(app) {
  const update = lastUpdate(app);
  const row = tableRow(app);
  return {
    element: h("section", { class: "rl-inspector", "aria-label": "Inspector" }, update.element, row.element),
    refresh() {
      update.refresh();
      row.refresh();
    },
  };
}

/** The row of the table for the pose that is pointed at: a bar for each turn, with the exact value as a mark. */
function tableRow(app) {
  const title = h("h3", { class: "rl-subtitle" });
  const body = h("tbody", {});
  const columns = ["Turn", "", "Q", "q*", "Visits"].map((text) => h("th", { scope: "col", text }));
  columns[1].setAttribute("aria-hidden", "true");
  const table = h("table", { class: "rl-q" }, h("thead", {}, h("tr", {}, columns)), body);
  const note = h("p", { class: "rl-help" });
  const element = h("div", { class: "rl-stack" }, title, table, note);
  element.dataset.key = "pose";
  const built = changes();
  let rows = [];
  return {
    element,
    refresh() {
      const { session } = app;
      const pose = poseOf(app);
      const row = pose && session.inspect(pose);
      table.hidden = !row;
      put(title, row ? `Q at (${pose.x}, ${pose.y}), looking ${headingInWords(pose.theta)}` : "Q of a pose");
      put(note, row ? noteOf(session, row) : "Point at the map, or move its cursor with the arrow keys.");
      if (!row) return;
      if (built(session.task)) {
        rows = session.task.robot.steering.map(barRow);
        body.replaceChildren(...rows.map((each) => each.element));
      }
      const ends = [Math.min(0, ...row.Q, ...row.exact), Math.max(0, ...row.Q, ...row.exact)];
      rows.forEach((each, a) => each.show(row, a, ends, !session.isPlayback));
    },
  };
}

/** The pose that is pointed at; or the robot's, or the one before if its episode is over. */
function poseOf({ arena, pose, session }) {
  const { learner, mdp } = session;
  const ended = learner.last?.s >= 0 && mdp.terminal[learner.s];
  return arena.pointed ?? (ended ? session.task.pose(learner.last.s) : pose);
}

/** What there is to say about a row. */
function noteOf(session, { s, visits }) {
  if (session.mdp.goal[s]) return "On the goal the episode is over: nothing is to be decided.";
  if (visits.every((n) => n === 0)) return "Never tried: the table still holds its initial values.";
  return "The bar is what it has learned, the stroke the exact value q*.";
}

/** One turn of the table's row. */
function barRow(turn) {
  const cell = (kind) => h("td", { class: kind });
  const bar = h("i", { class: "rl-q-bar" });
  const exact = h("i", { class: "rl-q-exact" });
  const zero = h("i", { class: "rl-q-zero" });
  const scale = h("td", { class: "rl-q-scale", "aria-hidden": true }, h("div", {}, zero, bar, exact));
  const [q, star, visits] = [cell(), cell("rl-q-star"), cell()];
  const best = h("span", { class: "rl-q-best", text: "best" });
  const name = h("th", { scope: "row" }, shortTurn(turn), " ", best);
  const element = h("tr", {}, name, scale, q, star, visits);
  return {
    element,
    show({ Q, exact: stars, visits: counts, best: winner }, a, [low, high], counted) {
      const at = (v) => (100 * (v - low)) / (high - low || 1);
      const [from, to] = [at(Math.min(0, Q[a])), at(Math.max(0, Q[a]))];
      Object.assign(bar.style, { left: `${from}%`, width: `${to - from}%` });
      exact.style.left = `${at(stars[a])}%`;
      zero.style.left = `${at(0)}%`;
      q.textContent = decimals(Q[a]);
      star.textContent = decimals(stars[a]);
      visits.textContent = counted ? grouped(counts[a]) : "–";
      best.hidden = a !== winner;
      element.classList.toggle("rl-q-winner", a === winner);
    },
  };
}

/** "45° left": a column of a phone is narrow. */
function shortTurn(a) {
  return a === 0 ? "straight on" : `${Math.abs(a)}° ${a > 0 ? "left" : "right"}`;
}
