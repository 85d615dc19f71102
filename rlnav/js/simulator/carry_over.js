/**
 * The learned table on another map, without any further learning: on a map of its own, so that the run stays as it is.
 */
import { paint, PRESETS, randomMap } from "../scenario/edits.js";
import { checkScenario } from "../scenario/scenario.js";
import { button, choice, toggle } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { changes } from "./fields.js";
import { groundOf, isWall } from "./ground.js";
import { decimals, percent } from "./measures.js";
import { inWords } from "./world_panel.js";

const SIDE = 10; // cells of a random map
const DENSITY = 0.2;

/** Build the part "Carry over". */
export function carryOver(app) {
  const part = new CarryOver(app);
  return { element: part.element, refresh: () => part.refresh() };
}

class CarryOver {
  constructor(app) {
    this.app = app;
    this.seed = 1;
    this.other = null; // the scenario with the other map
    this.result = null; // what the table is worth there
    this.changed = changes();
    this.slice = (ms) => this.work(ms);
    this.build();
  }

  build() {
    const names = Object.keys(PRESETS).map((name) => [name, inWords(name)]);
    const options = [["", "Choose a map"], ...names, ["random", "Random"]];
    this.menu = choice({ label: "Other map", options, value: "", onChange: (name) => this.choose(name) });
    this.menu.element.dataset.key = "carry_map";
    this.another = button({ label: "Another random map", onClick: () => this.scatter() });
    this.draws = toggle({
      label: "Draw obstacles on it",
      value: false,
      onChange: (on) => (this.view.touch = on ? "paint" : "scroll"),
    });
    this.words = h("p", { role: "status" });
    this.place = h("div", { class: "rl-carry-map", hidden: true });
    this.view = new GridView(this.place, {
      label: "Where the learned table is tried",
      onCell: (event) => this.pressed(event),
      onKey: (event) => this.typed(event),
    });
    this.app.stage.onCleanup(() => this.view.destroy());
    this.tools = h("div", { class: "rl-stack", hidden: true }, this.another.element, this.draws.element);
    const title = h("h4", { class: "rl-subtitle", text: "Carry the table over" });
    const help = h("p", { class: "rl-help", text: "What is it worth on another map, without learning there?" });
    const parts = [title, help, this.menu.element, this.words, this.place, this.tools];
    this.element = h("section", { class: "rl-part", dataset: { key: "carry" } }, parts);
  }

  choose(name) {
    if (name === "random") this.scatter();
    else this.take(name === "" ? null : PRESETS[name]);
  }

  scatter() {
    this.seed += 1;
    this.take(randomMap({ width: SIDE, height: SIDE, density: DENSITY, seed: this.seed }));
    this.menu.value = "random";
  }

  /** Put the table on a map. */
  take(ground) {
    this.other = ground && checkScenario({ ...this.app.session.scenario, map: ground.map, starts: ground.starts });
    this.app.refresh();
  }

  pressed({ type, x, y }) {
    if (!this.draws.value) return;
    if (type === "down") this.wall = !isWall(this.other, x, y);
    if (type === "down" || type === "move") this.draw(x, y, this.wall);
  }

  typed(event) {
    if (![" ", "Enter"].includes(event.key) || !this.draws.value) return false;
    const [x, y] = this.view.cursor;
    this.draw(x, y, !isWall(this.other, x, y));
    return true;
  }

  draw(x, y, wall) {
    try {
      this.other = paint(this.other, x, y, wall);
    } catch {
      return; // the goal or a start: they stay
    }
    this.app.refresh();
  }

  refresh() {
    const { session } = this.app;
    if (this.app.playing || !this.changed(session, session.updates, this.other)) return;
    this.result = null;
    this.place.hidden = this.tools.hidden = this.other === null;
    this.another.show(this.menu.value === "random");
    this.tell(this.begin());
    this.show();
  }

  /** Begin the computation; return why it cannot, or "". */
  begin() {
    const { session } = this.app;
    if (this.other === null) return "";
    if (!session.updates) return "Train first: the table is empty.";
    try {
      this.result = session.carryTo(this.other);
      this.app.chore(this.slice);
      return "";
    } catch (error) {
      return error.message;
    }
  }

  work(ms) {
    const more = this.result !== null && this.result.slice(ms);
    if (!more) this.tell("");
    return more;
  }

  tell(trouble) {
    this.words.textContent = trouble || this.sentence();
    this.words.classList.toggle("rl-sign", trouble !== "");
  }

  sentence() {
    if (!this.result) return "";
    const { evaluation, path } = this.result;
    const steps = `${path.steps} ${path.steps === 1 ? "step" : "steps"}`;
    const end = path.goal ? `reaches the goal in ${steps}` : path.crashed ? `crashes after ${steps}` : "gets lost";
    const way = `On the way that is shown it ${end}.`;
    if (!evaluation) return `${way} The exact scores are being computed …`;
    const { success, crash, timeout, gap } = evaluation;
    const worth = Number.isFinite(gap) ? ` The best possible policy is worth ${decimals(gap)} more.` : "";
    const ends = `crashes in ${percent(crash)} and gets lost in ${percent(timeout)}`;
    return `There it reaches the goal in ${percent(success)} of all drives, ${ends}.${worth} ${way}`;
  }

  show() {
    if (this.other === null) return;
    const poses = this.result?.path.poses ?? null;
    const last = poses?.at(-1);
    this.view.draw({ ...groundOf(this.other), path: poses, robot: last ? { ...last, at: 1 } : null });
  }
}
