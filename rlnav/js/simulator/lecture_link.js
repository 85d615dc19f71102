/**
 * A link for a lecture: large type, and only those parts and controls that the teacher wants to be seen.
 */
import { toAddress } from "../scenario/address.js";
import { button, toggle } from "../views/controls.js";
import { h } from "../views/dom.js";

// parts of the page; what is not in this list is a single control
const PARTS = {
  world: "World",
  design: "Design",
  learner: "Learner",
  compare: "Compare",
  share: "Share",
  metrics: "Metrics",
  inspector: "Inspector",
  see: "Menus below the map",
  legend: "Legend of the colors",
  result: "Sentence below the map",
  speed: "Speed",
  drive: "Drive",
};
// single controls that have no name of their own on the page
const NAMES = {
  train: "Train",
  progress: "Progress",
  curve: "Choice of the curve",
  scores: "Exact scores",
  update: "Last update",
  pose: "Q of a pose",
  features: "Whole pose or features",
  size: "Size of the table",
  twins: "Sign of look-alikes",
  carry: "Carry over",
  python: "Python code",
};

/** Build the folded part in which a teacher chooses what is left out. */
export function lectureLink(app, outlet) {
  const left = new Set(app.view.hide);
  const large = toggle({ label: "Fill the screen, in large type", value: true });
  const boxes = (names) => names.map(([key, label]) => {
    const flip = (out) => (out ? left.add(key) : left.delete(key));
    return toggle({ label, value: left.has(key), onChange: flip }).element;
  });
  const singles = h("div", { class: "rl-choices" });
  const more = h("details", { class: "rl-inner" }, h("summary", { text: "Single controls" }), singles);
  more.addEventListener("toggle", () => {
    if (!singles.childElementCount) singles.append(...boxes(singleControls(app)));
  });
  const state = () => ({ scenario: app.scenario, view: { ...app.view, lecture: large.value, hide: [...left] } });
  const copy = button({
    label: "Copy lecture link",
    icon: "share",
    onClick: () => outlet.copy(`${location.href.split("#")[0]}${toAddress(state())}`, "The lecture link"),
  });
  const parts = h("div", { class: "rl-choices" });
  const title = h("p", { class: "rl-label", text: "Leave out" });
  const choices = h("div", { role: "group", "aria-label": "Leave out" }, title, parts, more);
  const body = h("div", { class: "rl-stack" }, large.element, choices, copy.element);
  const element = h("details", { class: "rl-inner" }, h("summary", { text: "Link for a lecture" }), body);
  element.dataset.key = "lecture";
  element.addEventListener("toggle", () => {
    if (!parts.childElementCount) parts.append(...boxes(Object.entries(PARTS)));
  });
  return element;
}

/** List what else has a key on the page, as [key, name]. */
function singleControls(app) {
  const found = new Map();
  for (const part of app.stage.frame.querySelectorAll("[data-key]")) {
    const { key } = part.dataset;
    if (!PARTS[key] && !found.has(key)) found.set(key, NAMES[key] ?? nameOf(part) ?? key);
  }
  return [...found];
}

/** What a part is called on the page. */
function nameOf(part) {
  const named = part.querySelector(".rl-subtitle, .rl-label, .rl-button-text, summary");
  return named?.textContent ?? part.getAttribute("aria-label");
}
