/**
 * What a reward asks for, in words.
 */
import { written } from "./naming.js";

const SAME = 1e-9; // as where a policy is read off: what differs by less is equally good

/** Write a number with two digits after the point and its sign. */
export function signed(value) {
  const text = written(value, 2);
  return value > 0 && text !== "0" ? `+${text}` : text;
}

/** Say what the robot does that is paid by this reward, and whether it is what the task asks for. */
export function verdict(mix) {
  return `${fate(mix)} ${comparison(mix)}`;
}

function fate({ drive, asked, worth: [[here, there]] }) {
  const n = drive.actions.length;
  const after = `after ${n} step${n === 1 ? "" : "s"}`;
  if (drive.end === "goal") return `It arrives ${after}.`;
  if (drive.end === "circle") {
    const { from, length, paid } = drive.loop;
    const late = from > 0 ? `, from step ${from} on` : "";
    return `It circles for ever${late}: each round of ${length} steps pays ${signed(paid)}, and the goal is not in it.`;
  }
  if (asked.end === "crash") return `It crashes ${after}: from this pose nothing can prevent it.`;
  const why = `that is worth ${signed(here)} by this reward, the drive to the goal ${signed(there)}`;
  return here - there > SAME ? `It drives into the wall on purpose, ${after}: ${why}.` : `It crashes ${after}.`;
}

function comparison({ drive, worth: [[here, there], [real, best]] }) {
  if (best - real <= SAME) return "The task could not ask for more.";
  const loss = `By the task this is worth ${signed(real)}, and the best drive ${signed(best)}.`;
  if (here - there > SAME) return loss;
  const blind = drive.end === "goal" ? "a shorter way" : "the way to the goal";
  return `${loss} This reward does not care: it pays exactly as much for ${blind}.`;
}

/** Tell how far the drive has come; `paid` holds the two returns so far. */
export function tally(mix, t, paid) {
  if (t === 0) return "";
  const { loop } = mix.drive;
  const round = loop && t > loop.from ? `, round ${Math.floor((t - loop.from - 1) / loop.length) + 1}` : "";
  return `Step ${t}${round}. Return so far: ${signed(paid[0])} by this reward, ${signed(paid[1])} by the task.`;
}
