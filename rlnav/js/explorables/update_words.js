/**
 * What one step was, and what it has taught, in words.
 */
import { poseText, turnInWords, written } from "./naming.js";

const ENDS = { goal: "The goal is reached", crash: "The robot has crashed" };

/** Tell the step after which a learner stands, without what it has taught; `parts` is that of partsOf. */
export function stepInWords({ learner, parts, task }) {
  const episode = learner.over ? learner.episode : learner.episode + 1;
  const turn = task.robot.steering[parts.a];
  const choice = `chose to ${turn === 0 ? "drive " : ""}${turnInWords(turn)}`;
  const got = `${parts.r > 0 ? "+" : ""}${written(parts.r)}`;
  const place = poseText(task.pose(parts.s));
  return `Update ${learner.updates}, episode ${episode}: at ${place} the robot ${choice}, and got ${got}.`;
}

/** Tell the step and what it has taught; `careless` says that the rule forgets what an end is. */
export function updateInWords({ learner, parts, task }, careless) {
  if (!parts) return "Nothing is learned yet. Take one step: the robot drives, and one entry of its table changes.";
  const words = [stepInWords({ learner, parts, task }), `The entry ${changeInWords(parts)}.`];
  return [...words, ...endInWords(parts.end, careless)].join(" ");
}

function changeInWords({ before, after, tdError }) {
  const [old, now] = [written(before), written(after)];
  if (old !== now) return `${tdError > 0 ? "rises" : "falls"} from ${old} to ${now}`;
  return before === after ? `stays ${now}` : `hardly moves: it stays near ${now}`;
}

function endInWords(end, careless) {
  if (end === "") return [];
  if (end === "time") return ["Time ran out, but the road goes on, so the next row counts as always."];
  if (careless) return [`${ENDS[end]}, and the careless rule adds what the table says of the end.`];
  return [`${ENDS[end]}: nothing follows the end, so γ is 0 and only the reward counts.`];
}
