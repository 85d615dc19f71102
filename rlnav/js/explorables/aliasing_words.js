/**
 * What the robot perceives and what may follow, in words.
 */
import { SAME } from "../scenario/history.js";
import { ARROWS, poseText, turnInWords } from "./naming.js";

/** Name an observation: { short, words }; `short` is an arrow where there is one, seen from the cell `here`. */
export function named(o, perceive, { goal, crash, task: { world } }, here) {
  if (o === goal) return { short: "★", words: "the goal" };
  if (o === crash) return { short: "✕", words: "a crash" };
  if (perceive === "heading") return { short: ARROWS[o], words: `heading ${45 * o}° ${ARROWS[o]}` };
  const cell = perceive === "cell" ? o : Math.floor(o / 8);
  const [x, y] = [cell % world.width, Math.floor(cell / world.width)];
  if (perceive === "pose") {
    const words = poseText({ x, y, theta: 45 * (o % 8) });
    return { short: words, words };
  }
  const turn = Math.round(Math.atan2(y - here.y, x - here.x) / (Math.PI / 4));
  return { short: ARROWS[(turn + 8) % 8], words: `(${x}, ${y})` };
}

/** Tell whether the past helps here, and on the whole map. */
export function verdict(look, forecast, count, { perceive, pose, turn }) {
  const s = look.task.index(pose);
  const twins = look.alike(s).length;
  const seen = perceive === "cell" ? "only the cell" : perceive === "heading" ? "only the" : "the pose";
  const alike = twins === 1 ? "which no other pose shares" : `which ${twins} poses share`;
  const what = `It perceives ${seen} ${named(look.phi[s], perceive, look, pose).words}, ${alike}`;
  const { helped, of } = count;
  const markov = helped === 0 ? "Markov." : "Not Markov.";
  return `${markov} ${what}. ${here(look, forecast, { perceive, pose, turn })} ${onTheMap(helped, of, forecast.most)}`;
}

function here(look, { all, rows, most }, { perceive, pose, turn }) {
  if (!rows.length) return "No step leads here, so there is no past to ask.";
  const steers = turn === 0 ? "If it drives straight on" : `With a ${turnInWords(turn)}`;
  if (most <= SAME) {
    const chance = all.next.size > 1 ? " Chance is left, but the past does not help against it." : "";
    return `${steers}, the forecast is the same whatever it perceived before.${chance}`;
  }
  const { h, o, p, q } = largestChange(all, rows);
  const name = (one) => named(one, perceive, look, pose).words;
  const before = perceive === "heading" ? `its ${name(h)} before` : `it came from ${name(h)}`;
  return `${steers}, the chance of ${name(o)} is ${percent(q)}; knowing ${before}, it is ${percent(p)}.`;
}

function onTheMap(helped, of, most) {
  if (helped === 0) return `The past adds nothing in any of the ${of} situations on this map.`;
  const so = most > SAME ? "So the past helps, here and" : "Here the past adds nothing, but it helps";
  return `${so} in ${helped} of ${of} situations on this map.`;
}

/** The largest change of a chance that a row brings: from q to p, of the observation o. */
function largestChange(all, rows) {
  let best = { size: -1 };
  for (const { h, next } of rows) {
    for (const o of new Set([...next.keys(), ...all.next.keys()])) {
      const [p, q] = [next.get(o) ?? 0, all.next.get(o) ?? 0];
      if (Math.abs(p - q) > best.size + SAME) best = { size: Math.abs(p - q), h, o, p, q };
    }
  }
  return best;
}

/** Tell two steps that were drawn. */
export function drive(look, { before, s, next }, n) {
  const [first, now, then] = [before, s, next].map((state) => look.task.pose(state));
  const end = look.mdp.goal[next] ? "at the goal" : then ? `at ${poseText(then)}` : "crashed";
  return `Drive ${n.toLocaleString("en-US")}: it came from ${poseText(first)}, was at ${poseText(now)}, and is ${end}.`;
}

/** Write a chance. */
export function percent(p) {
  const text = (100 * p).toFixed(p > 0.0005 && p < 0.0995 ? 1 : 0);
  return `${text.replace(/\.0$/, "")} %`;
}
