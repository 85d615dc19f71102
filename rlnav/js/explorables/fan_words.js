/**
 * The steering fan in words: where the robot can be, what it hits, and what comes of a turn that it is told.
 */
import { poseInWords, turnInWords, turnText } from "./naming.js";

const HIT = { edge: "the edge of the map", obstacle: "an obstacle", corner: "a corner that it would cut" };

/** Tell how far the robot can come within k steps, and how far it has to the goal. */
export function sentence(reach, k) {
  return `${howFar(reach, k)} ${toGoal(reach)}`;
}

function howFar(reach, k) {
  if (k === 0) return "Before the first step there is one pose.";
  const { poses, cells } = reach.within(k);
  const { A } = reach.mdp;
  const { crash } = reach.ends(k);
  const where = `Within ${count(k, "step")}: ${count(poses, "pose")} on ${count(cells, "cell")}.`;
  const ways = A === 1 ? "The one way to steer" : `the ${count(A ** k, "way")} to steer`;
  if (crash >= 1 - 1e-12) return `${where} Every way to steer ends in a crash by then.`;
  if (crash === 0) return `${where} ${A === 1 ? `${ways} does not crash` : `None of ${ways} crashes`}.`;
  return `${where} Of ${ways}, ${percent(crash)} end in a crash.`;
}

function toGoal({ toGoal: steps }) {
  return Number.isFinite(steps) ? `The goal is ${count(steps, "step")} away.` : "From here the goal cannot be reached.";
}

/** Tell the moves of one step, or what comes of the turn that is told. */
export function movesInWords(fan, chances, told) {
  if (told === null) return `Moves of one step: ${fan.map(move).join("; ")}.`;
  const likely = fan.map((one, i) => [one, chances[i]]).filter(([, p]) => p > 0).sort(([, p], [, q]) => q - p);
  return `Told “${turnInWords(told)}”, it does: ${likely.map(([one, p]) => `${percent(p)} ${move(one)}`).join("; ")}.`;
}

function move({ a, to, crash, goal }) {
  const end = crash ? `hits ${HIT[crash]}` : goal ? "reaches the goal" : `to ${poseInWords(to)}`;
  return `${turnText(a)} ${end}`;
}

function percent(share) {
  const part = 100 * share;
  return `${part < 1 && part > 0 ? "less than 1" : Math.round(part)} %`;
}

function count(n, noun) {
  return `${n.toLocaleString("en-US")} ${noun}${n === 1 ? "" : "s"}`;
}
