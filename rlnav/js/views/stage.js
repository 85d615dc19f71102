/**
 * The stage on which an interactive figure stands: its element, its state that a kernel may share, and its messages.
 */
import { h } from "./dom.js";

const SETTLED = 150; // milliseconds without a change before the kernel is told
const BETWEEN = 1000; // milliseconds between two sentences, or a screen reader never finishes one
const READY = ["idle", "busy"]; // what a kernel is while it listens
const LOST = "The kernel no longer answers; what you see here goes on without it.";

/** Mount what `start` builds in `el`, and return the function that takes it away. */
export function open(model, el, start) {
  const stage = new Stage(model, el);
  const begin = () => {
    const works = stage.attempt(() => {
      const cleanup = start(stage);
      if (typeof cleanup === "function") stage.onCleanup(cleanup);
    });
    stage.frame.classList.toggle("rl-failed", !works); // the page keeps its still picture beside the message
  };
  if (el.isConnected) begin();
  else stage.onCleanup(onPage(el, begin));
  return () => stage.close();
}

/** Call `fn` once `el` is in the page: JupyterLab puts it there later, and only then it has colors and a size. */
function onPage(el, fn) {
  const sizes = new ResizeObserver(() => {
    if (!el.isConnected) return;
    sizes.disconnect();
    fn();
  });
  sizes.observe(el);
  return () => sizes.disconnect();
}

export class Stage {
  constructor(model, el) {
    this.model = model;
    this.live = typeof model.send === "function"; // a static page gives a model without a way to a kernel
    this.state = Object.freeze({ ...model.get("state") });
    this.listeners = [];
    this.cleanups = [];
    this.own = false; // true while the model hears of our own change
    this.timer = { save: 0, say: 0 };
    this.build(el);
    this.listen("change:state", () => this.receive());
    this.listen("comm_live_update", () => setTimeout(() => this.hearKernel())); // after the view has marked itself
    this.listen("comm:close", () => this.lose());
    this.restore = () => this.save(); // a page that is left must not forget what was just changed
    addEventListener("pagehide", this.restore);
  }

  build(el) {
    this.el = el;
    this.alert = h("div", { class: "rl-message-area", role: "alert" });
    this.notice = h("div", { class: "rl-message-area", role: "status" });
    this.voice = h("p", { class: "rl-hidden", role: "status", "aria-live": "polite" });
    this.root = h("div", { class: "rl-stage" });
    this.frame = h("div", { class: "rlnav" });
    // JupyterLab would take arrow keys and letters for commands to the notebook: keys pressed here end here
    this.frame.addEventListener("keydown", (event) => {
      if (!event.ctrlKey && !event.metaKey && !event.altKey) event.stopPropagation();
    });
    this.frame.append(this.alert, this.notice, this.root, this.voice);
    el.append(this.frame);
  }

  get reducedMotion() {
    return matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  /** Merge a patch into the state; the kernel is told when changes settle. */
  update(patch) {
    this.state = Object.freeze({ ...this.state, ...patch });
    clearTimeout(this.timer.save);
    this.timer.save = setTimeout(() => this.save(), SETTLED);
  }

  /** Tell the model now what `update` has gathered. */
  save() {
    if (!this.timer.save) return;
    clearTimeout(this.timer.save);
    this.timer.save = 0;
    this.own = true;
    try {
      this.model.set("state", this.state);
      if (this.kernel === null || this.kernel?.isDisposed) return this.lose();
      const sent = this.model.save_changes();
      if (typeof sent?.catch === "function") sent.catch(() => this.lose());
    } catch {
      this.lose();
    } finally {
      this.own = false;
    }
  }

  /** Take over the state that the kernel, or another view of the same widget, has set: the last word counts. */
  receive() {
    if (this.own) return;
    clearTimeout(this.timer.save);
    this.timer.save = 0;
    const before = this.state;
    this.state = Object.freeze({ ...this.model.get("state") });
    const worked = this.attempt(() => {
      for (const { name, fn } of this.listeners) if (name === "state") fn(this.state);
    });
    if (!worked) this.state = before; // the picture still shows the last good one
  }

  /** Call `fn(state)` when the kernel has changed the state. */
  onState(fn) {
    this.listeners.push({ name: "state", fn });
  }

  /** Return what Python gives beside the state: "tables" or "training", null if it gives none. */
  data(name) {
    return this.model.get(name) ?? null;
  }

  /** Call `fn(value)` when Python gives something new. */
  onData(name, fn) {
    this.listen(`change:${name}`, () => this.attempt(() => fn(this.data(name))));
  }

  listen(event, fn) {
    this.model.on(event, fn);
    this.onCleanup(() => this.model.off(event, fn));
  }

  onCleanup(fn) {
    this.cleanups.push(fn);
  }

  /** Say a sentence to those who cannot see the picture; of several in a second they hear the last. */
  say(text) {
    this.next = text;
    if (this.timer.say) return;
    this.voice.textContent = text;
    this.timer.say = setTimeout(() => {
      this.timer.say = 0;
      if (this.next !== this.voice.textContent) this.say(this.next);
    }, BETWEEN);
  }

  /** Show a message above the picture until the next one; an empty text takes it away. */
  message(text, kind = "error") {
    const box = text && h("p", { class: `rl-message rl-${kind}`, text });
    this.alert.replaceChildren(...(text && kind === "error" ? [box] : []));
    this.notice.replaceChildren(...(text && kind !== "error" ? [box] : []), ...(this.lost ? [this.lost] : []));
  }

  /** Run `fn`; what it throws becomes a message. Return whether it worked. */
  attempt(fn) {
    try {
      fn();
      return true;
    } catch (error) {
      this.message(error?.message || String(error));
      if (!error?.message?.startsWith("`")) console.warn(error); // not one of check.js: a mistake of ours
      return false;
    }
  }

  /** The kernel, where a notebook lets us see it: null if it is gone, undefined if that cannot be known. */
  get kernel() {
    return this.model.widget_manager?.kernel;
  }

  /** The link to the kernel has come or gone: which of the two, only the kernel and the mark of the view can tell. */
  hearKernel() {
    const { kernel } = this;
    const marked = this.el.closest(".jupyter-widgets-disconnected") !== null;
    const listens = kernel === undefined || (kernel?.connectionStatus === "connected" && READY.includes(kernel.status));
    if (marked || !listens) {
      this.lose();
    } else if (this.lost) {
      this.lost.remove();
      this.lost = null;
    }
  }

  /** Say once that the kernel is gone; everything goes on in the page. */
  lose() {
    if (this.lost) return;
    this.lost = h("p", { class: "rl-message rl-note", text: LOST });
    this.notice.append(this.lost);
  }

  close() {
    this.save();
    clearTimeout(this.timer.say);
    removeEventListener("pagehide", this.restore);
    for (const fn of this.cleanups.reverse()) {
      try {
        fn();
      } catch (error) {
        console.warn(error); // the others still have to be called
      }
    }
    this.cleanups = [];
    this.frame.remove();
  }
}
