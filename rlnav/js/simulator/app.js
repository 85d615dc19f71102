/**
 * The simulator: one run of one scenario, with the map it happens on, the bar that runs it, and the panels around it.
 *
 * What a panel is and may ask for
 * -------------------------------
 * A panel is a function `worldPanel(app) -> { element, refresh() }` in a file of its own. It builds its element once;
 * `refresh()` brings it up to date and is called after every change, and while the robot learns at most ten times a
 * second: it must be cheap. World, design, learner, compare and share are closed groups (`group` of views/controls.js),
 * which are loaded when the first of them is opened (folded.js); metrics and inspector are open sections. Every control's element carries `data-key`: `hide=alpha` hides that one.
 *
 *   app.stage                the stage (views/stage.js): message(text), say(text), live, ...
 *   app.scenario             what is set, complete and frozen; app.trouble says why it cannot run, "" if it can
 *   app.session              the run (scenario/session.js), of the last scenario that could run
 *   app.view                 how it is looked at; panels may keep plain settings of their own in it, under the key
 *                            `panels`: app.setView({ panels: { ...app.view.panels, curve: "steps" } })
 *   app.change(patch)        merge into the scenario: checks it and begins a new run; what cannot be becomes a message,
 *                            the last good one stays; returns whether it worked
 *   app.edit(fn)             the same with a function of the scenario: app.edit((s) => resize(s, 8, 8))
 *   app.replace(state)       take a whole { scenario, view }, such as one read from a file
 *   app.undo()               the scenario before the last change
 *   app.setView(patch)       merge into the view
 *   app.refresh()            bring everything up to date, in the next frame
 *   app.say(text)            tell those who listen instead of looking
 *   app.hidden(key)          whether the teacher hides this part
 *   app.chore(fn)            long work in slices, in spare time: fn(ms) does some and returns whether there is more;
 *                            it is forgotten when a new run begins
 *   app.playing, app.play(), app.pause()
 *   app.pinned, app.pin(), app.unpin()
 *   app.pose                 the pose that is pointed at, or selected, or else the robot's: what an inspector shows
 *   app.tool, app.setTool(tool)     "none" | "wall" | "free" | "goal" | "start": what a press on the map does
 *   app.showPair([pose, pose] | null)     mark two poses on the map
 *   app.arena                the map; app.arena.toBlob() -> Promise<Blob> of its picture
 */
import { whyNot } from "../scenario/model.js";
import { checkScenario } from "../scenario/scenario.js";
import { Session } from "../scenario/session.js";
import { Player } from "../views/player.js";
import { Arena } from "./arena.js";
import { Chores } from "./chores.js";
import { Drive } from "./drive.js";
import { Keys } from "./keys.js";
import { layOut } from "./layout.js";
import { Lecture } from "./lecture.js";
import { Link } from "./link.js";
import { Result } from "./result.js";
import { Runbar } from "./runbar.js";
import { See } from "./see.js";
import { Tour } from "./tour.js";
import { checkView, rateOf } from "./view.js";

const CALM = 100; // milliseconds between two looks of the panels while the robot learns
const SOON = 10; // milliseconds in which small problems are solved at once
const REMEMBERED = 100; // scenarios to which one can go back

/** Build the simulator on its stage. */
export function start(stage) {
  const app = new App(stage);
  app.open();
  return () => app.destroy();
}

class App {
  constructor(stage) {
    this.stage = stage;
    this.scenario = null;
    this.session = null;
    this.trouble = "";
    this.view = checkView({});
    this.history = [];
    this.pinned = null;
    this.pair = null;
    this.tool = "none";
    this.frame = 0;
    this.looked = 0; // when the panels were refreshed last,
    this.rest = CALM; // and how long they are left alone
    this.told = 0; // episodes that have been told
    this.chores = new Chores((error) => stage.message(error.message));
    this.evaluating = (ms) => this.evaluate(ms);
    this.player = new Player({
      tick: (ms) => this.tick(ms),
      draw: (at) => this.draw(at),
      onStop: (error) => this.stopped(error),
    });
  }

  /** Take the opening state and build what is seen. */
  open() {
    const { stage } = this;
    this.link = new Link(this);
    const { state, messages } = this.link.opening();
    const attempts = [state, { scenario: state.scenario }, {}]; // what is wrong with one part costs that part only
    attempts.some((part) => stage.attempt(() => this.take(part)));
    this.drive = new Drive(this);
    this.tour = new Tour(this);
    this.arena = new Arena(this);
    this.see = new See(this);
    this.runbar = new Runbar(this);
    this.result = new Result(this);
    this.lecture = new Lecture(this);
    this.keys = new Keys(this);
    this.panels = layOut(this);
    if (messages.length) stage.message(messages.join(" "));
    stage.onState((changed) => this.heard(changed));
    stage.onData("tables", () => this.restart());
    stage.onData("training", () => this.restart());
    this.applyView();
    this.refresh();
  }

  destroy() {
    cancelAnimationFrame(this.frame);
    this.chores.clear();
    for (const part of [this.player, this.tour, this.arena, this.lecture, this.keys, this.link]) part?.destroy();
  }

  /* -------------------------------------------------------------- settings */

  change(patch) {
    return this.edit((scenario) => ({ ...scenario, ...patch }));
  }

  edit(fn) {
    const before = this.scenario;
    const worked = this.stage.attempt(() => this.begin(checkScenario(fn(before))));
    if (worked) this.changed(before);
    return worked;
  }

  replace(state) {
    const before = this.scenario;
    const worked = this.stage.attempt(() => this.take(state));
    if (worked) {
      this.applyView();
      this.changed(before);
    }
    return worked;
  }

  undo() {
    const before = this.history.pop();
    if (!before || !this.stage.attempt(() => this.begin(before))) return;
    this.keep();
    this.say("The last change is undone.");
  }

  setView(patch) {
    const worked = this.stage.attempt(() => (this.view = checkView({ ...this.view, ...patch })));
    if (worked) this.applyView();
    this.keep();
    return worked;
  }

  hidden(key) {
    return this.view.hide.includes(key);
  }

  /** Take a whole state; throws, before anything has changed, if it cannot be. */
  take({ scenario = {}, view = {} }) {
    const seen = checkView(view);
    this.begin(checkScenario(scenario));
    this.view = seen;
  }

  /** Begin a run of a scenario. One that cannot run is shown and can be mended; the run stays what it was. */
  begin(scenario, { anew = false } = {}) {
    const { stage } = this;
    const given = { tables: stage.data("tables"), training: stage.data("training") };
    const trouble = whyNot(scenario, given.tables);
    if (!trouble && !anew && this.goesOn(scenario)) {
      this.scenario = scenario;
      this.trouble = "";
      return;
    }
    if (!trouble || !this.session) {
      this.renewed = this.session?.updates > 0; // what was learned is gone
      this.session = new Session(trouble ? checkScenario({}) : scenario, trouble ? {} : given);
      this.chores.clear();
      if (this.session.solveSlice(SOON)) this.chore((ms) => this.solve(ms));
      if (this.session.note) stage.message(this.session.note, "note");
    }
    this.scenario = scenario;
    this.trouble = trouble;
    this.told = this.session.episode;
    this.pair = null;
    this.tour?.stop();
    this.drive?.end();
    if (trouble) this.pause();
    this.since = performance.now();
  }

  /** Whether the run can go on under a scenario: the same one, or one that only has more episodes. */
  goesOn(scenario) {
    const same = JSON.stringify(scenario) === JSON.stringify(this.session?.scenario);
    return Boolean(same || this.session?.goOn(scenario));
  }

  /** Python has given other tables: begin again with them. */
  restart() {
    this.begin(this.scenario, { anew: true });
    this.refresh();
  }

  /** The kernel has set the state. What it cannot be is refused by an error that the stage shows. */
  heard(state) {
    const before = this.scenario;
    this.take(state);
    this.history = [...this.history, before].slice(-REMEMBERED);
    this.applyView();
    this.refresh();
  }

  changed(before) {
    this.history = [...this.history, before].slice(-REMEMBERED);
    this.stage.message("");
    this.keep();
  }

  /** Tell the kernel and the address what is set now. */
  keep() {
    this.stage.update({ scenario: this.scenario, view: this.view });
    this.link.write();
    this.refresh();
  }

  /** Hide what the teacher hides. */
  applyView() {
    for (const part of this.stage.frame.querySelectorAll("[data-key]")) {
      part.classList.toggle("rl-left-out", this.hidden(part.dataset.key));
    }
    this.lecture.follow();
  }

  /* -------------------------------------------------------------- the run */

  get playing() {
    return this.player.playing;
  }

  play() {
    if (this.trouble) {
      this.stage.message(this.trouble);
      return;
    }
    this.drive.end();
    this.tour.stop();
    if (this.session.done) {
      this.tour.watch();
      return;
    }
    this.since = performance.now();
    this.player.speed = this.rate;
    this.player.play();
    this.refresh();
  }

  pause() {
    if (!this.playing) return;
    this.player.pause();
    this.refresh();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Learn for as many episodes again. */
  goOn() {
    if (this.change({ episodes: 2 * this.session.episodes })) this.play();
  }

  setSpeed(speed) {
    this.since = performance.now();
    this.setView({ speed });
  }

  /** Steps a second at this moment. */
  get rate() {
    return rateOf(this.view.speed, (performance.now() - this.since) / 1000);
  }

  /** Whether steps come too fast for an eye to follow. */
  get fast() {
    return this.playing && this.rate > 30;
  }

  tick(ms) {
    if (ms > 0) this.session.runFor(ms);
    else this.session.step();
    return !this.session.done;
  }

  /** Take single steps, forward or back, by hand. */
  move(fn) {
    this.player.pause();
    this.tour.stop();
    this.drive.end();
    if (this.trouble) this.stage.message(this.trouble);
    else this.stage.attempt(() => fn(this.session));
    this.told = -1;
    this.refresh();
  }

  stopped(error) {
    if (error) this.stage.attempt(() => { throw error; });
    this.refresh();
    if (this.session.done) this.tour.watch();
  }

  /** Compute the exact values, a few milliseconds at once. */
  solve(ms) {
    const more = this.session.solveSlice(ms);
    if (!more) this.refresh();
    return more;
  }

  /** Compute what the learned policy is worth, a few milliseconds at once. */
  evaluate(ms) {
    if (this.playing || this.trouble) return false;
    const more = this.session.evaluateSlice(ms);
    if (more) return true;
    this.refresh();
    if (this.session.done) this.say(this.result.sentence());
    return false;
  }

  pin() {
    this.pinned = this.session.pin();
    this.refresh();
  }

  unpin() {
    this.pinned = null;
    this.refresh();
  }

  /* -------------------------------------------------------------- what is seen */

  say(text) {
    this.stage.say(text);
  }

  chore(fn) {
    this.chores.add(fn);
  }

  get pose() {
    return this.arena.pose;
  }

  setTool(tool) {
    this.tool = tool;
    this.refresh();
  }

  showPair(pair) {
    this.pair = pair;
    this.refresh();
  }

  refresh() {
    if (this.frame || !this.panels) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.draw(1);
      this.refreshPanels();
    });
  }

  /** Draw one frame; `at` is how far the robot has come on its way to the next cell. */
  draw(at) {
    this.player.speed = this.rate;
    this.tell();
    this.arena.draw(at);
    this.see.refresh();
    this.runbar.refresh();
    this.result.refresh();
    if (performance.now() - this.looked > this.rest) this.refreshPanels();
  }

  refreshPanels() {
    if (this.session.stale && this.session.updates && !this.playing) this.chore(this.evaluating);
    const begin = performance.now();
    for (const panel of this.panels) this.stage.attempt(() => panel.refresh());
    this.looked = performance.now();
    this.rest = Math.max(CALM, 10 * (this.looked - begin)); // a slow machine looks less often
  }

  /** Tell how the last episode ended. */
  tell() {
    if (this.session.episode === this.told) return;
    this.told = this.session.episode;
    this.say(this.session.sentence());
  }
}
