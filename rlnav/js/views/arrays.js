/**
 * Arrays that Python has sent: base64 of little-endian bytes, with their type and shape.
 * Mirrors rlnav/widgets/_arrays.py.
 */
const TYPES = { uint8: Uint8Array, int32: Int32Array, float32: Float32Array, float64: Float64Array };

/** Read one array as a flat typed array; what Python wrote once because it repeats is repeated here. */
export function unpack({ dtype, shape, data }) {
  const Type = TYPES[dtype];
  if (!Type) throw new TypeError(`\`dtype\` must be one of ${Object.keys(TYPES).join(", ")}; got ${dtype}.`);
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  const once = new Type(littleEndian(bytes, Type.BYTES_PER_ELEMENT).buffer);
  const length = shape.reduce((product, n) => product * n, 1);
  if (once.length === length) return once;
  if (!once.length || length % once.length) {
    throw new RangeError(`\`data\` must be numbers that fill the shape [${shape}]; got ${once.length} of them.`);
  }
  const all = new Type(length);
  for (let i = 0; i < length; i += once.length) all.set(once, i);
  return all;
}

/** Copy plain data with every array in it read. */
export function unpackAll(value) {
  if (value === null || typeof value !== "object") return value;
  if (Array.isArray(value)) return value.map(unpackAll);
  if (typeof value.data === "string" && value.dtype && value.shape) return unpack(value);
  return Object.fromEntries(Object.entries(value).map(([name, item]) => [name, unpackAll(item)]));
}

/** Turn the bytes of each number around on the few machines that keep them the other way. */
function littleEndian(bytes, size) {
  if (new Uint8Array(Uint16Array.of(1).buffer)[0] === 1) return bytes;
  for (let i = 0; i < bytes.length; i += size) bytes.subarray(i, i + size).reverse();
  return bytes;
}
