/** Explanations by touch: a long press shows what a pointer over the same place would show. */

import { clamp } from "./clamp.js";
import { h } from "./dom.js";

const HOLD_MS = 500;
/** A finger that is held still moves no further than this, px. */
const STILL_PX = 10;
const GAP = 12;

/**
 * What is explained at an element: its own title, that of a part around it, or of the field that it labels.
 * @param {Element} target
 */
function explanationOf(target) {
  for (
    let element = /** @type {Element|null} */ (target);
    element && element !== document.body;
    element = element.parentElement
  ) {
    const text =
      element.getAttribute("title")
      || element.querySelector(":scope > title")?.textContent
      || (element instanceof HTMLLabelElement && element.control?.title);
    if (text) return text;
  }
  return null;
}

/** Controls that act while they are held, or that must act however long they are pressed. */
const actsWhileHeld = (/** @type {Element} */ target) =>
  target.closest(".hold:not([aria-disabled])") !== null;
const actsAlways = (/** @type {Element} */ target) => target.closest("#stop") !== null;

/**
 * Puts the explanation over the finger, inside the window.
 * @param {HTMLElement} bubble
 * @param {PointerEvent} event
 */
function place(bubble, { clientX, clientY }) {
  const { offsetWidth: width, offsetHeight: height } = bubble;
  const above = clientY - height - 2 * GAP;
  const top = above >= GAP ? above : clientY + 2 * GAP;
  bubble.style.left = `${clamp(clientX - width / 2, GAP, Math.max(GAP, innerWidth - width - GAP))}px`;
  bubble.style.top = `${clamp(top, GAP, Math.max(GAP, innerHeight - height - GAP))}px`;
}

/**
 * Keeps the browser from its own act on an event.
 * @param {string} type
 * @param {() => boolean} isKept
 */
function keepFromBrowser(type, isKept) {
  const prevent = (/** @type {Event} */ event) => {
    if (isKept()) event.preventDefault();
  };
  window.addEventListener(type, prevent, { capture: true, passive: false });
}

/**
 * Explains by long presses. A press that explained does nothing else.
 * @param {() => void} shown called with each explanation, to end what the press had begun
 */
export function mountTouchHelp(shown) {
  const bubble = h("div", { class: "touch-help", role: "status", "aria-label": "Explanation", hidden: true });
  document.body.append(bubble);
  /** @type {{x: number, y: number, timer: number}|null} */
  let press = null;
  let hasExplained = false;

  function letGo() {
    clearTimeout(press?.timer);
    press = null;
  }

  function hide() {
    bubble.hidden = true;
    bubble.textContent = "";
  }

  /**
   * @param {PointerEvent} event
   * @param {string} text
   */
  function explain(event, text) {
    letGo();
    hasExplained = !actsAlways(/** @type {Element} */ (event.target));
    bubble.textContent = text;
    bubble.hidden = false;
    place(bubble, event);
    shown();
  }

  /** @param {PointerEvent} event */
  function begin(event) {
    letGo();
    hide();
    hasExplained = false;
    const target = /** @type {Element} */ (event.target);
    if (event.pointerType !== "touch" || !event.isPrimary || actsWhileHeld(target)) return;
    // Read now: what the press begins may draw the place anew.
    const text = explanationOf(target);
    if (text)
      press = { x: event.clientX, y: event.clientY, timer: setTimeout(() => explain(event, text), HOLD_MS) };
  }

  /** @param {PointerEvent} event */
  function move({ clientX, clientY }) {
    if (press && Math.hypot(clientX - press.x, clientY - press.y) > STILL_PX) letGo();
  }

  window.addEventListener("pointerdown", begin, true);
  window.addEventListener("pointermove", move, true);
  for (const type of ["pointerup", "pointercancel", "blur"]) window.addEventListener(type, letGo, true);
  // Neither a click, nor what a press of the mouse opens, such as a list of choices.
  keepFromBrowser("touchend", () => hasExplained);
  window.addEventListener(
    "click",
    (event) => {
      if (!hasExplained) return;
      hasExplained = false;
      event.preventDefault();
      event.stopImmediatePropagation();
    },
    true,
  );
  // The browser's own menu of a long press would cover the explanation.
  keepFromBrowser("contextmenu", () => press !== null || hasExplained);
  window.addEventListener("scroll", hide, true);
  window.addEventListener("keydown", hide, true);
}
