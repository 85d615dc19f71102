/**
 * The feature picker in words: what a table mixes up, and what it is worth once it is learned.
 */
import { MAPS } from "../scenario/school.js";
import { poseText, turnInWords } from "./naming.js";

/** Tell how many situations there are, how many are met, and how many mix what should be kept apart. */
export function beforeTraining({ rows, met, mixed }) {
  const here = met === rows ? "all of them" : grouped(met);
  const size = `It can tell ${count(rows, "situation")} apart, and meets ${here} on this map.`;
  if (mixed === 0) return `${size} In each of them one turn is best for all of its poses: this table can be perfect.`;
  const part = mixed === met ? "All" : mixed === 1 ? "One" : grouped(mixed);
  const some = `${part} of these ${mixed === 1 ? "mixes" : "mix"}`;
  return `${size} ${some} poses that need different turns.`;
}

/** Tell what a learned table is worth, here and elsewhere. */
export function afterTraining({ variety, features, home, away }, possible) {
  const where = variety === "many" ? `on ${MAPS} random maps` : "on this map";
  const here = `Learned ${where}. Here it reaches the goal from ${percent(home.success)} of all poses; ` +
    `${percent(possible)} is the best possible.`;
  if (!features) return `${here} To other maps it cannot go: its rows are the poses of this one.`;
  return `${here} On ${MAPS} maps that it has never seen: ${percent(away.success)} of ${percent(away.possible)}.`;
}

/** Tell two poses that look alike. */
export function pairInWords({ pair: [a, b], turns: [first, second] }, place, pairs) {
  const where = `A at ${poseText(a)} and B at ${poseText(b)} share a row.`;
  return `${place + 1} of ${pairs}: ${where} Best at A: ${turnInWords(first)}. Best at B: ${turnInWords(second)}.`;
}

/** Tell the drive that is shown. */
export function driveInWords({ goal, crashed, steps }) {
  const n = count(steps, "step");
  return goal ? `It arrives in ${n}.` : crashed ? `It crashes in step ${steps}.` : `After ${n} it is still under way.`;
}

export function percent(share) {
  return `${Math.round(100 * share)} %`;
}

export function grouped(n) {
  return n.toLocaleString("en-US");
}

function count(n, noun) {
  return `${grouped(n)} ${noun}${n === 1 ? "" : "s"}`;
}
