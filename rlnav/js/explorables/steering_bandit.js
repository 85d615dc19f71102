/**
 * The steering bandit: which turn pays best, and what does it cost to find out? By hand first, then by strategies.
 */
import { solve } from "../planning.js";
import { Generator } from "../rng.js";
import { Pose } from "../robot.js";
import { Bandit, Crowd, games, luckOf, play, seen, STRATEGIES, summedUp } from "../scenario/bandit.js";
import { button, segmented, slider, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Player } from "../views/player.js";
import { ArmsView } from "./bandit_arms.js";
import { lookOf, RivalsView } from "./bandit_rivals.js";
import { playing, revealed } from "./bandit_words.js";
import { pair } from "./figure.js";
import { TaskFigure } from "./task_figure.js";

const EXACT = 1e-12;
const ROBOTS = 200; // of a strategy in the comparison
const BY_HAND = 200; // pulls
const SETTINGS = ["epsilon", "tau", "c", "Q0", "alpha"];

/** Build the figure on a stage. */
export function start(stage) {
  new SteeringBandit(stage).open();
}

class SteeringBandit extends TaskFigure {
  constructor(stage) {
    super(stage, "Which turn pays best, and what does it cost to find out?");
    this.player = this.part(
      new Player({ tick: (ms) => this.crowd.runFor(ms), draw: () => this.drawRivals(), speed: Infinity }),
    );
    stage.root.addEventListener("keydown", (event) => this.key(event));
  }

  // ---------------------------------------------------------------- building
  build() {
    this.prepare(this.first); // the robot has turns
    const { element, left, right } = pair("rl-bandit");
    const { element: after, left: below, right: beside } = pair();
    this.after = after; // what follows the truth
    this.frame.body.append(element, after);
    this.map = this.part(
      new GridView(left, { label: "Map with the robot and its turns", cursor: false, maxHeight: 360 }),
    );
    right.append(this.frame.answer);
    this.arms = new ArmsView(right, this.task.robot.steering, { onPick: (a) => this.pick(a) });
    this.frame.focusFirst(this.arms.rows[0].pick.element);
    right.append(this.buildTools());
    this.rivals = new RivalsView(below, {
      onToggle: (name, on) => this.toggle(name, on),
      onChange: (parameter, value) => this.change({ [parameter]: value }),
    });
    const axes = { xLabel: "pulls", yLabel: "regret" };
    this.chart = this.part(new CurveView(beside, { label: "Regret of you and of the strategies", ...axes }));
    this.bands = h("p", { class: "rl-help" });
    beside.append(this.bands);
    this.frame.body.append(this.buildSettings());
  }

  buildTools() {
    this.reveal = button({
      label: "Tell me the truth, and let strategies play", icon: "play", onClick: () => this.tell(),
    });
    this.anew = button({ label: "New game", icon: "reset", title: "Another pose, other luck", onClick: () => this.newGame() });
    return toolbar({ label: "Game", children: [this.reveal, this.anew] }).element;
  }

  buildSettings() {
    const most = { min: 20, max: 1000, step: 10 };
    this.noise = slider({
      label: "Noise", min: 0, max: 6, step: 0.5, value: 0, onInput: (noise) => this.change({ noise }),
    });
    this.pulls = slider({ label: "Pulls of a robot", ...most, value: 20, onInput: (pulls) => this.change({ pulls }) });
    this.alpha = segmented({
      label: "Step size of a robot",
      options: [["mean", "1/N"], ["0.1", "0.1"]],
      onChange: (alpha) => this.change({ alpha: alpha === "mean" ? null : Number(alpha) }),
    });
    const parts = [this.noise, this.pulls, this.alpha].map((one) => one.element);
    return h("div", { class: "rl-row" }, parts);
  }

  // ---------------------------------------------------------------- changing
  showAll() {
    const { state } = this.stage;
    this.noise.value = state.noise;
    this.pulls.value = state.pulls;
    this.alpha.value = state.alpha === null ? "mean" : String(state.alpha);
    this.rivals.adopt(state);
    this.draw();
  }

  /** Build the bandit of a state, and let its robots begin. */
  prepare(state) {
    const { task, mdp } = this.problemOf({ ...state.scenario, starts: null });
    const Q = mdp === this.mdp ? this.Q : solve(mdp, { tol: EXACT }).Q;
    const s = task.index(new Pose(...state.pose));
    const bandit = new Bandit(Q.subarray(s * mdp.A, (s + 1) * mdp.A), state.noise);
    const luck = luckOf(state.scenario.seed, Math.max(BY_HAND, state.pulls));
    Object.assign(this, { task, mdp, Q, bandit, luck });
    this.hold(state);
  }

  /** Gather the robots of the strategies that play. */
  hold({ playing: names, pulls, ...state }) {
    const settings = Object.fromEntries(SETTINGS.map((name) => [name, state[name]]));
    this.crowd = new Crowd(this.bandit, names, settings, { robots: ROBOTS, pulls });
    this.own = Object.fromEntries(names.map((name) => {
      const { chosen } = play(this.bandit, STRATEGIES[name], settings, this.luck, Math.max(pulls, BY_HAND));
      return [name, summedUp(this.bandit, chosen)];
    }));
    if (state.shown) this.player.play();
  }

  toggle(name, on) {
    const names = Object.keys(STRATEGIES);
    const { playing: now } = this.stage.state;
    this.change({ playing: names.filter((one) => (one === name ? on : now.includes(one))) });
  }

  tell() {
    this.change({ shown: true });
    this.anew.input.focus({ preventScroll: true });
  }

  pick(a) {
    const { turns, shown } = this.stage.state;
    if (shown || turns.length >= BY_HAND) return;
    this.set({ turns: [...turns, a] });
  }

  /** Take the robot to another pose with other luck. */
  newGame() {
    const { scenario } = this.stage.state;
    const seed = scenario.seed + 1;
    const poses = games(this.mdp, this.Q);
    const { x, y, theta } = this.task.pose(poses[Math.floor(new Generator(seed).random() * poses.length)]);
    this.change({ scenario: { ...scenario, seed }, pose: [x, y, theta], turns: [], shown: false });
    this.player.pause();
    this.arms.rows[0].pick.input.focus({ preventScroll: true });
  }

  key(event) {
    const a = Number(event.key) - 1;
    if (event.target.matches("input:not([type=radio], [type=checkbox]), select") || !(a >= 0 && a < this.bandit.A)) return;
    event.preventDefault();
    this.pick(a);
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { stage, bandit, luck } = this;
    const { turns, shown, noise } = stage.state;
    this.game = { ...seen(bandit, turns, luck), turns, steering: this.task.robot.steering };
    const full = turns.length >= BY_HAND ? `Here are ${BY_HAND} pulls: enough` : "";
    const blocked = shown ? "The truth is told; begin a new game to play again" : full;
    this.arms.draw({ ...this.game, noise, shown, blocked });
    this.map.draw(this.picture());
    this.map.describe("The robot, and an arrow for each turn, numbered as the turns in the table.");
    this.reveal.show(!shown);
    this.reveal.disabled(turns.length || shown ? "" : "Try some turns first");
    this.after.hidden = !shown;
    for (const part of [this.pulls, this.alpha]) part.show(shown);
    this.drawRivals();
  }

  /** What the map shows: the robot, and where its turns lead. */
  picture() {
    const { width, height, obstacles, goal } = this.task.world;
    const [x, y, theta] = this.stage.state.pose;
    const marks = this.task.robot.steering.flatMap((turn, a) => {
      const way = theta + turn / 2;
      const [dx, dy] = [Math.cos((way * Math.PI) / 180), Math.sin((way * Math.PI) / 180)];
      const text = { x: x + 1.45 * dx, y: y + 1.45 * dy, kind: "text", text: String(a + 1) };
      return [{ x: x + 0.85 * dx, y: y + 0.85 * dy, kind: "arrow", theta: way }, text];
    });
    return { width, height, obstacles, goal, robot: { x, y, theta }, marks };
  }

  drawRivals() {
    const { crowd, game, stage, own } = this;
    const { shown, turns } = stage.state;
    if (!shown) {
      this.frame.say(playing(game));
      return;
    }
    const hand = turns.length;
    const curves = crowd.rows.map((row) => ({ name: row.name, ...crowd.curve(row), best: row.best / crowd.done }));
    const results = Object.fromEntries(curves.map(({ name, mean, off, best }) => {
      const mine = hand ? own[name][hand - 1] : NaN;
      return [name, { mine, mean: mean.at(-1), off: off.at(-1), best }];
    }));
    this.rivals.draw(crowd.done ? results : {}, { robots: crowd.done, pulls: crowd.pulls, hand });
    this.chart.draw({ series: this.series(crowd.done ? curves : []), xRange: [0, Math.max(crowd.pulls, hand)] });
    this.bands.textContent =
      `Means over ${crowd.done} robots; the bands are 95 % confidence intervals of these means. Robot 1 of each strategy has ` +
      "the same luck, and so has robot 2, and so on.";
    this.frame.say(revealed({ ...game, results }));
  }

  series(curves) {
    const yours = Float64Array.of(0, ...this.game.regret);
    const you = { name: "you", x: yours.map((_, t) => t), y: yours, color: "var(--rl-ink)", dash: "" };
    const others = curves.map(({ name, mean, off }) => {
      const x = mean.map((_, t) => t + 1);
      const band = [mean.map((m, t) => m - off[t]), mean.map((m, t) => m + off[t])];
      return { name: STRATEGIES[name].name, x, y: mean, band, ...lookOf(name) };
    });
    return this.game.turns.length ? [you, ...others] : others;
  }
}
