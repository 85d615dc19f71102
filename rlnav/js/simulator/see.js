/**
 * What the map shows: colors, glyphs, the path, numbers, and the bar that says what a color means.
 */
import { choice, toggle } from "../views/controls.js";
import { h } from "../views/dom.js";
import { Legend } from "../views/legend.js";
import { CHOICES } from "./view.js";

export class See {
  constructor(app) {
    this.app = app;
    const menu = (key, label) => {
      const options = { label, options: CHOICES[key], value: app.view[key] };
      const control = choice({ ...options, onChange: (value) => app.setView({ [key]: value }) });
      control.element.dataset.key = key;
      return control;
    };
    this.menus = { color: menu("color", "Color"), glyph: menu("glyph", "Glyph"), path: menu("path", "Path") };
    this.numbers = toggle({
      label: "Numbers",
      value: app.view.numbers,
      onChange: (numbers) => app.setView({ numbers }),
    });
    this.numbers.element.dataset.key = "numbers";
    const legend = h("div", { dataset: { key: "legend" } });
    this.legend = new Legend(legend);
    this.legendElement = legend;
    const menus = Object.values(this.menus).map((control) => control.element);
    this.element = h("div", { class: "rl-see", dataset: { key: "see" } }, menus, this.numbers.element);
  }

  refresh() {
    const { view, arena } = this.app;
    for (const [key, control] of Object.entries(this.menus)) control.value = view[key];
    this.numbers.value = view.numbers;
    this.legendElement.hidden = view.color === "none";
    if (view.color !== "none") this.legend.draw(arena.scale);
  }
}
