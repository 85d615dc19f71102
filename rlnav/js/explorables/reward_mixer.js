/**
 * The reward mixer: what does this reward ask for?  The best drive by a reward that is mixed, at once, and played.
 */
import { Mixer, MOST_GAMMA, placeAt, RECIPES, recipeOf } from "../scenario/mixer.js";
import { PRESETS } from "../scenario/edits.js";
import { choice, group, slider, toggle, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Figure, pair } from "./figure.js";
import { MapCursor } from "./map_cursor.js";
import { MixerLearning } from "./mixer_learning.js";
import { drawn, fateKey } from "./mixer_picture.js";
import { MixerTable } from "./mixer_table.js";
import { signed, tally, verdict } from "./mixer_words.js";
import { poseInWords } from "./naming.js";
import { PlayButton } from "./playback.js";

const SPEED = 5; // steps a second
const TERMS = [
  ["goal", "Goal", 0, 20, 1],
  ["crash", "Crash", -20, 0, 1],
  ["step", "Every other step", -2, 1, 0.1],
  ["turn", "Each 90° of turning", -2, 1, 0.1],
  ["progress", "Each cell closer", 0, 3, 0.1],
  ["shaping", "Potential shaping, weight", 0, 5, 0.1],
];
const MAPS = { page: "the map of this page", free_space: "free space", obstacles: "obstacles", rooms: "rooms" };
const MORE = { corridor: "a corridor", maze: "a maze", cliff: "a cliff" };

/** Build the figure on a stage. */
export function start(stage) {
  new RewardMixer(stage).open();
}

class RewardMixer extends Figure {
  constructor(stage) {
    super(stage, "What does this reward ask for?");
    this.mixer = new Mixer();
    this.keep = false; // what was learned before the present mix
    this.cursor = new MapCursor({ facing: 0, onTell: (cell) => this.tell(cell), enter: (cell) => this.pick(cell) });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair("rl-mixer");
    body.append(element);
    this.map = this.part(new GridView(left, {
      label: "Map with the drive that is best by this reward",
      onCell: (event) => event.type === "down" && event.button === 0 && this.pick(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, this.map),
    }));
    this.keyed = h("div", { class: "rl-fates" });
    left.append(this.keyed, this.buildRun(), this.buildTask());
    right.append(answer);
    this.table = new MixerTable(right);
    right.append(this.buildMix());
    this.learning = new MixerLearning(this.stage, body);
  }

  buildRun() {
    this.player = new PlayButton(this.stage, {
      label: "Watch it drive",
      primary: true,
      tick: () => this.tick(),
      draw: (at) => this.drawRobot(at),
      speed: SPEED,
      before: () => this.atEnd && this.begin(),
      onStop: () => this.drawRobot(1),
      onChange: () => this.drawButton(),
    });
    this.frame.focusFirst(this.player.element);
    this.counted = h("p", { class: "rl-help rl-tally" });
    return h("div", { class: "rl-run" }, toolbar({ label: "Drive", children: [this.player] }).element, this.counted);
  }

  buildMix() {
    const recipes = Object.entries(RECIPES).map(([name, [words]]) => [name, words]);
    this.recipe = choice({
      label: "Recipe",
      options: [["task", "The reward of the task"], ...recipes, ["own", "Your own mix"]],
      onChange: (name) => this.cook(name),
    });
    this.terms = {};
    const term = ([key, label, min, max, step]) => {
      const onInput = (value) => this.pay({ [key]: value });
      this.terms[key] = slider({ label, min, max, step, value: 0, format: signed, onInput });
      return this.terms[key].element;
    };
    this.closer = toggle({
      label: "Forget to charge for going away",
      onChange: (only_closer) => this.pay({ only_closer }),
    });
    const sliders = TERMS.map(term);
    sliders.splice(5, 0, this.closer.element);
    return h("div", { class: "rl-mixer-terms" }, this.recipe.element, sliders);
  }

  buildTask() {
    this.place = choice({
      label: "Map",
      options: Object.entries({ ...MAPS, ...MORE }),
      value: "page",
      onChange: (name) => this.move(name),
    });
    const onInput = (gamma) => this.change({ scenario: { ...this.stage.state.scenario, gamma } }, false);
    this.gamma = slider({ label: "Discount γ", min: 0, max: MOST_GAMMA, step: 0.01, value: 0, onInput });
    const row = h("div", { class: "rl-row" }, this.place.element, this.gamma.element);
    const help = "Press a cell to start there; the eight wedges of a ring are the headings. " +
      "Keys on the map: arrows move, R turns the heading, Enter starts there.";
    return group({ title: "Map, discount and start", children: [row, h("p", { class: "rl-help", text: help })] }).element;
  }

  // ---------------------------------------------------------------- changing
  prepare(state) {
    this.mix = this.mixer.mix(state);
  }

  adopt(state) {
    this.prepare(state);
    this.stage.message("");
    this.player.pause();
    this.keep = false;
    this.showAll();
  }

  /** Mix anew, and `keep` what was learned before, for comparison. */
  change(patch, keep = true) {
    this.keep = keep;
    return super.change(patch);
  }

  showAll() {
    const { scenario, task_reward: taskReward } = this.stage.state;
    const name = recipeOf(scenario.reward, taskReward);
    this.recipe.value = name;
    for (const [key, one] of Object.entries(this.terms)) one.value = scenario.reward[key];
    this.closer.value = scenario.reward.only_closer;
    this.gamma.value = scenario.gamma;
    this.place.value = this.nameOfPlace(scenario);
    this.begin();
    this.frame.say(verdict(this.mix));
    this.map.describe(`${verdict(this.mix)} Arrow keys move, R turns the heading, Enter starts the robot there.`);
    this.table.draw(this.mix.worth);
    this.learning.adopt(this.mix, scenario, this.recipe.input.selectedOptions[0].text, this.keep);
    this.keyed.replaceChildren(...fateKey(this.mix, this.stage.reducedMotion));
    this.drawRobot(1);
    this.drawButton();
  }

  pay(patch) {
    const { scenario } = this.stage.state;
    this.change({ scenario: { ...scenario, reward: { ...scenario.reward, ...patch } } });
  }

  cook(name) {
    if (name === "own") return;
    this.pay(name === "task" ? this.stage.state.task_reward : RECIPES[name][1]);
  }

  move(name) {
    const { scenario } = this.stage.state;
    const { map, starts } = name === "page" ? this.first.scenario : PRESETS[name];
    this.change({ scenario: { ...scenario, map, starts }, pose: name === "page" ? this.first.pose : null }, false);
  }

  nameOfPlace({ map }) {
    const same = (other) => JSON.stringify(other) === JSON.stringify(map);
    return same(this.first.scenario.map) ? "page" : Object.keys(PRESETS).find((name) => same(PRESETS[name].map)) ?? "page";
  }

  // ---------------------------------------------------------------- the map
  pick({ x, y, theta }) {
    const { world } = this.mix.task;
    if (world.blocked(x, y) || world.isGoal(x, y)) return;
    this.change({ pose: [x, y, theta ?? this.cursor.facing] });
    this.tell({ x, y });
  }

  tell({ x, y }) {
    const { task } = this.mix;
    const what = task.world.blocked(x, y) ? ", a wall" : task.world.isGoal(x, y) ? ", the goal" : "";
    this.stage.say(what ? `cell (${x}, ${y})${what}.` : `${poseInWords({ x, y, theta: this.cursor.facing })}.`);
  }

  // ---------------------------------------------------------------- the drive
  begin() {
    this.t = 0;
    this.paid = [0, 0];
    this.weight = 1;
  }

  /** Drive one step; return whether another follows. */
  tick() {
    const { drive, mdp, ownMdp } = this.mix;
    const last = drive.states.length - 1;
    if (!drive.loop && this.t >= last) return false;
    this.t += 1;
    const from = placeAt(drive, this.t) - 1;
    const i = (drive.states[from] * mdp.A + drive.actions[from]) * mdp.K;
    [mdp, ownMdp].forEach((model, k) => (this.paid[k] += this.weight * model.reward[i]));
    this.weight *= mdp.gamma;
    return drive.loop !== null || this.t < last;
  }

  get atEnd() {
    const { loop, states } = this.mix.drive;
    return !loop && this.t === states.length - 1;
  }

  // ---------------------------------------------------------------- drawing
  drawRobot(at) {
    this.map.draw(drawn(this.mix, this.t, at));
    this.counted.textContent = tally(this.mix, this.t, this.paid);
  }

  drawButton() {
    this.player.refresh(`Watch it ${this.mix.drive.end === "circle" ? "circle" : "drive"}`);
  }
}
