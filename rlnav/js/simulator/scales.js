/**
 * Which numbers the ends of the color scale stand for: fixed for one run, so that a color keeps its meaning.
 */
const LABELS = { value: "best Q of a pose", visits: "visits (powers of 10)", error: "largest error of Q" };

const KNOWN = new WeakMap(); // session -> color -> scale

/** Return { low, high, diverging, label } for what is shown. */
export function scaleOf(session, color) {
  if (color === "visits") return { low: 0, high: Math.max(1, mostVisits(session)), label: LABELS.visits };
  if (!KNOWN.has(session)) KNOWN.set(session, {});
  if (!session.solved) return preliminary(session, color);
  const scales = KNOWN.get(session);
  scales[color] ??= color === "value" ? ofValues(session) : ofErrors(session);
  return scales[color];
}

/** Until the exact values are known, the rewards say how large a value may be. */
function preliminary({ mdp }, color) {
  const high = mdp.reward.reduce((most, r) => Math.max(most, Math.abs(r)), 1e-9);
  const value = color !== "error";
  return { low: value ? -high : 0, high, diverging: value, label: value ? LABELS.value : LABELS.error };
}

function mostVisits(session) {
  let most = 1;
  for (const n of session.visitsPerPose()) if (n > most) most = n;
  return Math.log10(most);
}

/** White where nothing is known, blue for the best that is possible, vermilion for what is as bad as that is good. */
function ofValues({ best, mdp }) {
  const most = best.V.reduce((high, v, s) => (mdp.terminal[s] ? high : Math.max(high, v)), -Infinity);
  const least = best.V.reduce((low, v, s) => (mdp.terminal[s] ? low : Math.min(low, v)), Infinity);
  const high = Math.max(most, most > 0 ? 0 : -least, 1e-9);
  return { low: -high, high, diverging: true, label: LABELS.value };
}

/** From no error up to that of a table in which nothing has been learned. */
function ofErrors({ best, scenario }) {
  const start = scenario?.Q0 ?? 0;
  const high = best.Q.reduce((most, q) => Math.max(most, Math.abs(q - start)), 1e-9);
  return { low: 0, high, label: LABELS.error };
}
