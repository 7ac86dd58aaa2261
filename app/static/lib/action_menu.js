/** A button that opens a menu of actions. */

import { openable } from "./check_menu.js";
import { h, onPress, setAllowed } from "./dom.js";
import { attempt, toast } from "./toasts.js";

/** Between the button and its menu, and between the menu and the window's edge, px. */
const GAP = 4;

/**
 * @typedef {object} Entry
 * @property {string} text
 * @property {string} help
 * @property {() => void} act
 * @property {string} [group] the heading that it stands under
 * @property {() => Promise<string|null>|string|null} [refusal] why the entry cannot be used now; called when
 *   the menu opens
 */

/**
 * Puts a menu under its button, as wide as the drawer and as high as the window allows.
 * @param {HTMLElement} button
 * @param {HTMLElement} menu
 */
function place(button, menu) {
  const { bottom } = button.getBoundingClientRect();
  const { left, width } = (button.closest(".drawer") ?? button).getBoundingClientRect();
  Object.assign(menu.style, {
    left: `${left + 2 * GAP}px`,
    top: `${bottom + GAP}px`,
    width: `${width - 4 * GAP}px`,
    maxHeight: `${innerHeight - bottom - 2 * GAP}px`,
  });
}

/**
 * The entries under one heading.
 * @param {string} name
 */
function entryGroup(name) {
  const heading = h("span", { class: "menu-heading", "aria-hidden": "true", text: name });
  return h("div", { role: "group", "aria-label": name }, heading);
}

/**
 * Builds the button with its menu.
 * @param {{name: string, help: string, entries: Entry[]}} options `name` stands on the button
 * @returns {{element: HTMLElement, add: (entry: Entry, at?: number) => void}} `add` puts another entry before
 *   the one at a place (a negative place counts from the end), or last; an entry of a group that is there
 *   goes to the group's end
 */
export function actionMenu({ name, help, entries }) {
  /** @type {HTMLElement[]} */
  const items = [];
  /** @type {Map<string, HTMLElement>} */
  const groups = new Map();
  const button = h("button", {
    class: "link menu-button",
    "aria-haspopup": "menu",
    "aria-expanded": "false",
    title: help,
    text: name,
  });
  const menu = h("div", {
    class: "menu",
    role: "menu",
    "aria-label": name,
    data: { arrows: "" },
    hidden: true,
  });
  const element = h("div", { class: "check-menu act-menu" }, button, menu);
  /** @type {(() => void)[]} */
  const questions = [];
  const prepare = () => {
    place(button, menu);
    questions.forEach((question) => question());
  };
  button.addEventListener("click", prepare);
  button.addEventListener("keydown", ({ key }) => {
    if (key === "ArrowDown") prepare();
  });

  /** @type {(item: HTMLElement, group: string|undefined, at: number) => void} */
  const insert = (item, group, at) => {
    const next = items.at(at);
    const before = next?.closest('[role="group"]') ?? next ?? null;
    if (!group) menu.insertBefore(item, before);
    else {
      const known = groups.get(group) ?? entryGroup(group);
      if (!groups.has(group)) menu.insertBefore(known, before);
      groups.set(group, known);
      known.append(item);
    }
    const now = /** @type {NodeListOf<HTMLElement>} */ (menu.querySelectorAll('[role="menuitem"]'));
    items.splice(0, items.length, ...now);
  };

  /** @type {(entry: Entry, at?: number) => void} */
  const add = ({ text, help: own, act, group, refusal }, at = items.length) => {
    const item = h("button", { role: "menuitem", tabindex: "-1", title: own, text });
    onPress(
      item,
      () => {
        menu.hidden = true;
        button.setAttribute("aria-expanded", "false");
        button.focus();
        act();
      },
      (why) => toast(why),
    );
    if (refusal) questions.push(attempt(async () => setAllowed(item, await refusal(), own)));
    insert(item, group, at);
  };
  entries.forEach((entry) => add(entry));
  openable(element, button, menu, items);
  return { element, add };
}
