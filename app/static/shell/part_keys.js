/** The key F6: from one part of the page to the next, with Shift to the one before. */

import { isShown } from "../lib/dom.js";

/** The parts in their order; the button of the next act is one of its own. */
const PARTS = [
  ".topbar",
  ".rail",
  "#drawers",
  ".stage",
  "#verdict",
  ".transport",
  "#chart, #segments",
  "#sections",
  ".inspector-foot",
];
const STOPS = "a[href], button, input, select, summary, [tabindex]";

const isStop = (element) =>
  element.tabIndex >= 0 && !element.disabled && isShown(element) && !element.closest("[inert]");

/** Of a foot the button of the next act, else what Tab reaches first; undefined where the part is hidden. */
function firstStop(part) {
  /** @type {NodeListOf<HTMLElement>} */
  const found = document.querySelectorAll(`:is(${part}) :is(${STOPS})`);
  const stops = [...found].filter(isStop);
  return stops.find((stop) => stop.matches(".inspector-foot .primary")) ?? stops[0];
}

/**
 * Moves the focus to the next part that is shown.
 * @param {1|-1} way
 */
export function goToPart(way) {
  const { length } = PARTS;
  const here = PARTS.findIndex((part) => document.activeElement?.closest(part));
  const from = here < 0 && way < 0 ? 0 : here;
  const others = PARTS.map((_, step) => PARTS[(from + way * (step + 1) + 2 * length) % length]);
  others.map(firstStop).find(Boolean)?.focus();
}
