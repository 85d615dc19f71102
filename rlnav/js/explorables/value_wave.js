/**
 * The value wave: how does the news of the goal travel?  Value iteration on the map, sweep by sweep, forward and back.
 */
import { HEADINGS, Pose } from "../robot.js";
import { paint } from "../scenario/edits.js";
import { scaleOf, Wave } from "../scenario/wave.js";
import { button, choice, segmented, slider, toggle, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { frame } from "./frame.js";
import { LookAhead } from "./look_ahead.js";
import { ARROWS, poseInWords, poseText, written } from "./naming.js";
import { rememberedProblem } from "./problem.js";
import { curvesOf, mapOf } from "./wave_picture.js";
import { sentence } from "./wave_words.js";

const SWEEPS_A_SECOND = 2.5;

/** Build the figure on a stage. */
export function start(stage) {
  const figure = new ValueWave(stage);
  return () => figure.destroy();
}

class ValueWave {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.problemOf = rememberedProblem();
    this.hovered = null; // a pose that is pointed at
    this.facing = 90; // the heading that the keyboard's cursor asks for
    this.stroke = null; // while walls are drawn: whether they are built or taken away
    this.player = new Player({
      tick: () => this.go(this.k + 1),
      draw: () => {},
      speed: SWEEPS_A_SECOND,
      onStop: (error) => {
        if (error) stage.message(error.message);
        this.drawButtons();
      },
    });
    this.ahead = new Player({ tick: (ms) => this.wave.runFor(ms), draw: () => this.draw(), speed: Infinity });
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
    stage.onData("tables", () => this.adopt(stage.state));
  }

  destroy() {
    for (const part of [this.player, this.ahead, this.map, this.chart]) part.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    const { stage } = this;
    this.frame = frame(stage, { question: "How does the news of the goal travel?", onReset: () => this.reset() });
    const left = h("div", { class: "rl-column" });
    const right = h("div", { class: "rl-column" });
    this.frame.body.append(h("div", { class: "rl-pair" }, left, right));
    left.append(this.buildLook());
    this.map = new GridView(left, {
      label: "Map with the value of every pose",
      onCell: (event) => this.press(event),
      onHover: (cell) => this.point(cell),
      onKey: (event) => this.key(event),
    });
    this.legend = new Legend(left);
    left.append(this.buildRun());
    right.append(this.frame.answer);
    this.lookAhead = new LookAhead(right);
    const axes = { xLabel: "sweep", yLabel: "largest over all poses" };
    this.chart = new CurveView(right, { label: "Changes and errors", ...axes });
    this.frame.body.append(this.buildSettings());
  }

  /** What the map shows. */
  buildLook() {
    this.show = segmented({
      label: "Color",
      hideLabel: true,
      options: [["values", "Values"], ["changes", "Changes"]],
      onChange: (show) => this.set({ show }),
    });
    const arrows = HEADINGS.map((theta) => [String(theta), `heading ${theta}° ${ARROWS[theta / 45]}`]);
    this.heading = choice({
      label: "Headings",
      hideLabel: true,
      options: [["all", "all headings"], ...arrows],
      onChange: (theta) => this.set({ heading: theta === "all" ? null : Number(theta) }),
    });
    this.walls = toggle({
      label: "Draw walls",
      onChange: (on) => (this.map.touch = on ? "paint" : "scroll"),
    });
    const parts = [this.show, this.heading, this.walls];
    return h("div", { class: "rl-look" }, parts.map((part) => part.element));
  }

  /** What runs the sweeps. */
  buildRun() {
    this.back = button({ label: "Back", icon: "back", title: "One sweep back", onClick: () => this.step(-1) });
    this.play = button({ label: "Play", icon: "play", onClick: () => this.playOrPause() });
    this.next = button({ label: "One sweep", icon: "step", primary: true, onClick: () => this.step(1) });
    this.frame.focusFirst(this.next.element);
    const tools = toolbar({ label: "Sweeps", children: [this.back, this.play, this.next] });
    this.scrubber = slider({ label: "Sweep", min: 0, max: 1, step: 1, value: 0, onInput: (k) => this.go(k) });
    return h("div", { class: "rl-wave-run" }, tools.element, this.scrubber.element);
  }

  /** What the planner is told. */
  buildSettings() {
    const plan = (name) => (value) => this.plan({ scenario: { ...this.stage.state.scenario, [name]: value } });
    this.gamma = slider({ label: "Discount γ", min: 0, max: 0.99, step: 0.01, value: 0, onInput: plan("gamma") });
    this.slip = slider({ label: "Slip", min: 0, max: 1, step: 0.05, value: 0, onInput: plan("slip") });
    this.tol = slider({
      label: "Tolerance",
      min: 1e-6,
      max: 1,
      log: true,
      value: 1,
      format: (v) => (v < 0.001 ? v.toExponential().replace("-", "−") : String(v)),
      onInput: (tol) => this.plan({ tol }),
    });
    const row = h("div", { class: "rl-row" }, [this.gamma, this.slip, this.tol].map((one) => one.element));
    const keys = "Keys on the map: arrows move, R turns the heading, Enter picks a pose, W sets or takes away a wall.";
    return h("div", {}, row, h("p", { class: "rl-help rl-keys-help", text: keys }));
  }

  // ---------------------------------------------------------------- changing
  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.prepare(state);
    const { scenario, tol, show, heading } = state;
    this.gamma.value = scenario.gamma;
    this.slip.value = scenario.slip;
    this.tol.value = tol;
    this.show.value = show;
    this.heading.value = heading === null ? "all" : String(heading);
    const own = Boolean(this.stage.data("tables")?.mdp);
    this.walls.disabled(own ? "Python made this model; its map stays as it is." : "");
    this.draw();
  }

  /** Plan in the world of a state: all sweeps up to the one that is shown now, the others when there is time. */
  prepare({ scenario, tol, sweep }) {
    const { task, mdp } = this.problemOf({ ...scenario, starts: null }, this.stage.data("tables")); // it starts nowhere
    const wave = new Wave(mdp, tol, mdp === this.wave?.mdp ? this.wave.best : null);
    const scale = scaleOf(wave.best.filter((_, s) => !mdp.terminal[s])); // fails where nothing is best
    Object.assign(this, { task, wave, scale, k: wave.run(sweep) });
    this.ahead.play();
  }

  /** Change what is planned; what cannot be becomes a message, and the last good state stays. */
  plan(patch) {
    const state = { ...this.stage.state, ...patch, sweep: this.k };
    if (!this.stage.attempt(() => this.prepare(state))) return;
    this.stage.message("");
    this.set({ ...patch, sweep: this.k });
  }

  /** Change what is shown. */
  set(patch) {
    this.stage.update(patch);
    this.draw();
  }

  /** Show sweep k, or the last one there is; return whether another follows. */
  go(k) {
    this.k = this.wave.run(Math.max(0, k));
    this.set({ sweep: this.k });
    return !this.wave.done || this.k < this.wave.length;
  }

  step(direction) {
    this.player.pause();
    this.go(this.k + direction);
  }

  playOrPause() {
    if (this.player.playing) this.player.pause();
    else {
      if (this.wave.done && this.k === this.wave.length) this.go(0);
      this.player.play();
    }
    this.drawButtons();
  }

  reset() {
    this.player.pause();
    this.stage.message("");
    this.stage.update(this.first);
    this.adopt(this.first);
  }

  // ---------------------------------------------------------------- the map
  poseAt({ x, y, theta }) {
    const inside = x >= 0 && !this.task.world.blocked(x, y);
    return inside ? { x, y, theta: this.stage.state.heading ?? theta ?? this.facing } : null;
  }

  point(cell) {
    this.hovered = cell && this.poseAt(cell);
    this.draw();
    if (cell?.theta === null) this.tell(cell); // the keyboard's cursor
  }

  tell(cell) {
    const pose = this.poseAt(cell);
    const wall = `cell (${cell.x}, ${cell.y}), a wall`;
    this.stage.say(pose ? `${poseInWords(pose)}: value ${this.valueAt(pose)}.` : `${wall}.`);
  }

  /** The pose that was picked, as long as no wall stands there. */
  get picked() {
    const [x, y, theta] = this.stage.state.pose ?? [-1];
    return this.poseAt({ x, y, theta });
  }

  valueAt(pose) {
    return written(this.wave.values[this.k][this.stateOf(pose)], 2);
  }

  stateOf({ x, y, theta }) {
    return this.task.index(new Pose(x, y, theta));
  }

  press(event) {
    if (this.walls.value) {
      if (event.type === "down") this.stroke = !this.task.world.blocked(event.x, event.y);
      if (event.type === "down" || event.type === "move") this.paint(event.x, event.y, this.stroke);
    } else if (event.type === "down" && event.button === 0) {
      this.pick(event);
    }
  }

  /** Keep the numbers of a pose in view; the same pose again lets it go. */
  pick(cell) {
    const pose = this.poseAt(cell);
    const again = pose && this.picked && poseText(pose) === poseText(this.picked);
    this.set({ pose: again || !pose ? null : [pose.x, pose.y, pose.theta] });
    if (pose) this.tell(cell);
  }

  paint(x, y, wall) {
    if (this.task.world.blocked(x, y) === wall) return;
    this.stage.attempt(() => this.plan({ scenario: paint(this.stage.state.scenario, x, y, wall) }));
  }

  key({ key, shiftKey }) {
    const [x, y] = this.map.cursor;
    if (key === "Enter" || key === " ") this.pick({ x, y, theta: null });
    else if (key.toLowerCase() === "w") this.paint(x, y, !this.task.world.blocked(x, y));
    else if (key.toLowerCase() === "r") {
      this.facing = (this.facing + (shiftKey ? 315 : 45)) % 360;
      this.point({ x, y, theta: null });
    } else return false;
    return true;
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { k, wave } = this;
    const pose = (this.hovered && this.poseAt(this.hovered)) ?? this.picked; // it may be a wall by now
    const s = pose && this.stateOf(pose);
    this.drawMap(pose, s);
    this.chart.draw(curvesOf(wave, k));
    this.drawButtons();
    this.lookAhead.draw({ wave, k, pose, s, steering: this.task.robot.steering });
    this.frame.say(sentence(wave, k));
  }

  drawMap(pose, s) {
    const { task, wave, k, stage } = this;
    const { heading, scenario, show } = stage.state;
    const changes = show === "changes";
    const best = pose && k > 0 && !wave.mdp.terminal[s] ? wave.lookAhead(s, k).find((row) => row.best) : null;
    const next = best && task.pose(best.sNext);
    const map = mapOf(this, k, { heading, changes });
    this.map.draw({
      ...map,
      starts: scenario.starts?.map(([x, y, theta]) => ({ x, y, theta })),
      selected: pose,
      path: next ? [pose, next] : null,
    });
    this.map.describe(`${sentence(wave, k)} Arrow keys move, R turns the heading, Enter picks a pose, W sets a wall.`);
    this.legend.draw({ ...map.scale, label: changes ? "change in this sweep" : "value" });
  }

  drawButtons() {
    const { wave, k, player } = this;
    const last = wave.done && k === wave.length;
    this.back.disabled(k === 0 ? "This is the beginning" : "");
    this.next.disabled(last ? "No value changes any more by more than the limit" : "");
    this.play.label = player.playing ? "Pause" : "Play";
    this.play.icon = player.playing ? "pause" : "play";
    this.scrubber.limit(Math.max(wave.length, 1));
    this.scrubber.value = k;
  }
}
