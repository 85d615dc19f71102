/**
 * Drawing the world on the map itself: by mouse, finger and keyboard.
 *
 * The goal and the start can be dragged at any time; walls are painted with a tool, so that a finger can scroll.
 * A stroke is a draft until it ends: only then a new run begins.
 */
import { moveGoal, moveStart, paint } from "../scenario/edits.js";
import { checkScenario, goalOf } from "../scenario/scenario.js";
import { groundOf, isWall } from "./ground.js";

const PAINTS = ["wall", "free"]; // tools
const HEADINGS = [0, 45, 90, 135, 180, 225, 270, 315];

export class Editing {
  constructor(app, arena) {
    this.app = app;
    this.arena = arena;
    this.stroke = null; // { act(scenario, cell), draft, error } while a press lasts
    this.drawn = { scenario: null, ground: null };
  }

  /** What the map shows as walls, goal and starts: the draft, or what is set. */
  get ground() {
    const scenario = this.stroke?.draft ?? this.app.scenario;
    if (this.drawn.scenario !== scenario) this.drawn = { scenario, ground: groundOf(scenario) };
    return this.drawn.ground;
  }

  pressed({ type, ...cell }) {
    if (type === "down") this.begin(cell);
    else if (type === "move") this.goOn(cell);
    else if (type === "up") this.end();
    else this.stroke = null;
    this.app.refresh();
  }

  begin(cell) {
    if (cell.button > 0) return;
    const act = this.actionAt(cell);
    this.stroke = act ? { act, from: cell, draft: this.app.scenario, error: null } : { act: null, from: cell };
    if (act) this.goOn(cell);
  }

  goOn(cell) {
    const { stroke } = this;
    if (!stroke?.act) return;
    try {
      stroke.draft = stroke.act(stroke.draft, cell);
      if (!PAINTS.includes(this.app.tool)) stroke.error = null; // what is dragged has found a place after all
    } catch (error) {
      stroke.error = error;
    }
  }

  /** The stroke counts. What was never moved is a tap: it selects the pose. */
  end() {
    const { stroke } = this;
    const { app } = this;
    this.stroke = null;
    if (!stroke) return;
    if (!stroke.act) this.arena.select({ x: stroke.from.x, y: stroke.from.y, theta: stroke.from.theta });
    else if (stroke.draft !== app.scenario) app.edit(() => stroke.draft);
    if (stroke.error) app.stage.message(stroke.error.message);
  }

  /** What a press on a cell begins, with the tool that is in hand or without one. */
  actionAt({ x, y }) {
    const { tool, drive } = this.app;
    if (drive.on) return null;
    if (tool === "wall" || tool === "free") return (scenario, cell) => painted(scenario, cell, tool === "wall");
    if (tool === "goal" || this.isGoal(x, y)) return (scenario, cell) => moveGoal(scenario, cell.x, cell.y);
    if (tool === "start") return (scenario, cell) => startAt(scenario, cell);
    if (this.isStart(x, y)) return drag({ x, y });
    return null;
  }

  /** Whether a touch takes hold of something, so that the page must not scroll. */
  grabs({ touches }) {
    if (touches.length !== 1 || this.app.tool !== "none") return false;
    const { px, py } = this.arena.view.placeOf(touches[0]);
    const [x, y] = [Math.round(px), Math.round(py)];
    return !this.app.drive.on && (this.isGoal(x, y) || this.isStart(x, y));
  }

  isGoal(x, y) {
    const [gx, gy] = goalOf(this.app.scenario);
    return x === gx && y === gy;
  }

  isStart(x, y) {
    return (this.app.scenario.starts ?? []).some(([sx, sy]) => sx === x && sy === y);
  }

  /** Act on a key at the cursor; return whether it meant anything. */
  typed(event) {
    const { app, arena } = this;
    if (event.ctrlKey || event.metaKey || event.altKey || app.drive.on) return false;
    const [x, y] = arena.view.cursor;
    const cell = { x, y };
    const tools = { none: "paint", wall: "paint", free: "erase", goal: "goal", start: "start" };
    const keys = { " ": tools[app.tool], enter: tools[app.tool], delete: "erase", backspace: "erase" };
    const key = event.key.toLowerCase();
    const name = keys[key] ?? { g: "goal", s: "start", r: "turn", a: "anywhere" }[key];
    if (key === "h") arena.turn();
    else if (name) this.act(name, cell);
    else return false;
    return true;
  }

  act(name, cell) {
    const { app } = this;
    const wall = isWall(app.scenario, cell.x, cell.y);
    const acts = {
      paint: (scenario) => painted(scenario, cell, !wall),
      erase: (scenario) => painted(scenario, cell, false),
      goal: (scenario) => moveGoal(scenario, cell.x, cell.y),
      start: (scenario) => startAt(scenario, cell),
      turn: turned,
      anywhere: (scenario) => moveStart(scenario, null),
    };
    const said = {
      paint: wall ? "free" : "obstacle",
      erase: "free",
      goal: "the goal is here",
      start: "the start is here",
      turn: "the start is turned",
      anywhere: "the robot starts anywhere",
    };
    if (app.edit(acts[name])) app.say(`(${cell.x}, ${cell.y}): ${said[name]}.${app.trouble ? ` ${app.trouble}` : ""}`);
  }
}

/** Paint one cell, unless it is as it should be. */
function painted(scenario, { x, y }, wall) {
  return isWall(scenario, x, y) === wall ? scenario : paint(scenario, x, y, wall);
}

/** Put the start into a cell, with the heading that it has, or any. */
function startAt(scenario, { x, y }) {
  const headings = [...new Set((scenario.starts ?? []).map(([, , theta]) => theta))];
  const kept = headings.length === 1 ? headings : HEADINGS;
  return withStarts(scenario, kept.map((theta) => [x, y, theta]));
}

/** Drag the starts of one cell, wherever they were dragged before. */
function drag(from) {
  return (scenario, to) => {
    const isHeld = ([x, y]) => x === from.x && y === from.y;
    const starts = scenario.starts.map((start) => (isHeld(start) ? [to.x, to.y, start[2]] : start));
    const moved = withStarts(scenario, starts);
    from = { x: to.x, y: to.y };
    return moved;
  };
}

function withStarts(scenario, starts) {
  return checkScenario({ ...scenario, starts });
}

/** Turn the start: each heading in turn, then any. */
function turned(scenario) {
  if (!scenario.starts) throw new RangeError("The robot starts anywhere. Put the start somewhere first: S.");
  const [[x, y, theta]] = scenario.starts;
  const any = scenario.starts.length > 1;
  const next = any ? [0] : theta === 315 ? HEADINGS : [theta + 45];
  return withStarts(scenario, next.map((heading) => [x, y, heading]));
}
