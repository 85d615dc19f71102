/**
 * The bar that runs the simulator: train and pause, steps forth and back, speed, and how far it has come.
 */
import { button, choice } from "../views/controls.js";
import { h } from "../views/dom.js";
import { CHOICES } from "./view.js";

const COUNT = new Intl.NumberFormat("en-US");
const HOLD = 350; // milliseconds until a button that is held repeats
const REPEAT = 70; // milliseconds between two repetitions

export class Runbar {
  constructor(app) {
    this.app = app;
    const move = (fn) => () => app.move(fn);
    this.train = button({ label: "Train", icon: "play", primary: true, shortcut: "T", onClick: () => app.toggle() });
    this.back = button({ label: "Back", icon: "back", title: "Take the last update back", shortcut: "B" });
    this.step = button({ label: "Update", icon: "step", title: "One step, one update", shortcut: "N" });
    this.episode = button({
      label: "Episode",
      icon: "episode",
      title: "To the end of the episode",
      shortcut: "E",
      onClick: move((session) => session.episodeOn()),
    });
    this.reset = button({
      label: "Reset",
      icon: "reset",
      title: "Begin again, untrained",
      shortcut: "0",
      onClick: move((session) => session.reset()),
    });
    holdable(this.back.element, move((session) => session.back()));
    holdable(this.step.element, move((session) => session.step()));
    this.speed = choice({
      label: "Speed",
      hideLabel: true,
      options: CHOICES.speed,
      value: app.view.speed,
      onChange: (speed) => app.setSpeed(speed),
    });
    this.element = this.build();
  }

  build() {
    const { app } = this;
    this.bar = h("progress", { class: "rl-run-bar", max: 1, value: 0, "aria-label": "Episodes done" });
    this.words = h("p", { class: "rl-run-words" });
    this.drive = button({
      label: "Drive",
      icon: "robot",
      pressed: false,
      title: "Drive the robot yourself",
      shortcut: "D",
      onClick: () => app.drive.toggle(),
    });
    this.lecture = button({
      label: "Lecture view",
      icon: "full",
      iconOnly: true,
      pressed: false,
      shortcut: "L",
      onClick: () => app.setView({ lecture: !app.view.lecture }),
    });
    this.keys = button({ label: "Keys", icon: "info", iconOnly: true, shortcut: "?", onClick: () => app.keys.open() });
    const keyed = (key, control) => {
      control.element.dataset.key = key;
      return control.element;
    };
    const run = h(
      "div",
      { class: "rl-run-buttons", role: "group", "aria-label": "Run" },
      keyed("train", this.train),
      keyed("back", this.back),
      keyed("step", this.step),
      keyed("episode", this.episode),
      keyed("reset", this.reset),
    );
    const others = [keyed("drive", this.drive), this.lecture.element, this.keys.element];
    const more = h("div", { class: "rl-run-more" }, others);
    const told = h("div", { class: "rl-run-told", dataset: { key: "progress" } }, this.words, this.bar);
    return h("div", { class: "rl-run" }, run, told, keyed("speed", this.speed), more);
  }

  refresh() {
    const { app } = this;
    const { session, trouble, playing } = app;
    const { done, updates } = session;
    const resume = updates > 0 && !trouble ? "Go on" : "Train";
    this.show(playing ? "Pause" : done && !trouble ? "Watch it" : resume, playing ? "pause" : "play");
    this.train.disabled(trouble);
    this.step.disabled(trouble || (done ? "All episodes are over." : ""));
    this.episode.disabled(trouble || (done ? "All episodes are over." : ""));
    this.back.disabled(trouble || (updates ? "" : "Nothing has been learned yet."));
    this.reset.disabled(trouble || (updates ? "" : "Nothing has been learned yet."));
    this.drive.disabled(trouble);
    this.drive.pressed = app.drive.on;
    this.lecture.pressed = app.view.lecture;
    this.speed.value = app.view.speed;
    this.tell(session);
  }

  show(label, icon) {
    if (this.train.label === label) return;
    this.train.label = label;
    this.train.icon = icon;
  }

  tell({ episode, episodes, updates, done }) {
    const now = done ? episodes : episode + (updates ? 1 : 0);
    const words = updates
      ? `Episode ${grouped(now)} of ${grouped(episodes)}, ${grouped(updates)} ${updates === 1 ? "update" : "updates"}`
      : `Untrained, ${grouped(episodes)} ${episodes === 1 ? "episode" : "episodes"} to go`;
    if (words !== this.words.textContent) this.words.textContent = words;
    this.bar.value = episode / episodes;
  }
}

/** Write a number with commas between thousands. */
export function grouped(n) {
  return COUNT.format(n);
}

/** Let a button act at once, and again and again while it is held; a key that is held repeats by itself. */
function holdable(element, act) {
  let timer = 0;
  let held = false;
  const blocked = () => element.getAttribute("aria-disabled") === "true";
  const stop = () => clearTimeout(timer);
  const again = () => {
    if (blocked() || !element.isConnected) return;
    held = true;
    act();
    timer = setTimeout(again, REPEAT);
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    held = false;
    timer = setTimeout(again, HOLD);
  });
  for (const name of ["pointerup", "pointerleave", "pointercancel", "blur"]) element.addEventListener(name, stop);
  element.addEventListener("contextmenu", (event) => event.preventDefault()); // what a long touch would open
  element.addEventListener("click", () => {
    if (!held && !blocked()) act();
    held = false;
  });
}
