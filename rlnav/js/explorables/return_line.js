/**
 * Explorable of chapter 2: which way is worth more?  Two ways on one time line, their returns built backwards.
 */
import { worldOf } from "../scenario/model.js";
import { better, checkWays, curvesOf, endOf, rangeOf, seen, ties } from "../scenario/return_line.js";
import { button, slider, toggle, toolbar } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { CRASH_AT } from "../views/glyphs.js";
import { GridView } from "../views/grid.js";
import { Figure, pair } from "./figure.js";
import { timed, written } from "./naming.js";
import { ReturnLane } from "./return_lane.js";

/** Build the figure on a stage. */
export function start(stage) {
  new ReturnLine(stage).open();
}

class ReturnLine extends Figure {
  constructor(stage) {
    super(stage, "Which way is worth more?");
    this.lanes = [];
    stage.onCleanup(() => this.removeLanes());
  }

  removeLanes() {
    for (const lane of this.lanes) lane.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair("rl-return-pair");
    body.append(element);
    const look = { label: "Map with both ways", cursor: false, maxCell: 60 };
    if (this.first.map) this.map = this.part(new GridView(left, look));
    this.gamma = slider({
      label: "Discount γ", min: 0, max: 1, step: 0.01, value: 0, onInput: (gamma) => this.set({ gamma }),
    });
    left.append(answer, this.bar(), this.gamma.element);
    this.all = toggle({ label: "Show all discounts", onChange: (curves) => this.set({ curves }) });
    this.below = h("div", { class: "rl-column" });
    left.append(this.all.element, this.below);
    const axes = { xLabel: "discount γ", yLabel: "G₀: worth at the beginning" };
    const label = "Worth of both ways at every discount";
    this.chart = this.part(new CurveView(this.below, { label, height: 190, ...axes }));
    this.tie = h("p", { class: "rl-tie" });
    this.below.append(this.tie);
    this.place = h("div", { class: "rl-lanes" });
    const text = "Outline: the reward. Filled: what counts of it at the time that is built. " +
      "Drag a knob, or use the keys: left and right pick a reward, up and down change it.";
    right.append(this.place, h("p", { class: "rl-help", text }));
  }

  bar() {
    this.next = button({ label: "Build", icon: "back", primary: true, onClick: () => this.go(this.known - 1) });
    this.rest = button({ label: "Build all", onClick: () => this.go(0) });
    this.undo = button({ label: "Take back", onClick: () => this.go(this.known + 1) });
    this.frame.focusFirst(this.next.element);
    const tools = toolbar({ label: "Returns", children: [this.next, this.rest, this.undo] });
    tools.element.classList.add("rl-return-bar");
    return tools.element;
  }

  /** Make a lane for each way, unless there are such lanes already. */
  buildLanes(ways) {
    const sizes = JSON.stringify(ways.map(({ rewards }) => rewards.length));
    if (sizes === this.sizes) return;
    this.sizes = sizes;
    this.removeLanes();
    this.place.replaceChildren();
    const columns = endOf(ways);
    this.lanes = ways.map(({ rewards }, place) => new ReturnLane(this.place, {
      place, columns, steps: rewards.length,
      onReward: (t, r) => this.setReward(place, t, r),
      onDrop: () => this.draw(),
    }));
  }

  // ---------------------------------------------------------------- changing
  get known() {
    return this.stage.state.known;
  }

  /** Take over a whole state, in its complete form. */
  adopt(given) {
    const state = checkWays(given);
    if (state.map) this.world = worldOf({ map: state.map, starts: null });
    this.stage.message("");
    this.stage.update(state);
    this.buildLanes(state.ways);
    this.gamma.value = state.gamma;
    this.all.value = state.curves;
    this.draw();
  }

  /** Know the returns from time t on. */
  go(t) {
    const { ways } = this.stage.state;
    this.set({ known: Math.min(Math.max(t, 0), endOf(ways)) });
  }

  setReward(place, t, r) {
    const ways = this.stage.state.ways.map((way, i) =>
      i === place ? { ...way, rewards: way.rewards.with(t, r) } : way);
    this.set({ ways });
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { ways, gamma, known, curves } = this.stage.state;
    const best = known === 0 ? better(ways, gamma) : null;
    if (!this.lanes.some(({ held }) => held)) this.range = rangeOf(ways); // a bar that is held must not jump
    ways.forEach((way, i) => {
      const shown = { ...way, ...seen(way, gamma, known), gamma, known, wins: best === i, range: this.range };
      this.lanes[i].draw(shown);
    });
    this.drawMap(best);
    this.below.hidden = !curves;
    if (curves) this.drawCurves(ways, gamma);
    this.drawButtons();
    this.frame.say(sentence({ ways, gamma, known }, best));
  }

  /** The map: the first way in full, the second in dashes, as everywhere here; the better prize has a frame. */
  drawMap(best) {
    if (!this.map) return;
    const { ways } = this.stage.state;
    const ends = ways.map(({ poses }) => poses.at(-1));
    const marks = ways.map(({ rewards }, i) => {
      const prize = rewards.at(-1);
      return { x: ends[i][0], y: ends[i][1], text: `${prize > 0 ? "+" : ""}${written(prize, 1)}` };
    });
    const { width, height, obstacles, goal } = this.world;
    const [path, ghost] = ways.map(pathOf);
    const selected = best === null ? null : { x: ends[best][0], y: ends[best][1] };
    this.map.draw({ width, height, obstacles, goal, path, ghost, marks, selected });
    const told = ways.map(({ name, rewards }) => `The ${name} has ${rewards.length} steps.`).join(" ");
    this.map.describe(`${told}${best === null ? "" : ` The prize of the ${ways[best].name} has a frame.`}`);
  }

  drawCurves(ways, gamma) {
    const series = curvesOf(ways);
    this.chart.draw({ series, marker: gamma, xRange: [0, 1] });
    const found = ties(ways).map((tie) => written(tie, 3));
    this.tie.textContent = found.length
      ? `The two ways tie at γ = ${found.join(" and at γ = ")}.`
      : "The two ways tie at no discount.";
  }

  drawButtons() {
    const { known } = this;
    const last = endOf(this.stage.state.ways);
    this.next.label = known > 0 ? `Build ${timed("G", known - 1)}` : `${timed("G", 0)} is built`;
    this.next.disabled(known > 0 ? "" : "All returns are built");
    this.rest.disabled(known > 0 ? "" : "All returns are built");
    this.undo.disabled(known < last ? "" : "Nothing is built yet");
  }
}

/** The poses of a way; one that ends in something solid ends half way to it. */
function pathOf({ poses, crashed }) {
  const path = poses.map(([x, y, theta]) => ({ x, y, theta }));
  if (!crashed) return path;
  const [from, to] = path.slice(-2);
  const part = (a, b) => a + CRASH_AT * (b - a);
  return [...path.slice(0, -1), { x: part(from.x, to.x), y: part(from.y, to.y), theta: to.theta }];
}

/** Tell where the building is, and at its end which way is worth more. */
function sentence({ ways, gamma, known }, best) {
  const last = endOf(ways);
  if (known === last) {
    const begin = `${timed("G", last - 1)} = ${timed("R", last)}`;
    return `Nothing is added up yet. Begin at the end, where nothing follows: ${begin}.`;
  }
  const worth = ways.map((way) => ({ name: way.name, steps: way.rewards.length, G: seen(way, gamma, known).G }));
  const told = ({ name, G }) => `the ${name} is worth ${written(G[known], 3)}`;
  if (known > 0) {
    const there = worth.filter(({ steps }) => known < steps).map(told);
    return `Seen from t = ${known}, ${there.join(", and ")}.`;
  }
  const at = `At γ = ${written(gamma, 4)}`;
  if (best === null) return `${at} the two ways tie: both are worth ${written(worth[0].G[0], 2)}.`;
  const [winner, other] = [worth[best], worth[1 - best]];
  return `${at} ${told({ ...winner, G: winner.G })} and wins; ${told(other)}.`;
}
