/**
 * Everything that can leave the page, and come back: a link, Python, a file of settings, a picture, the run as a table.
 */
import { fromText, toText } from "../scenario/address.js";
import { asPython } from "../scenario/python.js";
import { button, group, toolbar } from "../views/controls.js";
import { h, uniqueId } from "../views/dom.js";
import { changes } from "./fields.js";
import { lectureLink } from "./lecture_link.js";
import { Outlet } from "./outlet.js";
import { runAsTable } from "./run_table.js";

const MOST_BYTES = 1_000_000; // of a file with settings

/** Build the group "Share". */
export function sharePanel(app) {
  const outlet = new Outlet((words) => app.say(words));
  const python = pythonCode(app, outlet);
  const inlet = settingsIn(app);
  const lecture = app.stage.live ? [] : [lectureLink(app, outlet)]; // a notebook has no address to link to
  const panel = group({
    title: "Share",
    summary: "link, Python, files",
    children: [ways(app, outlet), outlet.element, python.element, inlet, ...lecture],
    onToggle: () => app.refresh(),
  });
  return {
    element: panel.element,
    refresh: () => panel.open && python.refresh(),
  };
}

/** The buttons that give something away. */
function ways(app, outlet) {
  const give = (key, label, icon, title, fn) => {
    const run = async () => {
      try {
        await fn();
      } catch (error) {
        app.stage.message(error.message);
      }
    };
    const control = button({ label, icon, title, onClick: run });
    control.element.dataset.key = key;
    return control;
  };
  const copyLink = () => outlet.copy(app.link.address, "The link");
  const saveSettings = () => {
    const text = toText({ scenario: app.scenario, view: app.view });
    return outlet.save(text, "rlnav-settings.json", "application/json");
  };
  const savePicture = async () => outlet.save(await app.arena.toBlob(), "rlnav-map.png", "image/png");
  const saveRun = () => outlet.save(runAsTable(app.session), "rlnav-run.csv", "text/csv");
  const link = give("link", "Copy link", "share", "All settings in one address", copyLink);
  const settings = give("json", "Settings (JSON)", "save", "Save all settings as a file", saveSettings);
  const picture = give("picture", "Picture (PNG)", "save", "Save the map as a picture", savePicture);
  const table = give("csv", "Run (CSV)", "save", "Save one line for each episode", saveRun);
  const all = [...(app.stage.live ? [] : [link]), settings, picture, table];
  return toolbar({ label: "Give away", children: all }).element;
}

/** The lines of Python that make this very run. */
function pythonCode(app, outlet) {
  const code = h("code", {});
  const pre = h("pre", { class: "rl-code", tabindex: 0, "aria-label": "Python code" }, code);
  const copyCode = () => outlet.copy(code.textContent, "The code");
  const copy = button({ label: "Copy as Python", icon: "copy", onClick: copyCode });
  const help = h("p", { class: "rl-help" });
  const changed = changes();
  const element = h("div", { class: "rl-stack" }, copy.element, help, pre);
  element.dataset.key = "python";
  return {
    element,
    refresh() {
      const { session, scenario } = app;
      if (!changed(session, scenario)) return;
      code.textContent = asPython(scenario, session.own);
      help.textContent = session.isPlayback
        ? "The run that is shown has come from Python; these lines train anew, with the settings of this page."
        : "In Python, these lines give this very run, to the last bit.";
    },
  };
}

/** Settings from a file, or pasted. */
function settingsIn(app) {
  const fault = h("p", { class: "rl-fault", id: uniqueId("fault"), role: "alert" });
  const read = (text) => {
    try {
      if (!app.replace(fromText(text))) return;
      fault.textContent = "";
      field.value = "";
      app.say("The settings are taken over.");
    } catch (error) {
      fault.textContent = error.message;
    }
  };
  const file = h("input", { type: "file", id: uniqueId("file"), class: "rl-file", accept: ".json,application/json" });
  file.addEventListener("change", async () => {
    const [chosen] = file.files;
    if (!chosen) return;
    if (chosen.size > MOST_BYTES) fault.textContent = "This file is too large to hold settings. Nothing has changed.";
    else read(await chosen.text());
    file.value = ""; // so that the same file can be chosen again
  });
  const field = h("textarea", { class: "rl-text", id: uniqueId("paste"), rows: 3, spellcheck: "false" });
  const take = button({ label: "Take over", icon: "open", onClick: () => read(field.value) });
  const element = h(
    "details",
    { class: "rl-inner" },
    h("summary", { text: "Open settings" }),
    h("div", { class: "rl-stack" },
      h("label", { class: "rl-label", for: file.id, text: "From a file" }), file,
      h("label", { class: "rl-label", for: field.id, text: "Or paste them here" }), field, take.element, fault),
  );
  element.dataset.key = "open";
  return element;
}
