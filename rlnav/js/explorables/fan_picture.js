/**
 * The fan from close by: the nine cells around the robot, the exact arc of every turn, where the formula puts the robot,
 * and the cell to which that is snapped.
 */
import { arcAt } from "../scenario/reach.js";
import { h, svg } from "../views/dom.js";
import { unit } from "../views/glyphs.js";
import { turnText } from "./naming.js";

const CELL = 100; // of the drawing's own units
const REACH = 1.62; // cells from the middle to the edge of the picture
const LINE = 16; // of text
const HIT = 0.5; // of the arc: there it meets the edge or the corner of a cell
const ARROW = [[16, 0], [-11, 10], [-6, 0], [-11, -10]];
const ROBOT = [[28, 0], [-20, 19], [-10, 0], [-20, -19]];

export class FanPicture {
  constructor(parent) {
    this.parts = svg("g");
    const view = [-REACH, -REACH, 2 * REACH, 2 * REACH].map((v) => v * CELL).join(" ");
    this.svg = svg("svg", { viewBox: view, role: "img", "aria-label": "The moves of one step, from close by" }, this.parts);
    parent.append(h("div", { class: "rl-fan" }, this.svg));
  }

  /** Draw the moves of `fan` from a pose; `chances` are those of a turn that is told, or null if none is. */
  draw({ world, pose, fan, chances, words }) {
    const middle = { x: 0, y: 0, theta: pose.theta };
    const moves = fan.map((move, i) => ({ ...move, chance: chances ? chances[i] : null }));
    const shown = moves.toSorted((a, b) => (a.chance ?? 1) - (b.chance ?? 1)); // what is likely lies on top
    this.svg.setAttribute("aria-label", words);
    this.parts.replaceChildren(
      ...cellsAround(world, pose),
      ...shown.flatMap((move) => drawMove(middle, pose, move)),
      svg("circle", { r: 32, class: "rl-fan-robot" }),
      svg("path", { d: shape(ROBOT, 0, 0, pose.theta, 0.78), class: "rl-fan-nose" }),
      ...moves.filter(({ crash }) => !crash).map((move) => label(pose, move)),
      ...crashLabels(pose, moves.filter(({ crash }) => crash)),
    );
  }
}

/** The floor, the walls, and what lies outside the map. */
function cellsAround(world, pose) {
  const around = [-1, 0, 1].flatMap((dx) => [-1, 0, 1].map((dy) => [dx, dy]));
  const star = around.find(([dx, dy]) => world.isGoal(pose.x + dx, pose.y + dy));
  const cells = around.map(([dx, dy]) => {
    const [x, y] = [pose.x + dx, pose.y + dy];
    const inside = x >= 0 && y >= 0 && x < world.width && y < world.height;
    const kind = !inside ? "rl-fan-outside" : world.blocked(x, y) ? "rl-fan-wall" : "rl-fan-floor";
    const corner = { x: (dx - 0.5) * CELL, y: (-dy - 0.5) * CELL, width: CELL, height: CELL };
    return svg("rect", { ...corner, class: kind });
  });
  return star ? [...cells, svg("path", { d: starAt(...star), class: "rl-fan-goal" })] : cells;
}

function starAt(x, y) {
  const corners = Array.from({ length: 10 }, (_, i) => unit(90 + 36 * i).map((c) => c * CELL * (i % 2 ? 0.18 : 0.4)));
  return `M${corners.map(([dx, dy]) => `${x * CELL + dx} ${-y * CELL - dy}`).join("L")}Z`;
}

/** The arc of one move, the point of the formula, and the pose on the grid, or a cross where it crashes. */
function drawMove(middle, pose, { a, point, to, crash, chance }) {
  const parts = Array.from({ length: 17 }, (_, i) => arcAt(middle, a, (crash ? HIT * i : i) / 16));
  const [px, py] = [point[0] - pose.x, point[1] - pose.y];
  const [tx, ty] = arrowAt(pose, to);
  const kind = `rl-fan-move${crash ? " rl-crashes" : ""}${chance === null ? "" : chance > 0 ? " rl-told" : " rl-faint"}`;
  const arc = svg("path", { d: `M${parts.map(([x, y]) => `${x * CELL} ${-y * CELL}`).join("L")}`, class: "rl-fan-arc" });
  if (crash) {
    const [x, y] = parts.at(-1).map((c) => c * CELL);
    const cross = `M${x - 9} ${-y - 9}l18 18M${x - 9} ${-y + 9}l18 -18`;
    const [under, over] = ["rl-fan-under", "rl-fan-cross"].map((name) => svg("path", { d: cross, class: name }));
    return [svg("g", { class: kind }, arc, under, over)];
  }
  const snap = { x1: px * CELL, y1: -py * CELL, x2: tx * CELL, y2: -ty * CELL, class: "rl-fan-snap" };
  const dot = svg("circle", { cx: px * CELL, cy: -py * CELL, r: 4, class: "rl-fan-dot" });
  const arrow = svg("path", { d: shape(ARROW, tx, ty, to.theta), class: "rl-fan-arrow" });
  return [svg("g", { class: kind }, arc, svg("line", snap), dot, arrow)];
}

/** Where the arrowhead of a pose is drawn, in cells: on the side of its cell to which it looks, as a wedge on the map. */
function arrowAt(pose, to, out = 0.24) {
  const [dx, dy] = unit(to.theta);
  return [to.x - pose.x + out * dx, to.y - pose.y + out * dy];
}

/** Name a move beside its arrowhead. */
function label(pose, { a, to, chance }) {
  const [x, y] = arrowAt(pose, to, 0.45).map((c) => c * CELL);
  const text = svg("text", { x, y: -y + 4, class: chance === 0 ? "rl-faint" : null, text: turnText(a) });
  if (chance) text.append(svg("tspan", { x, dy: "1.05em", text: percent(chance) }));
  return text;
}

/** Name the moves that crash, one below the other in the cell at which they drive. */
function crashLabels(pose, moves) {
  return moves.map((move) => {
    const { a, to, crash, chance } = move;
    const together = moves.filter((other) => other.to.x === to.x && other.to.y === to.y);
    const line = together.indexOf(move) - (together.length - 1) / 2;
    const [x, y] = [(to.x - pose.x) * CELL, -(to.y - pose.y) * CELL + LINE * line + 4];
    const kind = `${chance === 0 ? "rl-faint " : ""}${crash === "obstacle" ? "rl-on-wall" : ""}`;
    return svg("text", { x, y, class: kind, text: `${turnText(a)}${chance ? `: ${percent(chance)}` : ""}` });
  });
}

function percent(chance) {
  return `${Math.round(100 * chance)} %`;
}

/** A shape that looks along theta at a place in cells, as a path. */
function shape(corners, x, y, theta, size = 1) {
  const [cos, sin] = unit(theta).map((c) => c * size);
  const turned = corners.map(([u, v]) => [x * CELL + u * cos - v * sin, -(y * CELL + u * sin + v * cos)]);
  return `M${turned.map((corner) => corner.join(" ")).join("L")}Z`;
}
