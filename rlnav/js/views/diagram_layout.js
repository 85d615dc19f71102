/**
 * Where the nodes of a backup diagram stand, and which of its numbers have room.
 */

export const RADIUS = { state: 9, action: 5.5 };
const ROWS = 3; // of numbers below the leaves, when they are crowded

/** List a tree from the root down: entries with node, parent, level, x and y in pixels. */
export function placeNodes(root, { width, left, right, top, high }) {
  const all = [];
  const visit = (node, parent, level) => {
    const entry = { node, parent, level, y: top + high * level, below: [] };
    all.push(entry);
    entry.below = (node.children ?? []).map((child) => visit(child, entry, level + 1));
    return entry;
  };
  visit(root, null, 0);
  const leaves = all.filter((entry) => !entry.below.length);
  const apart = (width - left - right) / leaves.length;
  leaves.forEach((entry, i) => (entry.x = left + apart * (i + 0.5)));
  for (const entry of all.toReversed()) {
    if (entry.below.length) entry.x = (entry.below[0].x + entry.below.at(-1).x) / 2;
    const full = RADIUS[entry.node.kind] ?? RADIUS.state;
    entry.radius = entry.below.length ? full : Math.min(full, Math.max(0.36 * apart, 3));
  }
  return { all, leaves, apart };
}

/** Return in how many rows the numbers below the leaves stand, so that none touches the next. */
export function rowsFor(leaves, apart, widthOf) {
  const widest = Math.max(0, ...leaves.map((entry) => widthOf(entry.value)));
  for (let rows = 1; rows <= ROWS; rows++) if (rows * apart >= widest + 6) return rows;
  return 0;
}

/**
 * Choose places for texts: those first in the list come first, and one that would touch another is left out. A text
 * that belongs to one of the branches, `text.branch`, does not lie across another, or it would be taken for that one's:
 * then it is shortened to `text.short`, or else left out, unless it is `text.wanted`.
 */
export function fitTexts(wanted, taken, bounds, branches = []) {
  const boxes = [...taken];
  const fits = (box) =>
    box.x0 >= bounds.x0 && box.x1 <= bounds.x1 &&
    boxes.every((other) => box.x1 <= other.x0 || box.x0 >= other.x1 || box.y1 <= other.y0 || box.y0 >= other.y1);
  const clear = (box, own) => !own || branches.every((entry) => entry === own || !isCrossed(box, entry));
  const placed = [];
  for (const { places, short, ...text } of wanted) {
    const forms = [text, ...(short ? [{ ...text, ...short }] : [])];
    const tried = forms.flatMap((form) => places.map((place) => ({ ...form, ...place })));
    const possible = tried.filter((one) => fits(boxOf(one, one)));
    const shortest = possible.find(({ words }) => words === forms.at(-1).words);
    const best = possible.find((one) => clear(boxOf(one, one), text.branch)) ?? (text.wanted ? shortest : null);
    if (!best) continue;
    boxes.push(boxOf(best, best));
    placed.push(best);
  }
  return placed;
}

/** Whether the branch to an entry, which leads down from its parent, runs through a box. */
function isCrossed({ x0, x1, y0, y1 }, { x, y, parent }) {
  if (y1 <= parent.y || y0 >= y) return false;
  const at = (height) => {
    const part = Math.min(Math.max((height - parent.y) / (y - parent.y), 0), 1);
    return parent.x + part * (x - parent.x);
  };
  const [above, below] = [at(y0), at(y1)];
  return Math.min(above, below) < x1 && Math.max(above, below) > x0;
}

/** Return the room that a text takes at a place. */
export function boxOf({ x, y, anchor }, { wide, tall }) {
  const x0 = { start: x, middle: x - wide / 2, end: x - wide }[anchor];
  return { x0: x0 - 1, x1: x0 + wide + 1, y0: y - 0.8 * tall, y1: y + 0.25 * tall };
}

/** Return places beside a branch, best first; outer branches have theirs on the outer side. */
export function placesOnBranch(from, to, tall) {
  const side = to.x >= from.x ? "start" : "end";
  const other = side === "start" ? "end" : "start";
  return [0.58, 0.45, 0.72, 0.33].flatMap((part) => {
    const [x, y] = [from.x + part * (to.x - from.x), from.y + part * (to.y - from.y) + 0.3 * tall];
    return [side, other].map((anchor) => ({ x: x + (anchor === "start" ? 5 : -5), y, anchor }));
  });
}

/** Return places beside a node. */
export function placesAtNode({ x, y, radius }, tall) {
  const [away, middle] = [radius + 10, y + 0.32 * tall];
  return [
    { x: x + away, y: middle, anchor: "start" },
    { x: x - away, y: middle, anchor: "end" },
    { x: x + away, y: middle - 0.8 * tall, anchor: "start" },
    { x: x - away, y: middle - 0.8 * tall, anchor: "end" },
    { x, y: y - radius - 7, anchor: "middle" },
  ];
}
