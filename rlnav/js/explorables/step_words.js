/**
 * What a schedule of step sizes does, in words.
 */
import { verdictOf } from "../scenario/step_sizes.js";
import { written } from "./naming.js";
import { summary } from "./step_picture.js";

/** Say why each condition holds or fails. */
export function because({ kind, c, p, until }) {
  const value = (x) => written(Number(x.toPrecision(3)), 4);
  if (kind === "constant") {
    const square = `${value(c)}² = ${value(c * c)}`;
    return { first: `every update adds ${value(c)}`, second: `every update adds ${square}, without an end` };
  }
  if (kind === "power") {
    const sum = (power) => (power === 0 ? "Σ 1" : `Σ 1 / n${power === 1 ? "" : `^${value(power)}`}`);
    const [exponent, square] = [sum(p), sum(2 * p)];
    return {
      first: `${exponent} ${p <= 1 ? "has no limit, as p ≤ 1" : "has a limit, as p > 1"}`,
      second: `${square} ${2 * p > 1 ? "has a limit, as 2p > 1" : "has no limit, as 2p ≤ 1"}`,
    };
  }
  if (kind === "linear") {
    const end = `from update ${until + 1} on, all steps are 0`;
    return { first: `${end}; the sum stops at ${value((c * (until + 1)) / 2)}`, second: end };
  }
  return {
    first: `c · ${until} · (1 + 1/2 + 1/4 + …) = ${value(2 * c * until)}`,
    second: `c² · ${until} · (1 + 1/4 + 1/16 + …) = ${value((4 / 3) * c * c * until)}`,
  };
}

/** Tell where the runs are, and where they go in the long run. */
export function sentence({ study, settings, entry, watch, shown }) {
  const verdict = verdictOf(settings);
  const long = verdict.first && verdict.second ? settles() : verdict.first ? trembles(settings, entry, watch) : stops();
  if (shown === 0) return `Nothing is learned yet. Press “Run”. ${long}`;
  const { mean, low, high } = summary(study, shown);
  const now = (list) => written(list[shown], 2);
  const updates = `${shown} ${shown === 1 ? "update" : "updates"}${watch === "table" ? " of each entry" : ""}`;
  const exact = written(entry.exact, 2);
  const entryNow = `the runs stand between ${now(low)} and ${now(high)}; exact is ${exact}`;
  const found = watch === "entry" ? entryNow : `the mean error is ${now(mean)}`;
  return `After ${updates} ${found}. ${long}`;
}

function settles() {
  return "In the long run it settles at the exact value: both conditions hold.";
}

/** A constant step has a floor that can be told; slower ones have one that shrinks too slowly to be sure. */
function trembles({ kind, c, p }, { noise }, watch) {
  if (kind === "power" && p > 0) return "The steps shrink too slowly for the theorem to promise that it settles.";
  const floor = written(Math.sqrt(c / (2 - c)) * noise, 2);
  const trembles = watch === "entry" ? `it trembles by ±${floor} (one standard deviation)` : "the table trembles";
  return `It never settles: in the long run ${trembles}, because the second condition fails.`;
}

function stops() {
  return "The steps end too early: what is wrong when they have ended stays wrong. The first condition fails.";
}
