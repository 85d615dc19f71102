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
import { button, choice, group, number, segmented, slider, toggle, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { frame } from "./frame.js";
import { Guess } from "./guess.js";
import { rememberedProblem } from "./problem.js";
import { UpdateFormula } from "./update_formula.js";
import { errorsOf, mapOf } from "./update_picture.js";
import { UpdateRows } from "./update_rows.js";
import { stepInWords, updateInWords } from "./update_words.js";

const AT_ONCE = 20; // milliseconds that a search may take before the page is drawn
const BETWEEN = 200; // milliseconds between two pictures of the curve while it plays
const KINDS = [["episode", "end of an episode"], ["goal", "arrival at the goal"], ["surprise", "error above 1"]];
const SPEEDS = [
  ["1", "1 step a second"], ["5", "5 steps a second"], ["50", "50 steps a second"], ["Infinity", "as fast as it can"],
];

/** Build the figure on a stage. */
export function start(stage) {
  const figure = new OneUpdate(stage);
  return () => figure.destroy();
}

class OneUpdate {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.solved = false; // whether the number that is asked for has been found
    this.drawn = -Infinity; // when the curve was
    this.problemOf = rememberedProblem();
    this.player = new Player({
      tick: (ms) => this.tick(ms),
      draw: (at) => this.draw(at),
      speed: 1,
      onStop: (error) => this.rest(error),
    });
    this.search = null; // what is searched for: { kind, from }
    this.searcher = new Player({ tick: (ms) => this.look(ms), draw: () => this.draw(), speed: Infinity });
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
    stage.onData("tables", () => this.adopt(stage.state));
  }

  destroy() {
    for (const part of [this.player, this.searcher, this.map, this.chart]) part.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    this.frame = frame(this.stage, { question: "What does one step teach the robot?", onReset: () => this.reset() });
    const left = h("div", { class: "rl-column" });
    const right = h("div", { class: "rl-column" });
    this.algorithm = segmented({
      label: "Algorithm",
      hideLabel: true,
      options: Object.entries(ALGORITHMS).map(([key, { name }]) => [key, name]),
      onChange: (algorithm) => this.change({ algorithm }),
    });
    this.formula = new UpdateFormula(this.frame.body);
    this.frame.body.prepend(this.algorithm.element);
    this.frame.body.append(h("div", { class: "rl-pair" }, left, right));
    this.map = new GridView(left, { label: "Map with what the robot has learned", cursor: false });
    this.legend = new Legend(left);
    left.append(this.buildSteps());
    this.guess = new Guess(right, {
      label: "The entry after this update",
      judge: (value) => judge(this.parts, value),
      onSolved: () => this.solve(),
    });
    right.append(this.frame.answer);
    this.rows = new UpdateRows(right);
    right.append(this.buildJumps());
    const axes = { xLabel: "update", yLabel: "TD error", height: 130 };
    this.chart = new CurveView(this.frame.body, { label: "TD errors around this update", ...axes });
    this.scrubber = slider({ label: "Update", min: 0, max: 1, step: 1, value: 0, onInput: (n) => this.go(n) });
    this.frame.body.append(this.scrubber.element, this.buildSettings());
  }

  buildSteps() {
    this.back = button({ label: "Back", icon: "back", title: "Take the last step back", onClick: () => this.step(-1) });
    this.play = button({ label: "Play", icon: "play", onClick: () => this.playOrPause() });
    this.next = button({ label: "One step", icon: "step", primary: true, onClick: () => this.step(1) });
    this.frame.focusFirst(this.next.element);
    const tools = toolbar({ label: "Steps", children: [this.back, this.play, this.next] });
    return h("div", { class: "rl-steps" }, tools.element);
  }

  buildJumps() {
    this.kind = choice({ label: "Jump to", options: KINDS, value: "episode" });
    this.previous = button({ label: "Previous", icon: "back", onClick: () => this.jumpBack() });
    this.following = button({ label: "Next", icon: "step", onClick: () => this.jump() });
    const tools = toolbar({ label: "Jumps", children: [this.previous, this.following] });
    const setSpeed = (speed) => (this.player.speed = Number(speed));
    const speed = choice({ label: "Speed of playing", options: SPEEDS, value: "1", onChange: setSpeed });
    return h("div", { class: "rl-jumps" }, this.kind.element, tools.element, speed.element);
  }

  buildSettings() {
    const setting = (name) => (value) => this.change({ [name]: value });
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
      onChange: (end_has_value) => this.change({}, { end_has_value }),
    });
    const bug = h("div", { class: "rl-row" }, this.Q0.element, this.careless.element);
    const breaking = group({ title: "Break it", children: [bug] });
    const sliders = h("div", { class: "rl-row" }, Object.values(this.rates).map((one) => one.element));
    const help = h("p", { class: "rl-help", text: "A change begins a new run, which goes on to the same update." });
    return h("div", { class: "rl-column" }, sliders, help, this.asking.element, breaking.element);
  }

  // ---------------------------------------------------------------- changing
  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.prepare(state);
    const { scenario } = state;
    this.algorithm.value = scenario.algorithm;
    for (const [name, one] of Object.entries(this.rates)) one.value = scenario[name];
    this.asking.value = state.guess;
    this.Q0.value = scenario.Q0;
    this.careless.value = state.end_has_value;
    this.solved = false;
    this.guess.ask(state.guess);
    this.draw();
  }

  /** Begin the run of a state, and take it to the update that is shown. */
  prepare({ scenario, update, end_has_value }) {
    const tables = this.stage.data("tables");
    checkScenario(scenario);
    const { task, mdp } = this.problemOf(scenario, tables);
    const phi = unpackAll(tables ?? {}).phi ?? task.phi();
    const timeline = timelineOf(mdp, phi, ruleOf(scenario.algorithm, end_has_value), learnerOptions(scenario));
    timeline.seek(update);
    if (mdp !== this.mdp) this.scale = scaleOf(solve(mdp).V.filter((_, s) => !mdp.terminal[s]));
    Object.assign(this, { task, mdp, timeline });
  }

  /** Begin another run; what cannot be becomes a message, and the last good run stays. */
  change(scenario, patch = {}) {
    const { state } = this.stage;
    const changed = { ...patch, scenario: { ...state.scenario, ...scenario }, update: this.timeline.now };
    if (!this.stage.attempt(() => this.prepare({ ...state, ...changed }))) return;
    this.stage.message("");
    this.stage.update(changed);
    this.arrive();
  }

  /** Show the moment that the learner has come to. */
  arrive() {
    this.solved = false;
    this.stage.update({ update: this.timeline.now });
    this.guess.ask(this.stage.state.guess && this.timeline.now > 0);
    this.drawn = -Infinity;
    this.draw();
  }

  go(n) {
    this.player.pause();
    this.searcher.pause();
    this.timeline.seek(Math.max(0, n));
    this.arrive();
  }

  step(direction) {
    this.go(this.timeline.now + direction);
  }

  tick(milliseconds) {
    if (milliseconds === 0) this.timeline.step();
    else this.timeline.advance("never", milliseconds);
    return !this.timeline.done;
  }

  playOrPause() {
    if (this.player.playing) {
      this.player.pause();
      this.rest();
    } else {
      this.searcher.pause();
      this.stage.message("");
      this.player.play();
    }
  }

  /** The player has stopped; `error` says why, if something went wrong. */
  rest(error = null) {
    if (error) this.stage.message(error.message);
    this.arrive();
  }

  jumpBack() {
    this.go(this.timeline.before(this.kind.value) ?? 0);
  }

  jump() {
    this.player.pause();
    this.stage.message("");
    this.search = { kind: this.kind.value, from: this.timeline.now };
    if (this.look(AT_ONCE)) this.searcher.play();
  }

  /** Search for a while; return whether to go on. */
  look(milliseconds) {
    const found = this.timeline.advance(this.search.kind, milliseconds);
    if (found === "more") return true;
    if (found === "end") {
      this.timeline.seek(this.search.from);
      this.stage.message(`The rest of this run, ${this.timeline.reached} updates in all, has no such update.`, "note");
    }
    this.arrive();
    return false;
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
    this.next.element.focus({ preventScroll: true });
  }

  reset() {
    this.player.pause();
    this.searcher.pause();
    this.stage.message("");
    this.stage.update(this.first);
    this.adopt(this.first);
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
    const { timeline, player, stage } = this;
    const over = timeline.done ? "No update of this run is left" : "";
    const begin = timeline.now === 0 ? "This is the beginning" : "";
    this.back.disabled(begin);
    this.previous.disabled(begin);
    this.next.disabled(over);
    this.following.disabled(over);
    this.play.disabled(over || (stage.state.guess ? "Guess first is on: take one step at a time" : ""));
    this.play.label = player.playing ? "Pause" : "Play";
    this.play.icon = player.playing ? "pause" : "play";
    this.scrubber.limit(Math.max(timeline.reached, 1));
    this.scrubber.value = timeline.now;
  }
}
