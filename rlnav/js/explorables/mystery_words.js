/**
 * What a driver who knows nothing is told: after each press, and when everything is revealed.
 */
import { BUTTONS } from "../scenario/mystery.js";
import { poseInWords, turnText, written } from "./naming.js";

export const ENDS = {
  "": ["under way", ""],
  goal: ["terminated", "goal"],
  crash: ["terminated", "crash"],
  time: ["truncated", "out of time"],
};

const FELT = {
  goal: { map: "You found the goal", numbers: "That was good" },
  crash: { map: "You hit something", numbers: "That was bad" },
};

/** Tell what the last press has brought. */
export function sentence(mystery, see) {
  const { drive, drives } = mystery;
  const where = placeOf(mystery, mystery.s, see);
  if (!drive.letters) {
    if (drives.length > 1) return `Drive ${drives.length}: the same start, the same buttons, the same hidden goal.`;
    return `You are in ${where}. Press any button: nobody tells you what it does.`;
  }
  return `${drive.letters.at(-1)}: reward ${rewardText(drive.rewards.at(-1))}. ${afterwards(mystery, where, see)}`;
}

function afterwards({ drive, maxSteps }, where, see) {
  const score = `Score ${scoreText(drive.score)}.`;
  const felt = FELT[drive.end]?.[see];
  if (felt) return `${felt}: the drive has terminated. ${score}`;
  const cut = drive.end === "time" ? ` After ${maxSteps} steps the drive is cut off: truncated. ${score}` : "";
  return `You are in ${where}.${cut}`;
}

/** Name a state as the driver perceives it. */
export function placeOf({ task, names }, s, see) {
  return see === "map" ? poseInWords(task.pose(s)) : `state ${names[s]}`;
}

/** Tell what was hidden, and how good the driver was. */
export function truth({ answer, bestNumber, drives, task }) {
  const best = written(answer.score, 2);
  const scores = task.robot.slip ? `, if none of them slips, and scores ${best} on average` : ` and scores ${best}`;
  const mine = drives[bestNumber];
  const yours = mine ? `Your best score is ${scoreText(mine.score)}, in drive ${bestNumber + 1}. ` : "";
  const rare = Number((1 / answer.byChance).toPrecision(2)).toLocaleString("en-US");
  return `The best driver needs ${answer.steps} presses${scores}. ${yours}` +
    `A driver who presses at random finds the goal in one drive of ${rare}.`;
}

/** Tell what each button does: "A is +45°, ...". */
export function buttonsInWords({ answer }) {
  return `${[...BUTTONS].map((letter, i) => `${letter} is ${turnText(answer.steering[i])}`).join(", ")}.`;
}

/** What stands below the letter of a button, and what it means. */
export function noteOf(mystery, letter, { see, revealed }) {
  if (revealed) return turnText(mystery.answer.steering[BUTTONS.indexOf(letter)]);
  if (see === "map") return "?";
  const to = mystery.over ? null : mystery.outcome(mystery.s, letter);
  if (to === null) return "?";
  if (mystery.mdp.terminal[to]) return mystery.mdp.goal[to] ? "+10" : "−10";
  return `→ ${mystery.names[to]}`;
}

/** Write a reward with its sign. */
export function rewardText(r) {
  return r > 0 ? `+${written(r)}` : written(r);
}

/** Write a score: it is a sum of tenths. */
export function scoreText(score) {
  return written(score, 1);
}
