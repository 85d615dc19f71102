/**
 * Two runs side by side, and a learned table on another map.
 */
import { button, group, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { carryOver } from "./carry_over.js";
import { changes } from "./fields.js";
import { decimals, grouped, SCORES } from "./measures.js";
import { differences } from "./settings_text.js";

/** Build the group "Compare and carry over". */
export function comparePanel(app) {
  const pins = pinning(app);
  const table = twoRuns(app);
  const carry = carryOver(app);
  const title = h("h4", { class: "rl-subtitle", text: "Two runs side by side" });
  const panel = group({
    title: "Compare",
    summary: "pin a run, carry it over",
    children: [h("section", { class: "rl-part" }, title, pins.element, table.element), carry.element],
    onToggle: () => app.refresh(),
  });
  return {
    element: panel.element,
    refresh() {
      pins.refresh();
      panel.summary(app.pinned ? `pinned: ${grouped(app.pinned.episode)} episodes` : "pin a run, carry it over");
      if (!panel.open) return;
      table.refresh();
      carry.refresh();
    },
  };
}

/** The buttons that pin and unpin; a run is pinned with its exact scores, so they are computed first. */
function pinning(app) {
  let waiting = null; // the session that is about to be pinned
  const whenScored = (ms) => {
    if (waiting !== app.session || app.session.evaluateSlice(ms)) return waiting === app.session;
    waiting = null;
    app.pin();
    app.say("This run is pinned. Change a setting, train again, and compare.");
    return false;
  };
  const pin = button({
    label: "Pin this run",
    icon: "pin",
    onClick() {
      app.pause();
      waiting = app.session;
      app.chore(whenScored);
    },
  });
  const unpin = button({ label: "Unpin", onClick: () => app.unpin() });
  pin.element.dataset.key = "pin";
  const help = h("p", { class: "rl-help", text: "Keeps this run, so that the next one can be compared with it." });
  return {
    element: h("div", { class: "rl-stack" }, toolbar({ label: "Pinned run", children: [pin, unpin] }).element, help),
    refresh() {
      pin.disabled(app.session.updates ? "" : "Nothing has been learned yet.");
      unpin.show(app.pinned !== null);
      help.hidden = app.pinned !== null;
    },
  };
}

/** The table: settings that differ, then the scores. */
function twoRuns(app) {
  const caption = h("caption", {});
  const head = h("thead", {}, h("tr", {}, ["", "Pinned", "This run"].map((text) => h("th", { scope: "col", text }))));
  const body = h("tbody", {});
  const element = h("div", { class: "rl-wide" }, h("table", { class: "rl-two" }, caption, head, body));
  const changed = changes();
  return {
    element,
    refresh() {
      const { pinned, session } = app;
      element.hidden = pinned === null;
      if (!pinned || !changed(pinned, app.scenario, session.evaluation, session.episode)) return;
      const settings = differences(pinned.scenario, session.scenario);
      caption.textContent = settings.length ? "What differs, and what came of it" : "The same settings so far";
      const episodes = ["Episodes", grouped(pinned.episode), grouped(session.episode)];
      body.replaceChildren(...[...settings, episodes, ...scoreRows(pinned, session)].map(lineOf));
    },
  };
}

function scoreRows(pinned, { evaluation, stale, updates }) {
  const now = updates && !stale ? evaluation : null;
  return SCORES.map(({ key, name, tell }) => {
    const [before, after] = [pinned.evaluation[key], now?.[key]];
    const more = after - before;
    const change = Number.isFinite(more) && Math.abs(more) >= 0.0005 && tell(after) !== tell(before);
    return [name, tell(before), now ? tell(after) : "–", change ? signed(more, key) : ""];
  });
}

/** How much more or less; shares in percent points. */
function signed(difference, key) {
  const size = Math.abs(difference);
  const share = key === "success" || key === "crash" || key === "timeout";
  const text = share ? (100 * size).toFixed(1).replace(/\.0$/, "") : decimals(size);
  return `${difference > 0 ? "+" : "−"}${text}`;
}

function lineOf([name, before, after, change = ""]) {
  const now = h("td", {}, after, change && h("span", { class: "rl-change", text: ` (${change})` }));
  return h("tr", {}, h("th", { scope: "row", text: name }), h("td", { text: before }), now);
}
