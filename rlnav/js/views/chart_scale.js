/**
 * From numbers to pixels: nice ticks, and lines with no more points than a picture can show.
 */

/** Return a scale from [low, high] to [from, to] pixels; a logarithmic one knows no numbers of zero and below. */
export function makeScale(low, high, from, to, log = false) {
  const bend = log ? Math.log10 : (v) => v;
  const [a, b] = [bend(low), bend(high)];
  const factor = b > a ? (to - from) / (b - a) : 0;
  const at = (v) => (log && !(v > 0) ? NaN : from + (bend(v) - a) * factor);
  return { low, high, from, to, log, at };
}

/** Return the ends of a scale that holds all values with a little air; log: whole powers of ten. */
export function rangeOf(lists, log = false) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const v of list) {
      if (!Number.isFinite(v) || (log && v <= 0)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  if (low > high) return log ? [0.1, 1] : [0, 1];
  if (log) {
    const [from, to] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
    return [10 ** from, 10 ** Math.max(to, from + 1)];
  }
  if (low === high) return [low - 0.5, high + 0.5];
  const step = niceStep((high - low) / 4);
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step];
}

/** Return 1, 2 or 5 times a power of ten, at least as large as `rough`. */
export function niceStep(rough) {
  const size = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find((factor) => factor * size >= rough * (1 - 1e-9)) * size;
}

/** Return ticks with their texts, at least `apart` pixels from each other. */
export function ticksOf(scale, apart) {
  const most = Math.max(Math.floor(Math.abs(scale.to - scale.from) / apart), 1);
  if (scale.log) {
    const [first, last] = [Math.ceil(Math.log10(scale.low) - 1e-9), Math.floor(Math.log10(scale.high) + 1e-9)];
    const every = Math.max(Math.ceil((last - first) / most), 1);
    const powers = [];
    for (let e = last; e >= first; e -= every) powers.push(e);
    const text = (e) => (Math.abs(e) < 4 ? signed(10 ** e) : `1e${signed(e)}`);
    return powers.reverse().map((e) => ({ at: scale.at(10 ** e), text: text(e) }));
  }
  const step = niceStep((scale.high - scale.low) / most);
  const digits = Math.max(-Math.floor(Math.log10(step) + 1e-9), 0);
  const far = Math.max(Math.abs(scale.low), Math.abs(scale.high)) >= 10000 && step >= 1000;
  const ticks = [];
  for (let k = Math.ceil(scale.low / step - 1e-9); k * step <= scale.high + step * 1e-9; k++) {
    const value = k * step;
    ticks.push({ at: scale.at(value), text: far ? thousands(value) : signed(value.toFixed(digits)) });
  }
  return ticks;
}

/** Write 20000 as 20k and 3000000 as 3M. */
function thousands(value) {
  const large = Math.abs(value) >= 1e6;
  if (value === 0) return "0";
  return `${signed(Number((value / (large ? 1e6 : 1e3)).toPrecision(3)))}${large ? "M" : "k"}`;
}

function signed(value) {
  const text = String(value);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** Return runs of points of a line in pixels: lowest and highest of each column; a gap where a number is missing. */
export function thinned(xs, ys, scaleX, scaleY) {
  const runs = [];
  let run = null; // the points of the piece that is being made
  let column = null; // places in the lists: of the first, lowest, highest and last point in one column of pixels
  const close = () => {
    if (!column) return;
    const places = [...new Set([column.first, column.low, column.high, column.last])].sort((i, j) => i - j);
    for (const i of places) run.push([scaleX.at(xs[i]), scaleY.at(ys[i])]);
    column = null;
  };
  for (let i = 0; i < xs.length; i++) {
    const y = ys[i];
    if (!Number.isFinite(y) || (scaleY.log && y <= 0)) {
      close();
      run = null;
      continue;
    }
    if (!run) runs.push((run = []));
    const x = scaleX.at(xs[i]);
    if (column && x - column.x >= 1) close();
    column ??= { x, first: i, low: i, high: i, last: i };
    if (y < ys[column.low]) column.low = i;
    if (y > ys[column.high]) column.high = i;
    column.last = i;
  }
  close();
  return runs;
}

/** Write runs of points as the path of an SVG. */
export function pathOf(runs) {
  const near = (v) => Math.round(v * 10) / 10;
  const lines = runs.map((run) => `M${run.map(([x, y]) => `${near(x)} ${near(y)}`).join("L")}`);
  return lines.map((line, k) => (runs[k].length === 1 ? `${line}h.01` : line)).join(""); // a single point is a dot
}
