/**
 * The upper layer of the map: goal, starts, paths, marks, what is selected, the robot, the keyboard's cursor.
 */
import { CRASH_AT, onTheWay, wedgeOf } from "./glyphs.js";
import { drawArrow, drawCross, drawGoal, drawPath, drawRobot, drawStart } from "./glyphs.js";
import { inCells } from "./grid_ground.js";

/** Draw all of it; `view` is the GridView that it belongs to. */
export function drawAbove(context, data, view) {
  const { colors, geometry, font } = view;
  const pixel = geometry.ratio / geometry.cell; // of the page, in cells
  inCells(context, geometry);
  if (data.goal) drawGoal(context, data.goal, colors, pixel);
  for (const [x, y, thetas] of gathered(data.starts ?? [])) drawStart(context, x, y, thetas, colors, pixel);
  const line = { halo: colors.halo, pixel };
  if (data.ghost) drawPath(context, data.ghost, { ...line, color: colors.ghost, dashed: true, shift: 0.09 });
  if (data.path) drawPath(context, data.path, { ...line, color: colors.path });
  for (const mark of data.marks ?? []) drawMark(context, mark, colors, pixel);
  if (data.selected) drawSelected(context, data.selected, colors, pixel);
  if (data.robot) drawRobot(context, placed(data.robot), colors, pixel);
  if (view.cursorShown && view.hasCursor) drawFrame(context, view.cursor, colors.accent, colors.halo, 3 * pixel);
  for (const mark of data.marks ?? []) if (mark.text) drawText(context, mark, colors, geometry, font);
}

/** Draw a frame in a cell, with a halo. */
function drawFrame(context, [x, y], color, halo, width) {
  for (const [strokeStyle, lineWidth] of [[halo, 1.8 * width], [color, width]]) {
    Object.assign(context, { strokeStyle, lineWidth, lineJoin: "round" });
    context.strokeRect(x - 0.5 + width / 2, y - 0.5 + width / 2, 1 - width, 1 - width);
  }
}

/** Frame the selected cell, and the wedge of its heading. */
function drawSelected(context, { x, y, theta = null, color }, colors, pixel) {
  const shade = color ?? colors.ink;
  drawFrame(context, [x, y], shade, colors.halo, 2 * pixel);
  if (theta === null) return;
  context.beginPath();
  for (const [dx, dy] of wedgeOf(theta / 45)) context.lineTo(x + dx, y + dy);
  context.closePath();
  outline(context, shade, colors.halo, pixel);
}

function outline(context, color, halo, pixel) {
  context.lineJoin = "round";
  for (const [strokeStyle, lineWidth] of [[halo, 5 * pixel], [color, 2.2 * pixel]]) {
    Object.assign(context, { strokeStyle, lineWidth });
    context.stroke();
  }
}

/** Draw a mark: "pose" (its wedge), "cross", "ring", "square", "arrow" (along theta), or only its text. */
function drawMark(context, { x, y, kind, theta = 0, color }, colors, pixel) {
  const shade = color ?? colors.ink;
  if (kind === "pose") drawSelected(context, { x, y, theta, color: shade }, colors, pixel);
  if (kind === "cross") drawCross(context, x, y, shade, colors.halo, pixel);
  if (kind === "arrow") drawArrow(context, { x, y, theta }, shade, colors.halo, pixel);
  if (kind !== "ring" && kind !== "square") return;
  context.beginPath();
  if (kind === "ring") context.arc(x, y, 0.3, 0, 2 * Math.PI);
  else context.rect(x - 0.23, y - 0.23, 0.46, 0.46);
  outline(context, shade, colors.halo, pixel);
}

/** Write in a cell, upright, in pixels of the canvas. */
function drawText(context, { x, y, text, color }, colors, { cell, ratio, left, top, height }, font) {
  context.setTransform(1, 0, 0, 1, left + (x + 0.5) * cell, top + (height - y - 0.5) * cell);
  context.font = `600 ${Math.max(Math.min(0.32 * cell, 16 * ratio), 9 * ratio)}px ${font}`;
  Object.assign(context, { textAlign: "center", textBaseline: "middle", lineJoin: "round" });
  Object.assign(context, { strokeStyle: colors.halo, lineWidth: 3 * ratio, fillStyle: color ?? colors.ink });
  context.strokeText(text, 0, 0);
  context.fillText(text, 0, 0);
}

/** Return where the robot stands: at its pose, or on its way there from `from`; a crash ends half way. */
function placed({ from, at = 1, crashed = false, ...to }) {
  if (!from) return { ...to, crashed };
  const part = crashed ? at * CRASH_AT : at;
  return { ...onTheWay(from, to, part), crashed: crashed && at >= 1 };
}

/** Gather start poses by cell: [x, y, headings]. */
function gathered(starts) {
  const cells = new Map();
  for (const { x, y, theta } of starts) {
    const name = `${x} ${y}`;
    if (!cells.has(name)) cells.set(name, [x, y, []]);
    cells.get(name)[2].push(theta);
  }
  return cells.values();
}
