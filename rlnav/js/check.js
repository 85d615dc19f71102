/**
 * Checks at the public door: each returns a clean value, or raises one error that says what to do.
 * Mirrors rlnav/_check.py: TypeError for the wrong kind of thing, RangeError where Python has ValueError.
 */

const LARGEST_NUMBER = 1e100; // sums of larger numbers overflow
export const MOST_STEPS = 1_000_000; // of one episode

/** Raise `Kind` in the one form of all messages: `name` must be EXPECTED; got ACTUAL. WHAT TO DO. */
export function fail(name, expected, got, advice = "", Kind = RangeError) {
  throw new Kind(`\`${name}\` must be ${expected}; got ${got}.${advice && ` ${advice}`}`);
}

/** Raise a TypeError that shows the value and what kind of thing it is. */
function wrongKind(name, expected, value) {
  const kind = value?.constructor?.name ?? String(value);
  return fail(name, expected, `${show(value)} (${kind})`, "", TypeError);
}

/** Quote text as Python does, so that both sides give the same message. */
export function quote(text) {
  const mark = text.includes("'") && !text.includes('"') ? '"' : "'";
  return mark + text.replaceAll("\\", "\\\\").replaceAll("\t", "\\t").replaceAll(mark, `\\${mark}`) + mark;
}

/** Quote a value as an error message does: short and on one line. */
export function show(value) {
  if (ArrayBuffer.isView(value)) return `${value.constructor.name} of length ${value.length}`;
  let text = "something that cannot be shown";
  try {
    text = typeof value === "string" ? quote(value) : String(value);
    if (text === "[object Object]" || Array.isArray(value)) text = JSON.stringify(value);
  } catch {
    // such as one that holds itself, or thousands of others one in the other
  }
  return text.length <= 60 ? text : `${text.slice(0, 57)}...`;
}

/** Return a finite real number in [low, high], or in (low, high] if `above`. */
export function number(name, value, low = -Infinity, high = Infinity, { above = false } = {}) {
  let expected = `a number in ${above ? "(" : "["}${low}, ${high}]`;
  if (high === Infinity) {
    expected = low === -Infinity ? "a finite number" : `a finite number ${above ? "above" : "of at least"} ${low}`;
  }
  if (typeof value !== "number") wrongKind(name, expected, value);
  if (!Number.isFinite(value) || value < low || value > high || (above && value === low)) {
    fail(name, expected, show(value));
  }
  if (Math.abs(value) > LARGEST_NUMBER) {
    fail(name, "a number between -1e+100 and 1e+100", show(value), "Sums of larger ones overflow.");
  }
  return value;
}

/** Return a whole number in [low, high]. */
export function integer(name, value, low = -Infinity, high = Infinity) {
  let expected = low > -Infinity ? `an integer of at least ${low}` : "an integer";
  if (high < Infinity) expected = `an integer from ${low} to ${high}`;
  if (typeof value !== "number" || !Number.isInteger(value)) wrongKind(name, expected, value);
  if (value < low || value > high) fail(name, expected, show(value));
  if (!Number.isSafeInteger(value)) fail(name, "an integer of at most 2**53 - 1 in size", show(value));
  return value;
}

/** Return what a collection holds, as an array. */
export function items(name, value, expected) {
  const isCollection = value !== null && typeof value === "object" && Symbol.iterator in value;
  return isCollection ? Array.from(value) : wrongKind(name, expected, value);
}

/** Return a cell [x, y]. */
export function cellOf(name, value) {
  const pair = items(name, value, "a cell (x, y)");
  if (pair.length !== 2) fail(name, "a cell (x, y)", show(value), "", TypeError);
  return [integer(name, pair[0]), integer(name, pair[1])];
}

/** Return one finite number for each place of an array of a given length. */
export function numbers(name, value, length, meaning) {
  const list = ArrayBuffer.isView(value) ? value : items(name, value, meaning);
  if (list.length !== length) fail(name, `${meaning}, of shape (${length})`, `shape (${list.length})`);
  return Float64Array.from(list, (x) => number(name, x));
}

/** Return one whole number in [low, high] for each place of an array of a given length. */
export function integers(name, value, length, meaning, low, high) {
  const list = ArrayBuffer.isView(value) ? value : items(name, value, meaning);
  if (list.length !== length) fail(name, `${meaning}, of shape (${length})`, `shape (${list.length})`);
  const fits = (x) => Number.isInteger(x) && x >= low && x <= high; // the text of a name is made for errors only
  return Int32Array.from(list, (x, i) => (fits(x) ? x : integer(`${name}[${i}]`, x, low, high)));
}

/** Return a function; `formula` shows how it is called. */
export function callable(name, value, formula) {
  return typeof value === "function" ? value : fail(name, `a function ${formula}`, show(value), "", TypeError);
}

/** Return an instance of `Kind`. */
export function instance(name, value, Kind) {
  return value instanceof Kind ? value : wrongKind(name, `a ${Kind.name}`, value);
}

/** Call a reader's own function; what it raises becomes one error that names it and its arguments. */
export function called(name, own, ...args) {
  try {
    return own(...args);
  } catch (error) {
    const got = `${error?.name}: ${error?.message}`;
    const advice = `It was called with (${args.map(show).join(", ")}).`;
    return fail(name, "a function that takes these arguments", got, advice);
  }
}
