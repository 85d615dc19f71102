/**
 * Settings in words: what two scenarios have differently.
 */

const NAMES = {
  map: "Map",
  starts: "Start",
  steering: "Turns",
  slip: "Slip",
  gamma: "Discount γ",
  features: "Perceives",
  algorithm: "Algorithm",
  alpha: "Step size α",
  epsilon: "Exploration ε",
  episodes: "Episodes to learn",
  max_steps: "Step limit",
  Q0: "Initial Q",
  seed: "Seed",
};
const REWARDS = {
  goal: "Reward: goal",
  crash: "Reward: crash",
  step: "Reward: step",
  turn: "Reward: turn",
  progress: "Reward: progress",
  only_closer: "Only closer counts",
  shaping: "Reward: shaping",
};

/** List the settings that differ as [name, of the first, of the second]. */
export function differences(a, b) {
  const settings = Object.entries(NAMES).map(([key, name]) => [name, tell(a, key), tell(b, key)]);
  const rewards = Object.entries(REWARDS).map(([key, name]) => [name, plain(a.reward[key]), plain(b.reward[key])]);
  const different = [...settings, ...rewards].filter(([, first, second]) => first !== second);
  return different.map((setting) => (setting[0] === NAMES.map ? [NAMES.map, "its own", "another"] : setting));
}

function tell(scenario, key) {
  const value = scenario[key];
  if (key === "map") return value.join("\n");
  if (key === "starts") return startsInWords(value);
  if (key === "features") return value === null ? "whole pose" : value.map(featureInWords).join(", ");
  if (key === "algorithm") return words(value);
  if (key === "alpha" || key === "epsilon") return over(scenario, key);
  return Array.isArray(value) ? value.map(plain).join(", ") : plain(value);
}

function startsInWords(starts) {
  if (starts === null) return "anywhere";
  const cells = new Set(starts.map(([x, y]) => `(${x}, ${y})`));
  return starts.length === 1 ? `${[...cells][0]}, ${starts[0][2]}°` : [...cells].join(" ");
}

/** "moves_ahead" -> "moves ahead", ["goal_bearing", 8] -> "goal bearing 8". */
function featureInWords(feature) {
  return [feature].flat(2).map(words).join(" ");
}

/** A number with its schedule: "0.2", or "0.5 → 0.01, linear". */
function over(scenario, key) {
  const kind = scenario[`${key}_schedule`];
  const first = plain(scenario[key]);
  return kind === "constant" ? first : `${first} → ${plain(scenario[`${key}_end`])}, ${kind}`;
}

/** "q_learning" -> "q learning". */
function words(name) {
  return String(name).replaceAll("_", " ");
}

function plain(value) {
  return typeof value === "boolean" ? (value ? "yes" : "no") : String(value).replace("-", "−");
}
