/**
 * The pictures of the value wave: the map of one sweep, and the curves of all sweeps up to it.
 */
import { HEARABLE } from "./wave_words.js";

/** Return what GridView draws of sweep k: { width, ..., scale, rings or cells }; `changes` shows those of the sweep. */
export function mapOf({ wave, task, scale }, k, { heading, changes }) {
  const { width, height, obstacles, goal } = task.world;
  const each = heading === null ? 8 : 1;
  const [V, before] = [wave.values[k], wave.values[Math.max(k - 1, 0)]];
  const shades = new Float64Array(width * height * each).fill(NaN);
  task.poses.forEach(({ x, y, theta }, s) => {
    if (wave.mdp.terminal[s] || (heading !== null && theta !== heading)) return;
    const place = (y * width + x) * each + (each === 8 ? theta / 45 : 0);
    shades[place] = changes ? Math.abs(V[s] - before[s]) : V[s];
  });
  const shown = each === 8 ? { rings: shades } : { cells: shades, numbers: true };
  const scaleNow = changes ? { low: 0, high: wave.residuals[1] || 1 } : scale;
  return { width, height, obstacles, goal, scale: scaleNow, ...shown };
}

/** Return what CurveView draws: change, promise and true error of every sweep up to k, and where the sweeps stop. */
export function curvesOf(wave, k) {
  const { tol } = wave;
  const x = Array.from({ length: k }, (_, i) => i + 1);
  const of = (number) => x.map((i) => (number(i) > HEARABLE ? number(i) : NaN)); // there is no log of nothing
  const last = Math.max(wave.length, 2);
  const largest = Math.max(10 * tol, wave.residuals[1] || 1, wave.promise(1) || 1);
  return {
    series: [
      { name: "change in this sweep", x, y: of((i) => wave.residuals[i]) },
      { name: "promise for the error", x, y: of((i) => wave.promise(i)) },
      { name: "true error", x, y: of((i) => wave.error(i)) },
      { name: "stop", x: [0, last], y: [tol, tol], color: "var(--rl-muted)" },
    ],
    log: true,
    marker: k,
    xRange: [0, last],
    yRange: [Math.min(tol, 0.01) / 10, 2 * largest],
  };
}
