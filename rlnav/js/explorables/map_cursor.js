/**
 * Poses on a map: which one a reader points at, with the pointer or with the keyboard's cursor, and the keys of a map.
 */
import { HEADINGS } from "../robot.js";
import { choice } from "../views/controls.js";
import { h } from "../views/dom.js";
import { ARROWS } from "./naming.js";

/**
 * Make the listener of a map for keys: `actions` by letter, and "enter", which is the space bar as well. Each hears the
 * cell of the cursor, and whether Shift was held.
 */
export function keysOf(actions) {
  return ({ key, shiftKey, ctrlKey, metaKey, altKey }, map) => {
    const name = key === " " ? "enter" : key.toLowerCase();
    if (ctrlKey || metaKey || altKey || !(name in actions)) return false;
    const [x, y] = map.cursor;
    actions[name]({ x, y, theta: null }, shiftKey);
    return true;
  };
}

/** What a reader points at: with the keyboard a cell alone, whose heading R chooses, and which has to be told. */
export class MapCursor {
  /** `onPoint(cell)` hears each cell, `onTell(cell)` those of the keyboard; `actions` are for keys beside R. */
  constructor({ facing = 90, onPoint, onTell, ...actions }) {
    Object.assign(this, { facing, onPoint, onTell });
    const r = (cell, back) => {
      this.facing = (this.facing + (back ? 315 : 45)) % 360;
      this.point(cell);
    };
    this.key = keysOf({ r, ...actions });
  }

  /** Point at a cell { x, y, theta }, theta null from the keyboard, or at none. */
  point(cell) {
    this.onPoint?.(cell);
    if (cell?.theta === null) this.onTell(cell);
  }
}

/** Return a pose as a state keeps it, or null where it is the one that was kept: the same again lets it go. */
export function keptOrNot(pose, kept) {
  const again = !pose || (kept && pose.x === kept.x && pose.y === kept.y && pose.theta === kept.theta);
  return again ? null : [pose.x, pose.y, pose.theta];
}

/** A menu for the heading that a map shows; null stands for all of them. */
export function headingChoice(onChange) {
  const arrows = HEADINGS.map((theta) => [String(theta), `heading ${theta}° ${ARROWS[theta / 45]}`]);
  const menu = choice({
    label: "Headings",
    hideLabel: true,
    options: [["all", "all headings"], ...arrows],
    onChange: (theta) => onChange(theta === "all" ? null : Number(theta)),
  });
  return {
    element: menu.element,
    set value(heading) {
      menu.value = String(heading ?? "all");
    },
  };
}

/** The line that tells which keys a map knows. */
export function keysHelp(text) {
  return h("p", { class: "rl-help rl-keys-help", text });
}
