/**
 * A tour of the controls: one small robot that always turns in the same way, and every kind of control that figures of
 * the book have. The figure ticks off what the reader has tried.
 */
import { checkTour, drive, KINDS, MOST_STEPS, roundTask } from "../scenario/round.js";
import { button, choice, slider, toggle, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { ControlList } from "./control_list.js";
import { Figure, pair } from "./figure.js";
import { keysOf } from "./map_cursor.js";
import { poseInWords, turnInWords } from "./naming.js";
import { PlayButton } from "./playback.js";

const PACE = 3; // steps a second
const EVERYTHING = "You have tried everything: you can work every figure of this book.";

/** Build the figure on a stage. */
export function start(stage) {
  new ControlTour(stage).open();
}

class ControlTour extends Figure {
  constructor(stage) {
    super(stage, "Which turn, again and again, leads to the star?");
    this.task = roundTask();
    this.now = ""; // the kind of control that was used last
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair("rl-tour");
    body.append(answer, element);
    left.append(this.buildLook());
    const keys = keysOf({ enter: (cell) => this.put(cell), r: (cell, back) => this.turnBy(back ? 315 : 45) });
    this.map = this.part(new GridView(left, {
      label: "Map with the robot",
      onCell: (event) => event.type === "down" && event.button === 0 && this.put(event),
      onHover: () => this.drawMap(1),
      onKey: (event) => keys(event, this.map),
    }));
    left.append(this.buildRun());
    this.list = new ControlList(right, () => this.set({ tried: [] }));
    this.watchLecture();
  }

  buildLook() {
    const turns = this.task.robot.steering.toReversed().map((a) => [String(a), turnInWords(a)]);
    const label = "In every step";
    this.turn = choice({ label, options: turns, onChange: (turn) => this.use("menu", { turn: Number(turn) }) });
    this.trail = toggle({ label: "Leave a trail", onChange: (trail) => this.use("box", { trail }) });
    return h("div", { class: "rl-look" }, this.turn.element, this.trail.element);
  }

  buildRun() {
    this.back = button({ label: "Back", icon: "back", onClick: () => this.step("back", -1) });
    this.player = new PlayButton(this.stage, {
      tick: () => this.go(this.steps + 1),
      draw: (at) => this.drawMap(at),
      speed: PACE,
      before: () => this.steps === this.poses.length - 1 && this.go(0),
      onChange: () => this.draw(),
    });
    this.player.element.addEventListener("click", () => this.tick("play"));
    this.next = button({ label: "One step", icon: "step", primary: true, onClick: () => this.step("step", 1) });
    this.frame.focusFirst(this.next.element);
    const tools = toolbar({ label: "Run", children: [this.back, this.player, this.next] });
    this.scrubber = slider({
      label: "Steps", min: 0, max: MOST_STEPS, step: 1, value: 0,
      onInput: (steps) => this.use(this.typed ? "number" : "slider", { steps }),
    });
    // the same callback hears of both: who types, or presses an arrow key in the number, is in its field
    const field = this.scrubber.element.querySelector(".rl-number");
    for (const name of ["change", "keydown"]) {
      field.addEventListener(name, () => (this.typed = true), true);
      field.addEventListener(name, () => (this.typed = false));
    }
    return h("div", { class: "rl-run rl-scrubbed" }, tools.element, this.scrubber.element);
  }

  /** Notice the lecture view, which the frame opens. */
  watchLecture() {
    const { frame: shown } = this.stage;
    const watcher = new MutationObserver(() => {
      if (shown.classList.contains("rl-lecture")) this.tick("lecture");
    });
    watcher.observe(shown, { attributeFilter: ["class"] });
    this.stage.onCleanup(() => watcher.disconnect());
  }

  // ---------------------------------------------------------------- changing
  prepare(state) {
    checkTour(state, this.task);
    this.drive();
  }

  /** Drive anew, to the end; the steps that are shown cannot be more than there are. */
  drive() {
    const { pose, turn } = this.stage.state;
    this.poses = drive(this.task, pose, turn);
    this.map.cursor = pose.slice(0, 2);
  }

  get steps() {
    return Math.min(this.stage.state.steps, this.poses.length - 1);
  }

  set(patch) {
    this.stage.update(patch);
    this.drive();
    this.draw();
  }

  /** Change something by a kind of control, which is ticked off. */
  use(kind, patch) {
    this.now = kind;
    this.set({ ...patch, tried: this.with(kind) });
  }

  tick(kind) {
    this.use(kind, {});
  }

  with(kind) {
    const { tried } = this.stage.state;
    return tried.includes(kind) ? tried : [...tried, kind];
  }

  /** Go to a step; return whether another follows. */
  go(steps) {
    this.set({ steps: Math.min(Math.max(steps, 0), this.poses.length - 1) });
    return this.steps < this.poses.length - 1;
  }

  step(kind, direction) {
    this.player.pause();
    this.tick(kind);
    this.go(this.steps + direction);
  }

  /** Put the robot on a cell; on the same cell once more, it turns. */
  put({ x, y }) {
    const { world } = this.task;
    const [x0, y0, theta] = this.stage.state.pose;
    if (world.blocked(x, y) || world.isGoal(x, y)) {
      this.stage.message("The robot can stand on a free cell only, and the star is its goal.", "note");
      return;
    }
    this.stage.message("");
    this.player.pause();
    const same = x === x0 && y === y0;
    this.use("map", { pose: [x, y, same ? (theta + 45) % 360 : theta], steps: 0 });
  }

  /** Turn the robot where it begins; the keyboard's cursor stays. */
  turnBy(angle) {
    const { cursor } = this.map;
    const [x, y, theta] = this.stage.state.pose;
    this.use("map", { pose: [x, y, (theta + angle) % 360], steps: 0 });
    this.map.cursor = cursor;
  }

  /** Back to the settings of the page. The ticks stay: else nobody could tick off this button. */
  reset() {
    this.player.pause();
    this.stage.message("");
    const { pose, turn, steps, trail } = this.first;
    this.use("again", { pose, turn, steps, trail });
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { state } = this.stage;
    const last = this.steps === this.poses.length - 1;
    this.turn.value = String(state.turn);
    this.trail.value = state.trail;
    this.scrubber.limit(this.poses.length - 1);
    this.scrubber.value = this.steps;
    this.back.disabled(this.steps === 0 ? "This is the beginning." : "");
    this.next.disabled(last ? "The drive is over." : "");
    this.player.refresh();
    this.list.draw(state.tried, this.now);
    if (!this.player.playing) this.drawMap(1);
    this.frame.say(this.sentence());
  }

  drawMap(at) {
    const { state } = this.stage;
    const { world } = this.task;
    const passed = this.poses.slice(0, this.steps + 1);
    const { crashed = false, ...pose } = passed.at(-1);
    this.map.draw({
      width: world.width,
      height: world.height,
      obstacles: world.obstacles,
      goal: world.goal,
      path: state.trail ? passed : null,
      robot: { ...pose, from: passed.at(-2), at, crashed },
    });
    this.map.describe(`${this.sentence()} Arrow keys move a frame, Enter puts the robot there, R turns it.`);
  }

  sentence() {
    const { pose, turn, tried } = this.stage.state;
    const here = this.poses[this.steps];
    const { world } = this.task;
    const steps = `${this.steps} ${this.steps === 1 ? "step" : "steps"}`;
    const all = tried.length === KINDS.length ? ` ${EVERYTHING}` : "";
    if (here.crashed) return `After ${steps} the robot has crashed. Another turn, or another place to begin?${all}`;
    if (world.isGoal(here.x, here.y)) {
      return `The star, after ${steps}: ${turnInWords(turn)} in every step, from cell (${pose[0]}, ${pose[1]}).${all}`;
    }
    return `After ${steps} the robot is in ${poseInWords(here)}.${all}`;
  }
}
