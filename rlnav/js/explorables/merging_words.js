/**
 * What the last drive has taught, in words.
 */
import { written } from "./naming.js";

/** Name the roads: "left road" and "right road" where there are two side by side, or after their first cells. */
export function roadNames({ roads }, task) {
  const poses = roads.map((s) => task.pose(s));
  const [a, b] = poses;
  if (poses.length === 2 && a.x !== b.x) return a.x < b.x ? ["left road", "right road"] : ["right road", "left road"];
  return poses.map(({ x, y }) => `road from (${x}, ${y})`);
}

/** Tell what is known after k drives. */
export function sentence({ merging, moments, k, names, batch }) {
  if (k === 0) {
    const recorded = `${moments.length - 1} drives are recorded; press “Next drive” to learn from the first.`;
    return `No drive yet: both tables are 0. ${moments.length > 1 ? recorded : "Choose a road."}`;
  }
  const { drive, mc, td } = moments[k];
  const s = merging.roads[drive.road];
  const exact = `The exact value is ${say(merging.exact[s])}.`;
  const told = `Drive ${k}, ${names[drive.road]}: ${ending(merging, drive)}, return ${say(drive.G)}.`;
  if (batch) return `${told} Learned again and again, ${rest(merging, moments, k, names)}`;
  const before = moments[k - 1];
  const moved = (from, to) =>
    from[s] === to[s] ? `left the value at ${say(to[s])}` : `moved the value from ${say(from[s])} to ${say(to[s])}`;
  return `${told} At the start of this road Monte Carlo ${moved(before.mc, mc)}; TD ${moved(before.td, td)}. ${exact}`;
}

/** Tell where both tables come to rest. */
function rest({ roads, exact }, moments, k, names) {
  const { mc, td } = moments[k];
  const drives = moments.slice(1, k + 1).map(({ drive }) => drive);
  const each = names.map((name, road) => {
    const n = drives.filter((drive) => drive.road === road).length;
    if (!n) return `the ${name} was never driven, so both leave it at 0.`;
    const own = n === 1 ? "of its own drive" : `of its own ${n} drives`;
    const [byMc, byTd, truly] = [mc, td, exact].map((V) => say(V[roads[road]]));
    return `the ${name} is worth ${byMc} to Monte Carlo, the mean ${own}, and ${byTd} to TD (exact: ${truly}).`;
  });
  return each.join(" ").replace(/\. the/g, ". The");
}

function ending({ mdp }, { states, rewards, terminated }) {
  const steps = rewards.length === 1 ? "1 step" : `${rewards.length} steps`;
  if (!terminated) return `out of time after ${steps}`;
  return mdp.goal[states.at(-1)] ? `the goal after ${steps}` : `a crash in step ${rewards.length}`;
}

function say(value) {
  return written(value, 2);
}
