/**
 * The panels that are closed at first: a page loads them when the first one is opened (see folded.js).
 */
import { comparePanel } from "./compare_panel.js";
import { designPanel } from "./design_panel.js";
import { learnerPanel } from "./learner_panel.js";
import { sharePanel } from "./share_panel.js";
import { worldPanel } from "./world_panel.js";

/** Build the panels, by the key under which a teacher can hide each. */
export function buildPanels(app) {
  return {
    world: worldPanel(app),
    design: designPanel(app),
    learner: learnerPanel(app),
    compare: comparePanel(app),
    share: sharePanel(app),
  };
}
