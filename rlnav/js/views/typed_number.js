/**
 * Numbers that are typed: what is out of range or no number is refused with a message, and the last good one stays.
 */
import { h, uniqueId } from "./dom.js";

const GROUPED = /^[-−]?\d{1,3}(,\d{3})+$/; // 20,000

/** Write a number as short as it can be typed again. */
export function plain(value) {
  return String(Number(Number(value).toPrecision(12))).replace("-", "−");
}

/** A text field that only ever holds a number in range; `onTyped` hears of a new one. */
export function typedNumber({ min = -Infinity, max: most = Infinity, step = "any", integer, format = plain }) {
  let max = most;
  const fault = h("p", { class: "rl-fault", id: uniqueId("fault"), role: "alert" });
  const mode = min < 0 ? "text" : "decimal"; // the number pad of a phone has no minus sign
  const input = h("input", { type: "text", inputmode: mode, class: "rl-number", autocomplete: "off" });
  const whole = integer ?? (Number.isInteger(step) && Number.isInteger(min));
  const field = { input, fault, value: NaN, onTyped: null };
  const complain = (text) => {
    fault.textContent = text;
    input.setAttribute("aria-invalid", String(text !== ""));
    if (text) input.setAttribute("aria-errormessage", fault.id);
  };
  field.show = (v) => {
    field.value = v;
    complain("");
    input.value = document.activeElement === input ? plain(v) : format(v);
    input.style.setProperty("--rl-digits", Math.min(Math.max(format(v).length, 3), 9));
  };
  field.limit = (v) => (max = v);
  const accept = () => {
    const typed = input.value.trim();
    if (typed === format(field.value) || typed === plain(field.value)) return complain("");
    const dotted = whole && GROUPED.test(typed) ? typed.replaceAll(",", "") : typed.replace(",", ".");
    const v = typed === "" ? NaN : Number(dotted.replace("−", "-"));
    const wrong = !Number.isFinite(v) || v < min || v > max || (whole && !Number.isInteger(v));
    if (!wrong) {
      field.show(v);
      return field.onTyped(v);
    }
    return complain(`Type ${expected(whole, min, max)}. ${format(field.value)} is kept.`);
  };
  input.addEventListener("change", accept);
  input.addEventListener("focus", () => {
    input.value = plain(field.value);
    input.select();
  });
  input.addEventListener("blur", () => (input.value = format(field.value)));
  input.addEventListener("keydown", (event) => {
    const direction = { ArrowUp: 1, ArrowDown: -1, Enter: 0 }[event.key];
    if (direction === undefined) return;
    if (direction === 0) return accept();
    event.preventDefault();
    const next = field.value + direction * (step === "any" ? 1 : step);
    const v = Math.min(Math.max(Number(next.toPrecision(12)), min), max);
    field.show(v);
    field.onTyped(v);
  });
  return field;
}

/** Say which numbers can be typed. */
function expected(whole, min, max) {
  const kind = whole ? "a whole number" : "a number";
  if (min > -Infinity && max < Infinity) return `${kind} from ${plain(min)} to ${plain(max)}`;
  if (min > -Infinity) return `${kind} of at least ${plain(min)}`;
  return max < Infinity ? `${kind} of at most ${plain(max)}` : kind;
}

/** Put 0 ... 1000 of a range on min ... max, so that equal ways are equal factors. */
export function logScale(min, max, step) {
  const factor = Math.log(max / min);
  const round = (v) => {
    const size = 10 ** Math.floor(Math.log10(v) - 1); // two digits say enough
    const neat = Math.round(v / size) * size;
    return Math.min(Math.max(step === "any" ? Number(neat.toPrecision(2)) : Math.round(neat / step) * step, min), max);
  };
  const value = (at) => round(min * Math.exp((factor * at) / 1000));
  return { min: 0, max: 1000, step: 1, value, place: (v) => Math.round((1000 * Math.log(v / min)) / factor) };
}
