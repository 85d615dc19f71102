/**
 * The middle layer of the map: values as wedges or squares, needles and numbers.
 *
 * A map of 30 by 30 has 7200 wedges and as many needles, too many to trace in every frame. So each shape is traced
 * once, its pixels are remembered, and a cell is set from them; cells that did not change stay as they are.
 */
import { needle, tipOf, wedgeOf } from "./glyphs.js";
import { pixelOf, stamp, Tracer } from "./pixels.js";
import { DIVERGING, DIVERGING_ON_DARK, readableOn, SEQUENTIAL, UNDER } from "./theme.js";

export const NONE = 127; // in `needles`: no best turn is known
const EMPTY = 255; // in shades: nothing to show
const BELOW = 254; // in shades: under the scale
const WEDGES = Array.from({ length: 8 }, (_, k) => (context) => fillShape(context, wedgeOf(k)));
const COLORS = { sequential: [...SEQUENTIAL], diverging: [...DIVERGING], onDark: [...DIVERGING_ON_DARK] };
const INKS = {};
const WORDS = {}; // the same colors as a pixel holds them
for (const [name, colors] of Object.entries(COLORS)) {
  colors[BELOW] = UNDER;
  INKS[name] = colors.map(readableOn);
  WORDS[name] = Uint32Array.from({ length: EMPTY }, (_, shade) => pixelOf(colors[shade] ?? UNDER));
}

export class ValueLayer {
  constructor(canvas) {
    this.context = canvas.getContext("2d");
    this.key = "";
  }

  /** Bring the layer up to date with `data`; `key` changes when all of it has to be drawn anew. */
  update(data, geometry, colors, font, key) {
    const { rings, cells, needles, numbers = false, needlesAt = null, scale } = data;
    const values = rings ?? cells ?? null;
    const each = rings ? 8 : 1; // values in a cell
    const palette = scale?.diverging ? (isDark(colors) ? "onDark" : "diverging") : "sequential";
    const full = JSON.stringify([key, each, values === null, numbers, needlesAt, Boolean(needles), palette]);
    if (full !== this.key) {
      this.key = full;
      Object.assign(this, { geometry, colors, font, each, palette, large: needlesAt !== null });
      this.reset();
    }
    let dirty = this.findChanges(values, needles, needlesAt, scale ?? {});
    const size = numbers && values ? this.sizeOfNumbers() : 0;
    if (size && (this.renumbered(values) || dirty.length)) dirty = Array.from({ length: this.count }, (_, i) => i);
    if (!dirty.length) return;
    for (const i of dirty) this.setCell(i);
    this.context.putImageData(this.image, geometry.left, geometry.top, ...this.boxOf(dirty));
    if (size) this.drawNumbers(dirty, values, size);
  }

  /** Forget everything that was drawn for another map, size or theme. */
  reset() {
    const { cell, width, height } = this.geometry;
    this.count = width * height;
    this.shades = new Uint8Array(this.count * this.each).fill(EMPTY);
    this.turns = new Int8Array(this.count * 8).fill(NONE);
    this.written = "";
    this.image = new ImageData(width * cell, height * cell);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.needles = { [this.colors.ink]: [], "#ffffff": [], "#000000": [] };
    this.tracer = new Tracer(cell, width * cell);
    this.shape = this.tracer.traceTogether(this.each === 8 ? WEDGES : [(context) => context.fillRect(-1, -1, 2, 2)]);
    this.context.clearRect(0, 0, this.context.canvas.width, this.context.canvas.height);
  }

  /** Return the pixels of a needle in an ink; there are few different ones. */
  needleOf(k, turn, ink) {
    const { cell, ratio } = this.geometry;
    const paint = (context) => drawNeedle(context, k, turn, this.large, ink, this.colors.halo, ratio / cell);
    return (this.needles[ink][9 * k + turn + 4] ??= this.tracer.trace(paint));
  }

  /** Translate values to shades, and list the cells in which one, or a needle, is not as it was drawn. */
  findChanges(values, needles, needlesAt, { low = 0, high = 1 }) {
    const { each, shades, turns } = this;
    const steps = (this.palette === "sequential" ? SEQUENTIAL : DIVERGING).length;
    const factor = high > low ? steps / (high - low) : 0;
    const dirty = [];
    for (let i = 0; i < this.count; i++) {
      let changed = false;
      for (let j = i * each; values && j < (i + 1) * each; j++) {
        const shade = this.shadeOf(values[j], low, factor, steps);
        if (shade !== shades[j]) changed = true;
        shades[j] = shade;
      }
      for (let k = 0; needles && k < 8; k++) {
        const turn = needlesAt === null || needlesAt === 45 * k ? needles[i * 8 + k] : NONE;
        if (turn !== turns[i * 8 + k]) changed = true;
        turns[i * 8 + k] = turn;
      }
      if (changed) dirty.push(i);
    }
    return dirty;
  }

  shadeOf(value, low, factor, steps) {
    if (Number.isNaN(value)) return EMPTY;
    const shade = factor ? Math.floor((value - low) * factor) : steps >> 1;
    if (shade < 0) return this.palette === "sequential" ? BELOW : 0;
    return shade < steps ? shade : steps - 1;
  }

  /** Whether the numbers on the map have to be written again. */
  renumbered(values) {
    const text = Array.from(values, written).join();
    const changed = text !== this.written;
    this.written = text;
    return changed;
  }

  /** Set all pixels of a cell. */
  setCell(i) {
    const { geometry: { cell, width, height }, pixels, shape, shades, each } = this;
    const words = WORDS[this.palette];
    const start = ((height - 1 - Math.floor(i / width)) * cell * width + (i % width)) * cell;
    for (let y = 0; y < cell; y++) pixels.fill(0, start + y * cell * width, start + y * cell * width + cell);
    const { at, owner, alpha } = shape;
    for (let p = 0; p < at.length; p++) {
      const shade = shades[i * each + owner[p]];
      if (shade !== EMPTY) pixels[start + at[p]] = alpha[p] | words[shade];
    }
    for (let k = 0; k < 8; k++) {
      const turn = this.turns[i * 8 + k];
      if (turn === NONE) continue;
      const shade = shades[each === 8 ? i * 8 + k : i];
      const ink = this.large || shade === EMPTY ? this.colors.ink : INKS[this.palette][shade];
      stamp(pixels, start, this.needleOf(k, turn, ink));
    }
  }

  /** Return the smallest box around cells, in pixels of the map: left, top, width, height. */
  boxOf(list) {
    const { cell, width, height } = this.geometry;
    let [left, right, top, bottom] = [width, 0, height, 0];
    for (const i of list) {
      const [column, row] = [i % width, height - 1 - Math.floor(i / width)];
      left = Math.min(left, column);
      right = Math.max(right, column + 1);
      top = Math.min(top, row);
      bottom = Math.max(bottom, row + 1);
    }
    return [left, top, right - left, bottom - top].map((cells) => cells * cell);
  }

  /** Return the height of numbers in pixels; 0 where nobody could read them. */
  sizeOfNumbers() {
    const { cell, ratio } = this.geometry;
    const size = this.each === 8 ? 0.105 * cell : Math.min(0.3 * cell, 15 * ratio);
    return size < 7.5 * ratio ? 0 : size;
  }

  drawNumbers(list, values, size) {
    const { geometry: { cell, left, top, width, height }, context, each, shades } = this;
    Object.assign(context, { font: `${size}px ${this.font}`, textAlign: "center", textBaseline: "middle" });
    const away = each === 8 ? 0.335 * cell : 0;
    for (const i of list) {
      const x = left + ((i % width) + 0.5) * cell;
      const y = top + (height - 0.5 - Math.floor(i / width)) * cell + 0.04 * size;
      for (let k = 0; k < each; k++) {
        const shade = shades[i * each + k];
        if (shade === EMPTY) continue;
        const angle = (k * Math.PI) / 4;
        context.fillStyle = INKS[this.palette][shade];
        context.fillText(written(values[i * each + k]), x + away * Math.cos(angle), y - away * Math.sin(angle));
      }
    }
  }
}

function isDark({ floor }) {
  return readableOn(floor) === "#ffffff";
}

function fillShape(context, corners) {
  context.fillStyle = "#000";
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(x, y);
  context.closePath();
  context.fill();
}

/** Draw a needle: a small one on its wedge, or a large one with a tip that is seen on every color. */
function drawNeedle(context, k, turn, large, ink, halo, pixel) {
  const curve = needle(k, turn, large);
  const stem = new Path2D();
  stem.moveTo(curve[0], curve[1]);
  stem.bezierCurveTo(...curve.slice(2));
  const width = large ? Math.max(1.4 * pixel, 0.04) : Math.max(0.8 * pixel, 0.026);
  context.lineCap = "round";
  if (large) {
    const tip = new Path2D();
    for (const [x, y] of tipOf(curve, 45 * (k + turn))) tip.lineTo(x, y);
    tip.closePath();
    context.strokeStyle = halo;
    context.lineWidth = width + 2 * pixel;
    context.stroke(stem);
    context.lineWidth = 2 * pixel;
    context.stroke(tip);
    context.fillStyle = ink;
    context.fill(tip);
  }
  context.strokeStyle = ink;
  context.lineWidth = width;
  context.stroke(stem);
}

/** Write a value as rl.plot does: one decimal below ten, a true minus, and nothing as minus nothing. */
export function written(value) {
  const text = value.toFixed(Math.abs(value) < 9.95 ? 1 : 0);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}
