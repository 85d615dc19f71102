/**
 * What is measured: curves over the episodes, and the exact scores of what the robot would do now.
 */
import { number, segmented } from "../views/controls.js";
import { CurveView } from "../views/curve.js";
import { h } from "../views/dom.js";
import { changes, put } from "./fields.js";
import { CURVES, grouped, SCORES } from "./measures.js";

const MOST_SEEDS = 9;
const REST = 800; // milliseconds between two evaluations while the table moves on
const LEAST = 1e-6; // what a TD error is at least, on an axis of powers of ten

/** Build the section "Metrics". */
export function metricsPanel(app) {
  const curve = curves(app);
  const score = scores(app);
  return {
    element: h("section", { class: "rl-metrics", "aria-label": "Metrics" }, curve.element, score.element),
    refresh() {
      curve.refresh();
      score.refresh();
    },
  };
}

/** One curve at a time, with the band of other seeds and the pinned run. */
function curves(app) {
  const set = (patch) => app.setView({ panels: { ...app.view.panels, ...patch } });
  const which = segmented({
    label: "Curve",
    hideLabel: true,
    options: CURVES.map(({ key, name, meaning }) => [key, name, meaning]),
    value: CURVES[0].key,
    onChange: (key) => set({ curve: key }),
  });
  which.element.dataset.key = "curve";
  const seeds = number({
    label: "Other seeds beside it",
    min: 0,
    max: MOST_SEEDS,
    step: 1,
    value: 0,
    onChange: (n) => set({ seeds: n }),
  });
  seeds.element.dataset.key = "seeds";
  const place = h("div", { class: "rl-curve-place" });
  const view = new CurveView(place, { label: "Learning curve", xLabel: "episode", height: 190 });
  app.stage.onCleanup(() => view.destroy());
  const meaning = h("p", { class: "rl-help" });
  const below = h("div", { class: "rl-curve-below" }, meaning, seeds.element);
  const others = (ms) => {
    const more = app.session.bandSlice(ms, wanted(app).seeds);
    if (!more) app.refresh();
    return more;
  };
  const changed = changes();
  return {
    element: h("div", { class: "rl-stack" }, which.element, place, below),
    refresh() {
      const { session, pinned } = app;
      const now = wanted(app);
      if (which.value !== now.curve) which.value = now.curve;
      if (seeds.value !== now.seeds) seeds.value = now.seeds;
      const done = session.band?.done ?? 0;
      const free = session.updates && (app.playing || !session.stale); // the scores come first
      if (free && done < now.seeds && !session.isPlayback) app.chore(others);
      if (!changed(session, session.updates, session.episodes, done, now.curve, now.seeds, pinned)) return;
      seeds.disabled(session.isPlayback ? "A run from Python stands alone." : "");
      const measure = CURVES.find(({ key }) => key === now.curve);
      Object.assign(view, { label: measure.name, yLabel: measure.axis });
      meaning.textContent = session.series(measure.key) ? measure.meaning : "Not known of a run from Python.";
      view.draw(drawing(session, pinned, measure, now.seeds));
    },
  };
}

/** The settings of this panel; those of a link may be anything. */
function wanted({ view }) {
  const { curve, seeds } = view.panels;
  const known = CURVES.some(({ key }) => key === curve);
  const fits = Number.isInteger(seeds) && seeds >= 0 && seeds <= MOST_SEEDS;
  return { curve: known ? curve : CURVES[0].key, seeds: fits ? seeds : 0 };
}

/** What the curve shows: this run, the band of other seeds, and the pinned run as a second line in dashes. */
function drawing(session, pinned, { key, log = false, yRange = null }, seeds) {
  const lifted = ({ x, y }) => ({ x, y: log ? y.map((v) => Math.max(v, LEAST)) : y });
  const now = session.series(key);
  const series = now ? [{ name: "This run", ...lifted(now), color: "var(--rl-series-1)", dash: "" }] : [];
  const band = seeds ? session.bandOf(key) : null;
  if (band) {
    const name = `${band.runs} other seeds, middle 80 %`;
    const edges = [band.low, band.high].map((y) => lifted({ x: band.x, y }).y);
    series.unshift({ name, x: band.x, y: band.x.map(() => NaN), band: edges, color: "var(--rl-series-1)", dash: "" });
  }
  const before = pinned?.series[key];
  if (before) series.push({ name: "Pinned run", ...lifted(before), color: "var(--rl-series-2)", dash: "8 3" });
  return { series, log, yRange, xRange: [0, Math.max(session.episodes, pinned?.episodes ?? 0)] };
}

/** The exact scores of the greedy policy, computed in spare time. */
function scores(app) {
  const cells = SCORES.map(() => h("td", { class: "rl-score" }));
  const rows = SCORES.map(({ name, meaning }, i) => {
    const explained = h("td", { class: "rl-score-meaning", text: meaning });
    return h("tr", {}, h("th", { scope: "row", text: name }), cells[i], explained);
  });
  const title = h("h3", { class: "rl-subtitle", text: "If it drove now, without exploring" });
  const state = h("p", { class: "rl-help" });
  const caption = h("caption", { class: "rl-hidden", text: title.textContent });
  const table = h("table", { class: "rl-scores" }, caption, h("tbody", {}, rows));
  const element = h("div", { class: "rl-stack" }, title, table, state);
  element.dataset.key = "scores";
  let next = 0;
  const compute = (ms) => {
    if (!app.playing) return false; // then the app itself sees to it
    const more = app.session.evaluateSlice(ms);
    if (!more) next = performance.now() + REST;
    return more;
  };
  return {
    element,
    refresh() {
      const { session, playing } = app;
      if (playing && session.stale && performance.now() > next) app.chore(compute);
      const { evaluation } = session;
      const known = evaluation !== null && session.updates > 0;
      SCORES.forEach(({ key, tell }, i) => put(cells[i], known ? tell(evaluation[key]) : "–"));
      element.classList.toggle("rl-stale", known && session.stale && !playing);
      put(state, stateOf(session, known, playing));
    },
  };
}

/** Say what the scores are of, and whether newer ones are on their way. */
function stateOf(session, known, playing) {
  if (!session.updates) return "Exact numbers, as soon as it has learned something.";
  if (!known) return "Being computed …";
  const { why, updates } = session.evaluation;
  if (why) return why;
  if (!session.stale) return "Exact: all starts and all luck weighed, not a sample.";
  return playing ? `Exact, as of update ${grouped(updates)}; it learns on.` : "Being computed anew …";
}
