/**
 * The lowest layer of the map: floor, lines, obstacles, and the coordinates beside them.
 */

/** Let a context draw in cells: (x, y) is the middle of a cell, y up. */
export function inCells(context, geometry) {
  const { cell, left, top, height } = geometry;
  context.setTransform(cell, 0, 0, -cell, left + cell / 2, top + (height - 0.5) * cell);
}

/** Draw floor, lines, obstacles and the coordinates beside them, in device pixels. */
export function drawGround(context, geometry, obstacles, colors, font) {
  const { cell, left, top, width, height, ratio, axes } = geometry;
  const [w, h] = [cell * width, cell * height];
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  context.fillStyle = colors.floor;
  context.fillRect(left, top, w, h);
  context.fillStyle = colors.line;
  const thin = Math.max(1, Math.round(0.8 * ratio));
  for (let x = 1; x < width; x++) context.fillRect(left + x * cell - (thin >> 1), top, thin, h);
  for (let y = 1; y < height; y++) context.fillRect(left, top + y * cell - (thin >> 1), w, thin);
  context.fillStyle = colors.wall;
  for (let i = 0; i < width * height; i++) {
    if (!obstacles[i]) continue;
    context.fillRect(left + (i % width) * cell, top + (height - 1 - Math.floor(i / width)) * cell, cell, cell);
  }
  const thick = Math.round(2.5 * ratio);
  Object.assign(context, { strokeStyle: colors.wallEdge, lineWidth: thick, lineJoin: "round" });
  context.strokeRect(left - thick / 2, top - thick / 2, w + thick, h + thick);
  if (axes) drawCoordinates(context, geometry, colors, font);
}

function drawCoordinates(context, { cell, left, top, width, height, ratio }, colors, font) {
  const room = Math.max(width, height) > 9 ? 2 : 1.3; // digits beside a cell
  const step = [1, 2, 5, 10].find((s) => s * cell >= room * 9 * ratio) ?? 20;
  Object.assign(context, { fillStyle: colors.muted, font: `${11 * ratio}px ${font}` });
  Object.assign(context, { textAlign: "center", textBaseline: "top" });
  const bottom = top + height * cell + 6 * ratio;
  for (let x = 0; x < width; x += step) context.fillText(x, left + (x + 0.5) * cell, bottom);
  Object.assign(context, { textAlign: "right", textBaseline: "middle" });
  for (let y = 0; y < height; y += step) context.fillText(y, left - 6 * ratio, top + (height - y - 0.5) * cell);
}
