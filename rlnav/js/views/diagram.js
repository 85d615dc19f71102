/**
 * Backup diagrams: a tree of states (open circles) and actions (filled dots) with numbers, to be walked through.
 */
import { boxOf, fitTexts, placeNodes, placesAtNode, placesOnBranch, rowsFor } from "./diagram_layout.js";
import { h, svg } from "./dom.js";

const NEAR = 26; // pixels: how far from a node a mouse still points at it
const FINGER = 60; // ... and a finger
const ARC = 30; // pixels: radius of the arc for "max"

export class DiagramView {
  /**
   * `onPick(node)` hears the node under pointer, finger or keyboard focus; `onOpen(node)` the one that was picked
   * already when it is clicked, tapped or chosen by Enter.
   */
  constructor(parent, { label, onPick = null, onOpen = null }) {
    Object.assign(this, { label, onPick, onOpen });
    this.ink = document.createElement("canvas").getContext("2d");
    this.branches = svg("g", { "aria-hidden": true });
    this.nodes = svg("g");
    this.words = svg("g", { "aria-hidden": true });
    this.svg = svg("svg", { role: "tree", "aria-label": label }, this.branches, this.words, this.nodes);
    this.element = h("div", { class: "rl-diagram" }, this.svg);
    parent.append(this.element);
    this.data = null;
    this.svg.addEventListener("pointermove", (event) => event.pointerType === "mouse" && this.pickNear(event));
    this.svg.addEventListener("click", (event) => this.pickNear(event));
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.resizes = new ResizeObserver(() => this.data && this.draw(this.data));
    this.resizes.observe(this.element);
  }

  destroy() {
    this.resizes.disconnect();
    this.element.remove();
  }

  /**
   * Draw a tree of { id, kind, label, value, probability, reward, terminal, best, edge, children }.
   * `max` spans an arc over the branches of every state of which only the best counts; `levels` and `edges` are words
   * at the left; `edge` is what is written beside the branch to a node, by default its probability and reward.
   */
  draw(data) {
    this.data = data;
    const width = this.element.clientWidth;
    if (!width) return;
    this.measure();
    const depth = depthOf(data.root);
    const wordy = data.levels || data.edges;
    const room = { width, left: wordy ? 3.4 * this.em : 4, right: 4, top: 16, high: Math.max(78, 5.2 * this.em) };
    const { all, leaves, apart } = placeNodes(data.root, room);
    for (const entry of all) entry.value = valueOf(entry.node);
    const rows = rowsFor(leaves, apart, (text) => this.widthOf(text));
    const height = room.top + room.high * depth + 14 + Math.max(rows, 1) * 1.25 * this.em;
    for (const [name, value] of [["width", width], ["height", height], ["viewBox", `0 0 ${width} ${height}`]]) {
      this.svg.setAttribute(name, value);
    }
    Object.assign(this, { all, apart });
    this.picked = all.find((entry) => entry.node.id === data.picked) ?? null;
    this.drawBranches();
    this.drawNodes();
    this.drawWords(leaves, rows, room, width);
  }

  measure() {
    const style = getComputedStyle(this.element);
    this.em = parseFloat(style.fontSize) * 0.82;
    this.ink.font = `${this.em}px ${style.fontFamily}`;
  }

  widthOf(text) {
    return this.ink.measureText(text).width;
  }

  /** Whether an entry lies on the way from the root to what is picked, or below it. */
  isNear(entry) {
    return !this.picked || isAbove(entry, this.picked) || isAbove(this.picked, entry);
  }

  /** Whether the branch to an entry leads to what is picked, or begins there. */
  isAsked(entry) {
    return this.picked !== null && (isAbove(entry, this.picked) || entry.parent === this.picked);
  }

  drawBranches() {
    const lines = [];
    for (const entry of this.all) {
      const { parent } = entry;
      if (!parent) continue;
      const best = isBest(entry, this.data.max);
      const name = `rl-branch${best ? " rl-best" : ""}${this.isNear(entry) ? "" : " rl-faint"}`;
      lines.push(svg("line", { class: name, x1: parent.x, y1: parent.y, x2: entry.x, y2: entry.y }));
    }
    const spanned = this.all.filter(({ node, below }) => this.data.max && node.kind === "state" && below.length > 1);
    const arcs = spanned.map((one) => svg("path", { class: "rl-arc", d: arcBelow(one) }));
    this.branches.replaceChildren(...lines, ...arcs);
  }

  drawNodes() {
    const focused = this.nodes.contains(document.activeElement) ? document.activeElement.dataset.id : null;
    const current = this.picked ?? this.all[0];
    const elements = this.all.map((entry) => {
      const { node, x, y, radius, level } = entry;
      const shape = node.terminal
        ? svg("rect", { class: "rl-end", x: x - radius, y: y - radius, width: 2 * radius, height: 2 * radius })
        : svg("circle", { class: `rl-${node.kind}`, cx: x, cy: y, r: radius });
      const kind = entry === this.picked ? "rl-node rl-picked" : `rl-node${this.isNear(entry) ? "" : " rl-faint"}`;
      const attributes = {
        class: kind, role: "treeitem", tabindex: entry === current ? 0 : -1, "aria-level": level + 1,
        "aria-selected": entry === this.picked, "aria-label": spoken(entry), dataset: { id: node.id },
      };
      if (entry.below.length) attributes["aria-expanded"] = true;
      const ring = svg("circle", { class: "rl-ring", cx: x, cy: y, r: radius + 4 });
      return (entry.element = svg("g", attributes, ring, shape));
    });
    this.nodes.replaceChildren(...elements);
    if (focused !== null) elements.find((element) => element.dataset.id === focused)?.focus();
  }

  /** Write the numbers that have room: first those of what is picked. */
  drawWords(leaves, rows, room, width) {
    const tall = this.em;
    const side = this.sideWords(room);
    const taken = side.map(({ words, ...place }) => boxOf(place, { wide: this.widthOf(words), tall }));
    taken.push(...this.all.map(({ x, y, radius: r }) => ({ x0: x - r, x1: x + r, y0: y - r, y1: y + r })));
    const wanted = this.numbers(leaves, rows, tall).filter(({ words }) => words);
    const rank = ({ entry, strong }) => (this.picked && this.isNear(entry) ? 0 : 2) + (strong ? 0 : 1);
    const measured = wanted.map((text) => ({ ...text, wide: this.widthOf(text.words), tall }));
    const branches = this.all.filter((entry) => entry.parent);
    const fitted = fitTexts(measured.sort((a, b) => rank(a) - rank(b)), taken, { x0: 0, x1: width }, branches);
    this.words.replaceChildren(...[...side, ...fitted].map(({ words, x, y, anchor, strong, entry }) => {
      const name = `${strong ? "rl-strong" : ""}${!entry || this.isNear(entry) ? "" : " rl-faint"}`;
      return svg("text", { class: name, x, y, "text-anchor": anchor, text: words });
    }));
  }

  /** List all numbers with the places where they may stand. */
  numbers(leaves, rows, tall) {
    const staggered = Math.max(rows, 1);
    const atLeaves = leaves.map((entry, i) => {
      const y = entry.y + entry.radius + 3 + tall * (0.9 + 1.25 * (i % staggered));
      return { words: entry.value, entry, strong: true, places: [{ x: entry.x, y, anchor: "middle" }] };
    });
    const inside = this.all.filter((entry) => entry.below.length);
    const atNodes = inside.map((entry) => {
      return { words: named(entry), entry, strong: true, places: placesAtNode(entry, tall) };
    });
    const onBranches = this.all.filter((entry) => entry.parent).map((entry) => {
      const wanted = this.isAsked(entry);
      const places = placesOnBranch(entry.parent, entry, tall);
      const name = entry.node.kind === "action" && entry.node.label;
      const short = name ? { words: name, wide: this.widthOf(name) } : null;
      return { words: edgeOf(entry.node), short, entry, branch: entry, wanted, places };
    });
    // beside the branches of a crowded tree there is room for the numbers of one node only
    const tooWide = ({ words, entry }) => entry.level > 1 && this.widthOf(words) > 1.5 * this.apart;
    const crowded = onBranches.some(tooWide);
    const told = (entry) => !crowded || entry.level === 1 || this.isAsked(entry);
    return [...atLeaves, ...atNodes, ...onBranches.filter(({ entry }) => told(entry))];
  }

  /** Return what stands at the left: the names of levels and branches. */
  sideWords({ top, high }) {
    const { levels = [], edges = [] } = this.data;
    const word = (words, level, strong) => {
      return { words, x: 2, y: top + high * level + 0.32 * this.em, anchor: "start", strong };
    };
    return [...levels.map((words, k) => word(words, k, true)), ...edges.map((words, k) => word(words, k + 0.5, false))];
  }

  pick(entry, focus = false) {
    if (focus) entry.element.focus();
    if (entry.node.id === this.data.picked) return;
    this.draw({ ...this.data, picked: entry.node.id });
    if (focus) this.all.find((one) => one.node.id === entry.node.id).element.focus();
    this.onPick?.(entry.node);
  }

  /** Pick the node that is nearest to the pointer: small circles need no sure hand. */
  pickNear(event) {
    if (!this.all) return;
    const box = this.svg.getBoundingClientRect();
    const scale = this.svg.viewBox.baseVal.width / box.width;
    const [px, py] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const far = ({ x, y }) => Math.hypot(x - px, y - py);
    const nearest = this.all.reduce((a, b) => (far(b) < far(a) ? b : a));
    const clicked = event.type === "click";
    if (clicked && nearest === this.picked && far(nearest) <= NEAR) this.onOpen?.(nearest.node);
    else if (far(nearest) <= (clicked ? FINGER : NEAR)) this.pick(nearest);
  }

  /** Walk with the arrow keys: down to the first branch, up to the parent, left and right on a level. */
  key(event) {
    const here = this.all?.find(({ element }) => element === document.activeElement);
    if (!here) return;
    const level = this.all.filter((entry) => entry.level === here.level);
    const at = level.indexOf(here);
    const best = here.below.find((entry) => isBest(entry, this.data.max)) ?? here.below[0];
    const next = {
      ArrowUp: here.parent, ArrowDown: best, ArrowLeft: level[at - 1], ArrowRight: level[at + 1],
      Home: this.all[0], End: level.at(-1), Enter: here, " ": here,
    }[event.key];
    if (next === undefined && !event.key.startsWith("Arrow")) return;
    event.preventDefault();
    if (next && next === here && here === this.picked) this.onOpen?.(here.node);
    else if (next) this.pick(next, true);
  }
}

/** Whether an entry is another or one of those that lead to it. */
function isAbove(entry, other) {
  return other !== null && (entry === other || isAbove(entry, other.parent));
}

function depthOf(node) {
  return node.children?.length ? 1 + Math.max(...node.children.map(depthOf)) : 0;
}

/** Whether a branch below a "max" is one of those with the largest value. */
function isBest({ node, parent }, max) {
  if (!max || !parent || parent.node.kind !== "state") return false;
  return node.best ?? parent.below.every(({ node: other }) => !(other.value > node.value + 1e-9));
}

/** Return the arc below a node that spans its branches. */
function arcBelow({ x, y, below }) {
  const ends = [below[0], below.at(-1)].map((entry) => {
    const long = Math.hypot(entry.x - x, entry.y - y);
    return `${x + (ARC * (entry.x - x)) / long} ${y + (ARC * (entry.y - y)) / long}`;
  });
  return `M${ends[0]}A${ARC} ${ARC} 0 0 0 ${ends[1]}`;
}

/** Write a number with four digits, a true minus, and nothing as minus nothing. */
function digits(value) {
  const text = String(Number(value.toPrecision(Math.abs(value) < 1 ? 2 : 3)));
  return (Number(text) === 0 ? "0" : text).replace("-", "−");
}

function valueOf({ value }) {
  return typeof value === "number" ? digits(value) : value ?? "";
}

/** What stands beside a node inside the tree: its value; at the root, after its label. */
function named({ node, value, parent }) {
  return !parent && node.label && value !== "" ? `${node.label} = ${value}` : value || (parent ? "" : node.label ?? "");
}

/** What stands beside the branch to a node: the name of an action, how likely a state is and what it pays. */
function edgeOf({ kind, edge, label, probability, reward }) {
  if (edge !== undefined) return edge;
  if (kind === "action") return label ?? "";
  return [probability, reward].filter((v) => typeof v === "number").map(digits).join(", ");
}

/** Tell a node in words. */
function spoken({ node, value }) {
  const parts = [node.spoken ?? `${node.kind} ${node.label ?? ""}`.trim()];
  if (typeof node.probability === "number") parts.push(`probability ${digits(node.probability)}`);
  if (typeof node.reward === "number") parts.push(`reward ${digits(node.reward)}`);
  if (value !== "") parts.push(`value ${value}`);
  if (node.terminal) parts.push("the end");
  return parts.join(", ");
}
