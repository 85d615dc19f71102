/**
 * The pictures of the one-update inspector: the map with what is learned, and the errors around the update.
 */

const WINDOW = 200; // updates in the curve

/** Return what GridView draws: the largest entry of each row, the way of the episode, both rows, and the robot. */
export function mapOf({ learner, path, task, parts }, at, colors) {
  const { width, height, obstacles, goal } = task.world;
  const rings = new Float64Array(width * height * 8).fill(NaN);
  task.poses.forEach(({ x, y, theta }, s) => {
    const row = learner.phi[s] * learner.A;
    if (learner.mdp.terminal[s]) return;
    rings[(y * width + x) * 8 + theta / 45] = Math.max(...learner.Q.subarray(row, row + learner.A));
  });
  const from = parts && task.pose(parts.s);
  const to = parts && task.pose(parts.sNext);
  const here = to ?? (from ? crashTarget(task, from, parts.a) : task.pose(learner.s));
  const marks = from ? [{ ...from, kind: "pose", color: colors.series1 }] : []; // as in the formula
  if (to && !learner.mdp.terminal[parts.sNext]) marks.push({ ...to, kind: "pose", color: colors.series3 });
  const robot = { ...here, from, at, crashed: Boolean(from && !to) };
  const way = path.map((s) => task.pose(s)).filter(Boolean);
  return { width, height, obstacles, goal, rings, robot, path: way, marks };
}

/** Return the pose that the robot drove at when it crashed; a slip may have turned it one notch further. */
function crashTarget(task, from, a) {
  const outcomes = task.robot.outcomes(a).map(([applied]) => task.transition(from, task.robot.steering[applied]));
  return outcomes.find(({ crash }) => crash)?.sNext ?? from;
}

/** Return what CurveView draws: the TD errors around update `now`, up to it if what follows is still a secret. */
export function errorsOf({ errors, now }, secret) {
  const begin = WINDOW * Math.floor(Math.max(now - 1, 0) / WINDOW);
  const y = errors.slice(begin + 1, secret ? Math.max(now, 1) : begin + WINDOW + 1);
  const x = Array.from(y, (_, i) => begin + i + 1);
  const most = Math.max(1, ...y.map(Math.abs));
  const ranges = { xRange: [begin, begin + WINDOW], yRange: [-most, most] };
  return { series: [{ name: "TD error", x, y }], marker: now, ...ranges };
}
