/**
 * Explorable of chapter 10: what does one road learn from the other? Recorded drives on roads that merge, and the
 * tables of Monte Carlo and TD(0) side by side.
 */
import { Merging, MOST_DRIVES } from "../scenario/merging.js";
import { button, segmented, slider, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { Player } from "../views/player.js";
import { frame } from "./frame.js";
import { driveOf, errorCurves, SCALE, valuesOf } from "./merging_picture.js";
import { RoadTable } from "./merging_table.js";
import { roadNames, sentence } from "./merging_words.js";
import { problemOf } from "./problem.js";

const DRIVES_A_SECOND = 1.5;
const MAPS = [["drive", "The drive"], ["mc", "Monte Carlo"], ["td", "TD(0)"], ["exact", "Exact"]];
const OTHER_LUCK = 100; // the next seed whose drives are all other ones

/** Build the figure on its stage. */
export function start(stage) {
  const figure = new MergingPaths(stage);
  return () => figure.destroy();
}

class MergingPaths {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.player = new Player({
      tick: () => this.go(this.k + 1),
      draw: () => {},
      speed: DRIVES_A_SECOND,
      onStop: (error) => {
        if (error) stage.message(error.message);
        this.drawButtons();
      },
    });
    this.prepare(stage.state);
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
  }

  destroy() {
    for (const part of [this.player, ...Object.values(this.maps), this.chart]) part.destroy();
  }

  get k() {
    return this.stage.state.shown;
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = (this.frame = frame(this.stage, {
      question: "What does one road learn from the other?",
      onReset: () => this.reset(),
    }));
    const row = h("div", { class: "rl-merge-maps" });
    body.append(this.buildSettings(), row);
    this.maps = Object.fromEntries(MAPS.map(([name, title]) => {
      const place = h("div", { class: "rl-merge-map" }, h("p", { class: "rl-merge-title", text: title }));
      row.append(place);
      return [name, new GridView(place, { label: title, axes: false, cursor: false, maxHeight: 330 })];
    }));
    this.legend = new Legend(body);
    body.append(this.buildRun(), answer, this.buildMore());
    const [left, right] = [h("div", { class: "rl-column" }), h("div", { class: "rl-column" })];
    body.append(h("div", { class: "rl-pair" }, left, right));
    this.table = new RoadTable(left);
    const axes = { xLabel: "drive", yLabel: "error over all poses (RMS)", height: 190 };
    this.chart = new CurveView(right, { label: "Errors of both tables", ...axes });
  }

  buildSettings() {
    this.batch = segmented({
      label: "Learn from each drive",
      options: [["once", "once"], ["batch", "again and again"]],
      onChange: (how) => this.change({ batch: how === "batch" }),
    });
    this.alpha = slider({
      label: "Step size α", min: 0.05, max: 1, step: 0.05, value: 0.5, onInput: (alpha) => this.change({ alpha }),
    });
    return h("div", { class: "rl-merge-settings" }, this.batch.element, this.alpha.element);
  }

  /** What plays the drives. */
  buildRun() {
    this.back = button({ label: "Back", icon: "back", title: "One drive back", onClick: () => this.step(-1) });
    this.next = button({ label: "Next drive", icon: "step", primary: true, onClick: () => this.step(1) });
    this.play = button({ label: "Play", icon: "play", onClick: () => this.playOrPause() });
    this.frame.focusFirst(this.next.element);
    const recorded = toolbar({ label: "Recorded drives", children: [this.back, this.next, this.play] });
    return h("div", { class: "rl-merge-run" }, recorded.element);
  }

  /** What adds more drives. */
  buildMore() {
    this.roads = roadNames(this.merging, this.task).map((name, road) =>
      button({ label: `+ ${name}`, title: `Drive the ${name} now`, onClick: () => this.add(road) }));
    this.luck = button({
      label: "Other luck", title: "The same roads, driven with other chance", onClick: () => this.reseed(),
    });
    return toolbar({ label: "More drives", children: [...this.roads, this.luck] }).element;
  }

  // ---------------------------------------------------------------- changing
  /** Learn what a state asks for; one that cannot be throws and leaves what there is. */
  prepare({ scenario, drives, alpha, batch }) {
    const key = JSON.stringify(scenario);
    let { merging, task } = this;
    if (key !== this.key) {
      const problem = problemOf(scenario, this.stage.data("tables"));
      task = problem.task;
      merging = new Merging(problem.mdp, problem.policy, { seed: scenario.seed, maxSteps: scenario.max_steps });
    }
    const moments = merging.learn(drives, { alpha, batch });
    Object.assign(this, { key, task, merging, moments });
  }

  adopt(state) {
    this.prepare(state);
    this.alpha.value = state.alpha;
    this.batch.value = state.batch ? "batch" : "once";
    this.alpha.disabled(state.batch ? "Where the tables come to rest does not depend on the step size." : "");
    this.draw();
  }

  change(patch) {
    this.stage.message("");
    this.stage.update(patch);
    this.adopt(this.stage.state);
  }

  /** Show what is known after k drives; return whether another follows. */
  go(k) {
    const last = this.moments.length - 1;
    this.change({ shown: Math.min(Math.max(k, 0), last) });
    return this.k < last;
  }

  step(direction) {
    this.player.pause();
    this.go(this.k + direction);
  }

  playOrPause() {
    if (this.player.playing) this.player.pause();
    else {
      if (this.k === this.moments.length - 1) this.go(0);
      this.player.play();
    }
    this.drawButtons();
  }

  /** Drive on a road now; recorded drives that were still to come make room for it. */
  add(road) {
    this.player.pause();
    const drives = [...this.stage.state.drives.slice(0, this.k), road];
    this.change({ drives, shown: drives.length });
  }

  reseed() {
    this.player.pause();
    const { scenario } = this.stage.state;
    this.change({ scenario: { ...scenario, seed: scenario.seed + OTHER_LUCK } });
  }

  reset() {
    this.player.pause();
    this.change(this.first);
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { merging, task, moments, k } = this;
    const { batch } = this.stage.state;
    const now = moments[k];
    const names = roadNames(merging, task);
    const words = sentence({ merging, moments, k, names, batch });
    this.maps.drive.draw(driveOf(merging, task, now.drive));
    for (const [name, V] of [["mc", now.mc], ["td", now.td], ["exact", merging.exact]]) {
      this.maps[name].draw(valuesOf(merging, task, V, now.drive));
      this.maps[name].describe(`Values along the roads: ${names.map((road, i) =>
        `${road} ${V[merging.roads[i]].toFixed(1)}`).join(", ")} at the start.`);
    }
    this.maps.drive.describe(words);
    this.legend.draw({ ...SCALE, label: "value" });
    this.table.draw({ merging, moments, k, names });
    this.chart.draw(errorCurves(moments, k));
    this.frame.say(words);
    this.drawButtons();
  }

  drawButtons() {
    const { k, moments, player } = this;
    const last = moments.length - 1;
    const full = k >= MOST_DRIVES ? `${MOST_DRIVES} drives are enough to see it` : "";
    this.back.disabled(k === 0 ? "No drive yet" : "");
    this.next.disabled(k === last ? "All recorded drives have been played; choose a road for another one" : "");
    this.next.label = k === last ? "All played" : "Next drive";
    this.play.disabled(last === 0 ? "No drive is recorded" : "");
    this.play.label = player.playing ? "Pause" : "Play";
    this.play.icon = player.playing ? "pause" : "play";
    for (const road of this.roads) road.disabled(full);
  }
}
