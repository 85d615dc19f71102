/**
 * The lecture view: the simulator fills the screen in large type, and the keys of a presenter step through the run.
 */

const STEP = [" ", "ArrowRight", "PageDown"];
const BACK = ["ArrowLeft", "PageUp"];
const TYPED = "input:not([type=checkbox]):not([type=radio]):not([type=range]), select, textarea";

export class Lecture {
  constructor(app) {
    this.app = app;
    this.frame = app.stage.frame;
    this.onKey = (event) => this.pressed(event);
    this.onScreen = () => this.screenChanged();
    document.addEventListener("keydown", this.onKey, true);
    document.addEventListener("keyup", this.onKey, true);
    document.addEventListener("fullscreenchange", this.onScreen);
  }

  destroy() {
    document.removeEventListener("keydown", this.onKey, true);
    document.removeEventListener("keyup", this.onKey, true);
    document.removeEventListener("fullscreenchange", this.onScreen);
    this.leave();
  }

  get on() {
    return this.frame.classList.contains("rl-lecture");
  }

  /** Do as the view says. */
  follow() {
    if (this.app.view.lecture === this.on) return;
    if (this.app.view.lecture) this.enter();
    else this.leave();
  }

  /** Fill the screen, or at least the window where a browser refuses: without a click, and in some notebooks. */
  enter() {
    this.frame.classList.add("rl-lecture");
    document.documentElement.classList.add("rl-has-lecture");
    if (!this.frame.contains(document.activeElement)) this.app.runbar.train.element.focus(); // keys count in here only
    if (navigator.userActivation?.isActive ?? true) this.frame.requestFullscreen?.().catch(() => {});
  }

  leave() {
    if (!this.on) return;
    this.frame.classList.remove("rl-lecture");
    document.documentElement.classList.remove("rl-has-lecture");
    if (document.fullscreenElement === this.frame) document.exitFullscreen().catch(() => {});
  }

  /** The browser's own key has left the full screen. */
  screenChanged() {
    const left = this.wasFull && !document.fullscreenElement;
    this.wasFull = document.fullscreenElement === this.frame;
    if (left && this.on) this.app.setView({ lecture: false });
  }

  /** Step with a presenter's keys, wherever the focus is, unless something is being typed or painted. */
  pressed(event) {
    const { app } = this;
    const busy = app.drive.on || app.tool !== "none" || app.keys.dialog.open || event.target.matches?.(TYPED);
    if (!this.on || busy || event.ctrlKey || event.metaKey || event.altKey) return;
    const forth = STEP.includes(event.key);
    const back = BACK.includes(event.key);
    const away = event.key === "Escape";
    if (!forth && !back && !away) return;
    event.preventDefault(); // also of keyup: a button would be pressed by Space
    event.stopPropagation();
    if (event.type === "keyup") return;
    if (away) app.setView({ lecture: false });
    else app.move((session) => (forth ? session.step() : session.back()));
  }
}
