/** One tab stop for a list or a toolbar: the arrow keys move between its controls. */

import { clamp } from "./clamp.js";

/** @typedef {HTMLElement & {disabled?: boolean}} Control */

const isOffered = (/** @type {Control} */ item) => !item.hidden && !item.disabled;

/**
 * The control that has the tab stop at first: the current one, else the first that can be seen.
 * @param {HTMLElement} root
 * @param {Control[]} items
 */
function firstOf(root, items) {
  const offered = items.filter(isOffered);
  const seen = root.checkVisibility() ? offered.filter((item) => item.checkVisibility()) : offered;
  return seen.find((item) => item.getAttribute("aria-current") === "true") ?? seen[0] ?? null;
}

/**
 * Makes the controls of a part one tab stop. Up and Down move between them, in a toolbar Left and Right, and
 * Home and End.
 * @param {HTMLElement} root
 * @param {{items?: string, isToolbar?: boolean}} [options] `items` is the selector of the controls
 */
export function oneTabStop(root, { items = "button, a[href]", isToolbar = false } = {}) {
  /** @type {Control|null} */
  let held = null;
  const [back, on] = isToolbar ? ["ArrowLeft", "ArrowRight"] : ["ArrowUp", "ArrowDown"];
  const all = () => /** @type {Control[]} */ ([...root.querySelectorAll(items)]);

  /** @param {Control|null} item */
  function hold(item) {
    if (held && held !== item) held.tabIndex = -1;
    held = item;
    if (item) item.tabIndex = 0;
  }

  /**
   * Takes controls that are new out of the order of Tab, and finds another stop where the last one is gone.
   * @param {(item: Control) => boolean} isSeen
   */
  function settle(isSeen) {
    const now = all();
    for (const item of now) if (item !== held && item.tabIndex !== -1) item.tabIndex = -1;
    const hasFocus = root.contains(document.activeElement);
    const current = hasFocus
      ? null
      : now.find((item) => item.getAttribute("aria-current") === "true" && isOffered(item));
    if (current) hold(current);
    else if (!held || !now.includes(held) || !isOffered(held) || !isSeen(held)) hold(firstOf(root, now));
  }

  /** @param {KeyboardEvent} event */
  function move(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    const seen = all().filter((item) => isOffered(item) && item.checkVisibility());
    const at = seen.findIndex((item) => item === document.activeElement);
    /** @type {Record<string, number>} */
    const goals = { [back]: at - 1, [on]: at + 1, Home: 0, End: seen.length - 1 };
    const goal = goals[event.key];
    if (at < 0 || goal === undefined) return;
    seen[clamp(goal, 0, seen.length - 1)].focus();
    event.preventDefault();
  }

  root.dataset.arrows = isToolbar ? "" : "upright";
  root.addEventListener("keydown", move);
  root.addEventListener("focusin", ({ target }) => {
    const item = /** @type {Control|null} */ (/** @type {Element} */ (target).closest(items));
    if (item && root.contains(item)) hold(item);
  });
  const changes = {
    childList: true,
    subtree: true,
    attributes: true,
    attributeFilter: ["hidden", "disabled", "aria-current"],
  };
  new MutationObserver(() => settle(() => true)).observe(root, changes);
  // What a style sheet hides is noticed where the part is shown, or has another size.
  new ResizeObserver(() => settle((item) => !root.checkVisibility() || item.checkVisibility())).observe(root);
  settle(() => true);
}
