/**
 * Explorable of chapter 12: which step sizes settle? A schedule, its two sums, and what is learned with it.
 */
import { Pose } from "../robot.js";
import { solve } from "../planning.js";
import { entryOf, Study, sumsOf } from "../scenario/step_sizes.js";
import { button, choice, segmented, slider, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { Player } from "../views/player.js";
import { pair } from "./figure.js";
import { PlayButton } from "./playback.js";
import { learnedCurves, sumCurves } from "./step_picture.js";
import { SumTable, Verdict } from "./step_verdict.js";
import { sentence } from "./step_words.js";
import { TaskFigure } from "./task_figure.js";

const KINDS = [
  ["constant", "constant c"],
  ["power", "c / nᵖ"],
  ["linear", "from c to 0 in N updates"],
  ["halving", "c, halved every N updates"],
];
const LONGEST = { entry: 1000, table: 100 }; // updates of each entry
const SEEDS = { entry: 8, table: 4 };
const PART = 0.012; // of what is shown already: how much a tick adds, so that the beginning is seen as well
const TICKS = 40; // a second
const EXACT = 1e-12;

/** Build the figure on its stage. */
export function start(stage) {
  new StepSizes(stage).open();
}

class StepSizes extends TaskFigure {
  constructor(stage) {
    super(stage, "Which step sizes settle, and where?");
    const tick = (ms) => this.study.runFor(ms);
    this.worker = this.part(new Player({ tick, draw: () => this.drawLearned(), speed: Infinity }));
  }

  get n() {
    return this.stage.state.shown;
  }

  get longest() {
    return LONGEST[this.stage.state.watch];
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    body.append(this.buildSchedule());
    this.verdict = new Verdict(body);
    body.append(this.buildRun(), answer);
    const { element, left, right } = pair("rl-step-pair");
    body.append(element);
    const axes = { xLabel: "updates n", height: 210 };
    left.append(h("p", { class: "rl-step-title", text: "The two sums" }));
    this.sums = this.part(new CurveView(left, { label: "Sums of step sizes and of their squares", ...axes }));
    this.table = new SumTable(left);
    this.watch = segmented({
      label: "Watch",
      hideLabel: true,
      options: [["entry", "One noisy entry"], ["table", "A whole table"]],
      onChange: (watch) => this.change({ watch, shown: Math.min(this.n, LONGEST[watch]) }),
    });
    right.append(this.watch.element);
    this.learned = this.part(new CurveView(right, { label: "What is learned", ...axes }));
    this.note = h("p", { class: "rl-help" });
    right.append(this.note);
  }

  buildSchedule() {
    const set = (name) => (value) => this.change({ [name]: value });
    this.kind = choice({ label: "Step size αₙ of the n-th update", options: KINDS, onChange: set("kind") });
    this.c = slider({ label: "c", min: 0.01, max: 1, step: 0.01, value: 1, onInput: set("c") });
    this.p = slider({ label: "p", min: 0, max: 2, step: 0.05, value: 1, onInput: set("p") });
    this.until = slider({ label: "N", min: 1, max: 1000, step: 1, value: 200, onInput: set("until") });
    const parts = [this.kind, this.c, this.p, this.until];
    return h("div", { class: "rl-row rl-step-schedule" }, parts.map((part) => part.element));
  }

  buildRun() {
    this.player = new PlayButton(this.stage, {
      label: "Run",
      primary: true,
      tick: () => this.go(this.n + Math.max(1, Math.round(PART * this.n))),
      speed: TICKS,
      before: () => this.n === this.longest && this.go(0),
      onChange: () => this.drawButtons(),
    });
    this.frame.focusFirst(this.player.element);
    this.luck = button({ label: "Other luck", title: "The same runs with other chance", onClick: () => this.reseed() });
    const tools = toolbar({ label: "Run", children: [this.player, this.luck] });
    this.scrubber = slider({ label: "Updates", min: 0, max: 1000, step: 1, value: 0, onInput: (n) => this.go(n) });
    return h("div", { class: "rl-step-run" }, tools.element, this.scrubber.element);
  }

  // ---------------------------------------------------------------- changing
  /** Learn as a state asks for; one that cannot be throws and leaves what there is. */
  prepare(state) {
    const { scenario, pose, steering, watch, kind, c, p, until } = state;
    const key = JSON.stringify([scenario, pose, steering, watch, kind, c, p, until]);
    if (key === this.key) return;
    const { task, mdp } = this.problemOf(scenario);
    if (mdp !== this.mdp) {
      const entry = entryOf(mdp, task.index(new Pose(...pose)), task.robot.steering.indexOf(steering));
      Object.assign(this, { mdp, entry, best: solve(mdp, { tol: EXACT }).Q });
    }
    const settings = { kind, c, p, until };
    const shared = { seeds: SEEDS[watch], seed: scenario.seed, points: LONGEST[watch] };
    this.study = watch === "entry"
      ? new Study(this.entry.mdp, settings, { ...shared, every: 1, measure: (Q) => Q[0] })
      : new Study(mdp, settings, { ...shared, ...wholeTable(mdp, this.best) });
    Object.assign(this, { key, settings, totals: sumsOf(settings, LONGEST[watch]) });
    this.worker.play();
  }

  showAll() {
    const { kind, c, p, until, watch } = this.stage.state;
    this.kind.value = kind;
    this.c.value = c;
    this.p.value = p;
    this.until.value = until;
    this.watch.value = watch;
    this.p.show(kind === "power");
    this.until.show(kind === "linear" || kind === "halving");
    this.draw();
  }

  /** Show n updates; return whether more can follow. */
  go(n) {
    this.set({ shown: Math.min(Math.max(n, 0), this.longest) });
    return this.n < this.longest;
  }

  reseed() {
    this.changeTask({ seed: this.stage.state.scenario.seed + SEEDS.entry });
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { settings, totals, n } = this;
    this.verdict.draw(settings);
    this.sums.draw(sumCurves(totals, n, this.longest));
    this.table.draw(totals, n);
    this.drawLearned();
    this.drawButtons();
  }

  /** Show what is learned so far; no control is touched, for a number may just be typed. */
  drawLearned() {
    const { study, settings, entry, n } = this;
    const { watch } = this.stage.state;
    const shown = Math.min(n, study.ready);
    this.learned.draw(learnedCurves(study, { shown, watch, entry, longest: this.longest }));
    const many = Math.round(study.every * shown).toLocaleString("en-US");
    this.note.textContent = watch === "entry"
      ? "Q(s, a) of one pose and turn. The band holds all 8 runs."
      : `Mean of |Q − q*| over all entries, after ${many} steps of random steering. The band holds all 4 runs.`;
    this.frame.say(sentence({ study, settings, entry, watch, shown }));
  }

  drawButtons() {
    const { longest, n } = this;
    this.player.refresh(n === longest ? "Run again" : "Run");
    this.scrubber.limit(longest);
    this.scrubber.value = n;
  }
}

/** One point for as many steps as there are entries: on average one update of each. */
function wholeTable({ S, A, terminal }, best) {
  const live = Array.from({ length: S * A }, (_, i) => i).filter((i) => !terminal[Math.floor(i / A)]);
  const measure = (Q) => live.reduce((sum, i) => sum + Math.abs(Q[i] - best[i]), 0) / live.length;
  return { every: live.length, measure };
}
