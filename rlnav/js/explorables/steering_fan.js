/**
 * Explorable of chapter 13: where can the robot be next? The fan of its moves, and all poses within a few steps.
 */
import { fail } from "../check.js";
import { Pose } from "../robot.js";
import { taskOf, whyNot } from "../scenario/model.js";
import { chancesOf, fanOf, Reach } from "../scenario/reach.js";
import { button, choice, slider, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { CRASH_AT, onTheWay } from "../views/glyphs.js";
import { GridView } from "../views/grid.js";
import { Legend } from "../views/legend.js";
import { FanPicture } from "./fan_picture.js";
import { movesInWords, sentence } from "./fan_words.js";
import { Figure, pair } from "./figure.js";
import { keysHelp, MapCursor } from "./map_cursor.js";
import { poseInWords, turnText } from "./naming.js";
import { Walls } from "./walls.js";

const TURNS = [-180, -135, -90, -45, 0, 45, 90, 135, 180];
const MOST = 12; // steps
const NONE = "any";
const CRASH = "#d55e00"; // as --rl-crash

/** Build the figure on a stage. */
export function start(stage) {
  new SteeringFan(stage).open();
}

class SteeringFan extends Figure {
  constructor(stage) {
    super(stage, "Where can the robot be in a few steps?");
    this.hovered = null; // a pose that is pointed at
    this.cursor = new MapCursor({
      onPoint: (cell) => this.point(cell),
      onTell: () => stage.say(this.hovered ? this.tell(this.hovered) : "a wall"),
      enter: ({ x, y }) => this.place(x, y, this.cursor.facing),
      w: (cell) => this.walls.flip(cell),
    });
  }

  // ---------------------------------------------------------------- building
  build() {
    const { body, answer } = this.frame;
    const { element, left, right } = pair();
    body.append(this.buildTurns(), element, this.buildSettings());
    this.map = this.part(new GridView(left, {
      label: "Map with all poses that can be reached",
      onCell: (event) => this.press(event),
      onHover: (cell) => this.cursor.point(cell),
      onKey: (event) => this.cursor.key(event, this.map),
    }));
    this.legend = new Legend(left);
    left.append(this.buildRun());
    right.append(answer);
    this.picture = new FanPicture(right);
    this.moves = h("p", { class: "rl-help rl-moves" });
    right.append(this.moves);
  }

  /** The steering set, turn by turn. */
  buildTurns() {
    this.turns = TURNS.map((a) => button({ label: turnText(a), pressed: false, onClick: () => this.flip(a) }));
    const set = toolbar({ label: "Turns to choose from", children: this.turns });
    const label = h("span", { class: "rl-label", text: "Steering set (left is positive)" });
    return h("div", { class: "rl-fan-set" }, label, set.element);
  }

  buildRun() {
    this.back = button({ label: "One step less", icon: "back", onClick: () => this.go(this.k - 1) });
    this.more = button({ label: "One step more", icon: "step", primary: true, onClick: () => this.go(this.k + 1) });
    this.frame.focusFirst(this.more.element);
    const tools = toolbar({ label: "Steps", children: [this.back, this.more] });
    this.scrubber = slider({ label: "Steps", min: 0, max: MOST, step: 1, value: 0, onInput: (k) => this.go(k) });
    return h("div", { class: "rl-run rl-scrubbed" }, tools.element, this.scrubber.element);
  }

  buildSettings() {
    const tell = (told) => this.change({ told: told === NONE ? null : Number(told) });
    this.told = choice({ label: "The robot is told", options: [[NONE, "any turn"]], value: NONE, onChange: tell });
    this.slip = slider({ label: "Slip", min: 0, max: 1, step: 0.05, value: 0, onInput: (p) => this.setSlip(p) });
    const here = (x, y) => x === this.pose.x && y === this.pose.y;
    this.walls = new Walls(this, (x, y) => (here(x, y) ? "The robot stands there." : ""));
    const row = h("div", { class: "rl-row" }, [this.told, this.slip, this.walls].map((one) => one.element));
    const keys = "Keys on the map: arrows move, R turns the heading, Enter puts the robot there, W sets or takes a wall.";
    return h("div", {}, row, keysHelp(keys));
  }

  // ---------------------------------------------------------------- changing
  prepare(state) {
    const { scenario, pose: [x, y, theta], steps } = state;
    const trouble = whyNot({ ...scenario, starts: null });
    if (trouble) fail("map", "one on which the goal can be reached", "another", trouble);
    const task = taskOf({ ...scenario, starts: null });
    const pose = new Pose(x, y, theta);
    if (task.world.isGoal(x, y)) fail("pose", "away from the goal", `${pose}`);
    Object.assign(this, { reach: new Reach(task, pose), task, pose, k: steps });
    this.fan = fanOf(task, pose);
    if (this.hovered && task.world.blocked(this.hovered.x, this.hovered.y)) this.hovered = null; // a wall by now
  }

  showAll() {
    const { scenario: { steering, slip }, told } = this.stage.state;
    this.turns.forEach((turn, i) => {
      turn.pressed = steering.includes(TURNS[i]);
      turn.disabled(turn.pressed && steering.length === 1 ? "The robot needs at least one turn." : "");
    });
    const options = [[NONE, "any turn"], ...steering.map((a) => [String(a), turnText(a)])];
    this.told.input.replaceChildren(...options.map(([value, text]) => h("option", { value, text })));
    this.told.value = told === null ? NONE : String(told);
    this.slip.value = slip;
    this.draw();
  }

  /** Slips are those of a turn that is told: where none is, the straightest one. */
  setSlip(slip) {
    const { scenario, told } = this.stage.state;
    const straightest = scenario.steering.toSorted((a, b) => Math.abs(a) - Math.abs(b))[0];
    this.change({ scenario: { ...scenario, slip }, told: told ?? straightest });
  }

  flip(a) {
    const { scenario, told } = this.stage.state;
    const rest = scenario.steering.filter((turn) => turn !== a);
    const steering = rest.length < scenario.steering.length ? rest : [...rest, a].sort((p, q) => p - q);
    this.change({ scenario: { ...scenario, steering }, told: steering.includes(told) ? told : null });
  }

  /** Look k steps ahead. */
  go(k) {
    const steps = Math.min(Math.max(k, 0), MOST);
    this.k = steps;
    this.set({ steps });
  }

  // ---------------------------------------------------------------- the map
  press(event) {
    const { type, x, y, theta, button: pressed } = event;
    if (!this.walls.press(event) && type === "down" && pressed === 0) this.place(x, y, theta);
  }

  /** Put the robot on a pose. */
  place(x, y, theta) {
    if (this.task.world.blocked(x, y) || this.task.world.isGoal(x, y)) {
      this.stage.message("The robot can stand on a free cell that is not the goal.");
      return;
    }
    this.hovered = null;
    this.change({ pose: [x, y, theta] });
  }

  point(cell) {
    const free = cell && !this.task.world.blocked(cell.x, cell.y);
    this.hovered = free ? new Pose(cell.x, cell.y, cell.theta ?? this.cursor.facing) : null;
    this.drawMap();
  }

  tell(pose) {
    const steps = this.reach.steps[this.task.index(pose)];
    const how = steps < 0 ? "cannot be reached" : `first reached in step ${steps}`;
    return `${poseInWords(pose)}: ${how}.`;
  }

  // ---------------------------------------------------------------- drawing
  draw() {
    const { reach, k, task, pose, fan } = this;
    const told = this.told.value === NONE ? null : Number(this.told.value);
    const chances = told === null ? null : chancesOf(task.robot, task.robot.steering.indexOf(told));
    const words = movesInWords(fan, chances, told);
    this.picture.draw({ world: task.world, pose, fan, chances, words });
    this.moves.textContent = words;
    this.drawMap();
    this.frame.say(sentence(reach, k));
    this.back.disabled(k === 0 ? "This is the beginning." : "");
    this.more.disabled(k === MOST ? `This figure looks ${MOST} steps ahead.` : "");
    this.scrubber.value = k;
  }

  drawMap() {
    const { reach, k, task, pose } = this;
    const { width, height, obstacles, goal } = task.world;
    const rings = new Float64Array(width * height * 8).fill(NaN);
    task.poses.forEach(({ x, y, theta }, s) => {
      const steps = reach.steps[s];
      if (steps > 0 && steps <= k) rings[(y * width + x) * 8 + theta / 45] = steps;
    });
    const wanted = this.hovered ? task.index(this.hovered) : reach.toGoal <= k ? reach.arrival : -1;
    const marks = reach.crashes(k).map(({ from, to }) => ({ ...onTheWay(from, to, CRASH_AT), kind: "cross", color: CRASH }));
    const scale = { low: 0, high: MOST };
    const robot = { x: pose.x, y: pose.y, theta: pose.theta };
    this.map.draw({ width, height, obstacles, goal, rings, scale, robot, marks, path: reach.wayTo(wanted) });
    this.map.describe(`${sentence(reach, k)} Arrow keys move, R turns, Enter puts the robot there, W sets a wall.`);
    this.legend.draw({ ...scale, label: "reached in step" });
  }
}
