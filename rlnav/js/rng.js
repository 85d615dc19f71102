/**
 * Uniform random numbers, the same bits as `numpy.random.default_rng(seed).random()` in Python.
 *
 * The generator is PCG64 (M. E. O'Neill, PCG: a family of simple fast space-efficient statistically good algorithms for
 * random number generation, 2014): s <- s * M + c in 128 bits, folded to 64 bits and rotated.  JavaScript has no
 * integers of that size that are fast, so a number is held in six limbs of 24 bits, lowest first: the product of two
 * limbs has 48 bits, and a sum of six of them is still exact in a float64.
 */
import { instance, integer } from "./check.js";

const LIMB = 2 ** 24;
const [M0, M1, M2, M3, M4, M5] = [0xccf645, 0xdf649f, 0xa44385, 0x1fc65d, 0x60ed05, 0x23]; // the multiplier M

/** Draw uniform numbers in [0, 1). */
export class Generator {
  constructor(seed) {
    const w = Array.from(seedWords(integer("rng", seed, 0), 8), BigInt);
    const initial = (w[1] << 96n) | (w[0] << 64n) | (w[3] << 32n) | w[2];
    const stream = (w[5] << 96n) | (w[4] << 64n) | (w[7] << 32n) | w[6];
    const increment = (stream << 1n) | 1n;
    this.increment = limbs(increment);
    this.state = limbs(increment + initial); // write into it to take the generator back to an earlier state
    this.advance();
  }

  /** Return the next number. */
  random() {
    this.advance();
    const s = this.state;
    const w0 = s[0] | (s[1] << 24); // the state again, as four words of 32 bits, lowest first
    const w1 = (s[1] >>> 8) | (s[2] << 16);
    const w2 = (s[2] >>> 16) | (s[3] << 8);
    const w3 = s[4] | (s[5] << 24);
    const turn = w3 >>> 26;
    const low = turn & 32 ? w1 ^ w3 : w0 ^ w2;
    const high = turn & 32 ? w0 ^ w2 : w1 ^ w3;
    const back = 31 - (turn & 31); // in two shifts: a shift by 32 would be one by 0
    const outLow = (low >>> (turn & 31)) | ((high << 1) << back);
    const outHigh = (high >>> (turn & 31)) | ((low << 1) << back);
    return ((outHigh >>> 0) * 2097152 + (outLow >>> 11)) / 9007199254740992; // the top 53 bits, over 2 ** 53
  }

  /** Let s <- s * M + c: multiplication as on paper, limb by limb, each sum's overflow carried to the next. */
  advance() {
    const s = this.state;
    const c = this.increment;
    const a0 = s[0], a1 = s[1], a2 = s[2], a3 = s[3], a4 = s[4], a5 = s[5];
    let sum = a0 * M0 + c[0];
    let carry = Math.floor(sum / LIMB);
    s[0] = sum - carry * LIMB;
    sum = a0 * M1 + a1 * M0 + c[1] + carry;
    carry = Math.floor(sum / LIMB);
    s[1] = sum - carry * LIMB;
    sum = a0 * M2 + a1 * M1 + a2 * M0 + c[2] + carry;
    carry = Math.floor(sum / LIMB);
    s[2] = sum - carry * LIMB;
    sum = a0 * M3 + a1 * M2 + a2 * M1 + a3 * M0 + c[3] + carry;
    carry = Math.floor(sum / LIMB);
    s[3] = sum - carry * LIMB;
    sum = a0 * M4 + a1 * M3 + a2 * M2 + a3 * M1 + a4 * M0 + c[4] + carry;
    carry = Math.floor(sum / LIMB);
    s[4] = sum - carry * LIMB;
    sum = a0 * M5 + a1 * M4 + a2 * M3 + a3 * M2 + a4 * M1 + a5 * M0 + c[5] + carry;
    s[5] = sum - Math.floor(sum / 256) * 256; // 5 * 24 + 8 = 128 bits
  }
}

/** Return the generator that `rng` (null for a new seed, an integer seed or a Generator) stands for. */
export function generator(rng) {
  if (rng === null || rng === undefined) return new Generator(Math.floor(Math.random() * Number.MAX_SAFE_INTEGER));
  return typeof rng === "object" ? instance("rng", rng, Generator) : new Generator(rng);
}

/** Write a number of 128 bits in limbs. */
function limbs(big) {
  const bits = BigInt.asUintN(128, big);
  return Float64Array.from({ length: 6 }, (_, i) => Number((bits >> BigInt(24 * i)) & 0xffffffn));
}

/** Stir a seed into `n` words of 32 bits, as NumPy's SeedSequence does, so that near seeds give unrelated streams. */
function seedWords(seed, n) {
  const entropy = [seed % 2 ** 32, Math.floor(seed / 2 ** 32), 0, 0];
  let h = 0x43b0d7e5;
  const hash = (value, factor) => {
    const mixed = value ^ h;
    h = Math.imul(h, factor);
    const product = Math.imul(mixed, h);
    return (product ^ (product >>> 16)) >>> 0;
  };
  const mix = (x, y) => {
    const difference = Math.imul(x, 0xca01f9dd) - Math.imul(y, 0x4973f715);
    return (difference ^ (difference >>> 16)) >>> 0;
  };
  const pool = entropy.map((word) => hash(word, 0x931e8875));
  for (let from = 0; from < 4; from++) {
    for (let to = 0; to < 4; to++) {
      if (from !== to) pool[to] = mix(pool[to], hash(pool[from], 0x931e8875));
    }
  }
  h = 0x8b51f9dd;
  return Array.from({ length: n }, (_, i) => hash(pool[i % 4], 0x58f38ded));
}
