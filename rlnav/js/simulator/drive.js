/**
 * Driving the robot by hand: the same world, the same reward, and nothing is learned from it.
 */
import { button } from "../views/controls.js";
import { h, svg } from "../views/dom.js";
import { turnInWords } from "./words.js";

const SLIDE = 180; // milliseconds from cell to cell

export class Drive {
  constructor(app) {
    this.app = app;
    this.on = false;
    this.path = [];
    this.moved = 0; // when the robot began its last move
    this.turns = null;
    this.pad = h("div", { class: "rl-drive-pad", role: "group", "aria-label": "Steer" });
    this.words = h("p", { class: "rl-drive-words" });
    this.again = button({ label: "Once more", icon: "reset", onClick: () => this.begin() });
    this.stop = button({ label: "Stop driving", icon: "close", shortcut: "Escape", onClick: () => this.toggle() });
    const ways = h("div", { class: "rl-toolbar" }, this.again.element, this.stop.element);
    this.element = h("div", { class: "rl-drive", hidden: true }, this.words, this.pad, ways);
    this.element.dataset.key = "drive";
    app.stage.frame.addEventListener("keydown", (event) => this.typed(event), true);
  }

  toggle() {
    if (this.on) this.end();
    else if (!this.app.hidden("drive")) this.begin();
    this.app.refresh();
    if (this.on) this.app.arena.focus();
  }

  begin() {
    const { app } = this;
    if (app.trouble) return app.stage.message(app.trouble);
    app.player.pause();
    app.tour.stop();
    this.on = true;
    app.session.beginDrive();
    this.show();
    app.refresh();
    return undefined;
  }

  end() {
    this.on = false;
    this.element.hidden = true;
    this.app.refresh();
  }

  /** Steer by the action with this number. */
  steer(a) {
    const { app } = this;
    if (app.session.driving.over) return;
    app.session.drive(a);
    this.moved = performance.now();
    this.show();
    this.slide();
    app.say(this.words.textContent);
  }

  /** Draw until the robot has arrived. */
  slide() {
    this.app.draw(1);
    if (this.on && performance.now() - this.moved < SLIDE) requestAnimationFrame(() => this.slide());
  }

  /** What the map shows: the robot and its way. */
  shown() {
    const { path, crashed } = this.app.session.driving;
    const part = this.app.stage.reducedMotion ? 1 : Math.min((performance.now() - this.moved) / SLIDE, 1);
    const robot = { ...path.at(-1), from: path.at(-2), at: part, crashed };
    return { path, robot };
  }

  show() {
    const { session } = this.app;
    const { turns } = this;
    const steering = session.task.robot.steering;
    if (turns !== steering) this.build(steering);
    this.element.hidden = false;
    const { over, total, steps, reward, goal, crashed } = session.driving;
    const sum = `${steps} ${steps === 1 ? "step" : "steps"}, reward ${signed(reward)}, ${signed(total)} in all.`;
    const end = goal ? "The goal." : crashed ? "A crash." : over ? "Out of steps." : "";
    const hint = "Now you drive: with the arrow keys, or with these turns. Nothing is learned from it.";
    this.words.textContent = steps ? `${end} ${sum}`.trim() : hint;
    for (const part of this.buttons) part.disabled(over ? "This drive is over." : "");
  }

  /** Make one button for each turn, the largest to the left first. */
  build(steering) {
    this.turns = steering;
    this.order = steering.map((a, i) => [a, i]).reverse();
    this.buttons = this.order.map(([a, i], k) => {
      const onClick = () => this.steer(i);
      const made = button({ label: turnInWords(a), iconOnly: true, shortcut: `${k + 1}`, onClick });
      made.element.prepend(arrow(a));
      return made;
    });
    this.pad.replaceChildren(...this.buttons.map((made) => made.element));
  }

  typed(event) {
    const fields = "input:not([type=checkbox]):not([type=radio]), select, textarea";
    if (!this.on || event.ctrlKey || event.metaKey || event.altKey || event.target.matches(fields)) return;
    const a = this.actionOf(event);
    if (event.key !== "Escape" && a === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === "Escape") this.toggle();
    else this.steer(a);
  }

  /** Return the action that a key stands for. */
  actionOf({ key, shiftKey }) {
    const turns = this.order.map(([a]) => a);
    const left = turns.filter((a) => a > 0);
    const right = turns.filter((a) => a < 0);
    const wanted = {
      ArrowUp: turns.find((a) => a === 0),
      ArrowLeft: shiftKey ? left[0] : left.at(-1),
      ArrowRight: shiftKey ? right.at(-1) : right[0],
    };
    const a = key in wanted ? wanted[key] : turns[Number(key) - 1];
    return this.order.find(([turn]) => turn === a)?.[1];
  }
}

/** Draw a turn as the needle that the map shows, for a robot that looks up. */
function arrow(a) {
  const radians = ((90 + a) * Math.PI) / 180;
  const [dx, dy] = [Math.cos(radians), -Math.sin(radians)];
  const [x, y] = [12 + 7 * dx, 11 + 7 * dy];
  const tip = (turn) => {
    const angle = radians + Math.PI + turn;
    return `${(x + 4.5 * Math.cos(angle)).toFixed(2)} ${(y - 4.5 * Math.sin(angle)).toFixed(2)}`;
  };
  const shaft = `M12 21V15Q12 11 ${x.toFixed(2)} ${y.toFixed(2)}`;
  const head = `M${tip(0.55)} ${x.toFixed(2)} ${y.toFixed(2)} ${tip(-0.55)}`;
  const sign = { class: "rl-icon", viewBox: "0 0 24 24", "aria-hidden": true };
  return svg("svg", sign, svg("path", { d: `${shaft}${head}` }));
}

/** Write a reward with its sign. */
function signed(value) {
  const text = Math.abs(value).toFixed(2);
  return `${value < 0 ? "−" : "+"}${text}`;
}
