/**
 * The groups below the map. All are closed at first, and most readers open few: so each begins as its title with the
 * settings in brief, and a page loads what is inside when the first one is opened.
 */
import { group } from "../views/controls.js";
import { inBrief } from "./brief.js";

const TITLES = { world: "World", design: "Design", learner: "Learner", compare: "Compare", share: "Share" };

export class Folded {
  constructor(app) {
    this.app = app;
    this.loading = null;
    this.panels = {}; // none before they are loaded
    this.shells = Object.entries(TITLES).map(([key, title]) => {
      const shell = group({ title, onToggle: (open) => open && this.load() });
      shell.element.dataset.key = key;
      return [key, shell];
    });
  }

  /** The elements of some groups. */
  elements(keys) {
    return this.shells.filter(([key]) => keys.includes(key)).map(([, shell]) => shell.element);
  }

  refresh() {
    for (const [key, shell] of this.shells) {
      if (key in this.panels) this.app.stage.attempt(() => this.panels[key].refresh());
      else shell.summary(inBrief(key, this.app.scenario, this.app.session.own));
    }
  }

  /** Load the panels, once; a failure can be tried again. */
  async load() {
    if (this.loading) return;
    this.loading = import("./panels.js");
    try {
      const { buildPanels } = await this.loading;
      this.unfold(buildPanels(this.app));
    } catch (error) {
      this.loading = null;
      for (const [, shell] of this.shells) shell.open = false;
      this.app.stage.message(`The settings could not be loaded. ${error.message}`);
    }
  }

  /** Put the panels where their titles stood, open and in focus where those were. */
  unfold(panels) {
    for (const [key, shell] of this.shells) {
      const { element } = panels[key];
      const hasFocus = shell.element.contains(document.activeElement);
      element.dataset.key = key;
      element.open = shell.open;
      shell.element.replaceWith(element);
      if (hasFocus) element.querySelector("summary").focus();
    }
    this.panels = panels;
    const { world } = panels;
    world.element.addEventListener("toggle", () => {
      if (!world.element.open && this.app.tool !== "none") this.app.setTool("none"); // or a finger would paint unawares
    });
    this.app.applyView();
    this.app.refresh();
  }
}
