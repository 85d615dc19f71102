/**
 * The loop as a picture: the agent's box, the environment's box with the map in it, and the arrows between them.
 */
import { button } from "../views/controls.js";
import { h, svg } from "../views/dom.js";
import { GridView } from "../views/grid.js";
import { poseText, timed, turnInWords, turnText, written } from "./naming.js";

const TALLEST = [22, 0.45]; // of the map: in sizes of type, for a lecture has a larger one, and of the window
const DRIVE = 450; // milliseconds in which the robot is seen to move
const LEVELS = [0.16, 0.5, 0.84]; // where the arrows are, in parts of the gap: A, R, S from the top
const COLUMNS = [0.05, 0.35, 0.62]; // ... and from the left, where they stand upright
const NARROW = 0.86; // of the gap: where arrows end before the boxes

export class LoopPicture {
  /** `onChoose(a)` hears the action that the reader presses; `reduced()` tells whether motion is unwelcome. */
  constructor(parent, task, { onChoose, reduced }) {
    Object.assign(this, { task, reduced });
    this.agentWords = h("p", { class: "rl-part-words" });
    this.buttons = task.robot.steering.map((a, i) => turnButton(a, i, onChoose));
    const turns = h("div", { class: "rl-turns", role: "group", "aria-label": "Actions" });
    this.turnsHead = h("p", { class: "rl-turns-head" }, h("span", {}, "turn"), h("span", {}, "chance"));
    turns.append(this.turnsHead, ...this.buttons.toReversed().map(({ element }) => element)); // from left to right
    const part = (kind, name, ...inside) =>
      h("div", { class: `rl-part ${kind}` }, h("p", { class: "rl-part-name" }, name), inside);
    this.agent = part("rl-agent", "Agent", this.agentWords, turns);
    this.svg = svg("svg", { "aria-hidden": true });
    this.gap = h("div", { class: "rl-loop-gap" }, this.svg);
    this.worldWords = h("p", { class: "rl-part-words" });
    this.world = part("rl-environment", "Environment", this.worldWords);
    this.element = h("div", { class: "rl-loop" }, this.agent, this.gap, this.world);
    parent.append(this.element);
    this.grid = new GridView(this.world, { label: "Map with the robot", cursor: false });
    this.frame = 0;
    this.resizes = new ResizeObserver(() => this.scene && this.drawArrows());
    this.resizes.observe(this.gap);
  }

  destroy() {
    cancelAnimationFrame(this.frame);
    this.resizes.disconnect();
    this.grid.destroy();
  }

  /** Draw a moment: what is known in `row`, who is at work, and the way so far. `chance` is pi(a | S_t). */
  draw(scene) {
    this.scene = scene;
    const { active, agentWords, worldWords, row, free, chance } = scene;
    this.agent.classList.toggle("rl-active", active.agent);
    this.world.classList.toggle("rl-active", active.world);
    this.agentWords.textContent = agentWords;
    this.worldWords.textContent = worldWords;
    this.turnsHead.hidden = !chance;
    this.buttons.forEach((one, i) => {
      one.pressed = row.a === i;
      one.disabled(free ? "" : scene.whyNot);
      one.chance.hidden = !chance;
      one.share.textContent = chance ? written(chance[i], 2) : "";
    });
    this.drawArrows();
    this.drive(scene);
  }

  /** Draw the map; let the robot be seen to move where it just did. */
  drive({ robot, path, moving }) {
    cancelAnimationFrame(this.frame);
    const { world } = this.task;
    const size = parseFloat(getComputedStyle(this.element).fontSize);
    this.grid.maxHeight = Math.min(TALLEST[0] * size, TALLEST[1] * innerHeight);
    const ground = { width: world.width, height: world.height, obstacles: world.obstacles, goal: world.goal, path };
    if (!moving || this.reduced()) {
      this.grid.draw({ ...ground, robot: { ...robot, at: 1 } });
      return;
    }
    const begun = performance.now();
    const step = (now) => {
      const at = Math.min(Math.max((now - begun) / DRIVE, 0), 1);
      this.grid.draw({ ...ground, robot: { ...robot, at } });
      if (at < 1) this.frame = requestAnimationFrame(step);
    };
    step(begun);
  }

  /** Draw the three arrows across the gap, which lies between the boxes or, in a narrow place, below the upper one. */
  drawArrows() {
    const { clientWidth: width, clientHeight: height } = this.gap;
    if (!width || !height) return;
    const down = width > height;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const lanes = this.lanes();
    const parts = lanes.flatMap((one) => (down ? this.upright(one, width, height) : this.level(one, width, height)));
    this.svg.replaceChildren(...this.clock(down, width, height), ...parts);
  }

  /** What each arrow carries: `near` the agent what it has got, `far` from it what the environment gives next. */
  lanes() {
    const { row, active, over } = this.scene;
    const { t } = row;
    const next = (letter, i, value, write) => (over ? null : [timed(letter, i), value === null ? "" : write(value)]);
    const pose = (s) => poseText(this.task.pose(s));
    const turn = (a) => turnText(this.task.robot.steering[a]);
    return [
      { lane: 0, out: true, on: active.a, far: next("A", t, row.a, turn) },
      {
        lane: 1, clock: true, on: active.r,
        near: t ? [timed("R", t), written(row.rBefore)] : null, far: next("R", t + 1, row.r, written),
      },
      {
        lane: 2, clock: true, on: active.s,
        near: [timed("S", t), pose(row.s)], far: next("S", t + 1, row.sNext, pose),
      },
    ];
  }

  /** An arrow from side to side: symbols above it, values below. */
  level({ lane, out, on, near, far, clock }, width, height) {
    const y = LEVELS[lane] * height;
    const inset = ((1 - NARROW) / 2) * width;
    const [from, to] = out ? [inset, width - inset] : [width - inset, inset];
    const words = (pair, lit, x) => this.words(pair, lit, [x, y - 9], [x, y + 20], "middle");
    const before = clock ? words(near, on.near, 0.26 * width) : [];
    const after = words(far, on.far, (clock ? 0.75 : 0.5) * width);
    return [arrow(from, y, to, y, on.near || on.far), ...before, ...after];
  }

  /** An arrow up or down: symbols and values beside it. */
  upright({ lane, out, on, near, far, clock }, width, height) {
    const x = COLUMNS[lane] * width;
    const inset = ((1 - NARROW) / 2) * height;
    const [from, to] = out ? [inset, height - inset] : [height - inset, inset];
    const words = (pair, lit, y) => this.words(pair, lit, [x + 10, y], [x + 34, y], "start");
    const before = clock ? words(near, on.near, 0.26 * height) : [];
    const after = words(far, on.far, (clock ? 0.84 : 0.55) * height);
    return [arrow(x, from, x, to, on.near || on.far), ...before, ...after];
  }

  /** A symbol and, where it is known, its value. */
  words(pair, lit, [x, y], [xValue, yValue], anchor) {
    if (!pair) return [];
    const [name, value] = pair;
    const kind = `rl-signal${lit ? " rl-lit" : ""}${value ? "" : " rl-unknown"}`;
    const text = (words, at, to) => svg("text", { class: kind, x: at, y: to, "text-anchor": anchor, text: words });
    return [text(name, x, y), text(value, xValue, yValue)];
  }

  /** The dashed line that a reward and a state pass when the clock moves on. */
  clock(down, width, height) {
    const { row, active, over } = this.scene;
    const after = over ? "" : `t = ${row.t + 1}`;
    const kind = `rl-clock${active.clock ? " rl-lit" : ""}`;
    const words = (x, y, text, anchor) => svg("text", { class: kind, x, y, "text-anchor": anchor, text });
    if (down) {
      const [y, from] = [0.5 * height, 0.33 * width];
      return [
        svg("line", { class: kind, x1: from, x2: width, y1: y, y2: y }),
        words(width, y - 5, `t = ${row.t}`, "end"), words(width, y + 15, after, "end"),
      ];
    }
    const [x, from] = [0.5 * width, 0.3 * height];
    return [
      svg("line", { class: kind, x1: x, x2: x, y1: from, y2: height - 18 }),
      words(x - 8, height - 4, `t = ${row.t}`, "end"), words(x + 8, height - 4, after, "start"),
    ];
  }
}

/** A button for an action; `share` is where its probability is written. */
function turnButton(a, i, onChoose) {
  const words = turnInWords(a);
  const title = words[0].toUpperCase() + words.slice(1);
  const shortcut = String(i + 1);
  const made = button({ label: turnText(a), title, shortcut, pressed: false, onClick: () => onChoose(i) });
  made.share = h("span");
  made.chance = h("span", { class: "rl-chance" }, h("span", { class: "rl-hidden" }, " with probability "), made.share);
  made.element.append(made.chance);
  return made;
}

function arrow(x1, y1, x2, y2, lit) {
  const long = Math.hypot(x2 - x1, y2 - y1);
  const [ux, uy] = [(x2 - x1) / long, (y2 - y1) / long];
  const [bx, by] = [x2 - 10 * ux, y2 - 10 * uy];
  const kind = lit ? "rl-arrow rl-lit" : "rl-arrow";
  const tip = `M${x2} ${y2}L${bx - 5 * uy} ${by + 5 * ux}L${bx + 5 * uy} ${by - 5 * ux}Z`;
  return svg("g", { class: kind }, svg("line", { x1, y1, x2: bx, y2: by }), svg("path", { d: tip }));
}
