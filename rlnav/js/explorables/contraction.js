/**
 * Explorable of chapter 6: does it matter where one starts? Two guesses are backed up together, by the maximum or by
 * the mean of a policy, and a ruler shows how fast they come to agree.
 */
import { Pose } from "../robot.js";
import { policyOf, valuesOf } from "../scenario/backup.js";
import { guessOf, Pair } from "../scenario/contraction.js";
import { choice, segmented } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { curvesOf, mapOf, scaleOf } from "./contraction_picture.js";
import { Ruler } from "./contraction_ruler.js";
import { BackupTable } from "./contraction_table.js";
import { sentence } from "./contraction_words.js";
import { pair as columns } from "./figure.js";
import { keptOrNot, keysHelp, MapCursor } from "./map_cursor.js";
import { poseInWords, timed, written } from "./naming.js";
import { Walk } from "./playback.js";
import { TaskFigure } from "./task_figure.js";

const BACKUPS_A_SECOND = 2.5;
const GUESSES = [
  ["zeros", "0 everywhere"], ["high", "20: too good"], ["low", "−20: too bad"], ["random", "random"],
  ["answer", "the answer itself"],
];

/** Build the figure on a stage. */
export function start(stage) {
  new Contraction(stage).open();
}

class Contraction extends TaskFigure {
  constructor(stage) {
    super(stage, "Does it matter where you start?");
    this.hovered = null; // a pose that is pointed at
    this.cursor = new MapCursor({
      onPoint: (cell) => this.point(cell),
      onTell: () => this.tell(),
      enter: (cell) => this.pick(cell),
    });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const maps = h("div", { class: "rl-guess-maps" });
    const { element, left, right } = columns();
    this.maps = ["V", "W"].map((letter, i) => this.buildMap(maps, letter, i));
    const settings = h("div", { class: "rl-row" }, this.buildGamma(1), this.buildSlip(1));
    const keys = "Keys on a map: arrows move, R turns the heading, Enter keeps a pose in the table or lets it go.";
    body.append(maps, this.buildRun(), element, settings, keysHelp(keys));
    left.append(answer);
    this.ruler = new Ruler(left);
    const axes = { xLabel: "backup", yLabel: "largest difference" };
    this.chart = this.part(new CurveView(left, { label: "Largest difference after each backup", ...axes }));
    this.table = new BackupTable(right);
    this.legend = new Legend(maps);
  }

  buildMap(parent, letter, i) {
    const guess = choice({ label: `${letter} begins with`, options: GUESSES, onChange: (name) => this.guess(i, name) });
    const title = h("p", { class: "rl-label rl-guess-title" });
    const column = h("div", { class: "rl-column" }, guess.element, title);
    parent.append(column);
    const map = this.part(new GridView(column, {
      label: `Map with the values ${letter}`,
      axes: false,
      onCell: (event) => event.type === "down" && event.button === 0 && this.pick(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, map),
    }));
    return { letter, guess, title, map };
  }

  buildRun() {
    this.walk = new Walk(this, {
      back: { title: "One backup back" },
      next: { label: "One backup" },
      speed: BACKUPS_A_SECOND,
    });
    this.player = this.walk.player;
    const mean = ["mean", "mean of π", "All actions count, as often as π takes them"];
    const options = [["max", "max", "The best action counts"], mean];
    const onChange = (backup) => this.change({ backup });
    this.backup = segmented({ label: "Each backup takes the", options, onChange });
    return h("div", { class: "rl-run rl-guess-run" }, this.walk.row("Backups"), this.backup.element);
  }

  // ---------------------------------------------------------------- the state
  adopt(state) {
    this.prepare(state);
    this.player.pause();
    this.draw();
  }

  /** Begin with the guesses of a state, and back them up as often as it says. */
  prepare({ scenario, guesses, backup, seed, backups }) {
    const { task, mdp, policy } = this.problemOf(scenario);
    const pi = backup === "max" ? null : policyOf(mdp, { policy: policy ? "own" : "random" }, policy);
    const [V, W] = guesses.map((name, i) => guessOf(name, mdp, pi, seed + i));
    const pair = new Pair(mdp, pi, V, W);
    const scale = scaleOf(mdp, [V, W, valuesOf(mdp, pi).V]);
    Object.assign(this, { task, mdp, pair, scale, k: pair.run(backups) });
  }

  /** Back up anew, as often as before; a control that asked for what cannot be goes back. */
  change(patch) {
    if (super.change(patch)) this.stage.update({ backups: this.k });
    else this.draw();
  }

  /** A new guess is seen as it is, before it is backed up. */
  guess(i, name) {
    this.player.pause();
    this.change({ guesses: this.stage.state.guesses.with(i, name), backups: 0 });
  }

  /** Show backup k, or the last one there is; return whether another follows. */
  go(k) {
    this.k = this.pair.run(Math.max(0, k));
    this.set({ backups: this.k });
    return !this.over;
  }

  get over() {
    return this.pair.done && this.k === this.pair.length;
  }

  // ---------------------------------------------------------------- poses
  poseAt({ x, y, theta }) {
    const free = x >= 0 && !this.task.world.blocked(x, y) && !this.task.world.isGoal(x, y);
    return free ? new Pose(x, y, theta ?? this.cursor.facing) : null;
  }

  point(cell) {
    this.hovered = cell && this.poseAt(cell);
    this.draw();
  }

  tell() {
    const pose = this.hovered;
    const [v, w] = pose ? this.valuesAt(pose) : [];
    this.stage.say(pose ? `${poseInWords(pose)}: V is ${written(v, 2)}, W is ${written(w, 2)}.` : "No pose.");
  }

  valuesAt(pose) {
    const s = this.task.index(pose);
    return [this.pair.V[this.k][s], this.pair.W[this.k][s]];
  }

  get picked() {
    const { pose } = this.stage.state;
    return pose && new Pose(...pose);
  }

  /** Keep a pose in the table; the same again lets it go. */
  pick(cell) {
    this.set({ pose: keptOrNot(this.poseAt(cell), this.picked) });
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { pair, k, task } = this;
    const asked = this.hovered ?? this.picked;
    const worst = task.pose(pair.places[k]);
    const pose = asked ?? worst;
    const text = sentence(pair, k, task);
    this.drawMaps(pose, text);
    this.ruler.draw(pair, k);
    this.chart.draw(curvesOf(pair, k));
    const s = task.index(pose);
    this.table.draw({ pair, k, s, pose, steering: task.robot.steering, worst: !asked });
    this.drawSettings();
    this.drawButtons();
    this.frame.say(text);
  }

  drawMaps(pose, text) {
    for (const { letter, title, map } of this.maps) {
      title.textContent = timed(letter, this.k);
      map.draw({ ...mapOf(this.pair[letter][this.k], this), selected: pose });
      map.describe(`${text} Arrow keys move, R turns the heading, Enter keeps a pose in the table.`);
    }
    this.legend.draw({ ...this.scale, label: "value" });
  }

  drawSettings() {
    const { scenario, guesses, backup } = this.stage.state;
    this.maps.forEach(({ guess }, i) => (guess.value = guesses[i]));
    this.backup.value = backup;
    this.gamma.value = scenario.gamma;
    this.slip.value = scenario.slip;
  }

  drawButtons() {
    this.walk.draw({
      begin: this.k === 0 ? "This is the beginning" : "",
      end: this.over ? "Nothing is left to shrink" : "",
    });
  }
}
