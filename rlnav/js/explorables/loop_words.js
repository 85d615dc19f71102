/**
 * What is said of each moment of the loop, and the program that it runs.
 */
import { poseInWords, timed, turnInWords, written } from "./naming.js";

// The loop in seven lines; each moment of a step is one of them.
export const PROGRAM = Object.freeze([
  "s, t = world.start(), 0",
  "while not world.ended(s) and t < limit:",
  "    a = agent.choose(s)",
  "    s_next = world.move(s, a)",
  "    r = world.pay(s, a, s_next)",
  "    agent.hear(r, s_next)",
  "    s, t = s_next, t + 1",
]);
const LINES = { read: 1, choose: 2, move: 3, pay: 4, show: 5, tick: 6, terminated: 1, truncated: 1 };

/** The line of PROGRAM that runs at a moment. */
export function lineOf(moment) {
  return LINES[moment];
}

/** What the next press does: the label of its button. */
export function nextWords(loop) {
  const { t } = loop;
  const words = {
    read: `agent chooses ${timed("A", t)}`,
    choose: "world moves",
    move: `world pays ${timed("R", t + 1)}`,
    pay: `world shows ${timed("S", t + 1)}`,
    show: "clock moves on",
    tick: `agent reads ${timed("S", t + 1)}`,
  };
  return words[loop.moment] ?? "a new episode";
}

/** Tell a moment in a sentence or two. */
export function sentence(loop, task) {
  const { t, moment } = loop;
  const now = loop.rows.at(-1);
  const where = (s) => poseInWords(task.pose(s));
  if (moment === "read") return `The agent reads ${timed("S", t)}: ${where(now.s)}.`;
  if (moment === "choose") return `The agent chooses ${timed("A", t)}: ${turnInWords(task.robot.steering[now.a])}.`;
  if (moment === "move") return moveWords(loop, task);
  if (moment === "pay") {
    return `The environment pays ${timed("R", t + 1)} = ${written(now.r)} for ${timed("A", t)}. ` +
      "It comes with the next state, so it has the next index.";
  }
  if (moment === "show") return `The environment shows ${timed("S", t + 1)}: ${where(now.sNext)}.`;
  if (moment === "tick") {
    return `The clock moves on: t is now ${t + 1}, and ${timed("S", t + 1)} is where the next step begins.`;
  }
  return endWords(loop, task);
}

/** Tell where the robot went, and whether it was where it was steered to. */
function moveWords(loop, task) {
  const { s, a, place, sNext } = loop.steps[loop.t];
  const applied = appliedAt(loop.mdp, task, a, place);
  const slipped = applied === a ? "" : ` It slipped: the steering was ${turnInWords(task.robot.steering[applied])}.`;
  if (sNext === task.crashed) return `The environment moves the robot, and it crashes.${slipped}`;
  const cell = ({ x, y }) => `(${x}, ${y})`;
  return `The environment moves the robot from ${cell(task.pose(s))} to ${cell(task.pose(sNext))}.${slipped}`;
}

/** The action that was really applied, if the robot slips. */
export function appliedAt(mdp, task, a, place) {
  return task.robot.outcomes(a)[place % mdp.K][0];
}

function endWords({ moment, t, s, maxSteps }, task) {
  const steps = `${t} ${t === 1 ? "step" : "steps"}`;
  if (moment === "truncated") {
    return `Truncated: the step limit of ${maxSteps} is reached. The robot could drive on; only we stop watching. ` +
      `${timed("S", t)} is not an end, and what would have followed it still counts.`;
  }
  const how = s === task.crashed ? "the robot has crashed" : "the robot is at the goal";
  return `Terminated after ${steps}: ${how}. ${timed("S", t)} is an end of the task itself; nothing follows it.`;
}
