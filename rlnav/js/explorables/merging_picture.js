/**
 * The pictures of the merging paths: the last drive, the values of each pose in its cell, and the errors.
 */

export const SCALE = Object.freeze({ low: -10, high: 10, diverging: true }); // white: nothing is known

/** Return what GridView draws of the last drive; null before the first. */
export function driveOf(merging, task, drive) {
  const { width, height, obstacles, goal } = task.world;
  const starts = merging.roads.map((s) => task.pose(s));
  const map = { width, height, obstacles, goal, starts };
  if (!drive) return map;
  const path = Array.from(drive.states, (s) => task.pose(s)).filter(Boolean);
  const crashed = task.pose(drive.states.at(-1)) === null;
  return { ...map, path, robot: { ...path.at(-1), crashed } };
}

/** Return what GridView draws of a table: one value in each cell, since the policy comes to it with one heading. */
export function valuesOf(merging, task, V, drive) {
  const { width, height, obstacles, goal } = task.world;
  const cells = new Float64Array(width * height).fill(NaN);
  for (const s of merging.states) {
    const { x, y } = task.pose(s);
    cells[y * width + x] = V[s];
  }
  const selected = drive && { ...task.pose(drive.states[0]), theta: null };
  return { width, height, obstacles, goal, cells, numbers: true, scale: SCALE, selected };
}

/** Return what CurveView draws: the error of both tables after each drive up to the one that is shown. */
export function errorCurves(moments, k) {
  const x = Array.from({ length: k + 1 }, (_, i) => i);
  const of = (name) => x.map((i) => moments[i][name]);
  const most = Math.max(...moments.flatMap(({ mcError, tdError }) => [mcError, tdError]), 1);
  return {
    series: [
      { name: "Monte Carlo", x, y: of("mcError") },
      { name: "TD(0)", x, y: of("tdError") },
    ],
    xRange: [0, Math.max(moments.length - 1, 1)],
    yRange: [0, Math.ceil(most)],
  };
}
