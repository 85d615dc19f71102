/**
 * What is drawn on the map, with the shapes of rl.plot. A context is in cells: the origin in the middle of one, y up.
 */

const DEGREE = Math.PI / 180;
const ROBOT = [[0.36, 0], [-0.26, 0.24], [-0.13, 0], [-0.26, -0.24]]; // looking east
const TIP = [[0.12, 0], [-0.1, 0.11], [-0.05, 0], [-0.1, -0.11]];
const INNER = 0.13; // radii of the ring
const OUTER = 0.47;
const GAP = 0.02; // between two wedges
export const CRASH_AT = 0.42; // of the way to the next cell: there stands what cannot be driven through

/** Return the direction of a heading as [x, y]. */
export function unit(theta) {
  return [Math.cos(theta * DEGREE), Math.sin(theta * DEGREE)];
}

/** Return the corners of the ring's wedge for heading 45 k: [x, y], ... */
export function wedgeOf(k) {
  return [[OUTER, 1], [INNER, -1]].flatMap(([radius, turn]) => {
    const half = 22.5 - GAP / 2 / radius / DEGREE;
    const rim = [-1, -0.5, 0, 0.5, 1].map((part) => unit(45 * k + turn * half * part));
    return rim.map(([x, y]) => [radius * x, radius * y]);
  });
}

/** Return the Bezier curve of a drive: it begins along heading theta and ends along theta + a, dx and dy away. */
export function bend(theta, a, dx, dy) {
  const reach = 0.4 * Math.hypot(dx, dy);
  const [sx, sy] = unit(theta);
  const [ex, ey] = unit(theta + a);
  return [0, 0, reach * sx, reach * sy, dx - reach * ex, dy - reach * ey, dx, dy];
}

/** Return a needle's curve, eight numbers: a large one around the origin, a small one on its wedge of the ring. */
export function needle(k, turn, large) {
  const theta = 45 * k;
  const a = 45 * turn;
  const length = large ? 0.6 : 0.25;
  const [x, y] = unit(theta + a / 2);
  const curve = bend(theta, a, length * x, length * y);
  const [fx, fy] = large ? [(-length * x) / 2, (-length * y) / 2] : unit(theta).map((c) => 0.17 * c);
  return curve.map((c, i) => c + (i % 2 ? fy : fx));
}

function trace(context, corners, size = 1) {
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(size * x, size * y);
  context.closePath();
}

/** Draw what `paint` draws at a place, turned by theta. */
function at(context, x, y, theta, paint) {
  context.save();
  context.translate(x, y);
  context.rotate(theta * DEGREE);
  paint();
  context.restore();
}

/** Draw the goal: a star with a dark edge. */
export function drawGoal(context, [x, y], colors, pixel) {
  const corners = Array.from({ length: 10 }, (_, i) => unit(90 + 36 * i).map((c) => (i % 2 ? 0.18 : 0.4) * c));
  at(context, x, y, 0, () => {
    trace(context, corners);
    Object.assign(context, { fillStyle: colors.goal, strokeStyle: colors.goalEdge, lineWidth: pixel });
    context.lineJoin = "round";
    context.fill();
    context.stroke();
  });
}

/** Draw where episodes begin: an arrowhead for one heading, a disc with spokes for several. */
export function drawStart(context, x, y, thetas, colors, pixel) {
  context.fillStyle = context.strokeStyle = colors.path;
  if (thetas.length === 1) {
    at(context, x, y, thetas[0], () => {
      trace(context, ROBOT);
      context.fill();
    });
    return;
  }
  context.beginPath();
  for (const theta of thetas) {
    const [dx, dy] = unit(theta);
    context.moveTo(x + 0.2 * dx, y + 0.2 * dy);
    context.lineTo(x + 0.36 * dx, y + 0.36 * dy);
  }
  Object.assign(context, { lineWidth: Math.max(2 * pixel, 0.04), lineCap: "round" });
  context.stroke();
  context.beginPath();
  context.arc(x, y, 0.2, 0, 2 * Math.PI);
  context.fill();
}

/** Return the corners of the tip with which a large needle ends, looking along theta. */
export function tipOf(curve, theta) {
  const [cos, sin] = unit(theta);
  return TIP.map(([x, y]) => [curve[6] + x * cos - y * sin, curve[7] + x * sin + y * cos]);
}

/** Return where a robot is on its way from one pose to the next: x, y and heading; `part` in [0, 1]. */
export function onTheWay(from, to, part) {
  const a = ((to.theta - from.theta + 540) % 360) - 180;
  const [, , bx, by, cx, cy, dx, dy] = bend(from.theta, a, to.x - from.x, to.y - from.y);
  const rest = 1 - part;
  const mix = (b, c, d) => 3 * rest * rest * part * b + 3 * rest * part * part * c + part ** 3 * d;
  return { x: from.x + mix(bx, cx, dx), y: from.y + mix(by, cy, dy), theta: from.theta + a * part };
}

/** Draw the robot: a disc that carries an arrowhead; one that crashed shows a cross and what it hit. */
export function drawRobot(context, { x, y, theta, crashed }, colors, pixel) {
  at(context, x, y, theta, () => {
    context.beginPath();
    context.arc(0, 0, 0.36, 0, 2 * Math.PI);
    context.fillStyle = crashed ? colors.crash : colors.robot;
    context.strokeStyle = colors.robotInk;
    context.lineWidth = Math.max(1.5 * pixel, 0.045);
    context.fill();
    context.stroke();
    trace(context, ROBOT, 0.78);
    context.fillStyle = colors.robotInk;
    context.globalAlpha = crashed ? 0.45 : 1;
    context.fill();
  });
  if (crashed) drawCross(context, x, y, colors.robotInk, colors.goalEdge, pixel);
}

/** Draw an arrowhead at a pose, as the robot that a path leaves behind. */
export function drawArrow(context, { x, y, theta }, color, halo, pixel) {
  at(context, x, y, theta, () => {
    trace(context, ROBOT);
    Object.assign(context, { fillStyle: color, strokeStyle: halo, lineWidth: 2 * pixel, lineJoin: "round" });
    context.stroke();
    context.fill();
  });
}

/** Draw a cross with an edge, to be seen on every ground. */
export function drawCross(context, x, y, color, edge, pixel) {
  context.lineCap = "round";
  for (const [style, width] of [[edge, 0.15], [color, 0.085]]) {
    context.beginPath();
    for (const s of [1, -1]) {
      context.moveTo(x - 0.17, y - 0.17 * s);
      context.lineTo(x + 0.17, y + 0.17 * s);
    }
    Object.assign(context, { strokeStyle: style, lineWidth: Math.max(width, (width === 0.15 ? 3.5 : 1.8) * pixel) });
    context.stroke();
  }
}

/** Draw the way of a robot: curves as it drives them, an arrowhead at each pose, a disc at its start. */
export function drawPath(context, path, { color, halo, pixel, dashed = false, shift = 0 }) {
  if (!path.length) return;
  context.save();
  context.translate(shift, shift);
  traceWay(context, path);
  Object.assign(context, { lineJoin: "round", lineCap: "round" });
  const width = Math.min(Math.max(2 * pixel, 0.055), 4 * pixel);
  for (const [style, lineWidth, dash] of [[halo, width + 2 * pixel, []], [color, width, dashed ? [0.16, 0.12] : []]]) {
    Object.assign(context, { strokeStyle: style, lineWidth });
    context.setLineDash(dash);
    context.stroke();
  }
  context.setLineDash([]);
  drawPoses(context, path, color, halo, pixel);
  context.restore();
}

function traceWay(context, path) {
  context.beginPath();
  context.moveTo(path[0].x, path[0].y);
  for (let i = 1; i < path.length; i++) {
    const [from, to] = [path[i - 1], path[i]];
    if (to.crashed) {
      const { x, y } = onTheWay(from, to, CRASH_AT);
      context.lineTo(x, y);
    } else {
      const [, , ...c] = bend(from.theta, to.theta - from.theta, to.x - from.x, to.y - from.y);
      context.bezierCurveTo(...c.map((d, j) => d + (j % 2 ? from.y : from.x)));
    }
  }
}

function drawPoses(context, path, color, halo, pixel) {
  const last = path.at(-1);
  const poses = last.crashed ? path.slice(0, -1) : path;
  Object.assign(context, { fillStyle: halo, strokeStyle: color, lineWidth: Math.max(1.5 * pixel, 0.045) });
  context.beginPath();
  context.arc(path[0].x, path[0].y, 0.24, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  context.fillStyle = color;
  if (poses.length <= 400) {
    for (const { x, y, theta } of poses) {
      at(context, x, y, theta, () => {
        trace(context, ROBOT, 0.52);
        context.fill();
      });
    }
  }
  if (last.crashed && path.length > 1) {
    const { x, y } = onTheWay(path.at(-2), last, CRASH_AT);
    drawCross(context, x, y, color, halo, pixel);
  }
}
