/**
 * What a step of policy iteration has brought, in words.
 */
import { largest } from "../sampling.js";
import { actionValues } from "../mdp.js";
import { IMPROVE, SWEEP } from "../scenario/rounds.js";
import { poseInWords, turnInWords, written } from "./naming.js";

/** Tell what the last step has brought, and what it says about the question. */
export function sentence(rounds) {
  const { now, length, tol } = rounds;
  if (length === 0) return "The first policy, and nothing is known of its values yet: all are 0. Do a sweep, or improve at once.";
  const begin = `Step ${length}:`;
  if (now.kind === SWEEP) {
    const off = rounded(rounds.offPolicy(length));
    const done = now.change <= tol ? " They have settled: nothing but an improvement helps now." : "";
    return `${begin} one sweep. Values changed by up to ${rounded(now.change)}; they are still off by up to ${off} from what ` +
      `this policy is worth.${done}`;
  }
  if (now.kind !== IMPROVE) return "";
  if (rounds.done) return `${begin} improved, and no pose changed its turn; the values had settled. ${ending(rounds)}`;
  if (now.changed === 0) return `${begin} improved, but no pose changed its turn: these values say nothing new. Sweep on.`;
  return `${begin} improved. ${counted(now.changed, "pose")} changed the turn. ${standing(rounds)}`;
}

/** Tell how good the policy is. */
function standing(rounds) {
  const { truth, now, length } = rounds;
  const right = truth.right(now.pi);
  const all = truth.live.length;
  if (right === all) return `Every pose takes a best turn now, although the values are off by ${rounded(rounds.offBest(length))}.`;
  return `${right} of ${all} poses take a best turn now.`;
}

function ending(rounds) {
  const { truth, now } = rounds;
  const best = truth.right(now.pi) === truth.live.length ? "The policy is optimal" : "The policy is nearly optimal";
  return `${best}, after ${counted(rounds.count(SWEEP), "sweep")} and ${counted(rounds.count(IMPROVE), "improvement")}.`;
}

/** Tell what the policy does at a pose, and what an improvement would do. */
export function aboutPose(rounds, s, pose, steering) {
  const { mdp, now } = rounds;
  const where = capital(poseInWords(pose));
  if (mdp.terminal[s]) return `${where}: the goal. Nothing follows, so its value is 0.`;
  const a = now.pi[s];
  const here = `${where}: ${turnInWords(steering[a])}, value ${written(now.V[s], 2)}.`;
  const row = actionValues(mdp, now.V).subarray(s * mdp.A, (s + 1) * mdp.A);
  const most = largest(row, 0, mdp.A);
  const next = row.indexOf(most);
  const old = written(row[a], 2);
  if (!(most - row[a] > 1e-9)) return `${here} By one look-ahead no turn promises more than ${old}, so it would stay.`;
  return `${here} By one look-ahead it promises ${old}; ${turnInWords(steering[next])} promises ${written(most, 2)}.`;
}

function counted(n, word) {
  return `${n} ${word}${n === 1 ? "" : "s"}`;
}

function capital(text) {
  return text[0].toUpperCase() + text.slice(1);
}

/** Write a number with two digits that count. */
export function rounded(value) {
  return value < 1e-9 ? "0" : written(Number(value.toPrecision(2)), 12);
}
