/** A button that opens a menu of items to show or hide. */

import { h, setAttribute } from "./dom.js";

const MOVES = {
  ArrowDown: (at, count) => (at + 1) % count,
  ArrowUp: (at, count) => (at + count - 1) % count,
  Home: () => 0,
  End: (at, count) => count - 1,
};

/** Opens and closes a menu: by its button, by keys, and by whatever takes the focus elsewhere. */
export function openable(root, button, menu, items) {
  const isOpen = () => !menu.hidden;
  const setOpen = (open, focus) => {
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
    else
      items[MOVES[event.key](items.indexOf(document.activeElement), items.length)].focus({
        preventScroll: true,
      });
    event.preventDefault();
  });
  root.addEventListener("focusout", ({ relatedTarget }) => {
    if (!root.contains(relatedTarget)) setOpen(false, false);
  });
  // A press that gives nothing the focus; one inside the 3D scene takes it from the whole page.
  document.addEventListener("pointerdown", ({ target }) => {
    if (isOpen() && !root.contains(target)) setOpen(false, false);
  });
  window.addEventListener("blur", () => {
    if (isOpen()) setOpen(false, false);
  });
}

/** Whether a menu over the scene is open, which Esc closes before anything else. */
export const menuIsOpen = () => document.querySelector('.check-menu [role="menu"]:not([hidden])') !== null;

/**
 * Builds the button with its menu.
 * @param {Record<string, any>} options
 * @param {string} options.id of the button
 * @param {string} options.name on the button
 * @param {string} options.help
 * @param {{key: string, text: string, help: string, checked: boolean, swatch?: boolean}[]} options.entries `swatch` shows
 *   the colour that the style sheet gives to the entry's key
 * @param {(key: string, checked: boolean) => void} options.onChange
 * @returns {{element: HTMLElement, allow: (key: string, reason: string|null) => void, isOn: (key: string) => boolean}}
 *   `allow` greys an entry with the reason why it cannot be shown
 */
export function checkMenu({ id, name, help, entries, onChange }) {
  const byKey = new Map(
    entries.map((entry) => [
      entry.key,
      {
        ...entry,
        item: h(
          "button",
          {
            role: "menuitemcheckbox",
            tabindex: "-1",
            "aria-checked": String(entry.checked),
            title: entry.help,
          },
          h("span", { class: "tick-mark", "aria-hidden": "true" }),
          entry.text,
          entry.swatch && h("i", { class: "swatch", "aria-hidden": "true", data: { of: entry.key } }),
        ),
      },
    ]),
  );
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
    ...[...byKey.values()].map(({ item }) => item),
  );
  const element = h("div", { class: "check-menu" }, button, menu);
  const isOn = (key) => byKey.get(key).item.getAttribute("aria-checked") === "true";
  for (const [key, { item }] of byKey) {
    item.addEventListener("click", () => {
      if (item.getAttribute("aria-disabled") === "true") return;
      item.setAttribute("aria-checked", String(!isOn(key)));
      onChange(key, isOn(key));
    });
  }
  openable(
    element,
    button,
    menu,
    [...byKey.values()].map(({ item }) => item),
  );
  return {
    element,
    isOn,
    allow(key, reason) {
      const { item, help: own } = byKey.get(key);
      setAttribute(item, "aria-disabled", reason ? "true" : null);
      setAttribute(item, "title", reason ?? own);
    },
  };
}
