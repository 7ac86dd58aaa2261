/** Small helpers over the DOM: build, find, change only what differs. */

/**
 * The element of index.html with an id, of the kind that the caller knows it to be.
 * @param {string} id
 * @returns {any}
 */
export const byId = (id) => document.getElementById(id);

/**
 * Builds an element.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, any>} [attributes] `class`, `text`, `on` (listeners), `data` (dataset), else
 *   attributes; null skips
 * @param {...(Node|string|null|false|undefined)} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "text") element.textContent = value;
    else if (name === "on")
      Object.entries(value).forEach(([type, listener]) => element.addEventListener(type, listener));
    else if (name === "data") Object.assign(element.dataset, value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  const given = children.filter((child) => child !== null && child !== undefined && child !== false);
  element.append(.../** @type {(Node|string)[]} */ (given));
  return element;
}

/**
 * Builds an SVG element; `text` is its content.
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node|string)} children
 * @returns {SVGElementTagNameMap[Tag]}
 */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") element.textContent = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/**
 * An icon of the sprite in index.html.
 * @param {string} name
 */
export function icon(name) {
  const use = svg("use", { href: `#i-${name}` });
  return svg("svg", { class: "icon", "aria-hidden": "true" }, use);
}

/**
 * @param {Node} element
 * @param {string} text
 */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * @param {Element} element
 * @param {string} name
 * @param {any} value true for an empty attribute; null, undefined or false for none
 */
export function setAttribute(element, name, value) {
  if (value === null || value === undefined || value === false) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value))
    element.setAttribute(name, value === true ? "" : value);
}

/**
 * Enables a button, or disables it with the reason as hover help.
 * The button stays focusable, so that the reason can be found by keyboard.
 * @param {Element} button
 * @param {string|null|undefined} reason
 * @param {string} [help]
 */
export function setAllowed(button, reason, help = "") {
  setAttribute(button, "aria-disabled", reason ? "true" : null);
  setAttribute(button, "title", reason || help || null);
  setAttribute(button, "aria-description", reason || null);
}

/**
 * Calls `act` on a click. If the button is disabled, `explain` gets the reason instead.
 * @param {HTMLElement} button
 * @param {(event: MouseEvent) => void} act
 * @param {(reason: string) => void} [explain]
 */
export function onPress(button, act, explain = () => {}) {
  button.addEventListener("click", (event) => {
    if (button.getAttribute("aria-disabled") === "true") explain(button.title);
    else act(event);
  });
}

/**
 * Whether an element is shown, in or out of the window.
 * @param {Element} element
 */
export const isShown = (element) => element.checkVisibility({ visibilityProperty: true });

/**
 * Resolves when the current changes have been painted.
 * @returns {Promise<void>}
 */
export const painted = () =>
  new Promise((resume) => {
    requestAnimationFrame(() => setTimeout(resume));
  });

/** Why parts of the page cannot be used for a while. @type {WeakMap<HTMLElement, Set<string>>} */
const reasons = new WeakMap();

/**
 * Locks a part for a reason, or takes that reason back; the last one frees it.
 * @param {HTMLElement} element
 * @param {string} reason
 * @param {boolean} isLocked
 */
export function setInert(element, reason, isLocked) {
  const known = reasons.get(element) ?? new Set();
  if (isLocked) known.add(reason);
  else known.delete(reason);
  reasons.set(element, known);
  element.inert = known.size > 0;
}
