/**
 * Ten robots that learn from the reward that is mixed: how often they reach the goal, beside the reward before.
 */
import { Band } from "../scenario/band.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { written } from "./naming.js";
import { PlayButton } from "./playback.js";

const RUNS = 10;

export class MixerLearning {
  constructor(stage, parent) {
    this.band = null;
    this.before = null; // the curve of the reward before, with its name
    this.player = new PlayButton(stage, {
      label: "Let it learn",
      tick: (ms) => this.band.run(ms),
      draw: () => this.draw(),
      speed: Infinity,
      before: () => this.begin(),
      onStop: () => stage.say(this.sentence(this.band.of("success"))),
      onChange: () => this.draw(),
    });
    this.words = h("p", { class: "rl-help rl-mixer-learned" });
    parent.append(h("div", { class: "rl-mixer-learn" }, this.player.element, this.words));
    const axes = { xLabel: "episode", yLabel: "share that reach the goal", height: 190 };
    this.chart = new CurveView(parent, { label: "Learning curve", ...axes });
    stage.onCleanup(() => this.chart.destroy());
  }

  /** Take over another reward, or map; `keep` leaves what was learned before beside it. */
  adopt(mix, scenario, name, keep) {
    this.player.pause();
    const done = keep && this.band?.of("success");
    if (done) this.before = { ...done, name: `before: ${this.name}` };
    else if (!keep) this.before = null;
    this.band = null;
    Object.assign(this, { mix, scenario, name });
    this.draw();
  }

  /** Begin with ten new robots, if the last ones have learned. */
  begin() {
    if (this.band && this.band.done < RUNS) return;
    const { mdp, task } = this.mix;
    this.band = new Band({ mdp, phi: task.phi(), scenario: this.scenario, entries: 1 }, RUNS);
  }

  draw() {
    const now = this.band?.of("success");
    const line = ({ x, low, median, high, name }) => ({ name, x, y: median, band: [low, high] });
    const series = now ? [line({ ...now, name: "this reward" })] : [{ name: "this reward", x: [], y: [] }];
    if (this.before) series.push(line(this.before));
    this.chart.element.hidden = !now && !this.before;
    this.chart.draw({ series, yRange: [0, 1], xRange: [0, this.scenario.episodes] });
    this.player.refresh("Let it learn");
    this.words.textContent = this.sentence(now);
  }

  sentence(now) {
    const episodes = this.scenario.episodes.toLocaleString("en-US");
    if (!this.band) return `Q-learning: ${RUNS} robots, each with a seed of its own, ${episodes} episodes.`;
    if (this.band.done < RUNS) return `${this.band.done} of ${RUNS} robots have learned.`;
    const [low, middle, high] = [now.low, now.median, now.high].map((list) => written(list.at(-1), 2));
    return `In the last 50 of ${episodes} episodes, exploring, half of the robots reached the goal in a share of ` +
      `${middle} or more; eight in ten robots lie between ${low} and ${high}.`;
  }
}
