/**
 * Explorable of chapter 14: what must the robot perceive? Features, the table they make, the poses that they mix up,
 * and what the table is worth once it is learned: here, and on maps that it has never seen.
 */
import { inWorld, mixedRows } from "../scenario/alias.js";
import { tableSizeOf } from "../scenario/model.js";
import { featuresOf } from "../scenario/named.js";
import { checkScenario } from "../scenario/scenario.js";
import { Grounds, MAPS, School } from "../scenario/school.js";
import { Fields } from "../simulator/fields.js";
import { groundOf } from "../simulator/ground.js";
import { featureRow, FEATURES, meter } from "../simulator/perception.js";
import { button, segmented, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Player } from "../views/player.js";
import { Figure, pair } from "./figure.js";
import { remember, TriesTable } from "./picker_table.js";
import { afterTraining, beforeTraining, driveInWords, grouped, pairInWords } from "./picker_words.js";

const CARRIED = [["goal_bearing", 8], "moves_ahead"]; // a first choice that makes sense on any map
const NEXT = { pairs: "Next pair", drive: "Another start", unseen: "Another unseen map" };

/** Build the figure on a stage. */
export function start(stage) {
  new FeaturePicker(stage).open();
}

class FeaturePicker extends Figure {
  constructor(stage) {
    super(stage, "What must the robot perceive?");
    this.chosen = CARRIED; // taken up again when the reader comes back from the whole pose
    this.school = null;
    this.player = this.part(new Player({
      tick: (ms) => this.school.slice(ms),
      draw: () => this.drawProgress(),
      speed: Infinity,
      onStop: (error) => (error ? stage.message(error.message) : this.graduate()),
    }));
    this.fields = new Fields(this);
  }

  // ---------------------------------------------------------------- what the simulator's parts ask for
  get scenario() {
    return this.stage.state.scenario;
  }

  get session() {
    return { own: [] };
  }

  /** Change the scenario by a function of it; return whether that was possible. */
  edit(fn) {
    let scenario = null;
    if (!this.stage.attempt(() => (scenario = checkScenario(fn(this.scenario))))) return false;
    return this.begin({ scenario, variety: scenario.features ? this.stage.state.variety : "one" });
  }

  /** Begin with an empty table. */
  begin(patch) {
    return this.change({ ...patch, trained: false, view: "pairs", turn: 0 });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { element, left, right } = pair();
    this.frame.body.append(element, this.buildRun());
    left.append(...this.buildFeatures());
    right.append(this.frame.answer, this.buildView());
    this.map = this.part(new GridView(right, { label: "Map", cursor: false }));
    this.what = h("p", { class: "rl-help rl-what", role: "status" });
    right.append(this.what);
    this.tries = new TriesTable(this.frame.body);
  }

  buildFeatures() {
    this.kind = segmented({
      label: "The robot perceives",
      hideLabel: true,
      options: [["pose", "Its whole pose"], ["features", "A choice of features"]],
      onChange: (kind) => this.fields.change({ features: kind === "pose" ? null : this.chosen }),
    });
    this.rows = FEATURES.map((feature) => featureRow(this, this.fields, ...feature));
    this.list = h("div", { class: "rl-features" }, this.rows.map((row) => row.element));
    this.size = meter(this);
    return [this.kind.element, this.list, this.size.element];
  }

  buildView() {
    const options = [["pairs", "Pairs"], ["drive", "Drive"], ["unseen", "Unseen map"]];
    this.view = segmented({ label: "The map shows", hideLabel: true, options, onChange: (view) => this.set({ view, turn: 0 }) });
    this.next = button({ label: NEXT.pairs, icon: "step", onClick: () => this.set({ turn: this.stage.state.turn + 1 }) });
    return h("div", { class: "rl-look" }, this.view.element, this.next.element);
  }

  buildRun() {
    this.variety = segmented({
      label: "It learns on",
      options: [["one", "This map"], ["many", `${MAPS} random maps`]],
      onChange: (variety) => this.begin({ variety }),
    });
    this.train = button({ label: "Train", icon: "train", primary: true, onClick: () => this.learn() });
    this.frame.focusFirst(this.train.element);
    this.progress = h("span", { class: "rl-help rl-progress" });
    const tools = toolbar({ label: "Learning", children: [this.train] });
    return h("div", { class: "rl-run rl-picker-run" }, tools.element, this.variety.element, this.progress);
  }

  // ---------------------------------------------------------------- changing
  prepare(state) {
    const scenario = checkScenario({ ...state.scenario, starts: null });
    const { map, steering, slip, gamma, reward } = scenario;
    const key = JSON.stringify([map, steering, slip, gamma, reward]);
    if (key !== this.key) Object.assign(this, { key, grounds: new Grounds(scenario) });
    this.player.pause();
    this.chosen = scenario.features ?? this.chosen;
    this.features = featuresOf(scenario.features);
    this.school = new School(scenario, this.features, this.grounds, state.variety);
    this.judge(scenario);
  }

  /** See what the table mixes up at home. */
  judge(scenario) {
    const { mdp, best } = this.grounds.home;
    const found = mixedRows(mdp, this.grounds.home.phi(this.features), best.Q);
    this.table = { rows: tableSizeOf(scenario).rows - 1, ...found };
  }

  showAll() {
    const { scenario, variety, trained } = this.stage.state;
    this.fields.refresh();
    this.kind.value = scenario.features ? "features" : "pose";
    this.list.hidden = scenario.features === null;
    for (const row of this.rows) row.refresh();
    this.size.refresh();
    this.variety.value = variety;
    this.variety.disabled(scenario.features ? "" : "The poses of one map are not those of another.");
    if (trained) this.player.play();
    this.draw();
  }

  /** Begin to learn, with another seed if it has learned already; or stop before it is done. */
  learn() {
    if (this.player.playing) return this.change({ trained: false });
    const seed = this.scenario.seed + (this.learned ? 1 : 0);
    return this.change({ scenario: { ...this.scenario, seed }, trained: true, view: "drive", turn: 0 });
  }

  /** What was learned is known now. */
  graduate() {
    const { variety, tried, scenario } = this.stage.state;
    const { met, mixed } = this.table;
    const { home, away } = this.school;
    const scores = { home: home.success, away: away?.success ?? null };
    const one = { features: scenario.features, variety, seed: scenario.seed, met, mixed, ...scores };
    this.set({ tried: remember(tried, one) });
  }

  // ---------------------------------------------------------------- drawing
  get learned() {
    return this.stage.state.trained && this.school.done;
  }

  draw() {
    const { view, turn, tried } = this.stage.state;
    this.view.value = view;
    this.next.label = NEXT[view];
    this.drawProgress();
    if (view === "pairs") this.drawPairs(turn);
    else if (view === "drive") this.drawDrive(turn);
    else this.drawAway(turn);
    this.tries.draw(tried);
    const { home } = this.grounds;
    this.frame.say(this.learned ? afterTraining(this.school, home.possible) : beforeTraining(this.table));
  }

  drawProgress() {
    const { player, school } = this;
    this.train.label = player.playing ? "Stop" : this.learned ? "Train with another seed" : "Train";
    const { episodes } = this.scenario;
    const words = school.Q ? "Exam on other maps …" : `${grouped(school.episode)} of ${grouped(episodes)} episodes`;
    this.progress.textContent = player.playing ? words : "";
  }

  drawPairs(turn) {
    const { pairs } = this.table;
    this.next.disabled(pairs.length < 2 ? "There is no other pair." : "");
    const { home } = this.grounds;
    if (!pairs.length) return this.show(home, { words: "No two poses that look alike need different turns." });
    const place = turn % pairs.length;
    const found = inWorld(home.task, home.mdp, home.best.Q, pairs[place]);
    const ways = found.pair.map((pose, i) => [pose, home.task.robot.move(pose, found.turns[i])]);
    const marks = found.pair.map(({ x, y }, i) => ({ x: x - 0.31, y: y + 0.28, text: "AB"[i] }));
    return this.show(home, { path: ways[0], ghost: ways[1], marks, words: pairInWords(found, place, pairs.length) });
  }

  drawDrive(turn) {
    this.next.disabled(this.learned ? "" : "Train first: the table is empty.");
    this.drive(this.grounds.home, turn, "Train first: then its drive is shown here.");
  }

  drawAway(turn) {
    const carried = this.learned && this.features;
    this.next.disabled("");
    const words = this.features ? "Train first." : "A table of poses belongs to its own map.";
    this.drive(this.grounds.unseen(turn % MAPS), 0, `Map ${(turn % MAPS) + 1} of ${MAPS}. ${words}`, carried);
  }

  /** Show the drive of the learned table on a map, or what is missing. */
  drive(ground, i, missing, can = this.learned) {
    if (!can) return this.show(ground, { words: missing });
    const drive = ground.drive(this.school.policy(ground), i);
    return this.show(ground, { path: drive.poses, words: driveInWords(drive) });
  }

  show(ground, { path = null, ghost = null, marks = [], words }) {
    this.map.draw({ ...groundOf(ground.scenario), path, ghost, marks });
    this.map.describe(words);
    this.what.textContent = words;
  }
}
