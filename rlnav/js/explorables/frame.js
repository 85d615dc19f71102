/**
 * What all explorables have around their figure: the question as a title, a way back to the beginning, and the lecture
 * view, which fills the screen in large type. The answer in words stands where the explorable puts it.
 */
import { button, toolbar } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";

/** Frame an explorable: { body, answer, say(text), focusFirst(element) }; `onReset` goes back to its first state. */
export function frame(stage, { question, onReset }) {
  const title = h("p", { class: "rl-question", id: uniqueId("question"), text: question });
  const settings = "Back to the settings of the page";
  const reset = button({ label: "Start again", icon: "reset", title: settings, onClick: onReset });
  const lecture = lectureButton(stage);
  const tools = toolbar({ label: "This figure", children: [reset, lecture] });
  const body = h("div", { class: "rl-explorable-body" });
  const answer = h("p", { class: "rl-answer" });
  const head = h("div", { class: "rl-head" }, title, tools.element);
  stage.root.append(h("div", { class: "rl-explorable", role: "group", "aria-labelledby": title.id }, head, body));
  return {
    body,
    answer,
    /** Show the answer in words, and say it to those who cannot see it. */
    say(text) {
      if (answer.textContent === text) return;
      answer.textContent = text;
      stage.say(text);
    },
    /** Name the control that takes the focus in a lecture, so that the space bar works it. */
    focusFirst(element) {
      lecture.first = element;
    },
  };
}

/** The button that opens and leaves the lecture view. */
function lectureButton(stage) {
  const full = button({ label: "Lecture view", icon: "full", pressed: false, onClick: () => show(!full.pressed) });
  const show = (large) => {
    if (full.pressed === large) return;
    full.pressed = large;
    full.label = large ? "Leave lecture view" : "Lecture view";
    stage.frame.classList.toggle("rl-lecture", large);
    // where a browser refuses the full screen, the style fills its window
    if (large) stage.frame.requestFullscreen?.().catch(() => {});
    else if (document.fullscreenElement === stage.frame) document.exitFullscreen();
    if (large && full.first) full.first.focus({ preventScroll: true });
  };
  const onChange = () => document.fullscreenElement === stage.frame || show(false);
  const onKey = (event) => {
    if (event.key === "Escape" && !event.defaultPrevented) show(false);
  };
  document.addEventListener("fullscreenchange", onChange);
  stage.frame.addEventListener("keydown", onKey);
  stage.onCleanup(() => document.removeEventListener("fullscreenchange", onChange));
  return full;
}
