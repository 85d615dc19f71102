/**
 * What drives have earned and what the policy is worth, in words.
 */
import { FEW } from "../scenario/painted.js";
import { poseInWords, written } from "./naming.js";

/** Tell the mean of the drives beside the exact value. */
export function sentence(pose, { n, mean, sd, half }, v) {
  const worth = `exact value ${written(v, 2)}`;
  const from = `From ${poseInWords(pose)}`;
  if (n === 0) return `${from}, this policy has the ${worth}. What will a single drive earn?`;
  const earned = written(mean, 2);
  if (n === 1) return `${from}, one drive earned ${earned}; the ${worth} is the mean of all that may come.`;
  if (sd < 1e-9) return alike(`${from}, all ${n} drives earned ${earned}`, mean, v);
  const holds = Math.abs(mean - v) <= half ? "holds" : "misses";
  const few = n < FEW ? " Few drives: do not trust this interval yet." : "";
  return `${from}, ${n.toLocaleString("en-US")} drives earned ${earned} on average. The 95 % interval, ` +
    `${written(mean - half, 2)} to ${written(mean + half, 2)}, ${holds} the ${worth}.${few}`;
}

/** Drives without any spread: chance may be out of it, or has only not shown itself yet. */
function alike(so, mean, v) {
  if (Math.abs(mean - v) < 0.005) return `${so}, the exact value ${written(v, 2)}: nothing is left to chance.`;
  return `${so}, and yet the exact value is ${written(v, 2)}: they have not shown all that may come.`;
}

/** Compare with the policy that was kept. */
export function comparison({ better, worse, same }) {
  const counts = `Beside the kept policy: larger value in ${better} poses, smaller in ${worse}, the same in ${same}.`;
  if (better && worse) return `${counts} Neither policy is the better one.`;
  if (better) return `${counts} The painted policy is the better one.`;
  return worse ? `${counts} The kept policy is the better one.` : `${counts} They are equally good.`;
}
