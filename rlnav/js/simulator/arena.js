/**
 * The map of the simulator: what is known of every pose in color, the robot on its way, and the pose that is looked at.
 */
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Editing } from "./editing.js";
import { scaleOf } from "./scales.js";
import { atCursor, ofMap } from "./words.js";

const BESIDES = 300; // pixels of the window that the run bar, the result and the menus take
const NEVER = 127; // no best turn: the pose has never been visited

export class Arena {
  constructor(app) {
    this.app = app;
    this.element = h("div", { class: "rl-arena" });
    app.stage.root.append(this.element); // its colors are known only in the page
    this.editing = new Editing(app, this);
    this.hovered = null; // { x, y, theta } under the pointer or the keyboard's cursor
    this.selected = null; // the pose that was tapped last
    this.described = null; // the scenario that a screen reader knows
    this.heading = 0; // that the keyboard's cursor looks at
    this.view = new GridView(this.element, {
      label: "Map of the robot's world",
      onCell: (event) => this.editing.pressed(event),
      onHover: (cell) => this.hover(cell),
      onKey: (event) => this.editing.typed(event),
    });
    this.onTouch = (event) => this.editing.grabs(event) && event.preventDefault(); // or the page would scroll instead
    this.view.canvas.addEventListener("touchstart", this.onTouch, { passive: false });
  }

  destroy() {
    this.view.destroy();
  }

  toBlob() {
    return this.view.toBlob();
  }

  focus() {
    this.view.focus();
  }

  /** The pose that is pointed at, or was tapped, or where the robot stands. */
  get pose() {
    return this.pointed ?? this.app.session.pose;
  }

  get pointed() {
    return [this.hovered, this.selected].find((pose) => pose && this.isPose(pose)) ?? null;
  }

  isPose({ x, y }) {
    const { world } = this.app.session;
    return x < world.width && y < world.height && !world.blocked(x, y);
  }

  hover(cell) {
    const byKey = cell && cell.theta === null;
    this.hovered = cell && { ...cell, theta: cell.theta ?? this.heading };
    if (byKey) this.app.say(atCursor(this.app, this.hovered));
    this.app.refresh();
  }

  /** Select a pose, so that it stays while the pointer is away; the same once more lets it go. */
  select(pose) {
    const same = this.selected && ["x", "y", "theta"].every((key) => this.selected[key] === pose[key]);
    this.selected = same ? null : pose;
    this.app.refresh();
  }

  /** Turn the heading that the keyboard's cursor looks at. */
  turn() {
    this.heading = (this.heading + 45) % 360;
    const [x, y] = this.view.cursor;
    this.hover({ x, y, theta: null });
  }

  /** Draw all of it; `at` is how far the robot is on its way to the next cell. */
  draw(at) {
    const { app, view, editing } = this;
    view.touch = app.tool === "none" ? "scroll" : "paint";
    const ground = editing.ground;
    view.maxHeight = Math.max(300, innerHeight - BESIDES);
    const shown = { ...this.knowledge(ground), ...this.motion(at) };
    view.draw({ ...ground, ...shown, selected: this.pointed, marks: this.marks() });
    if (app.playing && app.scenario === this.described) return; // a robot that moves all the time is not told
    view.describe(ofMap(app));
    this.described = app.scenario;
  }

  /** Colors, needles and numbers: what the table says. */
  knowledge({ width, height, obstacles, goal }) {
    const { session, view } = this.app;
    const { world } = session;
    if (world.width !== width || world.height !== height) return {};
    this.scale = scaleOf(session, view.color);
    const shown = view.color === "none" ? null : this.known(view.color, obstacles, goal);
    const needles = view.glyph === "needles" ? this.needles(obstacles, goal) : null;
    const values = view.glyph === "none" ? { cells: shown && inCells(shown, view.color) } : { rings: shown };
    return { ...values, needles, scale: this.scale, numbers: view.numbers };
  }

  /** One number for each pose; those without a meaning are left out. */
  known(color, obstacles, goal) {
    const { session } = this.app;
    const visits = session.visitsPerPose();
    if (color === "error" && !session.solved) return null;
    const source = { value: () => session.valuesPerPose(), error: () => session.errorPerPose(), visits: () => visits };
    const goalAt = goal[1] * session.world.width + goal[0];
    const seen = color === "error" ? () => true : (i) => visits[i] > 0;
    return Float64Array.from(source[color](), (v, i) => {
      const cell = i >> 3;
      if (obstacles[cell] || cell === goalAt || !seen(i)) return NaN;
      return color === "visits" ? Math.log10(v) : v;
    });
  }

  needles(obstacles, goal) {
    const { session } = this.app;
    const visits = session.visitsPerPose();
    const goalAt = goal[1] * session.world.width + goal[0];
    return Int8Array.from(session.turnsPerPose(), (turn, i) => {
      const cell = i >> 3;
      return obstacles[cell] || cell === goalAt || !(visits[i] > 0) || !(Math.abs(turn) <= 180) ? NEVER : turn / 45;
    });
  }

  /** Where the robot is and which way it came. */
  motion(at) {
    const { app } = this;
    const { view, pinned, session } = app;
    if (app.trouble) return {};
    const ghost = pinned && pinned.path && sameMap(pinned.scenario, app.scenario) ? pinned.path : null;
    if (app.drive.on) return { ...app.drive.shown(at), ghost };
    const beyond = app.fast || session.done || session.isPlayback; // what the eye, or the run, can show step by step
    const learned = app.tour.watching || view.path === "learned" || (view.path === "auto" && beyond);
    const itself = () => ({ path: session.path(), robot: robotOf(session, at) });
    const motion = learned && session.updates ? app.tour.shown() : itself();
    return { ...motion, path: view.path === "none" ? null : motion.path, ghost };
  }

  marks() {
    const { pair } = this.app;
    if (!pair) return [];
    return pair.flatMap((pose, i) => [
      { ...pose, kind: "ring" },
      { ...pose, kind: "arrow" },
      { x: pose.x, y: pose.y + 0.3, kind: "text", text: "AB"[i] },
    ]);
  }
}

/** Where the robot of the learner stands, and where it came from. */
function robotOf(session, at) {
  const { pose, from, crashed } = session.robot;
  return { ...pose, from, crashed, at };
}

/** One number for each cell: that of its best heading, or of all of them together. */
function inCells(values, color) {
  const cells = new Float64Array(values.length / 8).fill(NaN);
  const join = color === "visits" ? (a, b) => Math.log10(10 ** a + 10 ** b) : Math.max;
  values.forEach((v, i) => {
    if (Number.isNaN(v)) return;
    const cell = i >> 3;
    cells[cell] = Number.isNaN(cells[cell]) ? v : join(cells[cell], v);
  });
  return cells;
}

function sameMap(a, b) {
  return a.map.join() === b.map.join();
}
