/**
 * Signs on buttons: strokes on a field of 24 by 24, in the color of the text beside them.
 */
import { svg } from "./dom.js";

const STROKES = {
  play: "M7 4.5 19 12 7 19.5z",
  pause: "M8 5v14M16 5v14",
  step: "M6 5.5 14 12 6 18.5zM18 5.5v13",
  back: "M18 5.5 10 12 18 18.5zM6 5.5v13",
  episode: "M4 5.5 11 12 4 18.5zM12 5.5 19 12 12 18.5z",
  train: "M13 3 5 13.5h6L10 21l9-11h-6z",
  reset: "M5 12a7 7 0 1 0 2.2-5.1M5 4v4h4",
  brush: "M4 4h16v16H4zM4 12h16M12 4v16",
  eraser: "M9 19.5h11M4 15 14 5l6 6-8.5 8.5H8z",
  flag: "M12 3.5 14.6 9l6 .8-4.4 4.2 1.1 6-5.3-2.9L6.700 20l1.100-6L3.400 9.800l6-.8z",
  robot: "M20 12 5 18l3-6-3-6z",
  pin: "M9 4h6l-1 6 3 3H7l3-3zM12 13v7",
  share: "M8 12h8M9.500 8H8a4 4 0 0 0 0 8h1.500M14.500 8H16a4 4 0 0 1 0 8h-1.500",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  save: "M12 4v11M7 10.500l5 5 5-5M4 20h16",
  open: "M12 15.500v-11M7 9l5-5 5 5M4 20h16",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  close: "M6 6l12 12M18 6 6 18",
  info: "M12 11v6M12 7.200v.1M12 3a9 9 0 1 0 .01 0z",
  more: "M6 12h.01M12 12h.01M18 12h.01",
};

/** Return the names of all signs. */
export function iconNames() {
  return Object.keys(STROKES);
}

/** Draw a sign; it says nothing to a screen reader, the button's text does. */
export function icon(name) {
  if (!STROKES[name]) throw new RangeError(`\`icon\` must be one of ${iconNames().join(", ")}; got "${name}".`);
  return svg("svg", { class: "rl-icon", viewBox: "0 0 24 24", "aria-hidden": true }, svg("path", { d: STROKES[name] }));
}
