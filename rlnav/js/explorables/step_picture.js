/**
 * The pictures of the step sizes: both partial sums, and what all runs have learned.
 */

/** Return what CurveView draws of the first n updates. */
export function sumCurves({ first, second }, n, longest) {
  const x = Array.from({ length: n }, (_, i) => i + 1);
  return {
    series: [
      { name: "sum of α", x, y: first.slice(0, n) },
      { name: "sum of α²", x, y: second.slice(0, n) },
    ],
    xRange: [0, longest],
    yRange: [0, Math.max(first[Math.max(n, 10) - 1] * 1.05, 1)],
  };
}

/** Return the mean of all runs at each point up to `shown`, and the lowest and the highest of them. */
export function summary({ curves }, shown) {
  const x = Array.from({ length: shown + 1 }, (_, i) => i);
  const over = (fn) => x.map((i) => fn(curves.map((curve) => curve[i])));
  const mean = over((values) => values.reduce((sum, v) => sum + v, 0) / values.length);
  return { x, mean, low: over((values) => Math.min(...values)), high: over((values) => Math.max(...values)) };
}

/** Return what CurveView draws of all runs. */
export function learnedCurves(study, { shown, watch, entry, longest }) {
  const { x, mean, low, high } = summary(study, shown);
  const name = watch === "entry" ? "estimate, mean of 8 runs" : "error, mean of 4 runs";
  const runs = { name, x, y: mean, band: [low, high] };
  if (watch === "table") return { series: [runs], xRange: [0, longest], yRange: [0, Math.max(mean[0], ...high)] };
  const targets = [0, ...entry.targets];
  return {
    series: [runs, { name: "exact", x: [0, longest], y: [entry.exact, entry.exact], color: "var(--rl-ink)" }],
    xRange: [0, longest],
    yRange: [Math.floor(Math.min(...targets)), Math.ceil(Math.max(...targets))],
  };
}
