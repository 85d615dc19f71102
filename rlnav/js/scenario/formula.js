/**
 * The last update as a line of its algorithm: the symbols, and the numbers that they stand for in this step.
 */

const ENTRY = "Q(S, A)";

// what stands for the future in the target
const NEXT = {
  q_learning: "max Q(S′, ·)",
  sarsa: "Q(S′, A′)",
  expected_sarsa: "Σ π(·|S′) Q(S′, ·)",
};

/**
 * Return { tokens, target, tdError, note, waits }, or null before the first update. A token is { text }, a sign, or
 * { role, symbol, value }: the role is after, before, alpha, reward, gamma, next, or target. `waits` is true while an
 * algorithm learns nothing because the episode is not over.
 */
export function formulaOf(learner, algorithm) {
  if (!learner.updates || !learner.last) return null;
  const { last } = learner;
  const waits = algorithm === "monte_carlo" && !learner.over;
  const tokens = algorithm === "monte_carlo" ? towardsReturn(learner) : towardsTarget(learner, algorithm);
  return { tokens, target: last.target, tdError: last.tdError, note: noteOf(learner, algorithm, waits), waits };
}

function towardsTarget({ last, alphaNow }, algorithm) {
  const [own, other] = last.table === 0 ? ["Q₁", "Q₂"] : ["Q₂", "Q₁"];
  const double = algorithm === "double_q_learning";
  const entry = double ? `${own}(S, A)` : ENTRY;
  const next = double ? `${other}(S′, argmax ${own}(S′, ·))` : NEXT[algorithm];
  const aim = [
    part("reward", "R", last.r),
    sign("+"),
    part("gamma", "γ", last.gamma),
    sign("·"),
    part("next", next, last.next),
  ];
  return line(entry, last, alphaNow, aim);
}

function towardsReturn({ last, alphaNow }) {
  return line(ENTRY, last, alphaNow, [part("target", "G", last.target)]);
}

/** entry ← entry + α [ aim − entry ] */
function line(entry, { before, after }, alpha, aim) {
  return [
    part("after", entry, after),
    sign("←"),
    part("before", entry, before),
    sign("+"),
    part("alpha", "α", alpha),
    sign("["),
    ...aim,
    sign("−"),
    part("before", entry, before),
    sign("]"),
  ];
}

/** What is special about this step, in a sentence; "" if nothing is. */
function noteOf({ last, mdp, over }, algorithm, waits) {
  if (waits) return "Monte Carlo waits for the end of the episode: then it learns from every step, backwards.";
  const what = mdp.goal[last.sNext] ? "goal" : "crash";
  if (mdp.terminal[last.sNext]) return `Nothing follows the ${what}: γ is 0 in this step.`;
  if (!over) return "";
  if (algorithm === "monte_carlo") return "Out of steps: the value of the last state and action stands for the rest.";
  return "Out of steps. The robot could have gone on, so the next value counts as ever.";
}

function part(role, symbol, value) {
  return { role, symbol, value };
}

function sign(text) {
  return { text };
}
