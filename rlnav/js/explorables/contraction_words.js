/**
 * What a backup has done to the difference of two guesses, in words.
 */
import { poseInWords, written } from "./naming.js";

/** Tell what backup k of a pair has brought. */
export function sentence(pair, k, task) {
  const [before, now] = [pair.distances[k - 1], pair.distances[k]];
  if (pair.distances[0] === 0) return "V and W are the same guess, and stay the same. Choose another one.";
  const where = poseInWords(task.pose(pair.places[k]));
  if (k === 0) return `Two guesses, ${rounded(now)} apart at most. What does one backup make of them?`;
  const ending = k === pair.length && pair.agreed;
  if (ending) return `Backup ${k}: V and W agree in every pose. Whatever was guessed is forgotten.`;
  const { gamma } = pair.mdp;
  const factor = now / before;
  const kept = Math.abs(factor - gamma) < 5e-7 ? "just what γ promises" : `γ promises ${written(gamma, 2)} or less`;
  return `Backup ${k}: ${rounded(now)} apart at most, ${rounded(factor)} times what it was; ${kept}. ` +
    `They differ most at ${where}.`;
}

/** Write a number with three digits that count. */
export function rounded(value) {
  return written(Number(value.toPrecision(3)), 12);
}
