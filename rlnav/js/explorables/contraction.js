/**
 * Explorable of chapter 6: does it matter where one starts? Two guesses are backed up together, by the maximum or by
 * the mean of a policy, and a ruler shows how fast they come to agree.
 */
import { Pose } from "../robot.js";
import { policyOf, valuesOf } from "../scenario/backup.js";
import { guessOf, Pair } from "../scenario/contraction.js";
import { button, choice, segmented, slider, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { curvesOf, mapOf, scaleOf } from "./contraction_picture.js";
import { Ruler } from "./contraction_ruler.js";
import { BackupTable } from "./contraction_table.js";
import { sentence } from "./contraction_words.js";
import { frame } from "./frame.js";
import { poseInWords, poseText, timed, written } from "./naming.js";
import { rememberedProblem } from "./problem.js";

const BACKUPS_A_SECOND = 2.5;
const GUESSES = [
  ["zeros", "0 everywhere"], ["high", "20: too good"], ["low", "−20: too bad"], ["random", "random"],
  ["answer", "the answer itself"],
];

/** Build the figure on a stage. */
export function start(stage) {
  const figure = new Contraction(stage);
  return () => figure.destroy();
}

class Contraction {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.problemOf = rememberedProblem();
    this.hovered = null; // a pose that is pointed at
    this.facing = 90; // the heading that the keyboard's cursor asks for
    this.player = new Player({
      tick: () => this.go(this.k + 1),
      draw: () => {},
      speed: BACKUPS_A_SECOND,
      onStop: (error) => {
        if (error) stage.message(error.message);
        this.drawButtons();
      },
    });
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
    stage.onData("tables", () => this.adopt(stage.state));
  }

  destroy() {
    for (const part of [this.player, ...this.maps.map(({ map }) => map), this.chart]) part.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    const question = "Does it matter where you start?";
    this.frame = frame(this.stage, { question, onReset: () => this.reset() });
    const maps = h("div", { class: "rl-guess-maps" });
    const left = h("div", { class: "rl-column" });
    const right = h("div", { class: "rl-column" });
    this.maps = ["V", "W"].map((letter, i) => this.buildMap(maps, letter, i));
    const keys = "Keys on a map: arrows move, R turns the heading, Enter keeps a pose in the table or lets it go.";
    this.frame.body.append(
      maps, this.buildRun(), h("div", { class: "rl-pair" }, left, right), this.buildSettings(),
      h("p", { class: "rl-help rl-keys-help", text: keys }),
    );
    left.append(this.frame.answer);
    this.ruler = new Ruler(left);
    const axes = { xLabel: "backup", yLabel: "largest difference" };
    this.chart = new CurveView(left, { label: "Largest difference after each backup", ...axes });
    this.table = new BackupTable(right);
    this.legend = new Legend(maps);
  }

  buildMap(parent, letter, i) {
    const guess = choice({ label: `${letter} begins with`, options: GUESSES, onChange: (name) => this.guess(i, name) });
    const title = h("p", { class: "rl-label rl-guess-title" });
    const column = h("div", { class: "rl-column" }, guess.element, title);
    parent.append(column);
    const map = new GridView(column, {
      label: `Map with the values ${letter}`,
      axes: false,
      onCell: (event) => event.type === "down" && event.button === 0 && this.pick(event),
      onHover: (cell) => this.point(cell),
      onKey: (event) => this.key(event, map),
    });
    return { letter, guess, title, map };
  }

  buildRun() {
    this.back = button({ label: "Back", icon: "back", title: "One backup back", onClick: () => this.step(-1) });
    this.play = button({ label: "Play", icon: "play", onClick: () => this.playOrPause() });
    this.next = button({ label: "One backup", icon: "step", primary: true, onClick: () => this.step(1) });
    this.frame.focusFirst(this.next.element);
    const tools = toolbar({ label: "Backups", children: [this.back, this.play, this.next] });
    const mean = ["mean", "mean of π", "All actions count, as often as π takes them"];
    const options = [["max", "max", "The best action counts"], mean];
    const onChange = (backup) => this.change({ backup });
    this.backup = segmented({ label: "Each backup takes the", options, onChange });
    return h("div", { class: "rl-guess-run" }, tools.element, this.backup.element);
  }

  buildSettings() {
    const change = (name) => (value) => this.change({ scenario: { ...this.stage.state.scenario, [name]: value } });
    this.gamma = slider({ label: "Discount γ", min: 0, max: 1, step: 0.01, value: 0, onInput: change("gamma") });
    this.slip = slider({ label: "Slip", min: 0, max: 1, step: 0.05, value: 0, onInput: change("slip") });
    return h("div", { class: "rl-row" }, this.gamma.element, this.slip.element);
  }

  // ---------------------------------------------------------------- the state
  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.prepare(state);
    this.player.pause();
    this.draw();
  }

  /** Begin with the guesses of a state, and back them up as often as it says. */
  prepare({ scenario, guesses, backup, seed, backups }) {
    const tables = this.stage.data("tables");
    const { task, mdp, policy } = this.problemOf(scenario, tables);
    const pi = backup === "max" ? null : policyOf(mdp, { policy: policy ? "own" : "random" }, policy);
    const [V, W] = guesses.map((name, i) => guessOf(name, mdp, pi, seed + i));
    const pair = new Pair(mdp, pi, V, W);
    const scale = scaleOf(mdp, [V, W, valuesOf(mdp, pi).V]);
    Object.assign(this, { task, mdp, pair, scale, k: pair.run(backups) });
  }

  /** Change what is backed up, and how; what cannot be becomes a message, and the last good state stays. */
  change(patch) {
    const state = { ...this.stage.state, ...patch };
    if (this.stage.attempt(() => this.prepare(state))) {
      this.stage.message("");
      this.stage.update({ ...patch, backups: this.k });
    }
    this.draw();
  }

  /** A new guess is seen as it is, before it is backed up. */
  guess(i, name) {
    this.player.pause();
    this.change({ guesses: this.stage.state.guesses.with(i, name), backups: 0 });
  }

  /** Show backup k, or the last one there is; return whether another follows. */
  go(k) {
    this.k = this.pair.run(Math.max(0, k));
    this.stage.update({ backups: this.k });
    this.draw();
    return !this.pair.done || this.k < this.pair.length;
  }

  step(direction) {
    this.player.pause();
    this.go(this.k + direction);
  }

  playOrPause() {
    if (this.player.playing) this.player.pause();
    else {
      if (this.pair.done && this.k === this.pair.length) this.go(0);
      this.player.play();
    }
    this.drawButtons();
  }

  reset() {
    this.stage.message("");
    this.stage.update(this.first);
    this.adopt(this.first);
  }

  // ---------------------------------------------------------------- poses
  poseAt({ x, y, theta }) {
    const free = x >= 0 && !this.task.world.blocked(x, y) && !this.task.world.isGoal(x, y);
    return free ? new Pose(x, y, theta ?? this.facing) : null;
  }

  point(cell) {
    this.hovered = cell && this.poseAt(cell);
    this.draw();
    if (cell?.theta === null) this.tell(); // the keyboard's cursor
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
    const pose = this.poseAt(cell);
    const again = pose && this.picked && poseText(pose) === poseText(this.picked);
    this.stage.update({ pose: again || !pose ? null : [pose.x, pose.y, pose.theta] });
    this.draw();
  }

  key({ key, shiftKey }, map) {
    const [x, y] = map.cursor;
    if (key === "Enter" || key === " ") this.pick({ x, y, theta: null });
    else if (key.toLowerCase() === "r") {
      this.facing = (this.facing + (shiftKey ? 315 : 45)) % 360;
      this.point({ x, y, theta: null });
    } else return false;
    return true;
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
    const { pair, k, player } = this;
    const last = pair.done && k === pair.length;
    this.back.disabled(k === 0 ? "This is the beginning" : "");
    this.next.disabled(last ? "Nothing is left to shrink" : "");
    this.play.label = player.playing ? "Pause" : "Play";
    this.play.icon = player.playing ? "pause" : "play";
  }
}
