/**
 * Pointer and keyboard on the map: every cell that is crossed, a cursor for the arrow keys.
 */

const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class GridInput {
  /** `view` has `canvas`, `placeOf(event)` in cells, `size()`, and the listeners `onCell`, `onHover`, `onKey`. */
  constructor(view) {
    this.view = view;
    this.pointer = null; // the one that is down; further fingers do not paint
    this.last = null; // where it was: { px, py } in cells, and the cell { x, y, theta }
    this.hovered = "";
    const { canvas } = view;
    const on = (name, fn) => canvas.addEventListener(name, fn);
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.end("up", event));
    on("pointercancel", (event) => this.end("cancel", event));
    on("lostpointercapture", (event) => this.end("cancel", event));
    on("pointerleave", () => this.hover(null));
    on("keydown", (event) => this.key(event));
    on("focus", () => view.showCursor(canvas.matches(":focus-visible")));
    on("blur", () => view.showCursor(false));
    on("contextmenu", (event) => this.pointer !== null && event.preventDefault()); // a long touch
  }

  /** Return the cell at a place, and in which of the eight directions from its middle; null outside. */
  cellAt({ px, py }) {
    const { width, height } = this.view.size();
    const [x, y] = [Math.floor(px + 0.5), Math.floor(py + 0.5)];
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    const theta = (Math.round(Math.atan2(py - y, px - x) / (Math.PI / 4)) * 45 + 360) % 360;
    return { x, y, theta };
  }

  tell(type, cell, event) {
    const { button, pointerType } = event;
    this.view.onCell?.({ type, ...cell, button, pointerType, event });
  }

  down(event) {
    const place = this.view.placeOf(event);
    const cell = this.cellAt(place);
    if (this.pointer !== null || !cell) return;
    this.view.showCursor(false);
    this.pointer = event.pointerId;
    this.last = { place, cell };
    this.view.canvas.setPointerCapture(event.pointerId);
    this.tell("down", cell, event);
  }

  move(event) {
    if (this.pointer === null && event.pointerType !== "touch") this.hover(this.cellAt(this.view.placeOf(event)));
    if (event.pointerId !== this.pointer) return;
    const between = event.getCoalescedEvents?.() ?? [];
    for (const one of between.length ? between : [event]) this.drag(this.view.placeOf(one), event);
  }

  /** Tell every cell between the last place and this one, so that a quick stroke leaves no gap. */
  drag(place, event) {
    const from = this.last.place;
    const pieces = Math.ceil(8 * Math.max(Math.abs(place.px - from.px), Math.abs(place.py - from.py), 1 / 8));
    for (let i = 1; i <= pieces; i++) {
      const part = i / pieces;
      const px = from.px + part * (place.px - from.px);
      const cell = this.cellAt({ px, py: from.py + part * (place.py - from.py) });
      const { cell: before } = this.last;
      const moved = cell && (cell.x !== before?.x || cell.y !== before?.y);
      const turned = cell && i === pieces && cell.theta !== before?.theta;
      if (moved || turned) this.tell("move", cell, event);
      this.last.cell = cell ?? this.last.cell;
    }
    this.last.place = place;
  }

  end(type, event) {
    if (event.pointerId !== this.pointer) return;
    const { cell } = this.last;
    this.pointer = null;
    this.tell(type, cell, event);
  }

  hover(cell) {
    const name = JSON.stringify(cell);
    if (name === this.hovered) return;
    this.hovered = name;
    this.view.onHover?.(cell);
  }

  key(event) {
    if (event.key === "Escape" && this.pointer !== null) {
      const { cell } = this.last;
      this.pointer = null;
      this.tell("cancel", cell, { button: 0, pointerType: "keyboard", event });
      return;
    }
    if (this.view.onKey?.(event) === true) {
      event.preventDefault();
      return;
    }
    const step = ARROWS[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { width, height } = this.view.size();
    const [x, y] = this.view.cursor;
    const inside = (v, n) => Math.min(Math.max(v, 0), n - 1);
    this.view.cursor = [inside(x + step[0], width), inside(y + step[1], height)];
    this.view.showCursor(true);
    this.hover({ x: this.view.cursor[0], y: this.view.cursor[1], theta: null });
  }
}
