/**
 * The pictures of two guesses: both maps on one scale of colors, and the curve of their largest difference.
 */
const SHORTEST = 20; // backups on the axis, at least
const LOWEST = 1e-3; // of the first difference: below, the curve has nothing more to tell

/** Return the color scale for all moments on the way: it holds all that is guessed, and the answer. */
export function scaleOf(mdp, tables) {
  const live = tables.flatMap((values) => Array.from(values).filter((_, s) => !mdp.terminal[s]));
  const [low, high] = [Math.min(...live), Math.max(...live)];
  return low < high ? { low, high } : { low: low - 0.5, high: high + 0.5 };
}

/** Return what GridView draws of the values of one guess: the map with a ring of eight wedges in each cell. */
export function mapOf(values, { task, mdp, scale }) {
  const { width, height, obstacles, goal } = task.world;
  const rings = new Float64Array(width * height * 8).fill(NaN);
  task.poses.forEach(({ x, y, theta }, s) => {
    if (!mdp.terminal[s]) rings[(y * width + x) * 8 + theta / 45] = values[s];
  });
  return { width, height, obstacles, goal, rings, scale };
}

/** Return what CurveView draws: largest difference and bound of every backup up to k. */
export function curvesOf(pair, k) {
  const x = Array.from({ length: k + 1 }, (_, i) => i);
  const first = pair.distances[0] || 1;
  const of = (numbers) => x.map((i) => (numbers[i] >= LOWEST * first ? numbers[i] : NaN));
  return {
    series: [
      { name: "largest difference", x, y: of(pair.distances) },
      { name: "promised: γᵏ times the first", x, y: of(pair.bounds) },
    ],
    log: true,
    marker: k,
    xRange: [0, Math.max(SHORTEST, 20 * Math.ceil(k / 20))],
    yRange: [LOWEST * first, 1.5 * first],
  };
}
