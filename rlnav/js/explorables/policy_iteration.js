/**
 * Policy iteration by hand: does a policy have to be evaluated to the end before it is improved?
 */
import { Pose } from "../robot.js";
import { Rounds, Truth, wholeRun } from "../scenario/rounds.js";
import { button, segmented, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { pair } from "./figure.js";
import { headingChoice, keysHelp, MapCursor } from "./map_cursor.js";
import { PlayButton } from "./playback.js";
import { curvesOf, mapOf, scaleOf } from "./rounds_picture.js";
import { RunsTable, StepTable } from "./rounds_tables.js";
import { aboutPose, sentence } from "./rounds_words.js";
import { TaskFigure } from "./task_figure.js";

const PACE = 6; // steps in a second of a run: time to see what each brings ...
const QUICK = 40; // ... and of one with so many sweeps that nobody would wait for them
const MANY = 10;
const AMOUNTS = [["1", "1"], ["3", "3"], ["10", "10"], ["30", "30"], ["all", "to the end"]];

/** Build the figure on a stage. */
export function start(stage) {
  new PolicyIteration(stage).open();
}

class PolicyIteration extends TaskFigure {
  constructor(stage) {
    super(stage, "Must a policy be evaluated to the end before it is improved?");
    this.pointed = null; // a pose
    this.cursor = new MapCursor({
      onPoint: (cell) => this.point(cell),
      onTell: () => this.pointed && stage.say(this.readout.textContent),
    });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair();
    body.append(element);
    left.append(this.buildLook());
    this.map = this.part(new GridView(left, {
      label: "Map with the value and the turn of every pose",
      onCell: (event) => event.type === "down" && this.cursor.point(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, this.map),
    }));
    this.legend = new Legend(left);
    this.readout = h("p", { class: "rl-help rl-rounds-readout" });
    left.append(this.readout, this.buildRun(), this.amount.element);
    right.append(answer);
    this.numbers = new StepTable(right);
    const axes = { xLabel: "step", yLabel: "largest over all poses" };
    this.chart = this.part(new CurveView(right, { label: "Errors after every step", ...axes }));
    this.runs = new RunsTable(right);
    body.append(this.buildSettings());
  }

  /** What the map shows. */
  buildLook() {
    this.show = segmented({
      label: "Map",
      hideLabel: true,
      options: [["values", "Values"], ["errors", "Errors"], ["changed", "Changed"]],
      onChange: (show) => this.set({ show }),
    });
    this.heading = headingChoice((heading) => this.set({ heading }));
    return h("div", { class: "rl-rounds-look" }, this.show.element, this.heading.element);
  }

  /** What takes the steps. */
  buildRun() {
    this.back = button({ label: "Back", icon: "back", title: "One step back", onClick: () => this.step("back") });
    this.sweep = button({ label: "One sweep", icon: "step", primary: true, onClick: () => this.step("sweep") });
    this.improve = button({ label: "Improve", icon: "train", onClick: () => this.step("improve") });
    this.player = new PlayButton(this.stage, {
      label: "Run to the end",
      tick: () => this.tick(),
      before: () => this.prepareRun(),
      onChange: () => this.drawButtons(),
    });
    this.frame.focusFirst(this.sweep.element);
    const tools = toolbar({ label: "Steps", children: [this.back, this.sweep, this.improve, this.player] });
    this.amount = segmented({
      label: "A run improves after so many sweeps",
      options: AMOUNTS,
      onChange: (n) => this.set({ sweeps: n === "all" ? null : Number(n) }),
    });
    return h("div", { class: "rl-run rl-rounds-run" }, tools.element);
  }

  buildSettings() {
    const row = h("div", { class: "rl-row" }, this.buildGamma(0.99), this.buildSlip(1));
    return h("div", {}, row, keysHelp("Keys on the map: arrows move, R turns the heading."));
  }

  // ---------------------------------------------------------------- changing
  adopt(state) {
    this.player.pause();
    super.adopt(state);
  }

  showAll() {
    const { scenario, sweeps, show, heading } = this.stage.state;
    this.gamma.value = scenario.gamma;
    this.slip.value = scenario.slip;
    this.show.value = show;
    this.heading.value = heading;
    this.amount.value = sweeps === null ? "all" : String(sweeps);
    this.draw();
  }

  /** Go through the steps of a state in its world. */
  prepare({ scenario, tol, moves }) {
    const { task, mdp, policy } = this.problemOf(scenario);
    const truth = mdp === this.truth?.mdp ? this.truth : new Truth(mdp);
    const rounds = new Rounds(mdp, firstPolicy(task, mdp, policy), tol, truth);
    rounds.replay(moves);
    Object.assign(this, { task, truth, rounds, scale: scaleOf(truth) });
  }

  /** Change the world; the same steps are taken in it. */
  change(patch) {
    this.player.pause();
    return super.change(patch);
  }

  /** Take one step: "sweep", "improve" or "back". */
  step(kind) {
    this.player.pause();
    if (this.stage.attempt(() => this.rounds[kind]())) this.set({ moves: this.rounds.moves });
  }

  /** One step of a run; whether another follows. */
  tick() {
    const { sweeps, tried } = this.stage.state;
    const more = this.rounds.advance(sweeps);
    const fresh = this.rounds.done && !tried.includes(sweeps);
    this.set({ moves: this.rounds.moves, tried: fresh ? [...tried, sweeps] : tried });
    return more;
  }

  /** A run begins anew if nothing is left to do. */
  prepareRun() {
    if (this.rounds.done) this.change({ moves: "" });
    this.player.speed = (this.stage.state.sweeps ?? Infinity) >= MANY ? QUICK : PACE;
  }

  // ---------------------------------------------------------------- the map
  point(cell) {
    const { heading } = this.stage.state;
    const free = cell && !this.task.world.blocked(cell.x, cell.y);
    this.pointed = free ? { x: cell.x, y: cell.y, theta: heading ?? cell.theta ?? this.cursor.facing } : null;
    this.draw();
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { rounds, task, pointed, stage } = this;
    const { heading, show } = stage.state;
    const picture = mapOf(this, { heading, show });
    this.map.draw({ ...picture, selected: pointed });
    const words = sentence(rounds);
    this.map.describe(`${words} Arrow keys move, R turns the heading.`);
    this.legend.draw({ ...picture.scale, label: picture.label });
    const about = "Point at a pose, or tap it, to see what an improvement would do there.";
    const s = pointed && task.index(new Pose(pointed.x, pointed.y, pointed.theta));
    this.readout.textContent = pointed ? aboutPose(rounds, s, pointed, task.robot.steering) : about;
    this.numbers.draw(rounds);
    this.chart.draw(curvesOf(rounds));
    this.drawRuns();
    this.drawButtons();
    this.frame.say(words);
  }

  /** What whole runs from the first policy cost, of those that the reader has tried. */
  drawRuns() {
    const { rounds, truth, stage } = this;
    const { tried, tol } = stage.state;
    const key = JSON.stringify([tried, tol, truth.mdp.gamma, stage.state.scenario.slip]);
    if (key === this.runsKey) return;
    this.runsKey = key;
    const first = rounds.steps[0].pi;
    const sorted = [...tried].sort((a, b) => (a ?? Infinity) - (b ?? Infinity));
    this.runs.draw(sorted.map((n) => ({ n, run: wholeRun(truth.mdp, first, tol, n, truth) })));
  }

  drawButtons() {
    const { rounds } = this;
    const full = rounds.full ? `Here are ${rounds.limit} steps; start again for more` : "";
    this.back.disabled(rounds.length === 0 ? "This is the beginning" : "");
    this.sweep.disabled(full);
    this.improve.disabled(full);
    this.player.refresh(rounds.done ? "Run again" : "Run to the end", full);
  }
}

/** The reader's own policy, or the robot that always drives as straight on as it can. */
function firstPolicy(task, mdp, policy) {
  const pick = (row) => row.indexOf(Math.max(...row));
  if (policy) return Int32Array.from({ length: mdp.S }, (_, s) => pick(policy.subarray(s * mdp.A, (s + 1) * mdp.A)));
  return new Int32Array(mdp.S).fill(pick(task.robot.steering.map((a) => -Math.abs(a))));
}
