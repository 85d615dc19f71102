/**
 * Native controls with labels. Each returns { element, input, value, disabled(reason), show(visible) }.
 */
import { h, uniqueId } from "./dom.js";
import { icon } from "./icons.js";
import { logScale, plain, typedNumber } from "./typed_number.js";

/**
 * A range with a visible number that can be typed into. `log` gives every factor of ten the same room; `.limit(max)`
 * moves the upper end.
 */
export function slider(options) {
  const { label, min, max, step = "any", value, format = plain, log = false, onInput, onChange } = options;
  const scale = log ? logScale(min, max, step) : { place: (v) => v, value: Number, min, max, step };
  const range = h("input", { type: "range", min: scale.min, max: scale.max, step: scale.step, class: "rl-range" });
  const field = typedNumber({ ...options, format });
  const show = (v) => {
    range.value = scale.place(v);
    range.setAttribute("aria-valuetext", format(v));
    range.style.setProperty("--rl-part", `${(100 * (range.value - scale.min)) / (scale.max - scale.min)}%`);
    field.show(v);
  };
  const change = (v, settled) => {
    show(v);
    onInput?.(v);
    if (settled) onChange?.(v);
  };
  field.onTyped = (v) => change(v, true);
  range.addEventListener("input", () => change(scale.value(range.value), false));
  range.addEventListener("change", () => onChange?.(field.value));
  field.input.setAttribute("aria-label", `${label}, as a number`);
  show(value);
  const limit = (most) => {
    range.max = scale.max = most;
    field.limit(most);
    show(field.value);
  };
  const parts = { ...options, input: range, beside: field.input, fault: field.fault, class: "rl-slider" };
  return Object.assign(control(parts, { get: () => field.value, set: show, inputs: [range, field.input] }), { limit });
}

/** A number that is typed; arrow keys add and take away one step. */
export function number(options) {
  const field = typedNumber({ format: plain, ...options });
  field.onTyped = (v) => options.onChange?.(v);
  field.show(options.value);
  return control({ ...options, input: field.input, fault: field.fault, class: "rl-number-field" }, {
    get: () => field.value,
    set: (v) => field.show(v),
  });
}

/** A menu. `options` are pairs of a value and its text. */
export function choice(options) {
  const input = h("select", { class: "rl-select" });
  input.append(...options.options.map(([value, text]) => h("option", { value, text })));
  input.value = options.value;
  input.addEventListener("change", () => options.onChange?.(input.value));
  return control({ ...options, input, class: "rl-choice" }, {
    get: () => input.value,
    set: (value) => (input.value = value),
  });
}

/** A box to tick. */
export function toggle(options) {
  const input = h("input", { type: "checkbox", class: "rl-check" });
  input.checked = Boolean(options.value);
  input.addEventListener("change", () => options.onChange?.(input.checked));
  return control({ ...options, input, class: "rl-toggle" }, {
    get: () => input.checked,
    set: (value) => (input.checked = Boolean(value)),
  });
}

/** A few choices side by side: a radio group, drawn as one bar. */
export function segmented({ label, options, value, help, hideLabel = false, onChange }) {
  const name = uniqueId("segmented");
  const radio = ([key]) => h("input", { type: "radio", name, value: key, onChange: () => onChange?.(key) });
  const radios = options.map(radio);
  const parts = options.map(([, text, title], i) => h("label", { title }, radios[i], h("span", { text })));
  const legend = h("legend", { class: hideLabel ? "rl-hidden" : "rl-label", text: label });
  const bar = h("div", { class: "rl-segments" }, parts);
  const element = h("fieldset", { class: "rl-field rl-segmented" }, legend, bar, helpText(help));
  const set = (key) => radios.forEach((one, i) => (one.checked = options[i][0] === key));
  set(value);
  return finish(element, radios[0], {
    get: () => options[radios.findIndex((one) => one.checked)]?.[0],
    set,
    inputs: radios,
  });
}

/** A button; `pressed` (true or false) makes it one that stays down. `label` and `pressed` can be set later. */
export function button({ label, icon: sign, primary, pressed, title, shortcut, iconOnly = false, onClick }) {
  const text = h("span", { class: iconOnly ? "rl-hidden" : "rl-button-text", text: label });
  const image = h("span", { class: "rl-button-icon" }, sign ? icon(sign) : null);
  const element = h("button", { type: "button", class: `rl-button${primary ? " rl-primary" : ""}` }, image, text);
  const tip = () => {
    const words = [title ?? (iconOnly ? text.textContent : ""), shortcut && `(${shortcut})`].filter(Boolean);
    element.title = blocked || words.join(" ");
  };
  let blocked = "";
  element.addEventListener("click", (event) => {
    if (!blocked) onClick?.(event);
  });
  if (shortcut) element.setAttribute("aria-keyshortcuts", shortcut);
  if (pressed !== undefined) element.setAttribute("aria-pressed", String(pressed));
  tip();
  return {
    element,
    input: element,
    get label() {
      return text.textContent;
    },
    set label(words) {
      if (text.textContent !== words) text.textContent = words;
      tip();
    },
    set icon(name) {
      image.replaceChildren(icon(name));
    },
    get pressed() {
      return element.getAttribute("aria-pressed") === "true";
    },
    set pressed(down) {
      element.setAttribute("aria-pressed", String(down));
    },
    /** Block the button for a reason; it keeps the focus, or a keyboard would lose its place. */
    disabled(reason) {
      blocked = reason || "";
      element.setAttribute("aria-disabled", String(blocked !== ""));
      tip();
    },
    show: (visible) => (element.hidden = !visible),
  };
}

/** A part that folds; its summary tells the present settings. */
export function group({ title, summary = "", open = false, children = [], onToggle }) {
  const settings = h("span", { class: "rl-settings", text: summary });
  const head = h("summary", {}, h("span", { class: "rl-title", text: title }), settings);
  const body = h("div", { class: "rl-body" }, children.map((child) => child.element ?? child));
  const element = h("details", { class: "rl-group", open }, head, body);
  element.addEventListener("toggle", () => onToggle?.(element.open));
  return {
    element,
    body,
    get open() {
      return element.open;
    },
    set open(value) {
      element.open = value;
    },
    summary(text) {
      if (settings.textContent !== text) settings.textContent = text;
    },
    show: (visible) => (element.hidden = !visible),
  };
}

/** Buttons that belong together, in one row. */
export function toolbar({ label, children = [] }) {
  const parts = children.map((child) => child.element ?? child);
  const element = h("div", { class: "rl-toolbar", role: "group", "aria-label": label }, parts);
  return { element, show: (visible) => (element.hidden = !visible) };
}

function helpText(text) {
  return text ? h("p", { class: "rl-help", id: uniqueId("help"), text }) : null;
}

/** Put label, input, help and fault together. */
function control({ label, input, beside, help, fault, hideLabel, class: kind }, access) {
  input.id = uniqueId("input");
  const words = h("label", { class: hideLabel ? "rl-hidden" : "rl-label", for: input.id, text: label });
  const note = helpText(help);
  if (note) input.setAttribute("aria-describedby", note.id);
  const element = h("div", { class: `rl-field ${kind}` }, words, input, beside, note, fault);
  return finish(element, input, { inputs: [input], ...access });
}

function finish(element, input, { get, set, inputs }) {
  const why = h("p", { class: "rl-why rl-help" });
  return {
    element,
    input,
    get value() {
      return get();
    },
    set value(v) {
      set(v);
    },
    /** Block the control and say why; an empty reason frees it. */
    disabled(reason) {
      for (const part of inputs) part.disabled = Boolean(reason);
      why.textContent = reason || "";
      if (reason) element.append(why);
      else why.remove();
    },
    show: (visible) => (element.hidden = !visible),
  };
}
