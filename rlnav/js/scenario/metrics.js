/**
 * Curves of a run: one number for each episode, thinned to as many points as a chart can show.
 */

export const METRICS = Object.freeze(["returns", "success", "steps", "tdErrors", "coverage"]);
const POINTS = 240;
const WINDOWS = { success: 50, coverage: 1 }; // episodes that one point is the mean of, at least
const WINDOW = 10;
const LOW = 0.1; // the band leaves out the lowest and the highest tenth
const HIGH = 0.9;

/** The log of a learner: how many episodes are over, and an array for each metric, made when it is asked for. */
export function logOf({ episode, returns, steps, stops, tdErrors, coverage, mdp }, entries) {
  return {
    episode,
    returns: returns.subarray(0, episode),
    steps: steps.subarray(0, episode),
    tdErrors: tdErrors.subarray(0, episode),
    get success() {
      const flags = new Uint8Array(episode);
      for (let e = 0; e < episode; e++) flags[e] = mdp.goal[stops[e]];
      return flags;
    },
    get coverage() {
      const shares = new Float64Array(episode);
      for (let e = 0; e < episode; e++) shares[e] = coverage[e] / entries;
      return shares;
    },
  };
}

/** Numbers of episodes at which a curve has its points: the same for all runs of that many episodes. */
export function ticksOf(episodes) {
  const n = Math.min(episodes, POINTS);
  return Array.from({ length: n }, (_, i) => Math.round(((i + 1) * episodes) / n));
}

/** A curve { x, y }: each point is the mean over the episodes since the last one, or over a window if that is wider. */
export function curveOf(log, metric, episodes) {
  const values = log[metric];
  if (!values) return null;
  const x = ticksOf(episodes).filter((tick) => tick < log.episode);
  if (log.episode) x.push(log.episode);
  const window = WINDOWS[metric] ?? WINDOW;
  const y = x.map((tick, i) => meanBetween(values, Math.min(x[i - 1] ?? 0, Math.max(0, tick - window)), tick));
  return { x, y };
}

/** The band of several runs { x, low, median, high, runs }: between quantiles, as soon as there are two. */
export function bandOf(logs, metric, episodes) {
  const curves = logs.map((log) => curveOf(log, metric, episodes));
  if (curves.length < 2 || curves.includes(null)) return null;
  const { x } = curves[0];
  const at = (share) => x.map((_, i) => quantile(curves.map(({ y }) => y[i]), share));
  return { x, low: at(LOW), median: at(0.5), high: at(HIGH), runs: logs.length };
}

/** The number below which this share of the values lies, between two of them in proportion. */
export function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  const place = share * (sorted.length - 1);
  const below = Math.floor(place);
  const part = place - below;
  return part === 0 ? sorted[below] : (1 - part) * sorted[below] + part * sorted[below + 1];
}

function meanBetween(values, from, to) {
  let sum = 0;
  for (let e = from; e < to; e++) sum += values[e];
  return sum / (to - from);
}
