/** A search field over a long list of gaits: every word must occur in name, robot, orientation, source or foot order. */

import { h } from "../lib/dom.js";

const ENOUGH = 20;

/** Whether a gait's line has every word of the search. */
export function found(gait, search) {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const text = [gait.name, gait.orientation, gait.source, gait.robot].filter(Boolean).join(" ").toLowerCase();
  return words.every((word) => text.includes(word) || word === gait.order.join(""));
}

/**
 * Builds the field; it is hidden while few gaits are listed. `show` gets the number of matches and the number of gaits.
 * @param {(search: string) => void} changed called with what is searched for
 * @returns {{element: HTMLElement, show: (listed: number, count: number) => void, search: () => string}}
 */
export function gaitSearch(changed) {
  const field = h("input", { type: "search", "aria-label": "Find a gait", placeholder: "Find a gait", autocomplete: "off", spellcheck: "false", title: "Words of its name, robot, orientation or making; or its foot order" });
  const nothing = h("p", { class: "teach", role: "status", hidden: true });
  const element = h("div", { class: "gait-search", hidden: true }, field, nothing);
  field.addEventListener("input", () => changed(field.value));
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !field.value) return;
    event.preventDefault();
    event.stopPropagation();
    field.value = "";
    changed("");
  });
  return {
    element,
    search: () => field.value,
    show(listed, count) {
      element.hidden = listed <= ENOUGH && !field.value;
      nothing.hidden = listed > 0 || !field.value;
      if (!listed) nothing.textContent = `No gait has “${field.value.trim()}”. Esc shows all ${count}.`;
    },
  };
}
