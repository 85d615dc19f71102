/**
 * What has happened in a run, in a sentence: for those who listen, and for the line below the map.
 */

/** Tell how the last episode ended, or the last step of one that goes on. */
export function sentenceOf({ learner, mdp, isPlayback }) {
  if (learner.updates === 0) return "The robot knows nothing yet.";
  if (isPlayback || learner.over) return ended(learner, isPlayback ? learner.success[learner.episode - 1] : null, mdp);
  const { last, t, episode } = learner;
  const error = Number.isNaN(last.tdError) ? "nothing is learned before its end" : `TD error ${signed(last.tdError)}`;
  return `Episode ${grouped(episode + 1)}, step ${t}: reward ${signed(last.r)}, ${error}.`;
}

function ended({ episode, steps, returns, stops }, success, mdp) {
  const e = episode - 1;
  const n = `${grouped(steps[e])} ${steps[e] === 1 ? "step" : "steps"}`;
  const reached = success ?? mdp.goal[stops[e]];
  const crashed = stops && mdp.terminal[stops[e]];
  const failed = crashed ? `crashed after ${n}` : `ended after ${n} without the goal`;
  const what = reached ? `reached the goal in ${n}` : failed;
  return `Episode ${grouped(episode)}: ${what}, return ${signed(returns[e])}.`;
}

/** Write a number with two decimals at most, and a minus sign that is read out as one. */
function signed(x) {
  const text = String(Number(Math.abs(x).toFixed(2)));
  return x < 0 && text !== "0" ? `−${text}` : text;
}

function grouped(n) {
  return n.toLocaleString("en-US");
}
