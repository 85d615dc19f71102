/**
 * One sentence below the map: what the robot does now, and what it can do when the learning is over.
 */
import { button } from "../views/controls.js";
import { h } from "../views/dom.js";

const FAST = "It learns faster than you can watch. The robot on the map drives with what it knows so far.";

export class Result {
  constructor(app) {
    this.app = app;
    this.words = h("p", { class: "rl-result-words" });
    this.more = button({ label: "More episodes", icon: "play", onClick: () => app.goOn() });
    this.element = h("div", { class: "rl-result", dataset: { key: "result" } }, this.words, this.more.element);
  }

  refresh() {
    const { app } = this;
    const { done, episodes } = app.session;
    this.element.hidden = app.drive.on;
    this.element.classList.toggle("rl-trouble", app.trouble !== "");
    this.more.show(done && !app.trouble);
    this.more.label = `${episodes.toLocaleString("en-US")} more episodes`;
    const text = this.sentence();
    if (text !== this.words.textContent) this.words.textContent = text;
  }

  sentence() {
    const { trouble, session, playing, fast, renewed } = this.app;
    if (trouble) return trouble;
    if (!session.updates) {
      const begin = renewed ? "A new task or learner, so a new run: the robot" : "The robot";
      return `${begin} knows nothing yet, and every turn seems as good as any other. Let it train.`;
    }
    if (playing && fast) return FAST;
    return session.done ? this.learned() : session.sentence();
  }

  /** Say what the learned policy is worth, once that is computed. */
  learned() {
    const { session } = this.app;
    const scores = session.evaluation;
    if (!scores || session.stale) return "The learning is over. How good is the robot now? One moment.";
    const { success, crash, timeout, steps, gap, why } = scores;
    if (success < 1e-9) {
      const ends = `${percent(crash)} of its drives end in a crash, ${percent(timeout)} lead nowhere`;
      return `Not yet: ${ends}. Let it train longer.`;
    }
    if (success < 1 - 1e-9) {
      return `It reaches the goal in ${percent(success)} of its drives. More training may help, or another design.`;
    }
    const worth = gap < 0.005 ? "Nobody can do better." : `The best possible policy is worth ${gap.toFixed(2)} more.`;
    const best = why || worth;
    return `The robot reaches the goal from every start, in ${steps.toFixed(1)} steps on average. ${best}`;
  }
}

function percent(share) {
  return `${(100 * share).toFixed(share > 0.995 && share < 1 ? 1 : 0)} %`;
}
