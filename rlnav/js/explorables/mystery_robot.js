/**
 * The first explorable of the book: where is the goal, and what do the buttons do?  The reader drives a robot of which
 * nothing is known, gets what an agent gets, and then sees everything that was hidden.
 */
import { BUTTONS, checkMystery, MOST_DRIVES, Mystery, SIDE } from "../scenario/mystery.js";
import { button, number, segmented, toolbar } from "../views/controls.js";
import { h } from "../views/dom.js";
import { CRASH_AT, onTheWay } from "../views/glyphs.js";
import { GridView } from "../views/grid.js";
import { Figure, pair } from "./figure.js";
import { Card, Gauges, Log, Scores } from "./mystery_board.js";
import { buttonsInWords, noteOf, sentence, truth } from "./mystery_words.js";
import { turnInWords } from "./naming.js";

const TALLEST = 0.58; // of the map, in parts of the window
const SLIDE = 220; // milliseconds from cell to cell
const LEVELS = [["free", "Free space"], ["obstacles", "Obstacles"], ["slip", "Obstacles and slips"]];
const VIEWS = [["map", "A map"], ["numbers", "Only numbers"]];
const MOST = 999_999; // the number of a mystery

/** Build the figure on a stage. */
export function start(stage) {
  new MysteryRobot(stage).open();
}

class MysteryRobot extends Figure {
  constructor(stage) {
    super(stage, "Where is the goal, and what do the buttons do?");
    this.motion = 0;
    stage.onCleanup(() => cancelAnimationFrame(this.motion));
    stage.root.addEventListener("keydown", (event) => this.key(event));
  }

  // ---------------------------------------------------------------- building
  build() {
    const { element, left, right } = pair("rl-mystery");
    this.frame.body.append(this.frame.answer, element, this.buildSettings());
    this.map = this.part(new GridView(left, { label: "Map of what you have seen", cursor: false }));
    this.card = new Card(left);
    this.keys = h("p", { class: "rl-help", text: "Solid: your best drive. Dashed: an optimal drive." });
    left.append(this.keys, this.buildPad());
    this.gauges = new Gauges(right);
    this.truth = h("p", { class: "rl-truth" });
    right.append(this.truth);
    this.log = new Log(right);
    this.scores = new Scores(right);
  }

  buildPad() {
    this.buttons = [...BUTTONS].map((letter) => {
      const made = button({ label: letter, shortcut: letter, onClick: () => this.press(letter) });
      made.note = h("span", { class: "rl-pad-note" });
      made.element.append(made.note);
      return made;
    });
    this.next = button({ label: "Next drive", icon: "reset", shortcut: "N", onClick: () => this.begin() });
    this.frame.focusFirst(this.buttons[0].element);
    const parts = this.buttons.map(({ element }) => element);
    const pad = h("div", { class: "rl-pad", role: "group", "aria-label": "Buttons of the robot" }, parts);
    return h("div", { class: "rl-mystery-drive" }, pad, this.next.element);
  }

  buildSettings() {
    this.reveal = button({ label: "Reveal", icon: "info", pressed: false, onClick: () => this.turnOver() });
    this.fresh = button({ label: "New mystery", onClick: () => this.mystify({ seed: this.following }) });
    const tools = toolbar({ label: "Mystery", children: [this.reveal, this.fresh] });
    this.level = segmented({ label: "Level", options: LEVELS, onChange: (level) => this.mystify({ level }) });
    this.see = segmented({ label: "You see", options: VIEWS, onChange: (see) => this.set({ see }) });
    this.seed = number({
      label: "Mystery number", min: 0, max: MOST, step: 1, value: 0, onChange: (seed) => this.mystify({ seed }),
    });
    const hidden = h("div", { class: "rl-mystery-tools" }, tools.element, this.seed.element);
    const row = h("div", { class: "rl-mystery-settings" }, this.level.element, this.see.element);
    const help = "Keys: A to E, or 1 to 5, press the buttons; N begins the next drive. " +
      "The same number and level hide the same things from everybody.";
    return h("div", { class: "rl-column" }, hidden, row, h("p", { class: "rl-help", text: help }));
  }

  get following() {
    return (this.stage.state.seed + 1) % (MOST + 1);
  }

  // ---------------------------------------------------------------- changing
  prepare(state) {
    checkMystery(state);
    this.mystery = new Mystery(state);
  }

  showAll() {
    const { level, see, seed } = this.stage.state;
    this.level.value = level;
    this.see.value = see;
    this.seed.value = seed;
    this.draw();
  }

  mystify(patch) {
    this.change({ ...patch, drives: [], revealed: false });
  }

  press(letter) {
    const { mystery } = this;
    if (!mystery.press(letter)) return;
    this.keep();
    this.slide();
    if (mystery.over && this.buttons.some(({ element }) => element === document.activeElement)) {
      this.next.element.focus({ preventScroll: true });
    }
  }

  begin() {
    const { mystery } = this;
    if (!mystery.over) return;
    if (mystery.drives.length === MOST_DRIVES) {
      this.stage.message(`After ${MOST_DRIVES} drives it is time for a new mystery.`, "note");
      return;
    }
    mystery.begin();
    this.keep();
    this.draw();
    if (document.activeElement === this.next.element) this.buttons[0].element.focus({ preventScroll: true });
  }

  keep() {
    this.stage.update({ drives: this.mystery.drives.map(({ letters }) => letters) });
  }

  /** Show what is hidden, or hide it again. */
  turnOver() {
    this.set({ revealed: !this.stage.state.revealed });
    if (this.stage.state.revealed) this.stage.say(`${buttonsInWords(this.mystery)} ${truth(this.mystery)}`);
  }

  key({ key, target, ctrlKey, metaKey, altKey }) {
    if (ctrlKey || metaKey || altKey || target.matches("input:not([type=radio]), select")) return;
    const letter = BUTTONS[Number(key) - 1] ?? key.toUpperCase();
    if (letter.length === 1 && BUTTONS.includes(letter)) this.press(letter);
    else if (letter === "N") this.begin();
  }

  // ---------------------------------------------------------------- drawing
  /** Draw until the robot has arrived. */
  slide() {
    cancelAnimationFrame(this.motion);
    const begun = performance.now();
    const step = (now) => {
      const at = this.stage.reducedMotion ? 1 : Math.min(Math.max((now - begun) / SLIDE, 0), 1);
      if (at < 1) this.motion = requestAnimationFrame(step);
      this.drawMap(at);
    };
    this.draw();
    step(begun);
  }

  draw() {
    const { mystery, stage } = this;
    const { see, revealed } = stage.state;
    cancelAnimationFrame(this.motion);
    const numbers = see === "numbers" && !revealed;
    this.map.element.hidden = numbers;
    this.card.element.hidden = !numbers;
    if (numbers) this.card.draw(mystery);
    else this.drawMap(1);
    this.drawButtons();
    this.gauges.draw(mystery);
    this.log.show(mystery, see);
    this.scores.show(mystery, revealed);
    this.truth.hidden = !revealed;
    this.truth.textContent = revealed ? truth(mystery) : "";
    this.frame.say(sentence(mystery, see));
  }

  drawButtons() {
    const { mystery } = this;
    const { see, revealed } = this.stage.state;
    const over = mystery.over ? "The drive is over. Begin the next one." : "";
    for (const [i, one] of this.buttons.entries()) {
      one.note.textContent = noteOf(mystery, BUTTONS[i], { see, revealed });
      one.disabled(over);
      const told = revealed ? turnInWords(mystery.answer.steering[i]) : "Nobody tells you what it does";
      one.element.title = over || told;
    }
    this.next.disabled(mystery.over ? "" : "The drive is under way.");
    this.next.element.classList.toggle("rl-primary", mystery.over);
    this.reveal.pressed = revealed;
    this.reveal.label = revealed ? "Hide again" : "Reveal";
  }

  /** Draw what the driver remembers, or everything; `at` says how far the robot is on its way to its cell. */
  drawMap(at) {
    const { mystery, map } = this;
    const { see, revealed } = this.stage.state;
    if (see === "numbers" && !revealed) return;
    const { world } = mystery.task;
    const { seen, crashes, goal } = mystery.memory;
    const arrived = at === 1 || mystery.drive.end !== "goal"; // the star appears when the robot is there
    const before = mystery.drives.slice(0, -1).some(({ end }) => end === "goal");
    const fog = revealed ? [] : unknown(seen, map.colors.muted);
    const compared = revealed && (mystery.over || !mystery.drive.letters);
    const { path, robot } = this.way(compared, at);
    map.maxHeight = Math.max(TALLEST * innerHeight, 260); // the buttons below it should be in view as well
    map.draw({
      width: SIDE,
      height: SIDE,
      obstacles: revealed ? world.obstacles : new Uint8Array(SIDE * SIDE),
      goal: revealed || (goal && (arrived || before)) ? world.goal : null,
      path,
      ghost: revealed ? mystery.answer.poses : null,
      robot,
      marks: [...fog, ...crashMarks(crashes, at === 1, map.colors.crash)],
    });
    this.keys.hidden = !compared || mystery.bestNumber < 0;
    const known = `${sentence(mystery, "map")} Cells that you have not seen show a question mark.`;
    map.describe(revealed ? truth(mystery) : known);
  }

  /** The way so far and the robot at its end; when all is revealed and the drive is over, the best of all drives. */
  way(compared, at) {
    const { mystery } = this;
    const best = compared && mystery.bestNumber >= 0 ? mystery.drives[mystery.bestNumber] : mystery.drive;
    const path = mystery.posesOf(best);
    const { crashed = false, ...pose } = path.at(-1);
    return { path, robot: { ...pose, from: path.at(-2), at, crashed } };
  }
}

/** A question mark in each cell that nobody has seen. */
function unknown(seen, color) {
  const marks = [];
  seen.forEach((known, i) => known || marks.push({ x: i % SIDE, y: Math.floor(i / SIDE), text: "?", color }));
  return marks;
}

/** A cross wherever a drive has ended in a crash: half way to what was hit. */
function crashMarks(crashes, all, color) {
  return (all ? crashes : crashes.slice(0, -1)).map(([from, to]) => {
    const { x, y } = onTheWay(from, to, CRASH_AT);
    return { x, y, kind: "cross", color };
  });
}
