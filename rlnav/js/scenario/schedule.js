/**
 * How the step size and the chance to explore change with the episodes.  rlnav/widgets/_schedule.py is the other side,
 * and so is one line of NumPy (python.js writes it): only + - * /, in the same order, so that all give the same bits.
 */

export const SCHEDULES = Object.freeze(["constant", "linear", "harmonic", "exponential"]);
export const RATIOS = Object.freeze(["harmonic", "exponential"]); // made from end / start: neither may be 0

/** Return one number for each episode, from `start` in the first to `end` in the last. */
export function scheduleOf(kind, start, end, episodes) {
  const values = new Float64Array(episodes).fill(start);
  const last = episodes - 1;
  if (kind === "constant" || last === 0) return values;
  if (kind === "linear") {
    const step = (end - start) / last; // as numpy.linspace
    for (let e = 1; e < last; e++) values[e] = e * step + start;
    values[last] = end;
  } else if (kind === "harmonic") {
    for (let e = 1; e <= last; e++) values[e] = start / (1 + ((start / end - 1) * e) / last);
  } else {
    const factor = factorOf(start, end, episodes);
    for (let e = 1; e <= last; e++) values[e] = values[e - 1] * factor;
  }
  return end > start ? values.map((value) => Math.min(value, 1)) : values; // rounding may lift the last ones above 1
}

/** The number by which an exponential schedule multiplies from episode to episode: a root of end / start. */
export function factorOf(start, end, episodes) {
  const ratio = end / start;
  let low = Math.min(ratio, 1);
  let high = Math.max(ratio, 1);
  for (let middle = (low + high) / 2; low < middle && middle < high; middle = (low + high) / 2) {
    if (power(middle, episodes - 1) < ratio) low = middle;
    else high = middle;
  }
  return high;
}

/** base ** n by multiplications: the bits of Math.pow differ between machines. */
function power(base, n) {
  let product = 1;
  for (let square = base, left = n; left > 0; left = Math.floor(left / 2)) {
    if (left % 2 === 1) product *= square;
    square *= square;
  }
  return product;
}
