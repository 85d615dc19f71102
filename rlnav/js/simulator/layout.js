/**
 * Where everything stands: the map and its bar, what is measured beside it, and the settings below, folded.
 */
import { h } from "../views/dom.js";
import { Folded } from "./folded.js";
import { inspectorPanel } from "./inspector_panel.js";
import { metricsPanel } from "./metrics_panel.js";

/** Build all panels and put everything into the stage; return the panels. */
export function layOut(app) {
  const beside = [metricsPanel(app), inspectorPanel(app)];
  beside[0].element.dataset.key = "metrics";
  beside[1].element.dataset.key = "inspector";
  const folded = new Folded(app);
  const map = h(
    "section",
    { class: "rl-sim-map", "aria-label": "Map" },
    app.arena.element,
    app.drive.element,
    app.result.element,
    h("div", { class: "rl-sim-seen" }, app.see.legendElement, app.see.element),
  );
  const side = h("div", { class: "rl-sim-side" }, beside.map((panel) => panel.element));
  const settings = folded.elements(["world", "design", "learner"]);
  const more = folded.elements(["compare", "share"]);
  const title = h("h2", { class: "rl-hidden", text: "Simulator" }); // above the headings of its parts
  app.stage.root.append(
    h("div", { class: "rl-sim" },
      title,
      app.runbar.element,
      h("div", { class: "rl-sim-main" }, map, side),
      h("section", { class: "rl-sim-settings", "aria-label": "Settings" }, settings),
      h("section", { class: "rl-sim-settings rl-sim-rest", "aria-label": "More" }, more)),
  );
  return [...beside, folded];
}
