/**
 * What a driver gets and has got: the state as a bare number, the log of this drive, and the scores of all drives.
 */
import { h } from "../views/dom.js";
import { poseText, written } from "./naming.js";
import { ENDS, rewardText, scoreText } from "./mystery_words.js";

/** The place of the map for a driver who sees only numbers. */
export class Card {
  constructor(parent) {
    this.number = h("b", {});
    this.reward = h("p", {});
    this.before = h("p", { class: "rl-help" });
    const where = h("p", {}, "You are in state ", this.number);
    this.element = h("div", { class: "rl-card" }, where, this.reward, this.before);
    parent.append(this.element);
  }

  draw({ drive, drives, names, s, over }) {
    this.number.textContent = names[s];
    const r = drive.rewards.at(-1);
    this.reward.textContent = r === undefined ? "No reward yet." : `Reward ${rewardText(r)}`;
    const visits = drives.flatMap(({ states }) => states).filter((other) => other === s).length - 1;
    const often = visits ? `${visits} ${visits === 1 ? "time" : "times"}` : "never";
    const seen = `You were here ${often} before.`.replace("here never", "never here");
    this.before.textContent = over ? "The drive is over." : seen;
  }
}

/** Drive, step and score, in large type. */
export class Gauges {
  constructor(parent) {
    this.values = ["Drive", "Step", "Score"].map((name) => [name, h("b", {})]);
    const boxes = this.values.map(([name, value]) => h("p", {}, h("span", {}, `${name} `), value));
    parent.append(h("div", { class: "rl-gauges" }, boxes));
  }

  draw({ drives, drive, maxSteps }) {
    const texts = [`${drives.length}`, `${drive.rewards.length} of ${maxSteps}`, scoreText(drive.score)];
    texts.forEach((text, i) => (this.values[i][1].textContent = text));
  }
}

/** A table with a head and a caption, that scrolls by itself. */
class Table {
  constructor(parent, caption, heads) {
    this.body = h("tbody", {});
    const head = h("thead", {}, h("tr", {}, heads.map((text) => h("th", { scope: "col" }, text))));
    const table = h("table", { class: "rl-numbers" }, h("caption", {}, caption), head, this.body);
    const region = { role: "region", "aria-label": caption, tabindex: 0 }; // so that keys can scroll it
    this.scroll = h("div", { class: "rl-numbers-scroll rl-board-scroll", ...region }, table);
    parent.append(this.scroll);
  }

  /** Show rows of texts; the row with the number `used` stands out. The last one is in view. */
  draw(rows, used = -1) {
    const key = JSON.stringify([rows, used]);
    if (key === this.key) return;
    this.key = key;
    const cell = (text) => h("td", {}, text);
    const line = (row, i) => h("tr", { class: i === used ? "rl-used" : null }, row.map(cell));
    this.body.replaceChildren(...rows.map(line));
    this.scroll.scrollTop = this.scroll.scrollHeight;
  }
}

/** One line for each press: all that an agent gets. */
export class Log extends Table {
  constructor(parent) {
    super(parent, "This drive, press by press", ["Press", "Reward", "State"]);
  }

  show({ drive, task, names }, see) {
    const name = (s) => (see === "map" ? poseText(task.pose(s)) : String(names[s]));
    const first = ["", "", name(drive.states[0])];
    const presses = [...drive.letters].map((letter, t) => {
      const last = t === drive.letters.length - 1;
      const end = last && drive.end && drive.end !== "time";
      return [letter, rewardText(drive.rewards[t]), end ? "the end" : name(drive.states[t + 1])];
    });
    this.draw([first, ...presses], presses.length);
  }
}

/** One line for each drive that has ended. */
export class Scores extends Table {
  constructor(parent) {
    super(parent, "Your drives", ["Drive", "Steps", "How it ended", "Score"]);
  }

  show({ drives, bestNumber, answer }, revealed) {
    const ended = drives.flatMap((drive, i) => (drive.end ? [[drive, i]] : []));
    const rows = ended.map(([{ rewards, end, score }, i]) => {
      const [word, why] = ENDS[end];
      return [String(i + 1), String(rewards.length), `${word} (${why})`, scoreText(score)];
    });
    if (revealed) rows.push(["best possible", String(answer.steps), "terminated (goal)", written(answer.score, 2)]);
    this.scroll.hidden = !rows.length;
    this.draw(rows, revealed ? -1 : ended.findIndex(([, i]) => i === bestNumber));
  }
}
