/**
 * A run of a scenario without any page: the learner with all that can be asked about it.  What takes long is done in
 * slices: call `...Slice(ms)` again while it returns true.  Arrays that it gives are to be read, not written.
 */
import { Learner } from "../learning.js";
import { aliasesOf } from "./alias.js";
import { Band } from "./band.js";
import { Carried } from "./carry.js";
import { Exact } from "./exact.js";
import { formulaOf } from "./formula.js";
import { Hand } from "./hand.js";
import { Knowledge } from "./knowledge.js";
import { curveOf, logOf, METRICS } from "./metrics.js";
import { algorithmOf, learnerOptions, modelOf } from "./model.js";
import { Playback } from "./playback.js";
import { checkScenario } from "./scenario.js";
import { driveFrom, posesOf } from "./trial.js";
import { sentenceOf } from "./words.js";

const PATIENCE = 300; // milliseconds that keeping a moment may take

export class Session {
  /** `tables` and `training` are what Python has sent: a model of its own, and a run to be played. */
  constructor(raw, { tables = null, training = null } = {}) {
    this.scenario = checkScenario(raw);
    this.own = tables?.own ?? []; // designs that are functions of the reader's own: "reward", "features"
    Object.assign(this, modelOf(this.scenario, tables)); // task, mdp, phi
    this.world = this.task.world;
    this.note = ""; // what there is to say about this run
    this.learner = this.#learnerFor(training);
    this.entries = this.#usedEntries();
    this.knowledge = new Knowledge(this.task, this.mdp, this.phi, this.learner);
    this.exact = new Exact(this.mdp, this.knowledge, this.scenario.max_steps);
    this.hand = new Hand(this.task, this.mdp, this.scenario.max_steps);
    this.band = null;
  }

  #learnerFor(training) {
    const { scenario, mdp, phi } = this;
    try {
      if (training) return new Playback(training, mdp, phi, scenario.Q0);
    } catch {
      this.note = "The run from Python has another table than this task needs: this is a new run.";
    }
    return new Learner(mdp, phi, algorithmOf(scenario), learnerOptions(scenario));
  }

  /** Entries of the table that belong to a pose in which the robot chooses. */
  #usedEntries() {
    const { mdp, phi } = this;
    return new Set(phi.filter((_, s) => !mdp.terminal[s])).size * mdp.A;
  }

  // ---------------------------------------------------------------- the run
  get isPlayback() {
    return this.learner instanceof Playback;
  }

  get updates() {
    return this.learner.updates;
  }

  /** Episodes that are over. */
  get episode() {
    return this.learner.episode;
  }

  get episodes() {
    return this.learner.episodes;
  }

  get done() {
    return this.learner.done;
  }

  /** One update; returns whether there was one left. */
  step() {
    return this.learner.step();
  }

  run(n) {
    return this.learner.run(n);
  }

  runFor(milliseconds) {
    return this.learner.runFor(milliseconds);
  }

  /** Go to the end of the episode; from there, to the end of the next. */
  episodeOn() {
    const { episode } = this;
    while (this.episode === episode && this.step());
  }

  back(k = 1) {
    this.learner.back(k);
  }

  /** Go to the beginning of the episode; from there, to the beginning of the one before. */
  backEpisode() {
    const { learner } = this;
    const over = this.isPlayback ? this.episode - 1 : learner.over ? this.episode - 1 : this.episode;
    this.seek(learner.steps.subarray(0, Math.max(0, over)).reduce((sum, n) => sum + n, 0));
  }

  seek(n) {
    this.learner.seek(n);
  }

  reset() {
    this.seek(0);
  }

  /**
   * Take over a scenario that only allows more episodes: the run goes on, and is still the one that the scenario
   * describes. Returns false, and changes nothing, for any other: that is a new run.
   */
  goOn(raw) {
    const scenario = checkScenario(raw);
    const fixed = scenario.alpha_schedule === "constant" && scenario.epsilon_schedule === "constant";
    const same = Object.keys(scenario).every((key) => key === "episodes" || equal(scenario[key], this.scenario[key]));
    if (this.isPlayback || !fixed || !same || scenario.episodes < this.episodes) return false;
    if (scenario.episodes > this.episodes) {
      this.learner.extend(scenario.episodes);
      this.band = null;
    }
    this.scenario = scenario;
    return true;
  }

  // ---------------------------------------------------------------- the robot
  /** Where the robot stands: the last pose on a free cell. */
  get pose() {
    const { learner, task } = this;
    return task.pose(learner.s) ?? task.pose(learner.way[learner.t - 1]);
  }

  /** What a map shows: { pose, from, crashed }; a robot that has crashed is at the pose that it drove at. */
  get robot() {
    const way = this.path().slice(-2);
    const { crashed = false, ...pose } = way.at(-1);
    return { pose, from: way.length > 1 ? way[0] : null, crashed };
  }

  /** The poses of the present episode, or of the one that has just ended. */
  path() {
    return this.knowledge.now("path", () => {
      const { learner } = this;
      return posesOf(this.task, learner.way.subarray(0, learner.t + 1), learner.last?.a);
    });
  }

  /** What the learned policy does from a pose now: { poses, crashed, goal, steps, total }. */
  greedyPath(start = this.world.starts[0]) {
    return driveFrom(this.task, this.mdp, this.knowledge.policy(), start, this.scenario.max_steps);
  }

  /** Put the robot that is driven by hand on a start. */
  beginDrive() {
    this.hand.begin();
  }

  /** Steer it by the action with this number. */
  drive(a) {
    return this.hand.drive(a);
  }

  /** { path, steps, reward (of the last step), total, over, goal, crashed } */
  get driving() {
    return this.hand;
  }

  // ---------------------------------------------------------------- the table, pose by pose (see knowledge.js)
  valuesPerPose() {
    return this.knowledge.values();
  }

  visitsPerPose() {
    return this.knowledge.visits();
  }

  turnsPerPose() {
    return this.knowledge.turns();
  }

  errorPerPose() {
    return this.knowledge.errors(this.best.Q);
  }

  inspect(pose) {
    return this.knowledge.inspect(pose, this.best.Q);
  }

  tableSize() {
    const { mdp, learner } = this;
    return { rows: learner.Q.length / mdp.A, actions: mdp.A, poseRows: mdp.S };
  }

  /** Rows that mix poses which need different turns: { count, pair, turns }. */
  aliasing() {
    return aliasesOf(this.task, this.mdp, this.phi, this.best.Q);
  }

  // ---------------------------------------------------------------- exact answers (see exact.js)
  /** Whether the exact values are known; until then, `best` holds them as they stand. */
  get solved() {
    return this.exact.solved;
  }

  solveSlice(milliseconds) {
    return this.exact.solve(milliseconds);
  }

  /** The exact solution { V, Q, pi, converged }; there is no best policy if it has not converged. */
  get best() {
    return this.exact.best;
  }

  /** { success, crash, timeout, steps, value, optimal, gap, why, updates } of the table's greedy policy, or null. */
  get evaluation() {
    return this.exact.scores;
  }

  /** Whether the table has moved on since it was scored. */
  get stale() {
    return this.exact.stale;
  }

  evaluateSlice(milliseconds) {
    return this.exact.score(milliseconds);
  }

  // ---------------------------------------------------------------- curves and words
  /** One number for each episode that is over: { returns, steps, success, tdErrors, coverage }. */
  get log() {
    if (!this.isPlayback) return logOf(this.learner, this.entries);
    const { episode, returns, steps, success } = this.learner;
    return { episode, returns: returns.subarray(0, episode), steps: steps.subarray(0, episode), success };
  }

  /** A curve { x, y } of "returns", "success", "steps", "tdErrors" or "coverage"; null where it is not known. */
  series(metric) {
    return curveOf(this.log, metric, this.episodes);
  }

  /** Run other seeds beside this one; as soon as two are done, `bandOf(metric)` is { x, low, median, high, runs }. */
  bandSlice(milliseconds, seeds) {
    if (this.isPlayback) return false;
    if (this.band?.seeds !== seeds) this.band = new Band(this, seeds, this.band);
    return this.band.run(milliseconds);
  }

  bandOf(metric) {
    return this.band?.of(metric) ?? null;
  }

  /** The last update as its formula, or null: see formula.js. */
  formula() {
    return this.isPlayback ? null : formulaOf(this.learner, this.scenario.algorithm);
  }

  /** What has happened last, in a sentence. */
  sentence() {
    return sentenceOf(this);
  }

  // ---------------------------------------------------------------- compare and carry over
  /** Keep this moment, to be compared with others. */
  pin() {
    const end = performance.now() + PATIENCE;
    while (this.stale && performance.now() < end) this.evaluateSlice(PATIENCE);
    const { scenario, updates, episode, episodes } = this;
    const evaluation = this.stale ? null : this.evaluation;
    const series = Object.fromEntries(METRICS.map((metric) => [metric, this.series(metric)]));
    return Object.freeze({ scenario, evaluation, updates, episode, episodes, series, path: this.greedyPath().poses });
  }

  /** Run the learned table on the map of another scenario; raises if its rows mean something else there. */
  carryTo(raw) {
    return new Carried(this, checkScenario(raw));
  }
}

function equal(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
