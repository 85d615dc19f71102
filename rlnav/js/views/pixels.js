/**
 * Shapes as lists of pixels: drawn once by the canvas, then copied as often as they are needed.
 */

/** Return #rrggbb as the lower 24 bits of a pixel. */
export function pixelOf(color) {
  const [red, green, blue] = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
  return red | (green << 8) | (blue << 16);
}

/** Draws glyphs into a square of `cell` pixels, and finds the pixels that they cover in a picture `row` pixels wide. */
export class Tracer {
  constructor(cell, row) {
    Object.assign(this, { cell, row });
    const canvas = Object.assign(document.createElement("canvas"), { width: cell, height: cell });
    this.context = canvas.getContext("2d", { willReadFrequently: true });
  }

  /** Return where the pixels are that `paint` draws around the middle of the square, in cells, and how they look. */
  trace(paint) {
    const all = this.pixelsOf(paint);
    const covered = Array.from(all.keys()).filter((p) => all[p] >>> 24);
    return { at: this.placesOf(covered), pixel: Uint32Array.from(covered, (p) => all[p]) };
  }

  /** Return the pixels that shapes cover together, with the shape that has most of each, and how opaque it is. */
  traceTogether(paints) {
    const size = this.cell * this.cell;
    const [cover, most, owner] = [new Uint16Array(size), new Uint8Array(size), new Uint8Array(size)];
    for (const [k, paint] of paints.entries()) {
      for (const [p, pixel] of this.pixelsOf(paint).entries()) {
        const alpha = pixel >>> 24;
        if (alpha > most[p]) [most[p], owner[p]] = [alpha, k];
        cover[p] += alpha;
      }
    }
    const covered = Array.from(cover.keys()).filter((p) => cover[p]);
    return {
      at: this.placesOf(covered),
      owner: Uint8Array.from(covered, (p) => owner[p]),
      alpha: Uint32Array.from(covered, (p) => Math.min(cover[p], 255) << 24),
    };
  }

  pixelsOf(paint) {
    const { cell, context } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, cell, cell);
    context.setTransform(cell, 0, 0, -cell, cell / 2, cell / 2);
    paint(context);
    return new Uint32Array(context.getImageData(0, 0, cell, cell).data.buffer);
  }

  placesOf(covered) {
    return Int32Array.from(covered, (p) => Math.floor(p / this.cell) * this.row + (p % this.cell));
  }
}

/** Lay the pixels of a glyph over those of a cell. */
export function stamp(pixels, start, { at, pixel }) {
  for (let p = 0; p < at.length; p++) {
    const [upper, lower] = [pixel[p], pixels[start + at[p]]];
    const a = upper >>> 24;
    const b = (((lower >>> 24) * (255 - a)) / 255) | 0; // how much of the lower one shows
    pixels[start + at[p]] = b === 0 ? upper : blend(upper, a, lower, b);
  }
}

/** Mix two pixels by their weights. */
function blend(upper, a, lower, b) {
  const all = a + b;
  const blue = ((((upper >>> 16) & 255) * a + ((lower >>> 16) & 255) * b) / all) | 0;
  const green = ((((upper >>> 8) & 255) * a + ((lower >>> 8) & 255) * b) / all) | 0;
  const red = (((upper & 255) * a + (lower & 255) * b) / all) | 0;
  return (all << 24) | (blue << 16) | (green << 8) | red;
}
