/**
 * Elements in one line each, so that a view reads like the page it makes.
 */

const SVG = "http://www.w3.org/2000/svg";
const SALT = Math.random().toString(36).slice(2, 7); // two widgets on one page must not share an id
let made = 0;

/** Return an id that no other element of the page has. */
export function uniqueId(stem) {
  made += 1;
  return `rl-${stem}-${SALT}-${made}`;
}

/** Make an HTML element: h("button", { class: "rl-button", onClick: go }, "Go"). */
export function h(tag, attributes, ...children) {
  return furnish(document.createElement(tag), attributes, children);
}

/** Make an SVG element. */
export function svg(tag, attributes, ...children) {
  return furnish(document.createElementNS(SVG, tag), attributes, children);
}

function furnish(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) set(element, name, value);
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** Set one attribute, listener, text or style; null and undefined leave the element as it is. */
function set(element, name, value) {
  if (value === null || value === undefined) return;
  if (name === "text") element.textContent = value;
  else if (name === "style" && typeof value === "object") Object.assign(element.style, value);
  else if (name === "dataset") Object.assign(element.dataset, value);
  else if (name.startsWith("on")) element.addEventListener(name.slice(2).toLowerCase(), value);
  else if (name.startsWith("aria-")) element.setAttribute(name, String(value));
  else if (value === true) element.setAttribute(name, "");
  else if (value !== false) element.setAttribute(name, String(value));
}
