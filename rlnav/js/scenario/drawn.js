/**
 * A map and its starts as short text for an address: letters, digits and marks that every program leaves as they are.
 * `10o_2oxoG5o` are two rows, the top one first: o free, x obstacle, G goal, a number repeats the next letter.
 */
import { fail, show } from "../check.js";
import { HEADINGS } from "../robot.js";
import { SIDES } from "./scenario.js";

const LETTERS = { ".": "o", "#": "x", G: "G" };
const SYMBOLS = { o: ".", x: "#", G: "G" };
const EXPECTED = "rows of letters o, x and one G, such as 10o_4oG5o";

/** Write the rows of a map. */
export function writeMap(rows) {
  const short = (run) => `${run.length > 1 ? run.length : ""}${LETTERS[run[0]]}`;
  return rows.map((row) => row.match(/(.)\1*/g).map(short).join("")).join("_");
}

/** Read the rows of a map. */
export function readMap(text) {
  const rows = text.split("_");
  const fits = rows.length <= SIDES.most && rows.every((row) => /^(\d{0,2}[oxG])+$/.test(row));
  if (!fits) fail("map", EXPECTED, show(text), "Presets go by their names: maze.");
  const long = (_, n, letter) => SYMBOLS[letter].repeat(n === "" ? 1 : Number(n));
  return rows.map((row) => row.replace(/(\d*)([oxG])/g, long));
}

/** Write starts: `2,2` with any heading, `2,2,90` with one, joined by `_`; `any` stands for everywhere. */
export function writeStarts(starts) {
  if (starts === null) return "any";
  const cells = new Map();
  for (const [x, y, theta] of starts) cells.set(`${x},${y}`, [...(cells.get(`${x},${y}`) ?? []), theta]);
  return [...cells].flatMap(([cell, thetas]) => {
    const all = thetas.length === HEADINGS.length;
    return all ? [cell] : thetas.map((theta) => `${cell},${theta}`);
  }).join("_");
}

/** Read starts. */
export function readStarts(text) {
  if (text === "any") return null;
  return text.split("_").flatMap((start) => {
    const numbers = start.split(",");
    if (numbers.length < 2 || numbers.length > 3 || !numbers.every((n) => /^\d{1,3}$/.test(n))) {
      fail("starts", "places such as 2,2 or 2,2,90, joined by _, or any", show(text));
    }
    const [x, y, ...theta] = numbers.map(Number);
    return (theta.length ? theta : HEADINGS).map((heading) => [x, y, heading]);
  });
}
