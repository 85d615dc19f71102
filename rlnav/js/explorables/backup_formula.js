/**
 * The line of the formula behind a node of a backup diagram: with symbols, and with the node's own numbers.
 */
import { ruleOf } from "../scenario/backup.js";
import { h } from "../views/dom.js";
import { poseInWords, turnInWords, written } from "./naming.js";

const LETTER = /((?<![a-zA-Z])[a-zA-Zγπ](?![a-zA-Z]))/; // alone: words such as max are set upright

/** Set plain text with indices in braces as mathematics: "v_{π}(s′)", with letters in italics. */
export function math(text) {
  return text.split(/(_\{[^}]*\})/).flatMap((part) => {
    if (part.startsWith("_{")) return [h("sub", {}, ...letters(part.slice(2, -1)))];
    return letters(part);
  });
}

function letters(text) {
  return text.split(LETTER).filter(Boolean).map((part) => (LETTER.test(part) ? h("i", {}, part) : part));
}

/** The symbol of a node; the levels below the root are primed where the letter comes twice. */
export function symbolOf(node, { max, actionFirst }) {
  const below = node.id !== "0";
  const level = node.id.split("-").length - 1;
  const primed = actionFirst ? below : level === 2;
  const star = max ? "*" : "π";
  const prime = primed ? "′" : "";
  return node.kind === "state" ? `v_{${star}}(s${prime})` : `q_{${star}}(s${prime}, a${prime})`;
}

/** Lines of the formula: with symbols, then with numbers unless they are to be found by the reader. */
export function formula(node, parent, options, hidden) {
  const lines = ruleOf(node) ? [symbolLine(node, options)] : [];
  if (ruleOf(node) && !hidden) lines.push(numberLine(node, options));
  if (!ruleOf(node) && parent) lines.push(...shareLines(node, parent, options, hidden));
  return lines.map((line) => h("p", { class: "rl-formula" }, ...math(line)));
}

function symbolLine(node, options) {
  const name = symbolOf(node, options);
  const inside = symbolOf(node.children[0], options);
  const p = options.actionFirst ? "′" : "";
  const action = node.kind === "state" && options.actionFirst ? p : "";
  if (ruleOf(node) === "max") return `${name} = max_{a${action}} ${inside}`;
  if (ruleOf(node) === "mean") return `${name} = Σ_{a${action}} π(a${action} | s${action}) ${inside}`;
  return `${name} = Σ_{s′, r} p(s′, r | s, a) [ r + γ ${inside} ]`;
}

function numberLine(node, { gamma }) {
  const value = ({ value: v }) => written(v);
  const result = ` = ${written(node.value)}`;
  if (ruleOf(node) === "max") return `= max { ${node.children.map(value).join(",  ")} }${result}`;
  if (ruleOf(node) === "mean") {
    const terms = node.children.filter(({ probability }) => probability > 0);
    return `= ${terms.map((child) => product(child.probability, child.value)).join(" + ")}${result}`;
  }
  if (node.children.length === 1) return `= ${ahead(node.children[0], gamma)}${result}`;
  return `= ${node.children.map((child) => weighed(child, gamma)).join(" + ")}${result}`;
}

/** One factor times another; a line may not break inside. */
function product(factor, value) {
  const number = written(value);
  return `${written(factor)}\u00a0·\u00a0${value < 0 ? `(${number})` : number}`;
}

/** The reward of a step and what follows it. */
function ahead({ reward, value }, gamma) {
  return `${written(reward)}\u00a0+\u00a0${product(gamma, value)}`;
}

function weighed(child, gamma) {
  return `${written(child.probability)}\u00a0[\u00a0${ahead(child, gamma)}\u00a0]`;
}

/** What a leaf is worth to the node above it. */
function shareLines(node, parent, options, hidden) {
  const { gamma } = options;
  const name = symbolOf(node, options);
  const above = symbolOf(parent, options);
  const own = `${name} = ${written(node.value)}`;
  if (hidden) return [own];
  if (ruleOf(parent) === "max") {
    return [own, `${node.best ? "This is the maximum:" : "It is not more than"} ${above} = ${written(parent.value)}`];
  }
  const expectation = ruleOf(parent) === "mean";
  const share = node.probability * (expectation ? node.value : node.reward + gamma * node.value);
  const terms = expectation ? product(node.probability, node.value) : weighed(node, gamma);
  return [own, `Its share in ${above}: ${terms} = ${written(share)}`];
}

/** Tell a node: what it is and where its number comes from. */
export function sentenceOf(node, parent, task) {
  const { steering } = task.robot;
  const pose = task.pose(node.s);
  const rule = ruleOf(node);
  if (node.kind === "action") {
    const turn = capital(turnInWords(steering[node.a]));
    if (!rule) return `${turn} at ${poseInWords(pose)}.`;
    const cases = node.children.length > 1 ? "the mean over what may follow, of " : "";
    return `${turn}: ${cases}the reward of the step and γ times the value of the next state.`;
  }
  const slip = parent?.kind === "action" ? slipWords(node, parent, task) : "";
  if (node.terminal) {
    const what = task.world.isGoal(pose?.x, pose?.y) ? "The goal" : "A crash";
    return `${slip}${what} ends the episode: nothing follows, so the value is 0. The reward is paid on the way there.`;
  }
  const where = `${slip}${capital(poseInWords(pose))}`;
  if (rule === "max") return `${where}: its value is that of the best action.`;
  if (rule === "mean") return `${where}: its value is the mean over the actions, each weighed by the policy.`;
  return `${where}. Choose it again to go there, and see where its number comes from.`;
}

/** How the robot comes to a next state, if there is more than one way things may go. */
function slipWords({ ks, probability }, { a, children }, { robot }) {
  if (children.length === 1) return "";
  const applied = new Set(ks.map((k) => robot.outcomes(a)[k][0]));
  if (applied.size > 1) return `With probability ${written(probability)}. `;
  const [only] = applied;
  const how = only === a ? "as it was steered" : `by a slip, ${turnInWords(robot.steering[only])}`;
  return `With probability ${written(probability)}, ${how}. `;
}

function capital(text) {
  return text[0].toUpperCase() + text.slice(1);
}
