/** A button that opens a menu of items to show or hide. */

import { h, setAttribute } from "./dom.js";

/** @type {Record<string, (at: number, count: number) => number>} */
const MOVES = {
  ArrowDown: (at, count) => (at + 1) % count,
  ArrowUp: (at, count) => (at + count - 1) % count,
  Home: () => 0,
  End: (at, count) => count - 1,
};

/**
 * Opens and closes a menu: by its button, by keys, and by whatever takes the focus elsewhere.
 * @param {HTMLElement} root
 * @param {HTMLElement} button
 * @param {HTMLElement} menu
 * @param {HTMLElement[]} items
 */
export function openable(root, button, menu, items) {
  const isOpen = () => !menu.hidden;
  const setOpen = (/** @type {boolean} */ open, /** @type {boolean} */ focus) => {
    menu.hidden = !open;
    button.setAttribute("aria-expanded", String(open));
    if (open) items[0]?.focus({ preventScroll: true });
    else if (focus) button.focus({ preventScroll: true });
  };
  button.addEventListener("click", () => setOpen(!isOpen(), false));
  root.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && isOpen()) setOpen(false, true);
    else if (event.target === button && event.key === "ArrowDown") setOpen(true, false);
    else if (!MOVES[event.key] || !isOpen()) return;
    else {
      const at = items.findIndex((item) => item === document.activeElement);
      items[MOVES[event.key](at, items.length)].focus({ preventScroll: true });
    }
    event.preventDefault();
  });
  root.addEventListener("focusout", ({ relatedTarget }) => {
    if (!root.contains(/** @type {Node|null} */ (relatedTarget))) setOpen(false, false);
  });
  // A press that gives nothing the focus; one inside the 3D scene takes it from the whole page.
  document.addEventListener("pointerdown", ({ target }) => {
    if (isOpen() && !root.contains(/** @type {Node|null} */ (target))) setOpen(false, false);
  });
  window.addEventListener("blur", () => {
    if (isOpen()) setOpen(false, false);
  });
}

/** Whether a menu over the scene is open, which Esc closes before anything else. */
export const menuIsOpen = () => document.querySelector('.check-menu [role="menu"]:not([hidden])') !== null;

/**
 * @typedef {object} CheckEntry
 * @property {string} key
 * @property {string} text
 * @property {string} help
 * @property {boolean} checked
 * @property {boolean} [swatch] shows the colour that the style sheet gives to the entry's key
 */

/** @param {CheckEntry} entry */
const checkItem = ({ key, text, help, checked, swatch }) =>
  h(
    "button",
    { role: "menuitemcheckbox", tabindex: "-1", "aria-checked": String(checked), title: help },
    h("span", { class: "tick-mark", "aria-hidden": "true" }),
    text,
    swatch && h("i", { class: "swatch", "aria-hidden": "true", data: { of: key } }),
  );

/**
 * Builds the button with its menu.
 * @param {object} options
 * @param {string} options.id of the button
 * @param {string} options.name on the button
 * @param {string} options.help
 * @param {CheckEntry[]} options.entries
 * @param {(key: string, checked: boolean) => void} options.onChange
 * @returns {{element: HTMLElement, allow: (key: string, reason: string|null) => void,
 *   isOn: (key: string) => boolean}} `allow` greys an entry with the reason why it cannot be shown
 */
export function checkMenu({ id, name, help, entries, onChange }) {
  const items = entries.map(checkItem);
  const itemOf = (/** @type {string} */ key) => items[entries.findIndex((entry) => entry.key === key)];
  const button = h("button", {
    id,
    class: "menu-button",
    "aria-haspopup": "menu",
    "aria-expanded": "false",
    title: help,
    text: name,
  });
  const menu = h(
    "div",
    { class: "menu", role: "menu", "aria-label": name, data: { arrows: "" }, hidden: true },
    ...items,
  );
  const element = h("div", { class: "check-menu" }, button, menu);
  const isOn = (/** @type {string} */ key) => itemOf(key).getAttribute("aria-checked") === "true";
  for (const { key } of entries) {
    const item = itemOf(key);
    item.addEventListener("click", () => {
      if (item.getAttribute("aria-disabled") === "true") return;
      item.setAttribute("aria-checked", String(!isOn(key)));
      onChange(key, isOn(key));
    });
  }
  openable(element, button, menu, items);
  return {
    element,
    isOn,
    allow(key, reason) {
      setAttribute(itemOf(key), "aria-disabled", reason ? "true" : null);
      setAttribute(itemOf(key), "title", reason ?? entries.find((entry) => entry.key === key)?.help);
    },
  };
}
