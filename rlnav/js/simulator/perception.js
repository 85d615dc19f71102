/**
 * What the robot perceives: its whole pose or a choice of features, how large a table that makes, and a sign when
 * situations that differ look alike to it.
 */
import { tableSizeOf } from "../scenario/model.js";
import { button, number, segmented, toggle } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";
import { changes } from "./fields.js";
import { headingInWords, turnInWords } from "./words.js";

export const FEATURES = [
  ["cell", "Its cell", "Where it stands, without its heading."],
  ["heading", "Its heading", "One of the eight, as on a compass."],
  ["goal_direction", "Direction of the goal on the map", "Left, level or right; below, level or above: nine cases."],
  ["goal_bearing", "Goal as seen from the robot", "In equal sectors around it; the first is straight ahead."],
  ["goal_distance", "Distance to the goal", "Sorted into bins by these limits, in cells."],
  ["moves_ahead", "Moves that would crash", "For each of its turns: free or not."],
];
const ARGUMENTS = { goal_bearing: 8, goal_distance: [1.5, 3, 6] };
const CARRIED = ["goal_bearing", "moves_ahead"]; // a first choice that makes sense on any map
const DECADES = 7; // of the bars' scale: tables have at most ten million rows

/** Build the part; `refresh(visible)` follows the scenario. */
export function perception(app, fields) {
  let chosen = CARRIED; // taken up again when the reader comes back from the whole pose
  const kind = segmented({
    label: "The robot perceives",
    hideLabel: true,
    options: [["pose", "Its whole pose"], ["features", "A choice of features"]],
    value: "pose",
    onChange: (value) => fields.change({ features: value === "pose" ? null : chosen }),
  });
  fields.add("features", kind, (scenario) => (scenario.features ? "features" : "pose"));
  const rows = FEATURES.map((feature) => featureRow(app, fields, ...feature));
  const list = h("div", { class: "rl-features" }, rows.map((row) => row.element));
  const own = h("p", { class: "rl-help", text: "The state features are a function of your own, in Python." });
  const size = meter(app);
  const sign = twins(app);
  const changed = changes();
  return {
    element: h("div", { class: "rl-stack" }, own, kind.element, list, size.element, sign.element),
    refresh(visible) {
      if (visible) sign.look();
      if (!changed(app.scenario, app.session)) return;
      chosen = app.scenario.features ?? chosen;
      own.hidden = !app.session.own.includes("features");
      kind.show(own.hidden);
      list.hidden = app.scenario.features === null || !own.hidden;
      for (const row of rows) row.refresh();
      size.refresh();
    },
  };
}

const nameOf = (feature) => (Array.isArray(feature) ? feature[0] : feature);

/** One feature: a box to tick, and its argument if it has one. */
export function featureRow(app, fields, name, label, help) {
  const present = () => app.scenario.features?.find((feature) => nameOf(feature) === name);
  const put = (feature) => {
    const others = (app.scenario.features ?? []).filter((other) => nameOf(other) !== name);
    const order = FEATURES.map(([key]) => key);
    const next = feature ? [...others, feature] : others;
    fields.change({ features: next.sort((a, b) => order.indexOf(nameOf(a)) - order.indexOf(nameOf(b))) });
  };
  const box = toggle({ label, help, value: false, onChange: (on) => put(on ? (argument?.feature() ?? name) : null) });
  const argument = argumentField(name, put);
  return {
    element: h("div", { class: "rl-feature" }, box.element, argument?.element),
    refresh() {
      const feature = present();
      box.value = feature !== undefined;
      const last = feature !== undefined && app.scenario.features.length === 1;
      box.input.disabled = last;
      box.element.title = last ? "The robot must perceive something." : "";
      if (argument) {
        argument.element.hidden = feature === undefined;
        if (feature) argument.show(Array.isArray(feature) ? feature[1] : ARGUMENTS[name]);
      }
    },
  };
}

/** The field for a feature's argument, or null if it has none. */
function argumentField(name, put) {
  if (name === "goal_bearing") {
    const sectors = number({ label: "Sectors", min: 2, max: 72, step: 1, value: 8, onChange: (n) => put([name, n]) });
    return { element: sectors.element, feature: () => [name, sectors.value], show: (n) => (sectors.value = n) };
  }
  if (name !== "goal_distance") return null;
  return binsField((bins) => put([name, bins]));
}

/** A text field for ascending limits, such as "1.5, 3, 6". */
function binsField(onChange) {
  let good = ARGUMENTS.goal_distance;
  const id = uniqueId("bins");
  const fault = h("p", { class: "rl-fault", id: `${id}-fault`, role: "alert" });
  const input = h("input", { type: "text", id, class: "rl-number rl-bins", inputmode: "text", autocomplete: "off" });
  const accept = () => {
    const bins = input.value.split(/[,;\s]+/).filter(Boolean).map(Number);
    const ascending = bins.every((bin, i) => bin >= 0 && (i === 0 || bin > bins[i - 1]));
    const fine = bins.length > 0 && bins.length <= 8 && ascending && bins.every(Number.isFinite);
    fault.textContent = fine ? "" : "Type one to eight ascending distances, such as 1.5, 3, 6. The last ones are kept.";
    input.setAttribute("aria-invalid", String(!fine));
    if (fine) onChange(bins);
  };
  input.addEventListener("change", accept);
  const label = h("label", { class: "rl-label", for: id, text: "Limits" });
  return {
    element: h("div", { class: "rl-field rl-number-field" }, label, input, fault),
    feature: () => ["goal_distance", good],
    show(bins) {
      good = bins;
      input.value = bins.join(", ");
      fault.textContent = "";
      input.setAttribute("aria-invalid", "false");
    },
  };
}

/** Two bars that compare the table with that of the whole pose; each mark is a factor of ten. */
export function meter(app) {
  const bar = (name) => {
    const part = h("i", {});
    const words = h("span", { class: "rl-meter-words" });
    const scale = h("span", { class: "rl-meter-bar", "aria-hidden": true }, part);
    return { element: h("div", { class: "rl-meter-row" }, h("span", { text: name }), scale, words), part, words };
  };
  const bars = [bar("This table"), bar("Whole pose")];
  const summary = h("p", { class: "rl-help", role: "status" });
  const element = h("div", { class: "rl-meter" }, bars.map((each) => each.element), summary);
  element.dataset.key = "size";
  return {
    element,
    refresh() {
      const sent = app.session.own.includes("features");
      const { rows, actions, poseRows } = sent ? app.session.tableSize() : tableSizeOf(app.scenario);
      [rows, poseRows].forEach((n, i) => {
        bars[i].part.style.width = `${(100 * Math.log10(n)) / DECADES}%`;
        bars[i].words.textContent = `${words(n)} rows × ${actions} = ${words(n * actions)} numbers`;
      });
      const whole = app.scenario.features === null && !sent;
      bars[1].element.hidden = whole;
      summary.textContent = whole ? "One row for each pose; each mark is ten times more." : compared(rows, poseRows);
    },
  };
}

function compared(rows, poseRows) {
  const factor = rows > poseRows ? rows / poseRows : poseRows / rows;
  const times = words(Number(factor.toPrecision(2)));
  if (rows === poseRows) return "As many rows as there are poses.";
  return rows < poseRows ? `${times} times smaller: what it learns at one pose, it knows at all that look alike.`
    : `${times} times larger than it needs to be: many rows belong to no pose of this map.`;
}

function words(n) {
  return n.toLocaleString("en-US");
}

/** The sign that different situations look alike, with a pair of them shown on the map. */
function twins(app) {
  let found = null;
  let of = null; // the session for which it has been looked up
  const text = h("p", {});
  const which = h("p", { role: "status" });
  const show = button({
    label: "Show two of them",
    pressed: false,
    onClick() {
      show.pressed = !show.pressed;
      app.showPair(show.pressed ? found.pair : null);
      which.textContent = show.pressed ? pairInWords(found) : "";
    },
  });
  const element = h("div", { class: "rl-sign" }, text, show.element, which);
  element.dataset.key = "twins";
  const tell = () => {
    element.hidden = found === null || found.count === 0;
    if (element.hidden) return;
    const mixed = found.count === 1 ? "1 row mixes" : `${words(found.count)} rows mix`;
    text.textContent = `${mixed} poses that need different turns: no table can be right there.`;
  };
  element.hidden = true;
  return {
    element,
    look() {
      if (of === app.session) return;
      of = app.session;
      found = null;
      show.pressed = false;
      which.textContent = "";
      tell();
      const { session } = app;
      if (session.tableSize().rows === session.tableSize().poseRows) return; // a row for each pose
      app.chore((ms) => {
        if (session !== app.session) return false;
        if (session.solveSlice(ms)) return true;
        found = session.aliasing();
        tell();
        return false;
      });
    },
  };
}

function pairInWords({ pair, turns }) {
  const [a, b] = pair.map(({ x, y, theta }) => `(${x}, ${y}), looking ${headingInWords(theta)}`);
  const [first, second] = turns.map(turnInWords);
  return `A at ${a}, and B at ${b}, look alike. The best turn at A is ${first}, at B ${second}.`;
}
