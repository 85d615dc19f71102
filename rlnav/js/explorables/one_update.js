/**
 * The one-update inspector: what does one step teach the robot?  A learner with a time machine.
 */
import { learnerOptions } from "../scenario/model.js";
import { checkScenario } from "../scenario/scenario.js";
import { timelineOf } from "../scenario/timeline.js";
import { ALGORITHMS, judge, partsOf, ruleOf } from "../scenario/update.js";
import { scaleOf } from "../scenario/wave.js";
import { solve } from "../planning.js";
import { unpackAll } from "../views/arrays.js";
import { choice, group, number, segmented, slider, toggle } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { pair } from "./figure.js";
import { Guess } from "./guess.js";
import { Jumps } from "./jumps.js";
import { Walk } from "./playback.js";
import { TaskFigure } from "./task_figure.js";
import { UpdateFormula } from "./update_formula.js";
import { errorsOf, mapOf } from "./update_picture.js";
import { UpdateRows } from "./update_rows.js";
import { stepInWords, updateInWords } from "./update_words.js";

const BETWEEN = 200; // milliseconds between two pictures of the curve while it plays
const SPEEDS = [
  ["1", "1 step a second"], ["5", "5 steps a second"], ["50", "50 steps a second"], ["Infinity", "as fast as it can"],
];

/** Build the figure on a stage. */
export function start(stage) {
  new OneUpdate(stage).open();
}

class OneUpdate extends TaskFigure {
  constructor(stage) {
    super(stage, "What does one step teach the robot?");
    this.solved = false; // whether the number that is asked for has been found
    this.drawn = -Infinity; // when the curve was
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair();
    this.algorithm = segmented({
      label: "Algorithm",
      hideLabel: true,
      options: Object.entries(ALGORITHMS).map(([key, { name }]) => [key, name]),
      onChange: (algorithm) => this.changeTask({ algorithm }),
    });
    body.append(this.algorithm.element);
    this.formula = new UpdateFormula(body);
    body.append(element);
    this.map = this.part(new GridView(left, { label: "Map with what the robot has learned", cursor: false }));
    this.legend = new Legend(left);
    left.append(this.buildSteps());
    this.guess = new Guess(right, {
      label: "The entry after this update",
      judge: (value) => judge(this.parts, value),
      onSolved: () => this.solve(),
    });
    right.append(answer);
    this.rows = new UpdateRows(right);
    right.append(this.buildJumps());
    const axes = { xLabel: "update", yLabel: "TD error", height: 130 };
    this.chart = this.part(new CurveView(body, { label: "TD errors around this update", ...axes }));
    this.scrubber = slider({ label: "Update", min: 0, max: 1, step: 1, value: 0, onInput: (n) => this.go(n) });
    body.append(this.scrubber.element, this.buildSettings());
  }

  buildSteps() {
    this.walk = new Walk(this, {
      back: { title: "Take the last step back" },
      next: { label: "One step" },
      speed: 1,
      tick: (ms) => this.tick(ms),
      draw: (at) => this.draw(at),
      before: () => this.beforePlay(),
      onChange: () => this.arrive(),
    });
    this.player = this.walk.player;
    return h("div", { class: "rl-run" }, this.walk.row("Steps"));
  }

  buildJumps() {
    this.jumps = new Jumps(this);
    const setSpeed = (speed) => (this.player.speed = Number(speed));
    const speed = choice({ label: "Speed of playing", options: SPEEDS, value: "1", onChange: setSpeed });
    const { kind, tools } = this.jumps;
    return h("div", { class: "rl-jumps" }, kind.element, tools.element, speed.element);
  }

  buildSettings() {
    const setting = (name) => (value) => this.changeTask({ [name]: value });
    this.rates = {
      alpha: slider({ label: "Step size α", min: 0.01, max: 1, step: 0.01, value: 1, onInput: setting("alpha") }),
      epsilon: slider({ label: "Exploration ε", min: 0, max: 1, step: 0.01, value: 0, onInput: setting("epsilon") }),
      gamma: slider({ label: "Discount γ", min: 0, max: 1, step: 0.01, value: 1, onInput: setting("gamma") }),
    };
    this.asking = toggle({
      label: "Guess first",
      help: "Every step hides the new entry until you have worked it out.",
      onChange: (guess) => this.ask(guess),
    });
    this.Q0 = number({ label: "First entries Q₀", min: -100, max: 100, value: 0, onChange: setting("Q0") });
    this.careless = toggle({
      label: "Let something follow the end",
      help: "A common bug: γ stays what it is after the goal and after a crash. With Q₀ = 0 it does no harm. Try 50.",
      onChange: (end_has_value) => this.change({ end_has_value }),
    });
    const bug = h("div", { class: "rl-row" }, this.Q0.element, this.careless.element);
    const breaking = group({ title: "Break it", children: [bug] });
    const sliders = h("div", { class: "rl-row" }, Object.values(this.rates).map((one) => one.element));
    const help = h("p", { class: "rl-help", text: "A change begins a new run, which goes on to the same update." });
    return h("div", { class: "rl-column" }, sliders, help, this.asking.element, breaking.element);
  }

  // ---------------------------------------------------------------- changing
  showAll() {
    const { scenario, guess, end_has_value: careless } = this.stage.state;
    this.algorithm.value = scenario.algorithm;
    for (const [name, one] of Object.entries(this.rates)) one.value = scenario[name];
    this.asking.value = guess;
    this.Q0.value = scenario.Q0;
    this.careless.value = careless;
    this.meet();
  }

  /** Begin the run of a state, and take it to the update that is shown. */
  prepare({ scenario, update, end_has_value }) {
    const tables = this.stage.data("tables");
    checkScenario(scenario);
    const { task, mdp } = this.problemOf(scenario);
    const phi = unpackAll(tables ?? {}).phi ?? task.phi();
    const timeline = timelineOf(mdp, phi, ruleOf(scenario.algorithm, end_has_value), learnerOptions(scenario));
    timeline.seek(update);
    if (mdp !== this.mdp) this.scale = scaleOf(solve(mdp).V.filter((_, s) => !mdp.terminal[s]));
    Object.assign(this, { task, mdp, timeline });
  }

  /** Begin another run, and go on to the same update, or to the last one. */
  change(patch) {
    if (super.change({ ...patch, update: this.timeline.now })) this.stage.update({ update: this.timeline.now });
  }

  /** Show the moment that the learner has come to, and ask for its number. */
  meet() {
    this.solved = false;
    this.guess.ask(this.stage.state.guess && this.timeline.now > 0);
    this.drawn = -Infinity;
    this.draw();
  }

  /** Keep the moment that the learner has come to, and show it. */
  arrive() {
    this.stage.update({ update: this.timeline.now });
    this.meet();
  }

  get k() {
    return this.timeline.now;
  }

  go(n) {
    this.player.pause();
    this.jumps.pause();
    this.timeline.seek(Math.max(0, n));
    this.arrive();
  }

  tick(milliseconds) {
    if (milliseconds === 0) this.timeline.step();
    else this.timeline.advance("never", milliseconds);
    return !this.timeline.done;
  }

  beforePlay() {
    this.jumps.pause();
    this.stage.message("");
  }

  ask(guess) {
    this.player.pause();
    this.stage.update({ guess });
    this.arrive();
  }

  solve() {
    this.solved = true;
    this.guess.ask(false);
    this.draw();
    this.walk.next.element.focus({ preventScroll: true });
  }

  reset() {
    this.jumps.pause();
    super.reset();
  }

  // ---------------------------------------------------------------- drawing
  draw(at = 1) {
    const { timeline, task, stage } = this;
    const { scenario, guess } = stage.state;
    const { learner, now, path } = timeline;
    const moving = at < 1 && this.moment === now; // only the robot is on its way
    this.moment = now;
    this.parts = now > 0 ? partsOf(learner, scenario.algorithm) : null;
    this.hidden = guess && !this.solved && now > 0;
    const picture = { learner, path, task, parts: this.parts };
    this.map.draw({ ...mapOf(picture, at, this.map.colors), scale: this.scale });
    if (moving) return;
    const words = this.hidden ? stepInWords(picture) : updateInWords(picture, stage.state.end_has_value);
    this.frame.say(words);
    this.map.describe(words);
    this.legend.draw({ ...this.scale, label: "largest entry of each row" });
    this.formula.draw(this.parts, scenario.algorithm, this.hidden);
    this.rows.draw(this.parts, scenario.algorithm, task);
    this.drawChart();
    this.drawControls();
  }

  /** The curve costs more than the rest: while it plays, a few a second are enough. */
  drawChart() {
    if (this.player.playing && performance.now() - this.drawn < BETWEEN) return;
    this.drawn = performance.now();
    this.chart.draw(errorsOf(this.timeline, this.hidden));
  }

  drawControls() {
    const { timeline, stage } = this;
    const end = timeline.done ? "No update of this run is left" : "";
    const begin = timeline.now === 0 ? "This is the beginning" : "";
    const why = end || (stage.state.guess ? "Guess first is on: take one step at a time" : "");
    this.walk.draw({ begin, end, why });
    this.jumps.draw({ begin, end });
    this.scrubber.limit(Math.max(timeline.reached, 1));
    this.scrubber.value = timeline.now;
  }
}
