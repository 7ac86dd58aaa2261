/** A button that opens a menu of actions. */

import { openable } from "./check_menu.js";
import { h, onPress, setAllowed } from "./dom.js";
import { attempt, toast } from "./toasts.js";

/**
 * Builds the button with its menu.
 * @param {object} options
 * @param {string} options.name on the button
 * @param {string} options.help
 * @param {{text: string, help: string, act: () => void, refusal?: () => Promise<string|null>}[]} options.entries `refusal` is
 *   asked whenever the menu opens: why the entry cannot be used now
 * @returns {{element: HTMLElement, add: (entry: object, at?: number) => void}} `add` puts another entry at a place, or last
 */
export function actionMenu({ name, help, entries }) {
  const items = [];
  const button = h("button", { class: "link menu-button", "aria-haspopup": "menu", "aria-expanded": "false", title: help, text: name });
  const menu = h("div", { class: "menu", role: "menu", "aria-label": name, data: { arrows: "" }, hidden: true });
  const element = h("div", { class: "check-menu act-menu" }, button, menu);
  const questions = [];
  const ask = () => questions.forEach((question) => question());
  button.addEventListener("click", ask);
  button.addEventListener("keydown", ({ key }) => { if (key === "ArrowDown") ask(); });
  const add = ({ text, help: own, act, refusal }, at = items.length) => {
    const item = h("button", { role: "menuitem", tabindex: "-1", title: own, text });
    onPress(item, () => {
      menu.hidden = true;
      button.setAttribute("aria-expanded", "false");
      button.focus();
      act();
    }, (why) => toast(why));
    if (refusal) questions.push(attempt(async () => setAllowed(item, await refusal(), own)));
    menu.insertBefore(item, items[at] ?? null);
    items.splice(at, 0, item);
  };
  entries.forEach((entry) => add(entry));
  openable(element, button, menu, items);
  return { element, add };
}
