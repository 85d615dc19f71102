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
import { Figure, pair } from "./figure.js";
import { driveOf, errorCurves, SCALE, valuesOf } from "./merging_picture.js";
import { RoadTable } from "./merging_table.js";
import { roadNames, sentence } from "./merging_words.js";
import { Walk } from "./playback.js";
import { problemOf } from "./problem.js";

const DRIVES_A_SECOND = 1.5;
const MAPS = [["drive", "The drive"], ["mc", "Monte Carlo"], ["td", "TD(0)"], ["exact", "Exact"]];
const OTHER_LUCK = 100; // the next seed whose drives are all other ones

/** Build the figure on its stage. */
export function start(stage) {
  new MergingPaths(stage, "What does one road learn from the other?").open();
}

class MergingPaths extends Figure {
  get k() {
    return this.stage.state.shown;
  }

  // ---------------------------------------------------------------- building
  build() {
    this.prepare(this.first); // the roads have names
    const { body, answer } = this.frame;
    const row = h("div", { class: "rl-merge-maps" });
    body.append(this.buildSettings(), row);
    this.maps = Object.fromEntries(MAPS.map(([name, title]) => {
      const place = h("div", { class: "rl-merge-map" }, h("p", { class: "rl-merge-title", text: title }));
      row.append(place);
      return [name, this.part(new GridView(place, { label: title, axes: false, cursor: false, maxHeight: 330 }))];
    }));
    this.legend = new Legend(body);
    body.append(this.buildRun(), answer, this.buildMore());
    const { element, left, right } = pair();
    body.append(element);
    this.table = new RoadTable(left);
    const axes = { xLabel: "drive", yLabel: "error over all poses (RMS)", height: 190 };
    this.chart = this.part(new CurveView(right, { label: "Errors of both tables", ...axes }));
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
    this.walk = new Walk(this, {
      back: { title: "One drive back" },
      next: { label: "Next drive" },
      speed: DRIVES_A_SECOND,
    });
    this.player = this.walk.player;
    const recorded = toolbar({ label: "Recorded drives", children: [this.walk.back, this.walk.next, this.player] });
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

  showAll() {
    const { alpha, batch } = this.stage.state;
    this.alpha.value = alpha;
    this.batch.value = batch ? "batch" : "once";
    this.alpha.disabled(batch ? "Where the tables come to rest does not depend on the step size." : "");
    this.draw();
  }

  /** Show what is known after k drives; return whether another follows. */
  go(k) {
    this.change({ shown: Math.min(Math.max(k, 0), this.moments.length - 1) });
    return !this.over;
  }

  get over() {
    return this.k === this.moments.length - 1;
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
    const { k, over } = this;
    const full = k >= MOST_DRIVES ? `${MOST_DRIVES} drives are enough to see it` : "";
    this.walk.draw({
      begin: k === 0 ? "No drive yet" : "",
      end: over ? "All recorded drives have been played; choose a road for another one" : "",
      why: this.moments.length === 1 ? "No drive is recorded" : "",
    });
    this.walk.next.label = over ? "All played" : "Next drive";
    for (const road of this.roads) road.disabled(full);
  }
}
