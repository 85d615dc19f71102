/**
 * The designs of the library that a scenario can name: rewards as numbers, features as words.
 */
import { fail, items, show } from "../check.js";
import {
  cell,
  goalBearing,
  goalDirection,
  goalDistance,
  heading,
  movesAhead,
  nearness,
  payment,
  progress,
  shaped,
  total,
} from "../designs.js";

// name in a scenario -> [the function that makes the feature, whether it takes an argument]
const FEATURES = Object.freeze({
  cell: [cell, false],
  heading: [heading, false],
  goal_direction: [goalDirection, false],
  goal_bearing: [goalBearing, true],
  goal_distance: [goalDistance, true],
  moves_ahead: [movesAhead, false],
});

/** Make the features with these names, or null for the whole pose; raise for what is no feature. */
export function featuresOf(recipes) {
  if (recipes === null) return null;
  const list = items("features", recipes, "names of features, or null for the whole pose");
  if (!list.length) fail("features", "at least one feature, or null for the whole pose", "none");
  return list.map(featureOf);
}

function featureOf(recipe) {
  const [name, ...given] = typeof recipe === "string" ? [recipe] : items("features", recipe, "names of features");
  if (typeof name !== "string" || !Object.hasOwn(FEATURES, name)) {
    fail("features", `one of ${Object.keys(FEATURES).join(", ")}`, show(name));
  }
  const [make, takesArgument] = FEATURES[name];
  if (given.length > (takesArgument ? 1 : 0)) {
    fail("features", `'${name}' with ${takesArgument ? "one argument at most" : "no argument"}`, show(recipe));
  }
  return make(...given);
}

/** Make the reward with these numbers; what is 0 is left out, as in the Python that scenario/python.js writes. */
export function rewardOf({ reward, gamma }, world) {
  const paid = payment(reward);
  const gain = progress(world.goal, { weight: reward.progress, onlyCloser: reward.only_closer });
  const played = reward.progress ? total(paid, gain) : paid;
  return reward.shaping ? shaped(played, nearness(world.goal, reward.shaping), gamma) : played;
}
