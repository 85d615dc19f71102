/**
 * Explorable of chapter 3: is what the robot perceives enough? Hide its heading, and one observation has many futures.
 */
import { Generator } from "../rng.js";
import { Pose } from "../robot.js";
import { History, PERCEPTIONS } from "../scenario/history.js";
import { posesOf } from "../scenario/trial.js";
import { button, segmented, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { drive as told, named, verdict } from "./aliasing_words.js";
import { ForecastBars } from "./forecast_bars.js";
import { pair } from "./figure.js";
import { keysOf } from "./map_cursor.js";
import { turnText } from "./naming.js";
import { TaskFigure } from "./task_figure.js";

const NAMES = { cell: "cell", heading: "heading", pose: "cell and heading" };
const MOST_DRIVES = 5000;
const LEGS_A_SECOND = 1.6;

/** Build the figure on a stage. */
export function start(stage) {
  new Aliasing(stage).open();
}

class Aliasing extends TaskFigure {
  constructor(stage) {
    super(stage, "Is what the robot perceives enough?");
    this.looks = new Map(); // what was found for a model and a way to perceive
    this.way = null; // the poses of the last drive, and the leg on which the robot is
    this.leg = 2;
    this.player = this.part(
      new Player({ tick: () => this.nextLeg(), draw: (at) => this.drawMap(at), speed: LEGS_A_SECOND }),
    );
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair("rl-alias-pair");
    body.append(this.buildLook(), element);
    const keys = keysOf({
      enter: ({ x, y }) => this.put(x, y, this.stage.state.pose[2]),
      l: () => this.turnBy(45),
      r: () => this.turnBy(-45),
    });
    this.map = this.part(new GridView(left, {
      label: "Map with the poses that look alike",
      onCell: (event) => this.press(event),
      onKey: (event) => keys(event, this.map),
    }));
    this.legend = new Legend(left);
    left.append(this.buildRun());
    right.append(answer);
    this.bars = new ForecastBars(right, { onPick: (before) => this.set({ before }) });
    this.told = h("p", { class: "rl-help rl-told" });
    right.append(this.told);
    body.append(this.buildSettings());
  }

  buildLook() {
    this.perceive = segmented({
      label: "The robot perceives its",
      options: PERCEPTIONS.map((one) => [one, NAMES[one]]),
      onChange: (perceive) => this.change({ perceive }),
    });
    const turns = this.first.scenario.steering.toReversed(); // left turns on the left
    this.turn = segmented({
      label: "and turns by",
      options: turns.map((a) => [String(a), turnText(a)]),
      onChange: (turn) => this.change({ turn: Number(turn) }),
    });
    return h("div", { class: "rl-alias-look" }, this.perceive.element, this.turn.element);
  }

  buildSettings() {
    const keys = "Keys on the map: arrows move, Enter puts it there, L and R turn it.";
    const help = h("p", { class: "rl-help", text: `Press a cell to put the robot there. ${keys}` });
    return h("div", { class: "rl-row" }, this.buildSlip(0.5), help);
  }

  buildRun() {
    this.once = button({ label: "Drive two steps", icon: "step", primary: true, onClick: () => this.drive(1) });
    this.many = button({ label: "100 drives", icon: "episode", onClick: () => this.drive(100) });
    this.frame.focusFirst(this.once.element);
    return toolbar({ label: "Try it", children: [this.once, this.many] }).element;
  }

  // ---------------------------------------------------------------- changing
  showAll() {
    const { perceive, turn, scenario } = this.stage.state;
    this.perceive.value = perceive;
    this.turn.value = String(turn);
    this.slip.value = scenario.slip;
    this.way = null;
    this.player.pause();
    this.draw();
  }

  /** Find the forecasts of a state, and drive as often as it says. */
  prepare({ scenario, perceive, pose, turn, drives }) {
    const { task, mdp } = this.problemOf(scenario);
    const s = task.index(new Pose(...pose));
    if (this.mdp !== mdp) this.looks.clear();
    if (!this.looks.has(perceive)) {
      const look = new History(task, mdp, perceive);
      this.looks.set(perceive, { look, count: look.count() });
    }
    const a = task.robot.steering.indexOf(turn);
    const { look, count } = this.looks.get(perceive);
    Object.assign(this, { task, mdp, look, count, s, a, forecast: look.forecast(s, a), tried: new Map(), last: null });
    this.chance = new Generator(scenario.seed);
    for (let n = 0; n < drives; n++) this.try();
  }

  /** Drive once, and count how it ended. */
  try() {
    const found = this.look.draw(this.s, this.a, this.chance);
    if (!found) return;
    const counts = this.tried.get(found.h) ?? this.tried.set(found.h, new Map()).get(found.h);
    const o = this.look.phi[found.next];
    counts.set(o, (counts.get(o) ?? 0) + 1);
    this.last = found;
  }

  /** Ask another question: what was tried for the old one is no answer to it. */
  change(patch) {
    return super.change({ ...patch, drives: 0, before: null });
  }

  drive(times) {
    const drives = Math.min(this.stage.state.drives + times, MOST_DRIVES);
    for (let n = this.stage.state.drives; n < drives; n++) this.try();
    this.way = this.last && this.wayOf(this.last);
    this.leg = times === 1 && this.way ? -1 : 2;
    this.set({ drives, before: null });
    if (times === 1 && this.way) this.player.play();
  }

  wayOf({ before, s, next }) {
    return posesOf(this.task, [before, s, next], this.a);
  }

  nextLeg() {
    this.leg += 1;
    return this.leg < 2;
  }

  // ---------------------------------------------------------------- the map
  press({ type, x, y, theta, button: pressed }) {
    if (type !== "down" || pressed > 0) return;
    this.map.cursor = [x, y];
    this.put(x, y, theta);
  }

  put(x, y, theta) {
    if (this.task.world.blocked(x, y)) return this.stage.message("An obstacle stands there.", "note");
    if (this.task.world.isGoal(x, y)) return this.stage.message("The goal: the episode is over there.", "note");
    this.stage.message("");
    return this.change({ pose: [x, y, theta] });
  }

  turnBy(angle) {
    const [x, y, theta] = this.stage.state.pose;
    this.put(x, y, (theta + angle + 360) % 360);
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { look, forecast, count, stage, tried } = this;
    const { perceive, pose: [x, y, theta], turn, before, drives } = stage.state;
    const pose = new Pose(x, y, theta);
    if (this.way === null && !this.map.cursorShown) this.map.cursor = [x, y];
    const title = perceive === "heading" ? "heading before" : "it came from";
    const name = (o) => named(o, perceive, look, pose);
    this.bars.draw({ forecast, name, tried, before, title });
    this.told.textContent = this.last ? told(look, this.last, drives) : "";
    this.frame.say(verdict(look, forecast, count, { perceive, pose, turn }));
    const none = forecast.rows.length ? "" : "No step leads here.";
    const enough = drives >= MOST_DRIVES ? `${MOST_DRIVES} drives are enough.` : "";
    for (const one of [this.once, this.many]) one.disabled(none || enough);
    this.drawMap(1);
  }

  /** The poses that look alike, as likely as they are for one who knows what was before, if a row is picked. */
  drawMap(at) {
    const { task, forecast, stage, way, leg } = this;
    const { before, pose: [x, y, theta], perceive } = stage.state;
    const { width, height, obstacles, goal } = task.world;
    const row = forecast.rows.find(({ h: one }) => one === before) ?? forecast.all;
    const rings = new Float64Array(width * height * 8).fill(NaN);
    for (const [s, chance] of row.poses) {
      const pose = task.pose(s);
      rings[(pose.y * width + pose.x) * 8 + pose.theta / 45] = chance;
    }
    const high = Math.max(...row.poses.values());
    const selected = { x, y, theta: perceive === "pose" ? theta : null };
    const moving = way && leg >= 0 && leg < 2;
    const drive = moving ? { robot: { ...way[leg + 1], from: way[leg], at } } : { path: way };
    const scale = { low: 0, high };
    const world = { width, height, obstacles, goal };
    this.map.draw({ ...world, rings, scale, selected, marks: this.futures(row), ...drive });
    this.legend.draw({ ...scale, label: "chance of the pose" });
    this.map.describe(`${this.frame.answer.textContent} Arrow keys move, Enter puts the robot there, L and R turn it.`);
  }

  /** Where it may be after the turn: the poses of the picked cell that look alike, without a slip. */
  futures(row) {
    const { task, stage } = this;
    const { pose: [x, y], turn, perceive, before } = stage.state;
    const marks = [];
    for (const s of row.poses.keys()) {
      const pose = task.pose(s);
      if (pose.x !== x || pose.y !== y) continue;
      const { sNext, crash } = task.transition(pose, turn);
      marks.push({ x: sNext.x, y: sNext.y, theta: sNext.theta, kind: crash ? "cross" : "arrow" });
    }
    if (before !== null && perceive !== "heading") {
      const cell = perceive === "cell" ? before : Math.floor(before / 8);
      marks.push({ x: cell % task.world.width, y: Math.floor(cell / task.world.width), kind: "square" });
    }
    return marks;
  }
}
