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
 * @param {Record<string, any>} [attributes] `class`, `text`, `on` (listeners), `data` (dataset), else attributes; null skips
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
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** Builds an SVG element; `text` is its content. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") element.textContent = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** An icon of the sprite in index.html. */
export function icon(name) {
  const use = svg("use", { href: `#i-${name}` });
  return svg("svg", { class: "icon", "aria-hidden": "true" }, use);
}

export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function setAttribute(element, name, value) {
  if (value === null || value === undefined || value === false) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value))
    element.setAttribute(name, value === true ? "" : value);
}

/**
 * Enables a button, or disables it with the reason as hover help.
 * The button stays focusable, so that the reason can be found by keyboard.
 */
export function setAllowed(button, reason, help = "") {
  setAttribute(button, "aria-disabled", reason ? "true" : null);
  setAttribute(button, "title", reason || help || null);
  setAttribute(button, "aria-description", reason || null);
}

/** Calls `act` on a click. If the button is disabled, `explain` gets the reason instead. */
export function onPress(button, act, explain = () => {}) {
  button.addEventListener("click", (event) => {
    if (button.getAttribute("aria-disabled") === "true") explain(button.title);
    else act(event);
  });
}

/** Resolves when the current changes have been painted. */
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
