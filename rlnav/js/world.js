/**
 * The grid that the robot drives on: obstacles, a goal, and where it may start.
 * Mirrors rlnav/world.py.  A cell is [x, y]; x grows to the right, y grows upwards.
 */
import { cellOf, fail, instance, integer, items, quote, show } from "./check.js";
import { HEADINGS, Pose } from "./robot.js";

const ARROWS = { ">": 0, "^": 90, "<": 180, v: 270 };
const DRAWN =
  "'#' obstacle, '.' free, 'G' goal, 'S' start with any heading, '>', '^', '<', 'v' start with that heading";
export const LARGEST_SIDE = 300; // cells along one side

/** Hold a rectangular grid with obstacles and one goal. */
export class GridWorld {
  constructor(width, height, { goal, obstacles = [], starts = [] }) {
    this.width = integer("width", width, 1, LARGEST_SIDE);
    this.height = integer("height", height, 1, LARGEST_SIDE);
    this.obstacles = new Uint8Array(width * height); // 1 where nobody may enter; cell [x, y] is at y * width + x
    for (const cell of items("obstacles", obstacles, "cells (x, y)")) {
      const [x, y] = this.#inside("obstacles", cell);
      this.obstacles[y * width + x] = 1;
    }
    this.goal = Object.freeze(this.#inside("goal", goal));
    if (this.blocked(...this.goal)) fail("goal", "a free cell", `${inWords(this.goal)}, an obstacle`);
    const near = reachable(this.goal, width, height, this.obstacles);
    const given = items("starts", starts, "poses");
    given.forEach((pose) => this.#checkStart(pose, near));
    this.starts = Object.freeze(given.length ? inOrder(given) : this.#everywhere(near));
    Object.freeze(this);
  }

  /** Read a world from rows of text; the top row has the highest y. */
  static fromAscii(drawing) {
    const rows = rowsOf(drawing);
    const height = rows.length;
    const drawn = rows.flatMap((row, i) => row.map((symbol, x) => ({ symbol, cell: [x, height - 1 - i] })));
    const cells = (wanted) => drawn.filter(({ symbol }) => symbol === wanted).map(({ cell }) => cell);
    const goals = cells("G");
    if (goals.length !== 1) {
      const got = goals.length ? `${goals.length} of them, at [${goals.map(inWords).join(", ")}]` : "none";
      fail("drawing", "a map with one goal 'G'", got);
    }
    const starts = cells("S").flatMap(([x, y]) => HEADINGS.map((theta) => new Pose(x, y, theta)));
    for (const { symbol, cell } of drawn) {
      if (symbol in ARROWS) starts.push(new Pose(...cell, ARROWS[symbol]));
    }
    return new GridWorld(rows[0].length, height, { goal: goals[0], obstacles: cells("#"), starts });
  }

  /** Cells that are not obstacles, row by row from the bottom left. */
  get free() {
    const cells = [];
    this.obstacles.forEach((wall, i) => wall || cells.push([i % this.width, Math.floor(i / this.width)]));
    return cells;
  }

  /** Whether a cell is the goal. */
  isGoal(x, y) {
    return x === this.goal[0] && y === this.goal[1];
  }

  /** Whether a cell lies outside or is an obstacle. */
  blocked(x, y) {
    return isBlocked(x, y, this.width, this.height, this.obstacles);
  }

  /** Whether the move between two neighbouring cells hits something: its target, or a corner that it would cut. */
  crash(x, y, xNext, yNext) {
    return isCrash(x, y, xNext, yNext, this.width, this.height, this.obstacles);
  }

  /** Draw the world; `fromAscii` reads it again. */
  toString() {
    const near = reachable(this.goal, this.width, this.height, this.obstacles);
    const anywhere = this.starts.length === this.#everywhere(near).length; // the default, which a drawing leaves out
    const symbols = Array.from(this.obstacles, (wall) => (wall ? "#" : "."));
    symbols[this.goal[1] * this.width + this.goal[0]] = "G";
    for (const { x, y, theta } of anywhere ? [] : this.starts) {
      const i = y * this.width + x;
      const arrow = Object.keys(ARROWS).find((symbol) => ARROWS[symbol] === theta) ?? "S";
      symbols[i] = symbols[i] === "." ? arrow : "S";
    }
    const rows = Array.from({ length: this.height }, (_, y) => symbols.slice(y * this.width, (y + 1) * this.width));
    return rows.reverse().map((row) => row.join("")).join("\n");
  }

  #everywhere(near) {
    const cells = this.free.filter(([x, y]) => near[y * this.width + x] && !this.isGoal(x, y));
    if (!cells.length) {
      const got = `${inWords(this.goal)}, walled in`;
      fail("goal", "a cell that can be reached", got, "Remove an obstacle beside it.");
    }
    return cells.flatMap(([x, y]) => HEADINGS.map((theta) => new Pose(x, y, theta)));
  }

  #inside(name, cell) {
    const [x, y] = cellOf(name, cell);
    if (!(x >= 0 && x < this.width && y >= 0 && y < this.height)) {
      fail(name, `(x, y) inside the ${this.width} x ${this.height} grid`, `(${x}, ${y})`);
    }
    return [x, y];
  }

  #checkStart(pose, near) {
    const { x, y } = instance("starts", pose, Pose);
    const got = inWords([x, y]);
    if (this.isGoal(x, y)) fail("starts", "free cells away from the goal", `${got}, the goal`);
    if (this.blocked(x, y)) {
      const outside = !(x >= 0 && x < this.width && y >= 0 && y < this.height);
      fail("starts", "free cells away from the goal", `${got}, ${outside ? "outside the grid" : "an obstacle"}`);
    }
    if (!near[y * this.width + x]) {
      fail("goal", `reachable from the start ${got}`, "no way between them", "Remove an obstacle.");
    }
  }
}

/** Cells from which `cell` can be reached by moves to free neighbours, and itself: 1 at y * width + x. */
export function reachable(cell, width, height, obstacles) {
  const reached = new Uint8Array(width * height);
  const frontier = [cell];
  reached[cell[1] * width + cell[0]] = 1;
  while (frontier.length) {
    const [x, y] = frontier.pop();
    for (let yNext = y - 1; yNext <= y + 1; yNext++) {
      for (let xNext = x - 1; xNext <= x + 1; xNext++) {
        if (isCrash(x, y, xNext, yNext, width, height, obstacles) || reached[yNext * width + xNext]) continue;
        reached[yNext * width + xNext] = 1;
        frontier.push([xNext, yNext]);
      }
    }
  }
  return reached;
}

function isBlocked(x, y, width, height, obstacles) {
  return !(x >= 0 && x < width && y >= 0 && y < height) || obstacles[y * width + x] === 1;
}

function isCrash(x, y, xNext, yNext, width, height, obstacles) {
  if (isBlocked(xNext, yNext, width, height, obstacles)) return true;
  const diagonal = x !== xNext && y !== yNext;
  return diagonal && (isBlocked(xNext, y, width, height, obstacles) || isBlocked(x, yNext, width, height, obstacles));
}

function inWords([x, y]) {
  return `(${x}, ${y})`;
}

/** Different poses in the order of states: row by row from the bottom left, then by heading. */
function inOrder(poses) {
  const different = new Map(poses.map((pose) => [String(pose), pose]));
  return [...different.values()].sort((p, q) => p.y - q.y || p.x - q.x || p.theta - q.theta);
}

/** Split a drawing into rows of symbols, and say what is wrong with it. */
function rowsOf(drawing) {
  if (typeof drawing !== "string") {
    fail("drawing", "rows of text", `${show(drawing)} (${typeof drawing})`, "", TypeError);
  }
  const text = drawing.trim();
  if (!text) fail("drawing", `rows of text (${DRAWN})`, "an empty one");
  const rows = text.split(/\r\n|[\n\r\v\f\u2028\u2029]/).map((row) => [...row.trim()]);
  rows.forEach((row, i) => {
    const there = `in row ${i + 1}: ${quote(row.join(""))}`;
    if (row.length !== rows[0].length) {
      fail("drawing", `rows of ${rows[0].length} characters, as the first`, `${row.length} ${there}`);
    }
    const unknown = row.find((symbol) => !"#.GS><^v".includes(symbol));
    if (unknown) fail("drawing", `made of ${DRAWN}`, `${quote(unknown)} ${there}`);
  });
  return rows;
}
