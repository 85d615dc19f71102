/**
 * An explorable of one task: the model of its scenario, and the controls for what a reader may change in it.
 */
import { HEADINGS } from "../robot.js";
import { choice, slider } from "../views/controls.js";
import { h } from "../views/dom.js";
import { Figure } from "./figure.js";
import { ARROWS } from "./naming.js";
import { rememberedProblem } from "./problem.js";

export class TaskFigure extends Figure {
  constructor(stage, question) {
    super(stage, question);
    this.remembered = rememberedProblem();
  }

  open() {
    super.open();
    this.stage.onData("tables", () => this.adopt(this.stage.state));
  }

  /** The model of a scenario: { task, mdp, policy }. */
  problemOf(scenario) {
    return this.remembered(scenario, this.stage.data("tables"));
  }

  changeTask(patch) {
    return this.change({ scenario: { ...this.stage.state.scenario, ...patch } });
  }

  buildGamma(max) {
    const onInput = (gamma) => this.changeTask({ gamma });
    this.gamma = slider({ label: "Discount γ", min: 0, max, step: 0.01, value: 0, onInput });
    return this.gamma.element;
  }

  buildSlip(max) {
    const onInput = (slip) => this.changeTask({ slip });
    this.slip = slider({ label: "Slip", min: 0, max, step: 0.05, value: 0, onInput });
    return this.slip.element;
  }
}

/** A menu for the heading that a map shows; null stands for all of them. */
export function headingChoice(onChange) {
  const arrows = HEADINGS.map((theta) => [String(theta), `heading ${theta}° ${ARROWS[theta / 45]}`]);
  const menu = choice({
    label: "Headings",
    hideLabel: true,
    options: [["all", "all headings"], ...arrows],
    onChange: (theta) => onChange(theta === "all" ? null : Number(theta)),
  });
  return {
    element: menu.element,
    set value(heading) {
      menu.value = String(heading ?? "all");
    },
  };
}

/** The line that tells which keys a map knows. */
export function keysHelp(text) {
  return h("p", { class: "rl-help rl-keys-help", text });
}
