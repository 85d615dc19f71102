/**
 * What the game has shown so far, in words.
 */
import { STRATEGIES } from "../scenario/bandit.js";
import { turnText, written } from "./naming.js";

/** Tell the player what is known, without telling the truth. */
export function playing({ arms, turns, rewards, steering }) {
  const t = turns.length;
  if (t === 0) return "The robot stands here, and each turn pays something else on average. Take one, and see what it pays.";
  const last = `${turnText(steering[turns[t - 1]])} paid ${written(rewards[t - 1], 1)}.`;
  const untried = arms.filter(({ n }) => n === 0).length;
  if (untried) return `${last} ${untried === 1 ? "One turn is" : `${untried} turns are`} still untried.`;
  const order = arms.map((arm, a) => ({ ...arm, a })).sort((one, other) => other.mean - one.mean);
  const [first, second] = order;
  const sure = first.mean - first.off > Math.max(...order.slice(1).map(({ mean, off }) => mean + off));
  const leads = `${turnText(steering[first.a])} leads with a mean of ${written(first.mean, 2)}`;
  if (sure) return `${last} ${leads}, and its line lies above all others.`;
  return `${last} ${leads}, but it may still be another one, such as ${turnText(steering[second.a])}.`;
}

/** Tell what it has cost: the player, and the strategies on the same luck. */
export function revealed({ arms, turns, regret, steering, results }) {
  const best = arms.reduce((most, { value }, a) => (value > arms[most].value ? a : most), 0);
  const truth = `The best turn is ${turnText(steering[best])}, worth ${written(arms[best].value, 2)} on average.`;
  if (!turns.length) return `${truth} You have not tried any; the strategies have.`;
  const t = turns.length;
  const yours = `You took it ${arms[best].n} of ${t} times and lost ${written(regret[t - 1], 1)}.`;
  const rivals = Object.entries(results).map(([name, { mine }]) => `${STRATEGIES[name].name} ${written(mine, 1)}`);
  return `${truth} ${yours}${rivals.length ? ` On the same luck: ${rivals.join(", ")}.` : ""}`;
}
