/**
 * The value wave: how does the news of the goal travel?  Value iteration on the map, sweep by sweep, forward and back.
 */
import { Pose } from "../robot.js";
import { scaleOf, Wave } from "../scenario/wave.js";
import { segmented, slider } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { pair } from "./figure.js";
import { LookAhead } from "./look_ahead.js";
import { headingChoice, keptOrNot, keysHelp, MapCursor } from "./map_cursor.js";
import { poseInWords, written } from "./naming.js";
import { Walk } from "./playback.js";
import { TaskFigure } from "./task_figure.js";
import { Walls } from "./walls.js";
import { curvesOf, mapOf } from "./wave_picture.js";
import { sentence } from "./wave_words.js";

const SWEEPS_A_SECOND = 2.5;

/** Build the figure on a stage. */
export function start(stage) {
  new ValueWave(stage).open();
}

class ValueWave extends TaskFigure {
  constructor(stage) {
    super(stage, "How does the news of the goal travel?");
    this.hovered = null; // a pose that is pointed at
    this.cursor = new MapCursor({
      onPoint: (cell) => this.point(cell),
      onTell: (cell) => this.tell(cell),
      enter: (cell) => this.pick(cell),
      w: (cell) => this.walls.flip(cell),
    });
    this.ahead = this.part(
      new Player({ tick: (ms) => this.wave.runFor(ms), draw: () => this.draw(), speed: Infinity }),
    );
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair();
    body.append(element);
    left.append(this.buildLook());
    this.map = this.part(new GridView(left, {
      label: "Map with the value of every pose",
      onCell: (event) => this.press(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, this.map),
    }));
    this.legend = new Legend(left);
    left.append(this.buildRun());
    right.append(answer);
    this.lookAhead = new LookAhead(right);
    const axes = { xLabel: "sweep", yLabel: "largest over all poses" };
    this.chart = this.part(new CurveView(right, { label: "Changes and errors", ...axes }));
    body.append(this.buildSettings());
  }

  /** What the map shows. */
  buildLook() {
    this.show = segmented({
      label: "Color",
      hideLabel: true,
      options: [["values", "Values"], ["changes", "Changes"]],
      onChange: (show) => this.set({ show }),
    });
    this.heading = headingChoice((heading) => this.set({ heading }));
    this.walls = new Walls(this);
    const parts = [this.show, this.heading, this.walls];
    return h("div", { class: "rl-look" }, parts.map((part) => part.element));
  }

  /** What runs the sweeps. */
  buildRun() {
    this.walk = new Walk(this, {
      back: { title: "One sweep back" },
      next: { label: "One sweep" },
      speed: SWEEPS_A_SECOND,
    });
    this.player = this.walk.player;
    this.scrubber = slider({ label: "Sweep", min: 0, max: 1, step: 1, value: 0, onInput: (k) => this.go(k) });
    return h("div", { class: "rl-run rl-scrubbed" }, this.walk.row("Sweeps"), this.scrubber.element);
  }

  /** What the planner is told. */
  buildSettings() {
    this.tol = slider({
      label: "Tolerance",
      min: 1e-6,
      max: 1,
      log: true,
      value: 1,
      format: (v) => (v < 0.001 ? v.toExponential().replace("-", "−") : String(v)),
      onInput: (tol) => this.change({ tol }),
    });
    const row = h("div", { class: "rl-row" }, this.buildGamma(0.99), this.buildSlip(1), this.tol.element);
    const keys = "Keys on the map: arrows move, R turns the heading, Enter picks a pose, W sets or takes away a wall.";
    return h("div", {}, row, keysHelp(keys));
  }

  // ---------------------------------------------------------------- changing
  showAll() {
    const { scenario, tol, show, heading } = this.stage.state;
    this.gamma.value = scenario.gamma;
    this.slip.value = scenario.slip;
    this.tol.value = tol;
    this.show.value = show;
    this.heading.value = heading;
    const own = Boolean(this.stage.data("tables")?.mdp);
    this.walls.box.disabled(own ? "Python made this model; its map stays as it is." : "");
    this.draw();
  }

  /** Plan in the world of a state: all sweeps up to the one that is shown now, the others when there is time. */
  prepare({ scenario, tol, sweep }) {
    const { task, mdp } = this.problemOf({ ...scenario, starts: null }); // it starts nowhere
    const wave = new Wave(mdp, tol, mdp === this.wave?.mdp ? this.wave.best : null);
    const scale = scaleOf(wave.best.filter((_, s) => !mdp.terminal[s])); // fails where nothing is best
    Object.assign(this, { task, wave, scale, k: wave.run(sweep) });
    this.ahead.play();
  }

  /** Plan anew, with as many sweeps as are shown, or as there are. */
  change(patch) {
    if (super.change({ ...patch, sweep: this.k })) this.stage.update({ sweep: this.k });
  }

  /** Show sweep k, or the last one there is; return whether another follows. */
  go(k) {
    this.k = this.wave.run(Math.max(0, k));
    this.set({ sweep: this.k });
    return !this.over;
  }

  get over() {
    return this.wave.done && this.k === this.wave.length;
  }

  // ---------------------------------------------------------------- the map
  poseAt({ x, y, theta }) {
    const inside = x >= 0 && !this.task.world.blocked(x, y);
    return inside ? { x, y, theta: this.stage.state.heading ?? theta ?? this.cursor.facing } : null;
  }

  point(cell) {
    this.hovered = cell && this.poseAt(cell);
    this.draw();
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
    if (!this.walls.press(event) && event.type === "down" && event.button === 0) this.pick(event);
  }

  /** Keep the numbers of a pose in view; the same pose again lets it go. */
  pick(cell) {
    const pose = this.poseAt(cell);
    this.set({ pose: keptOrNot(pose, this.picked) });
    if (pose) this.tell(cell);
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
    this.walk.draw({
      begin: this.k === 0 ? "This is the beginning" : "",
      end: this.over ? "No value changes any more by more than the limit" : "",
    });
    this.scrubber.limit(Math.max(this.wave.length, 1));
    this.scrubber.value = this.k;
  }
}
