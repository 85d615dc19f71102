/**
 * An explorable of one task: the model of its scenario, and the controls for what a reader may change in it.
 */
import { slider } from "../views/controls.js";
import { Figure } from "./figure.js";
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
