/**
 * The reward mixer: what does this reward ask for?  The best drive by a reward that is mixed, at once, and played.
 */
import { Mixer, MOST_GAMMA, placeAt, RECIPES, recipeOf } from "../scenario/mixer.js";
import { PRESETS } from "../scenario/edits.js";
import { button, choice, group, slider, toggle, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { Player } from "../views/player.js";
import { frame } from "./frame.js";
import { MixerLearning } from "./mixer_learning.js";
import { drawn, fateKey } from "./mixer_picture.js";
import { MixerTable } from "./mixer_table.js";
import { signed, tally, verdict } from "./mixer_words.js";
import { poseInWords } from "./naming.js";

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
  const figure = new RewardMixer(stage);
  return () => figure.destroy();
}

class RewardMixer {
  constructor(stage) {
    this.stage = stage;
    this.first = stage.state; // what "Start again" comes back to
    this.mixer = new Mixer();
    this.facing = 0; // the heading that the keyboard's cursor asks for
    this.player = new Player({
      tick: () => this.tick(),
      draw: (at) => this.drawRobot(at),
      speed: SPEED,
      onStop: (error) => {
        if (error) stage.message(error.message);
        this.drawRobot(1);
        this.drawButton();
      },
    });
    this.build();
    this.adopt(stage.state);
    stage.onState((state) => this.adopt(state));
  }

  destroy() {
    for (const part of [this.player, this.map, this.learning]) part.destroy();
  }

  // ---------------------------------------------------------------- building
  build() {
    this.frame = frame(this.stage, { question: "What does this reward ask for?", onReset: () => this.reset() });
    const left = h("div", { class: "rl-column" });
    const right = h("div", { class: "rl-column" });
    this.frame.body.append(h("div", { class: "rl-pair rl-mixer" }, left, right));
    this.map = new GridView(left, {
      label: "Map with the drive that is best by this reward",
      onCell: (event) => event.type === "down" && event.button === 0 && this.pick(event),
      onHover: (cell) => cell?.theta === null && this.tell(cell),
      onKey: (event) => this.key(event),
    });
    this.keyed = h("div", { class: "rl-fates" });
    left.append(this.keyed, this.buildRun(), this.buildTask());
    right.append(this.frame.answer);
    this.table = new MixerTable(right);
    right.append(this.buildMix());
    this.learning = new MixerLearning(this.stage, this.frame.body);
  }

  buildRun() {
    this.play = button({ label: "Watch it drive", icon: "play", primary: true, onClick: () => this.playOrPause() });
    this.frame.focusFirst(this.play.element);
    this.counted = h("p", { class: "rl-help rl-tally" });
    return h("div", { class: "rl-mixer-run" }, toolbar({ label: "Drive", children: [this.play] }).element, this.counted);
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
  /** Take over a whole state; one that cannot be throws and leaves what there is. */
  adopt(state) {
    this.mix = this.mixer.mix(state);
    this.stage.message("");
    this.player.pause();
    this.show(state, false);
  }

  /** Change a part of the state; what cannot be becomes a message, and the last good reward stays. */
  change(patch, keep = true) {
    const state = { ...this.stage.state, ...patch };
    if (!this.stage.attempt(() => (this.mix = this.mixer.mix(state)))) return;
    this.stage.message("");
    this.stage.update(patch);
    this.show(state, keep);
  }

  /** Show what is mixed; `keep` what was learned before, for comparison. */
  show(state, keep) {
    const { scenario, task_reward: taskReward } = state;
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
    this.learning.adopt(this.mix, scenario, this.recipe.input.selectedOptions[0].text, keep);
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

  reset() {
    this.stage.update(this.first);
    this.adopt(this.first);
  }

  // ---------------------------------------------------------------- the map
  pick({ x, y, theta }) {
    const { world } = this.mix.task;
    if (world.blocked(x, y) || world.isGoal(x, y)) return;
    this.change({ pose: [x, y, theta ?? this.facing] });
    this.tell({ x, y });
  }

  tell({ x, y }) {
    const { task } = this.mix;
    const what = task.world.blocked(x, y) ? ", a wall" : task.world.isGoal(x, y) ? ", the goal" : "";
    this.stage.say(what ? `cell (${x}, ${y})${what}.` : `${poseInWords({ x, y, theta: this.facing })}.`);
  }

  key({ key, shiftKey }) {
    const [x, y] = this.map.cursor;
    if (key === "Enter" || key === " ") this.pick({ x, y, theta: null });
    else if (key.toLowerCase() === "r") {
      this.facing = (this.facing + (shiftKey ? 315 : 45)) % 360;
      this.tell({ x, y });
    } else return false;
    return true;
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

  playOrPause() {
    if (this.player.playing) this.player.pause();
    else {
      if (!this.mix.drive.loop && this.t === this.mix.drive.states.length - 1) this.begin();
      this.player.play();
    }
    this.drawButton();
  }

  // ---------------------------------------------------------------- drawing
  drawRobot(at) {
    this.map.draw(drawn(this.mix, this.t, at));
    this.counted.textContent = tally(this.mix, this.t, this.paid);
  }

  drawButton() {
    const { playing } = this.player;
    this.play.label = playing ? "Pause" : `Watch it ${this.mix.drive.end === "circle" ? "circle" : "drive"}`;
    this.play.icon = playing ? "pause" : "play";
  }
}
