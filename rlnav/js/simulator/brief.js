/**
 * The settings of a group in a few words, beside its title.
 */
import { PRESETS } from "../scenario/edits.js";

export const ALGORITHM_NAMES = {
  q_learning: "Q-learning",
  sarsa: "SARSA",
  expected_sarsa: "Expected SARSA",
  double_q_learning: "Double Q-learning",
  monte_carlo: "Monte Carlo",
};

const BRIEF = {
  world({ map, slip }) {
    const name = Object.keys(PRESETS).find((key) => PRESETS[key].map.join() === map.join()) ?? "your own";
    const title = name[0].toUpperCase() + name.slice(1).replace("_", " ");
    return `${title}, ${map[0].length} × ${map.length}${slip ? `, slip ${slip}` : ""}`;
  },
  design({ features, steering, gamma }, own) {
    const given = features ? counted(features.length, "feature") : "whole pose";
    const state = own.includes("features") ? "features from Python" : given;
    return `${state}, ${counted(steering.length, "turn")}, γ ${gamma}`;
  },
  learner(scenario) {
    const { algorithm, episodes } = scenario;
    const values = `α ${over(scenario, "alpha")}, ε ${over(scenario, "epsilon")}`;
    return `${ALGORITHM_NAMES[algorithm]}, ${values}, ${episodes.toLocaleString("en-US")} episodes`;
  },
  compare: () => "pin a run, carry it over",
  share: () => "link, Python, files",
};

/** Tell a group's settings in brief; `own` names the designs that are functions of the reader's own. */
export function inBrief(key, scenario, own) {
  return BRIEF[key](scenario, own);
}

function counted(n, noun) {
  return `${n} ${noun}${n > 1 ? "s" : ""}`;
}

function over(scenario, key) {
  const falls = scenario[`${key}_schedule`] !== "constant";
  return falls ? `${scenario[key]} → ${scenario[`${key}_end`]}` : String(scenario[key]);
}
