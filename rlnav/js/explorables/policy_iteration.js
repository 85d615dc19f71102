/**
 * Policy iteration by hand: does a policy have to be evaluated to the end before it is improved?
 */
import { HEADINGS, Pose } from "../robot.js";
import { Rounds, Truth, wholeRun } from "../scenario/rounds.js";
import { button, choice, segmented, slider, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { frame } from "./frame.js";
import { ARROWS } from "./naming.js";
import { rememberedProblem } from "./problem.js";
import { curvesOf, mapOf, scaleOf } from "./rounds_picture.js";
import { RunsTable, StepTable } from "./rounds_tables.js";
import { aboutPose, sentence } from "./rounds_words.js";

const PACE = 6; // steps in a second of a run: time to see what each brings ...
const QUICK = 40; // ... and of one with so many sweeps that nobody would wait for them
const MANY = 10;
const AMOUNTS = [["1", "1"], ["3", "3"], ["10", "10"], ["30", "30"], ["all", "to the end"]];

/** Build the figure on a stage. */
export function start(stage) {
  const figure = new PolicyIteration(stage);
  return () => figure.destroy();
}

class PolicyIteration {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.problemOf = rememberedProblem();
    this.pointed = null; // a pose
    this.facing = 90; // the heading that the keyboard's cursor asks for
    this.player = new Player({
      tick: () => this.tick(),
      draw: () => {},
      onStop: (error) => {
        if (error) stage.message(error.message);
        this.drawButtons();
      },
    });
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
  }

  destroy() {
    for (const part of [this.player, this.map, this.chart]) part.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    const question = "Must a policy be evaluated to the end before it is improved?";
    this.frame = frame(this.stage, { question, onReset: () => this.reset() });
    const left = h("div", { class: "rl-column" });
    const right = h("div", { class: "rl-column" });
    this.frame.body.append(h("div", { class: "rl-pair" }, left, right));
    left.append(this.buildLook());
    this.map = new GridView(left, {
      label: "Map with the value and the turn of every pose",
      onCell: (event) => event.type === "down" && this.point(event),
      onHover: (cell) => this.point(cell),
      onKey: (event) => this.key(event),
    });
    this.legend = new Legend(left);
    this.readout = h("p", { class: "rl-help rl-rounds-readout" });
    left.append(this.readout, this.buildRun(), this.amount.element);
    right.append(this.frame.answer);
    this.numbers = new StepTable(right);
    const axes = { xLabel: "step", yLabel: "largest over all poses" };
    this.chart = new CurveView(right, { label: "Errors after every step", ...axes });
    this.runs = new RunsTable(right);
    this.frame.body.append(this.buildSettings());
  }

  /** What the map shows. */
  buildLook() {
    this.show = segmented({
      label: "Map",
      hideLabel: true,
      options: [["values", "Values"], ["errors", "Errors"], ["changed", "Changed"]],
      onChange: (show) => this.set({ show }),
    });
    const arrows = HEADINGS.map((theta) => [String(theta), `heading ${theta}° ${ARROWS[theta / 45]}`]);
    this.heading = choice({
      label: "Headings",
      hideLabel: true,
      options: [["all", "all headings"], ...arrows],
      onChange: (theta) => this.set({ heading: theta === "all" ? null : Number(theta) }),
    });
    return h("div", { class: "rl-rounds-look" }, this.show.element, this.heading.element);
  }

  /** What takes the steps. */
  buildRun() {
    this.back = button({ label: "Back", icon: "back", title: "One step back", onClick: () => this.step("back") });
    this.sweep = button({ label: "One sweep", icon: "step", primary: true, onClick: () => this.step("sweep") });
    this.improve = button({ label: "Improve", icon: "train", onClick: () => this.step("improve") });
    this.run = button({ label: "Run to the end", icon: "play", onClick: () => this.playOrPause() });
    this.frame.focusFirst(this.sweep.element);
    const tools = toolbar({ label: "Steps", children: [this.back, this.sweep, this.improve, this.run] });
    this.amount = segmented({
      label: "A run improves after so many sweeps",
      options: AMOUNTS,
      onChange: (n) => this.set({ sweeps: n === "all" ? null : Number(n) }),
    });
    return h("div", { class: "rl-rounds-run" }, tools.element);
  }

  buildSettings() {
    const plan = (name) => (value) => this.plan({ scenario: { ...this.stage.state.scenario, [name]: value } });
    this.gamma = slider({ label: "Discount γ", min: 0, max: 0.99, step: 0.01, value: 0, onInput: plan("gamma") });
    this.slip = slider({ label: "Slip", min: 0, max: 1, step: 0.05, value: 0, onInput: plan("slip") });
    const keys = "Keys on the map: arrows move, R turns the heading.";
    const row = h("div", { class: "rl-row" }, this.gamma.element, this.slip.element);
    return h("div", {}, row, h("p", { class: "rl-help rl-rounds-keys", text: keys }));
  }

  // ---------------------------------------------------------------- changing
  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.player.pause();
    this.prepare(state);
    const { scenario, sweeps, show, heading } = state;
    this.gamma.value = scenario.gamma;
    this.slip.value = scenario.slip;
    this.show.value = show;
    this.heading.value = heading === null ? "all" : String(heading);
    this.amount.value = sweeps === null ? "all" : String(sweeps);
    this.draw();
  }

  /** Go through the steps of a state in its world. */
  prepare({ scenario, tol, moves }) {
    const { task, mdp, policy } = this.problemOf(scenario, this.stage.data("tables"));
    const truth = mdp === this.truth?.mdp ? this.truth : new Truth(mdp);
    const rounds = new Rounds(mdp, firstPolicy(task, mdp, policy), tol, truth);
    rounds.replay(moves);
    Object.assign(this, { task, truth, rounds, scale: scaleOf(truth) });
  }

  /** Change the world; the same steps are taken in it. What cannot be becomes a message. */
  plan(patch) {
    this.player.pause();
    if (!this.stage.attempt(() => this.prepare({ ...this.stage.state, ...patch }))) return;
    this.stage.message("");
    this.set(patch);
  }

  /** Change what is shown. */
  set(patch) {
    this.stage.update(patch);
    this.draw();
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

  playOrPause() {
    if (this.player.playing) {
      this.player.pause();
    } else {
      if (this.rounds.done) this.plan({ moves: "" });
      this.player.speed = (this.stage.state.sweeps ?? Infinity) >= MANY ? QUICK : PACE;
      this.player.play();
    }
    this.drawButtons();
  }

  reset() {
    this.stage.message("");
    this.stage.update(this.first);
    this.adopt(this.first);
  }

  // ---------------------------------------------------------------- the map
  point(cell) {
    const { heading } = this.stage.state;
    const free = cell && !this.task.world.blocked(cell.x, cell.y);
    this.pointed = free ? { x: cell.x, y: cell.y, theta: heading ?? cell.theta ?? this.facing } : null;
    this.draw();
    if (this.pointed && cell.theta === null) this.stage.say(this.readout.textContent); // the keyboard's cursor
  }

  key({ key, shiftKey }) {
    if (key.toLowerCase() !== "r") return false;
    this.facing = (this.facing + (shiftKey ? 315 : 45)) % 360;
    const [x, y] = this.map.cursor;
    this.point({ x, y, theta: null });
    return true;
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
    const { rounds, player } = this;
    const full = rounds.full ? `Here are ${rounds.limit} steps; start again for more` : "";
    this.back.disabled(rounds.length === 0 ? "This is the beginning" : "");
    this.sweep.disabled(full);
    this.improve.disabled(full);
    this.run.disabled(full);
    this.run.label = player.playing ? "Pause" : rounds.done ? "Run again" : "Run to the end";
    this.run.icon = player.playing ? "pause" : "play";
  }
}

/** The reader's own policy, or the robot that always drives as straight on as it can. */
function firstPolicy(task, mdp, policy) {
  const pick = (row) => row.indexOf(Math.max(...row));
  if (policy) return Int32Array.from({ length: mdp.S }, (_, s) => pick(policy.subarray(s * mdp.A, (s + 1) * mdp.A)));
  return new Int32Array(mdp.S).fill(pick(task.robot.steering.map((a) => -Math.abs(a))));
}
