/**
 * A run as a table in text: one line for each episode, for a spreadsheet or for pandas.read_csv.
 */

const COLUMNS = [
  ["return", "returns"],
  ["steps", "steps"],
  ["success", "success"],
  ["td_error", "tdErrors"],
  ["coverage", "coverage"],
];

/** Write the log of a session as CSV; numbers in full, so that they are read back to the last bit. */
export function runAsTable({ log }) {
  const columns = COLUMNS.filter(([, key]) => log[key]);
  const line = (_, e) => [e + 1, ...columns.map(([, key]) => log[key][e])].join(",");
  const lines = Array.from({ length: log.episode }, line);
  return `${[["episode", ...columns.map(([name]) => name)].join(","), ...lines].join("\n")}\n`;
}
