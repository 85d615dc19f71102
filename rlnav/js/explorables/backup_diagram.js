/**
 * Explorable of chapter 5: where does the value of this pose come from? A map to pick a pose on, and its backup diagram
 * with real numbers.
 */
import { Pose } from "../robot.js";
import { backupTree, levelsTo, policyOf, valuesOf } from "../scenario/backup.js";
import { button, segmented, slider, toolbar } from "../views/controls.js";
import { DiagramView } from "../views/diagram.js";
import { h } from "../views/dom.js";
import { formula, math, sentenceOf, symbolOf } from "./backup_formula.js";
import { BackupMap } from "./backup_map.js";
import { FillNumber } from "./fill_number.js";
import { poseInWords, turnInWords, turnText, written } from "./naming.js";
import { TaskFigure } from "./task_figure.js";

const KINDS = { v_pi: "v_{π}(s)", q_pi: "q_{π}(s, a)", v_star: "v_{*}(s)", q_star: "q_{*}(s, a)" };

/** Build the live backup diagram on its stage. */
export function start(stage) {
  new BackupDiagram(stage).open();
}

class BackupDiagram extends TaskFigure {
  constructor(stage) {
    super(stage, "Where does the value of this pose come from?");
    this.trail = []; // poses from which the reader has walked on
    this.picked = "0";
    this.hidden = null;
  }

  // ---------------------------------------------------------------- building
  build() {
    const part = (name) => h("div", { class: `rl-column rl-backup-${name}` });
    const [place, settings, tree, tell] = ["map", "settings", "tree", "tell"].map(part);
    this.frame.body.append(h("div", { class: "rl-backup" }, place, settings, tree, tell));
    const onPose = (pose, first) => this.moveTo(pose, first);
    this.map = this.part(new BackupMap(place, { onPose, onTurn: (by) => this.turn(by) }));
    place.append(this.buildTurns());
    const model = h("div", { class: "rl-row" }, this.buildGamma(1), this.buildSlip(1));
    settings.append(...this.buildKind(), this.buildPolicy(), model);
    this.diagram = this.part(new DiagramView(tree, {
      label: "Backup diagram", onPick: (node) => this.pick(node.id), onOpen: (node) => this.walkTo(node),
    }));
    const hint = "Point at a circle or a dot, or tap it: its number is explained. Choose it again to go there.";
    tree.append(h("p", { class: "rl-help", text: hint }));
    this.formula = h("div", { class: "rl-formulas" });
    this.go = button({ label: "Go to this pose", icon: "step", onClick: () => this.walkTo(this.nodeOf(this.picked)) });
    tell.append(this.frame.answer, this.formula, this.go.element);
    const ask = () => ({ root: this.root, gamma: this.mdp.gamma });
    this.fill = new FillNumber({ ask, onChange: (id) => this.hide(id) });
    this.frame.body.append(this.fill.element);
  }

  buildTurns() {
    this.back = button({ label: "Back", icon: "back", title: "To the pose before", onClick: () => this.goBack() });
    const turn = (side, by) =>
      button({ label: `Turn ${side}`, title: `The same cell, 45° to the ${side}`, onClick: () => this.turn(by) });
    return toolbar({ label: "Pose", children: [this.back, turn("left", 45), turn("right", -45)] }).element;
  }

  buildKind() {
    const options = Object.keys(KINDS).map((kind) => [kind, ""]);
    this.kind = segmented({ label: "Diagram of", options, onChange: (diagram) => this.change({ diagram }) });
    const texts = this.kind.element.querySelectorAll("label > span");
    Object.values(KINDS).forEach((name, i) => texts[i].replaceChildren(h("bdi", {}, ...math(name))));
    const onChange = (a) => this.change({ action: Number(a) });
    this.action = segmented({ label: "Action a", options: this.actionOptions(), onChange });
    return [this.kind.element, this.action.element];
  }

  actionOptions() {
    const { steering } = this.stage.state.scenario;
    return steering.map((a, i) => [String(i), turnText(a), turnInWords(a)]).reverse();
  }

  buildPolicy() {
    const options = [["random", "Chance"], ["epsilon_greedy", "ε-greedy"]];
    if (this.stage.data("tables")?.policy) options.push(["own", "The given one"]);
    this.policy = segmented({ label: "Policy π", options, onChange: (policy) => this.change({ policy }) });
    this.epsilon = slider({
      label: "ε", min: 0, max: 1, step: 0.05, value: 0, onInput: (epsilon) => this.change({ epsilon }),
    });
    this.policies = h("div", { class: "rl-row" }, this.policy.element, this.epsilon.element);
    return this.policies;
  }

  // ---------------------------------------------------------------- the state
  adopt(state) {
    this.prepare(state);
    this.trail = [];
    this.showAll();
  }

  showAll() {
    this.fill.stop();
    this.draw();
  }

  /** Change the state; a control that asked for what cannot be goes back. */
  change(patch) {
    if (!super.change(patch)) this.draw();
  }

  /** Find the exact values and the tree of a state; only then is anything taken over. */
  prepare(state) {
    const key = JSON.stringify([state.scenario, state.policy, state.epsilon, state.diagram.endsWith("star")]);
    const tables = this.stage.data("tables");
    if (key !== this.key || tables !== this.tables) {
      const { task, mdp, policy } = this.problemOf(state.scenario);
      const pi = state.diagram.endsWith("star") ? null : policyOf(mdp, state, policy);
      Object.assign(this, { task, mdp, pi, ...valuesOf(mdp, pi), key, tables });
      this.map.show(task, this.V, this.max ? "v*" : "vπ");
    }
    this.pose = state.pose ? new Pose(...state.pose) : this.task.world.starts[0];
    const s = this.task.index(this.pose);
    const { mdp, pi, V, Q } = this;
    this.root = backupTree({ mdp, pi, V, Q }, s, state.diagram.startsWith("q") ? state.action : null);
    this.picked = "0";
  }

  // ---------------------------------------------------------------- picking and walking
  /** Make a pose the root, if there is one. */
  moveTo({ x, y, theta }, remember = true) {
    const { world } = this.task;
    if (world.blocked(x, y) || (x === this.pose.x && y === this.pose.y && theta === this.pose.theta)) return;
    if (remember) this.trail.push(this.pose);
    this.change({ pose: [x, y, theta] });
  }

  turn(by) {
    const { x, y, theta } = this.pose;
    this.moveTo({ x, y, theta: (theta + by + 360) % 360 });
  }

  /** Make a successor the root. */
  walkTo(node) {
    if (node.kind !== "state" || node.terminal || node.id === "0") return;
    const inside = this.diagram.element.contains(document.activeElement);
    this.moveTo(this.task.pose(node.s));
    if (inside) this.diagram.element.querySelector("[tabindex='0']").focus(); // a keyboard goes on from the root
  }

  goBack() {
    const pose = this.trail.pop();
    if (pose) this.moveTo(pose, false);
    this.draw();
  }

  pick(id) {
    this.picked = id;
    this.refreshPicked();
  }

  /** Hide the number of a node for the exercise, or show all again. */
  hide(id) {
    this.hidden = id;
    if (this.root) this.draw();
  }

  nodeOf(id) {
    return levelsTo(this.root, id).at(-1);
  }

  // ---------------------------------------------------------------- what is seen
  draw() {
    const { state } = this.stage;
    this.kind.value = state.diagram;
    this.action.value = String(state.action);
    this.action.show(state.diagram.startsWith("q"));
    this.policy.value = state.policy;
    this.policies.hidden = this.max;
    this.epsilon.value = state.epsilon;
    this.epsilon.show(state.policy === "epsilon_greedy");
    this.gamma.value = state.scenario.gamma;
    this.slip.value = state.scenario.slip;
    this.back.disabled(this.trail.length ? "" : "You have not gone anywhere yet.");
    this.diagram.draw({ root: this.written(this.root), max: this.max, picked: this.picked, ...this.sideWords() });
    this.refreshPicked();
  }

  get max() {
    return this.pi === null;
  }

  get options() {
    return { max: this.max, gamma: this.mdp.gamma, actionFirst: this.root.kind === "action" };
  }

  sideWords() {
    const choose = (p) => (this.max ? "max" : `π(a${p}|s${p})`);
    if (this.root.kind === "action") return { levels: ["s, a", "s′", "a′"], edges: ["p, r", choose("′")] };
    return { levels: ["s", "a", "s′"], edges: [choose(""), "p, r"] };
  }

  /** The tree as the diagram writes it; a number that is asked for, and all that would tell it, is left out. */
  written(node) {
    const { steering } = this.task.robot;
    const turn = node.kind === "action" ? turnText(steering[node.a]) : "";
    const chance = node.probability === null || node.probability === undefined ? "" : written(node.probability);
    const name = node.id === "0" ? symbolOf(node, this.options).replace(/_\{(.*?)\}/, "$1") : turn;
    return {
      ...node,
      label: name,
      value: node.id === this.hidden ? "?" : this.hides(node.id) ? "" : node.value,
      edge: node.kind === "action" ? [turn, chance].filter(Boolean).join(", ") : undefined,
      best: node.best && node.id.slice(0, node.id.lastIndexOf("-")) !== this.hidden, // or the answer could be seen
      spoken: node.kind === "action" ? turnInWords(steering[node.a]) : poseInWords(this.task.pose(node.s)),
      children: this.fromLeft(node).map((child) => this.written(child)),
    };
  }

  /** The branches of a node as the robot sees them: left turns at the left. */
  fromLeft({ kind, a, children }) {
    const { robot } = this.task;
    const applied = (child) => (kind === "state" ? child.a : robot.outcomes(a)[child.ks[0]][0]);
    return children.toSorted((one, other) => applied(other) - applied(one));
  }

  /** Whether the number of a node is asked for, or would tell the one that is. */
  hides(id) {
    return this.hidden !== null && (id === this.hidden || this.hidden.startsWith(`${id}-`));
  }

  refreshPicked() {
    const node = this.nodeOf(this.picked);
    const up = this.picked.split("-").slice(0, -1).join("-");
    const parent = up ? this.nodeOf(up) : null;
    this.frame.say(sentenceOf(node, parent, this.task));
    const secret = this.hides(node.id) || (parent !== null && this.hides(parent.id));
    const ordered = { ...node, children: this.fromLeft(node) }; // as they stand in the diagram
    this.formula.replaceChildren(...formula(ordered, parent, this.options, secret));
    const goes = node.kind === "state" && !node.terminal && node.id !== "0";
    const why = node.terminal ? "The episode is over there." : "Pick a next state in the diagram first.";
    this.go.disabled(goes ? "" : why);
    this.map.draw(node, levelsTo(this.root, this.picked), this.pose);
  }
}
