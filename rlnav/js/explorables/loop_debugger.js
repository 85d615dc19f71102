/**
 * Explorable of chapter 1: who does what in one step? The loop of agent and environment, one moment at a time.
 */
import { solve } from "../planning.js";
import { Loop, MOMENTS } from "../scenario/loop.js";
import { button, group, segmented, slider, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { LabelLog } from "./label_log.js";
import { LogView, ProgramView, TimeLine } from "./loop_log.js";
import { LoopPicture } from "./loop_picture.js";
import { chancesAt, sceneOf } from "./loop_scene.js";
import { nextWords, sentence } from "./loop_words.js";
import { PlayButton } from "./playback.js";
import { TaskFigure } from "./task_figure.js";

const PACE = 1.25; // moments in a second while it plays: time to read
const LONGEST = 40; // steps, of the slider for the limit
const ASKED = 4; // lines of the log in the exercise
// What is new in the last line of log and time line at each moment.
const FRESH = { read: ["s"], choose: ["a"], move: [], pay: ["r"], show: ["sNext"], tick: ["end"] };

/** Build the step debugger on its stage. */
export function start(stage) {
  new LoopDebugger(stage).open();
}

class LoopDebugger extends TaskFigure {
  constructor(stage) {
    super(stage, "Who does what in one step?");
    stage.root.addEventListener("keydown", (event) => this.key(event));
  }

  /** Build the model of a state, unless it is the present one. */
  model({ scenario }) {
    const { task, mdp, policy } = this.problemOf(scenario);
    if (mdp === this.mdp) return;
    const random = new Float64Array(mdp.S * mdp.A).fill(1 / mdp.A);
    const { pi, V } = solve(mdp);
    Object.assign(this, { task, mdp, V, policies: { random, optimal: pi, own: policy } });
    if (this.picture) this.picture.task = task;
  }

  build() {
    this.model(this.first);
    const { body, answer } = this.frame;
    body.append(this.settings(), answer);
    const reduced = () => this.stage.reducedMotion;
    this.picture = this.part(new LoopPicture(body, this.task, { onChoose: (a) => this.forward(a), reduced }));
    body.append(this.bar());
    this.line = new TimeLine(body, { onPick: (position) => this.goBackTo(position) });
    const below = h("div", { class: "rl-loop-below" });
    this.log = new LogView(below);
    this.program = new ProgramView(below);
    body.append(below, this.exercise());
    this.frame.focusFirst(this.next.element);
  }

  settings() {
    const choosers = [["random", "Chance"], ["optimal", "The best policy"], ["you", "You"]];
    if (this.policies.own) choosers.splice(2, 0, ["own", "The given policy"]);
    this.chooser = segmented({
      label: "Who chooses the actions?", options: choosers, onChange: (chooser) => this.set({ chooser }),
    });
    this.limit = slider({
      label: "Step limit", min: 1, max: Math.max(LONGEST, this.first.scenario.max_steps), step: 1, value: 1,
      onChange: (steps) => this.setLimit(steps),
    });
    return h("div", { class: "rl-loop-settings" }, this.chooser.element, this.limit.element);
  }

  bar() {
    this.back = button({ label: "Back", icon: "back", onClick: () => this.goBack() });
    this.next = button({ label: "Next", icon: "step", primary: true, onClick: () => this.forward() });
    this.whole = button({ label: "Whole step", icon: "episode", onClick: () => this.wholeStep() });
    this.player = new PlayButton(this.stage, {
      tick: () => this.tick(), speed: PACE, onChange: () => this.refreshBar(),
    });
    this.anew = button({ label: "New episode", icon: "reset", onClick: () => this.newEpisode() });
    this.next.element.classList.add("rl-next");
    const children = [this.back, this.next, this.whole, this.player, this.anew];
    const bar = toolbar({ label: "Run", children });
    bar.element.classList.add("rl-loop-bar");
    return bar.element;
  }

  exercise() {
    const place = h("div");
    this.label = new LabelLog(place);
    const other = new Loop(this.mdp, { seed: 1, maxSteps: ASKED, start: this.farStart() });
    while (!other.over) other.forward(this.policies.optimal[other.s]);
    this.label.show(other.rows, this.task);
    return group({ title: "Label a log", children: [place] }).element;
  }

  /** The start from which the best policy earns least: far from the goal, so that its log has several lines. */
  farStart() {
    return this.mdp.start.reduce((far, s) => (this.V[s] < this.V[far] ? s : far));
  }

  // ---------------------------------------------------------------- the run
  prepare(state) {
    const { scenario, actions, position } = state;
    this.model(state);
    this.loop = new Loop(this.mdp, { seed: scenario.seed, maxSteps: scenario.max_steps, actions, position });
  }

  showAll() {
    const { chooser, scenario } = this.stage.state;
    this.chooser.value = chooser;
    this.limit.value = scenario.max_steps;
    this.draw();
  }

  /** Whether the reader is the one who chooses, and it is time to. */
  get asks() {
    return this.loop.waits && this.stage.state.chooser === "you";
  }

  /** Go on by one moment; `a` is the reader's choice. */
  forward(a = null) {
    if (this.loop.over) {
      this.newEpisode();
      return;
    }
    if (this.asks && a === null) {
      this.picture.buttons.at(-1).element.focus();
      this.frame.say("It is your turn: press one of the actions of the agent.");
      return;
    }
    const { chooser } = this.stage.state;
    const chosen = this.loop.waits && a === null ? this.loop.choice(this.policies[chooser]) : a;
    if (this.loop.forward(chosen)) this.told(true);
    if (a !== null && !this.player.playing) this.next.element.focus({ preventScroll: true });
  }

  goBack() {
    this.player.pause();
    if (this.loop.back()) this.told(false);
  }

  /** Go back to a moment that is past; what chance gave afterwards comes again, what the reader chose does not. */
  goBackTo(position) {
    this.player.pause();
    while (this.loop.position > position && this.loop.back());
    this.told(false);
    this.next.element.focus({ preventScroll: true });
  }

  /** Go to the same moment of the next step, or as far as it goes. */
  wholeStep() {
    const wanted = this.loop.position + MOMENTS.length;
    while (this.loop.position < wanted && !this.loop.over) {
      if (this.asks) break;
      this.loop.forward(this.loop.waits ? this.loop.choice(this.policies[this.stage.state.chooser]) : null);
    }
    this.told(false);
  }

  tick() {
    if (!this.asks) this.forward();
    return !this.loop.over;
  }

  newEpisode() {
    const { scenario } = this.stage.state;
    this.change({ scenario: { ...scenario, seed: scenario.seed + 1 }, actions: [], position: 0 });
    this.next.element.focus({ preventScroll: true });
  }

  setLimit(max_steps) {
    if (this.changeTask({ max_steps })) this.told(false);
  }

  /** Keep where the run is, and show it. */
  told(moving) {
    this.stage.update({ actions: this.loop.actions, position: this.loop.position });
    this.draw(moving);
  }

  key(event) {
    const a = Number(event.key) - 1;
    if (!this.asks || event.target.matches("input:not([type=radio]), select") || !(a >= 0 && a < this.mdp.A)) return;
    event.preventDefault();
    this.forward(a);
  }

  // ---------------------------------------------------------------- what is seen
  draw(moving = false) {
    const { loop, task } = this;
    const rows = loop.rows;
    this.picture.draw(sceneOf(loop, task, { moving, ...this.choosing() }));
    this.line.draw(rows, task, loop.over ? ["s"] : FRESH[loop.moment]);
    this.log.draw(rows, task, loop.over ? ["end"] : FRESH[loop.moment]);
    this.program.draw(loop.moment);
    this.frame.say(sentence(loop, task));
    this.refreshBar();
  }

  /** Who may press the actions now, and how likely each is. */
  choosing() {
    const { loop, mdp, policies } = this;
    const { chooser } = this.stage.state;
    const yours = chooser === "you";
    return {
      free: this.asks,
      whyNot: yours ? "It is not the agent's turn." : "The policy chooses. Let “You” choose to press these.",
      chance: yours || loop.over ? null : chancesAt(policies[chooser], loop.s, mdp.A),
    };
  }

  refreshBar() {
    const { loop } = this;
    this.next.label = this.asks ? "Your turn: choose an action" : `Next: ${nextWords(loop)}`;
    this.whole.disabled(loop.over ? "The episode is over." : this.asks ? "It is your turn to choose." : "");
    this.back.disabled(loop.position === 0 ? "This is the beginning." : "");
    this.player.refresh("Play", loop.over ? "The episode is over." : "");
  }
}
