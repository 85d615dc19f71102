/**
 * Explorable of chapter 4: what is a policy worth? Paint one; drives fall as dots beside the exact value.
 */
import { actionValues, checkPolicy } from "../mdp.js";
import { evaluatePolicy } from "../prediction.js";
import { Pose } from "../robot.js";
import { returns, rollout } from "../rollouts.js";
import { ANY, chancesOf, compared, filled, painted, signOf, statistics } from "../scenario/painted.js";
import { button, segmented, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { DotAxis } from "./dot_axis.js";
import { pair } from "./figure.js";
import { headingChoice, keysHelp, MapCursor } from "./map_cursor.js";
import { poseInWords, turnText, written } from "./naming.js";
import { mapOf, scaleOf } from "./paint_picture.js";
import { comparison, sentence } from "./paint_words.js";
import { TaskFigure } from "./task_figure.js";

const MAX_STEPS = 1000; // of one drive; what comes later counts less than 0.0001
const MOST_DRIVES = 2000;
const REPEATED = 200; // drives that are made again, with the same luck, when the policy changes
const FILLS = [["straight", "straight on"], ["goal", "to the goal"], ["random", "random"]];

/** Build the figure on a stage. */
export function start(stage) {
  new PaintPolicy(stage).open();
}

class PaintPolicy extends TaskFigure {
  constructor(stage) {
    super(stage, "What is the policy worth that you paint?");
    this.difference = false; // whether the map compares with the kept policy
    this.cursor = new MapCursor({
      onTell: (cell) => this.tell(cell),
      enter: (cell) => {
        this.use(this.at(cell));
        this.tell(cell);
      },
    });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair();
    body.append(element);
    left.append(this.buildBrush());
    this.map = this.part(new GridView(left, {
      label: "Map with the painted turns and the value of every pose",
      onCell: (event) => this.press(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, this.map),
    }));
    this.legend = new Legend(left);
    right.append(this.buildRun(), answer);
    this.axis = this.part(new DotAxis(right));
    right.append(this.buildKeep());
    body.append(this.buildSettings());
  }

  /** What a press on the map does, and whole policies. */
  buildBrush() {
    const turns = this.first.scenario.steering.map((a, i) => [String(i), turnText(a)]).reverse();
    const brushes = [["start", "start here"], ...turns, ["random", "random"]];
    const onChange = (brush) => this.setBrush(brush);
    this.brush = segmented({ label: "A press on the map means", options: brushes, onChange });
    const fill = ([kind, label]) => button({ label, icon: "brush", onClick: () => this.paintAll(kind) });
    const tools = toolbar({ label: "The same everywhere", children: FILLS.map(fill) });
    this.heading = headingChoice((heading) => this.set({ heading }));
    const fills = h("div", { class: "rl-fills" }, h("span", { class: "rl-label", text: "Everywhere:" }), tools.element);
    return h("div", { class: "rl-paint" }, this.brush.element, fills, this.heading.element);
  }

  buildRun() {
    this.once = button({ label: "Drive once", icon: "step", primary: true, onClick: () => this.drive(1) });
    this.many = button({ label: "100 drives", icon: "episode", onClick: () => this.drive(100) });
    this.clear = button({ label: "Clear", icon: "close", onClick: () => this.change({ drives: 0 }) });
    this.frame.focusFirst(this.once.element);
    return toolbar({ label: "Drives", children: [this.once, this.many, this.clear] }).element;
  }

  buildKeep() {
    const title = "Compare the next policies with this one";
    const onKeep = () => this.change({ kept: this.stage.state.policy });
    this.keep = button({ label: "Keep this policy", title, icon: "pin", onClick: onKeep });
    this.compare = button({
      label: "Difference", icon: "info", pressed: false, onClick: () => this.showDifference(!this.difference),
    });
    this.versus = h("p", { class: "rl-versus" });
    const tools = toolbar({ label: "Compare", children: [this.keep, this.compare] });
    return h("div", { class: "rl-keep" }, tools.element, this.versus);
  }

  buildSettings() {
    const row = h("div", { class: "rl-row" }, this.buildSlip(0.5), this.buildGamma(0.99));
    const keys = "Keys on the map: arrows move, R turns the heading, Enter does what a press does.";
    return h("div", {}, row, keysHelp(keys));
  }

  // ---------------------------------------------------------------- changing
  showAll() {
    const { scenario, heading, brush, kept } = this.stage.state;
    this.slip.value = scenario.slip;
    this.gamma.value = scenario.gamma;
    this.heading.value = heading;
    this.brush.value = brush;
    this.map.touch = brush === "start" ? "scroll" : "paint";
    if (kept === null) this.difference = false;
    this.draw();
  }

  /** Evaluate the policies of a state exactly, and drive as often as it says. */
  prepare({ scenario, policy, kept, pose, drives }) {
    const { task, mdp } = this.problemOf(scenario);
    const s = task.index(new Pose(...pose));
    const pi = checkPolicy(mdp, chancesOf(policy, mdp));
    const V = evaluatePolicy(mdp, pi);
    const W = kept === null ? null : evaluatePolicy(mdp, chancesOf(kept, mdp));
    Object.assign(this, { task, mdp, s, pi, V, W, Q: actionValues(mdp, V), seed: scenario.seed, G: [] });
    this.drives(drives);
  }

  /** Drive until there are n drives; each has a seed of its own. */
  drives(n) {
    const { mdp, pi, s, seed, G } = this;
    while (G.length < n) {
      const { rewards } = rollout(mdp, pi, { start: s, maxSteps: MAX_STEPS, rng: seed + G.length });
      G.push(returns(rewards, mdp.gamma)[0]);
    }
  }

  /** Change what is computed, and drive again. */
  change(patch) {
    return super.change({ drives: Math.min(this.G.length, REPEATED), ...patch });
  }

  drive(times) {
    const before = this.G.length;
    this.drives(Math.min(before + times, MOST_DRIVES));
    this.stage.update({ drives: this.G.length });
    this.draw(this.G.length - before);
  }

  setBrush(brush) {
    this.map.touch = brush === "start" ? "scroll" : "paint";
    this.set({ brush });
  }

  paintAll(kind) {
    this.change({ policy: filled(this.task, kind) });
  }

  showDifference(on) {
    this.difference = on;
    this.draw();
  }

  reset() {
    this.difference = false;
    super.reset();
  }

  // ---------------------------------------------------------------- the map
  press({ type, x, y, theta, button: pressed }) {
    if ((type !== "down" && type !== "move") || pressed > 0) return;
    if (type === "down") this.map.cursor = [x, y];
    const { brush, heading } = this.stage.state;
    if (type === "down" || brush !== "start") this.use({ x, y, theta: heading ?? theta });
  }

  /** Do to a pose what a press means. */
  use({ x, y, theta }) {
    const { world } = this.task;
    if (world.blocked(x, y) || world.isGoal(x, y)) return;
    const { brush, policy } = this.stage.state;
    if (brush === "start") return this.change({ pose: [x, y, theta] });
    const pose = new Pose(x, y, theta);
    const next = painted(policy, this.task.index(pose), signOf(this.task, pose, brush));
    if (next !== policy) this.change({ policy: next });
  }

  at({ x, y }) {
    return { x, y, theta: this.stage.state.heading ?? this.cursor.facing };
  }

  /** Tell what the keyboard's cursor is on. */
  tell({ x, y }) {
    if (this.task.world.blocked(x, y)) return this.stage.say(`cell (${x}, ${y}), an obstacle.`);
    const pose = this.at({ x, y });
    const s = this.task.index(new Pose(x, y, pose.theta));
    const sign = this.stage.state.policy[s];
    const turn = sign === ANY ? "any turn" : `turn ${turnText(this.task.robot.steering[sign])}`;
    return this.stage.say(`${poseInWords(pose)}: ${turn}, value ${written(this.V[s], 2)}.`);
  }

  // ---------------------------------------------------------------- drawing
  draw(fresh = 0) {
    const { G, V, W, s, mdp, stage } = this;
    const [x, y, theta] = stage.state.pose;
    const numbers = statistics(G);
    const words = sentence({ x, y, theta }, numbers, V[s]);
    this.axis.draw({ G, statistics: numbers, v: V[s], ...scaleOf(mdp), fresh, label: words });
    this.frame.say(words);
    this.drawMap();
    const versus = W ? comparison(compared(mdp, V, W)) : "Keep a policy to compare the next ones with it.";
    if (this.versus.textContent !== versus) this.versus.textContent = versus;
    this.compare.pressed = this.difference;
    this.compare.disabled(W ? "" : "Keep a policy first.");
    this.clear.disabled(G.length ? "" : "There are no drives yet.");
    const enough = G.length >= MOST_DRIVES ? `${MOST_DRIVES} drives are enough.` : "";
    for (const one of [this.once, this.many]) one.disabled(enough);
  }

  drawMap() {
    const { difference, W, stage } = this;
    const map = mapOf(this, difference ? W : null, stage.state);
    this.map.draw(map);
    const keys = "Arrow keys move, R turns the heading, Enter does what a press does.";
    this.map.describe(`${this.frame.answer.textContent} ${keys}`);
    this.legend.draw({ ...map.scale, label: difference ? "value less that of the kept policy" : "value" });
  }
}
