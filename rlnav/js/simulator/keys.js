/**
 * The keys of the simulator, and the page that tells them. They count only while the focus is in it and not in a field.
 */
import { button } from "../views/controls.js";
import { h } from "../views/dom.js";

const IN_FIELDS = "input:not([type=checkbox]):not([type=radio]), select, textarea, pre, [contenteditable]";
const TABLE = [
  ["Anywhere in the simulator", [
    ["T", "train, or pause"],
    ["N", "one update"],
    ["B", "one update back"],
    ["E", "one episode"],
    ["0", "begin again, untrained"],
    ["D", "drive yourself, or stop driving"],
    ["L", "lecture view, or leave it"],
    ["Ctrl Z", "take back the last change of a setting or of the map"],
    ["?", "this page"],
  ]],
  ["On the map", [
    ["Arrow keys", "move the cursor from cell to cell"],
    ["H", "turn the heading that is looked at by 45°"],
    ["Space or Enter", "wall or no wall; with another tool, what it does"],
    ["Delete", "no wall"],
    ["G", "put the goal here"],
    ["S", "put the start here"],
    ["R", "turn the start by 45°"],
    ["A", "start anywhere"],
  ]],
  ["While you drive", [
    ["↑", "straight on"],
    ["← →", "the smallest turn to the left, to the right"],
    ["Shift ← →", "the largest turn"],
    ["1, 2, 3 …", "the turns in order, from left to right"],
    ["Escape", "stop driving"],
  ]],
  ["In lecture view", [
    ["Space or →", "one update"],
    ["←", "one update back"],
    ["Escape", "leave it"],
  ]],
];

export class Keys {
  constructor(app) {
    this.app = app;
    this.dialog = this.build();
    app.stage.frame.append(this.dialog);
    this.onKey = (event) => this.pressed(event);
    app.stage.frame.addEventListener("keydown", this.onKey);
  }

  destroy() {
    this.app.stage.frame.removeEventListener("keydown", this.onKey);
    this.dialog.remove();
  }

  build() {
    const close = button({ label: "Close", icon: "close", onClick: () => this.dialog.close() });
    const row = ([key, words]) =>
      h("tr", {}, h("th", { scope: "row" }, h("kbd", { text: key })), h("td", { text: words }));
    const tables = TABLE.map(([title, rows]) =>
      h("table", {}, h("caption", { text: title }), h("tbody", {}, rows.map(row))),
    );
    const head = h("div", { class: "rl-keys-head" }, h("h2", { text: "Keys" }), close.element);
    const all = h("div", { class: "rl-keys-all" }, tables);
    return h("dialog", { class: "rl-keys-page", "aria-label": "Keys" }, head, all);
  }

  open() {
    if (!this.dialog.open) this.dialog.showModal();
  }

  pressed(event) {
    const { app } = this;
    if (event.defaultPrevented || event.altKey || this.dialog.open || event.target.matches(IN_FIELDS)) return;
    const control = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    if (control && key === "z" && !event.shiftKey) app.undo();
    else if (control || !this.act(key)) return;
    event.preventDefault();
  }

  /** Do what a key stands for; return whether it stands for anything. */
  act(key) {
    const { app } = this;
    const actions = {
      t: () => app.toggle(),
      n: () => app.move((session) => session.step()),
      b: () => app.move((session) => session.back()),
      e: () => app.move((session) => session.episodeOn()),
      0: () => app.move((session) => session.reset()),
      d: () => app.drive.toggle(),
      l: () => app.setView({ lecture: !app.view.lecture }),
      "?": () => this.open(),
    };
    if (!Object.hasOwn(actions, key)) return false;
    actions[key]();
    return true;
  }
}
