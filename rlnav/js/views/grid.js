/**
 * The map as a picture that can be operated: floor and walls, values of poses, policy, path and robot.
 */
import { h, uniqueId } from "./dom.js";
import { drawAbove } from "./grid_above.js";
import { drawGround } from "./grid_ground.js";
import { GridInput } from "./grid_input.js";
import { ValueLayer } from "./grid_values.js";
import { colorsOf, onThemeChange } from "./theme.js";

const TALLEST = 0.78; // of the window's height
const LARGEST = 110; // pixels of a cell
const NOTHING = { width: 4, height: 4, obstacles: new Uint8Array(16), goal: null };

export class GridView {
  /**
   * `onCell({ type, x, y, theta, button, pointerType, event })` hears "down", "move" for every cell crossed, "up" and
   * "cancel"; `onHover(cell)` hears { x, y, theta } or null, also of the keyboard's cursor (theta null); `onKey(event)`
   * returns true for a key that it has used. `maxHeight` in pixels; `axes: false` leaves the coordinates out.
   */
  constructor(parent, { label, onCell, onHover, onKey, cursor = true, axes = true, maxHeight = null, maxCell }) {
    Object.assign(this, { onCell, onHover, onKey, axes, maxHeight, maxCell: maxCell ?? LARGEST, hasCursor: cursor });
    const note = h("p", { class: "rl-hidden", id: uniqueId("map") });
    this.note = note;
    const keys = onKey || (cursor && (onCell || onHover)); // else there is nothing to do for who comes by Tab
    const role = keys ? { role: "application", tabindex: 0 } : { role: "img" };
    this.canvas = h("canvas", { ...role, "aria-label": label, "aria-describedby": note.id });
    this.element = h("div", { class: "rl-grid" }, this.canvas, note);
    parent.append(this.element);
    this.context = this.canvas.getContext("2d");
    this.ground = document.createElement("canvas");
    this.values = new ValueLayer(document.createElement("canvas"));
    this.data = NOTHING;
    this.cursor = [0, 0];
    this.cursorShown = false;
    this.version = 0; // of the theme
    this.touch = "scroll";
    this.input = new GridInput(this);
    this.retheme();
    this.stopTheme = onThemeChange(this.element, () => this.retheme());
    this.resizes = new ResizeObserver(() => this.retheme()); // nothing has a color before it is on the page
    this.resizes.observe(this.element);
  }

  destroy() {
    this.resizes.disconnect();
    this.stopTheme();
    this.element.remove();
  }

  /** What a finger does: "paint" in the map, or "scroll" the page (a tap is still told). */
  get touch() {
    return this.canvas.style.touchAction === "pinch-zoom" ? "paint" : "scroll";
  }

  set touch(what) {
    this.canvas.style.touchAction = what === "paint" ? "pinch-zoom" : "pan-x pan-y pinch-zoom";
  }

  focus() {
    this.canvas.focus();
  }

  /** Set what a screen reader tells about the picture. */
  describe(text) {
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  size() {
    return this.data;
  }

  /** Return where an event is, in cells: whole numbers are the middles of cells. */
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    const { cell, left, top, height, ratio } = this.geometry;
    const scale = (this.canvas.width / box.width) || ratio;
    const px = ((event.clientX - box.left) * scale - left) / cell - 0.5;
    return { px, py: height - 0.5 - ((event.clientY - box.top) * scale - top) / cell };
  }

  showCursor(visible) {
    this.cursorShown = visible;
    this.draw(this.data);
  }

  /** Read colors and type anew, and draw with them. */
  retheme() {
    this.colors = colorsOf(this.element);
    this.font = getComputedStyle(this.element).fontFamily;
    this.version += 1;
    this.draw(this.data);
  }

  /**
   * Draw; what is missing or null is not drawn.
   * { width, height, obstacles (one byte a cell), goal: [x, y], starts: [pose] } is the map; a pose is { x, y, theta }.
   * `rings` holds 8 values a cell, `cells` one; NaN draws nothing; `scale` is { low, high, diverging }; `numbers`.
   * `needles` holds the best turn / 45 of 8 headings a cell, or NONE; `needlesAt` shows one heading, large.
   * `robot` is { x, y, theta, from, at, crashed }: `at` in [0, 1] on its way from the pose `from`.
   * `path` and `ghost` are lists of poses, of which the last may be `crashed`; `selected` is a pose, theta may be null.
   * `marks` are { x, y, kind, text, theta, color } with kind "pose", "cross", "ring", "square", "arrow" or "text".
   */
  draw(data) {
    this.data = data;
    this.cursor = [Math.min(this.cursor[0], data.width - 1), Math.min(this.cursor[1], data.height - 1)];
    if (!this.fit()) return;
    const { context, geometry } = this;
    const key = `${this.version} ${geometry.width} ${geometry.height} ${geometry.cell} ${geometry.left}`;
    this.updateGround(key);
    this.values.update(data, geometry, this.colors, this.font, key);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.ground, 0, 0);
    context.drawImage(this.values.context.canvas, 0, 0);
    drawAbove(context, data, this);
  }

  /** Choose the size of a cell for the room there is; false while there is none. */
  fit() {
    const { width, height } = this.data;
    const room = this.element.clientWidth;
    if (!room) return false;
    const ratio = window.devicePixelRatio || 1;
    const edge = Math.round(3 * ratio);
    const [left, bottom] = this.axes ? [Math.round(22 * ratio), Math.round(22 * ratio)] : [edge, edge];
    const tallest = (this.maxHeight ?? TALLEST * window.innerHeight) * ratio;
    const cell = Math.floor(
      Math.min((room * ratio - left - edge) / width, (tallest - bottom - edge) / height, this.maxCell * ratio),
    );
    this.geometry = { width, height, cell: Math.max(cell, 4), left, top: edge, ratio, axes: this.axes };
    const size = [left + edge + width * this.geometry.cell, bottom + edge + height * this.geometry.cell];
    for (const canvas of [this.canvas, this.ground, this.values.context.canvas]) {
      if (canvas.width === size[0] && canvas.height === size[1]) continue;
      [canvas.width, canvas.height] = size;
      this.values.key = "";
      this.groundKey = "";
    }
    this.canvas.style.width = `${size[0] / ratio}px`;
    this.canvas.style.height = `${size[1] / ratio}px`;
    return true;
  }

  updateGround(key) {
    const { obstacles } = this.data;
    const full = `${key} ${obstacles.join("")}`;
    if (full === this.groundKey) return;
    this.groundKey = full;
    drawGround(this.ground.getContext("2d"), this.geometry, obstacles, this.colors, this.font);
  }

  /** Return the picture as a PNG on the ground of the page. */
  toBlob() {
    const { width, height } = this.canvas;
    const copy = Object.assign(document.createElement("canvas"), { width, height });
    const context = copy.getContext("2d");
    context.fillStyle = this.colors.ground;
    context.fillRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    return new Promise((resolve) => copy.toBlob(resolve, "image/png"));
  }
}
