/** Messages that float over the preview for a while, and announcements for screen readers. */

import { byId, h, icon } from "./dom.js";

const MOST = 3;
const STAY_MS = 9000;
const STAY_BAD_MS = 15000;
const STAY_ACTION_MS = 90000;

/**
 * The sentences that stand, the oldest first.
 * @returns {HTMLElement[]}
 */
const standing = () => [...byId("toasts").children];

/** What makes room where too many stand: the oldest, an offer only after all others. */
function tooMany() {
  const older = standing().slice(0, -1);
  return older.find(({ dataset }) => dataset.of !== "studio") ?? older[0];
}

/**
 * Shows a sentence: a refusal longer than news, an offer such as bringing something back the longest.
 * @param {string} sentence
 * @param {{
 *   tone?: "bad"|"plain", action?: {label: string, act: () => void}|null, of?: "gait"|"studio"
 * }} [options]
 *   `of` says whether it belongs to the shown gait, and goes with it; an offer does not
 */
export function toast(sentence, { tone = "plain", action = null, of = action ? "studio" : "gait" } = {}) {
  const close = () => element.remove();
  const element = h(
    "div",
    { class: "toast", role: tone === "bad" ? "alert" : "status", data: { tone, of } },
    h("p", { text: sentence }),
    action
      && h("button", {
        text: action.label,
        on: {
          click: () => {
            close();
            action.act();
          },
        },
      }),
    h("button", { class: "plain icon-only", "aria-label": "Dismiss", on: { click: close } }, icon("close")),
  );
  standing()
    .filter((other) => other.querySelector("p")?.textContent === sentence)
    .forEach((other) => other.remove());
  byId("toasts").append(element);
  while (standing().length > MOST) tooMany().remove();
  setTimeout(close, action ? STAY_ACTION_MS : tone === "bad" ? STAY_BAD_MS : STAY_MS);
}

/** Removes error messages that no longer apply because the gait changed or another is shown. */
export function clearRefusals() {
  for (const element of standing())
    if (element.matches('[data-tone="bad"][data-of="gait"]')) element.remove();
}

/** Takes away what belongs to the gait that was shown until now. */
export function clearOfGait() {
  for (const element of standing()) if (element.matches('[data-of="gait"]')) element.remove();
}

/**
 * Shows the message of an error.
 * @param {any} error
 */
export function report(error) {
  toast(error.message, { tone: "bad" });
}

/**
 * Tells a screen reader, without taking the focus.
 * @param {string} sentence
 */
export function announce(sentence) {
  byId("announcer").textContent = sentence;
}

/**
 * Runs an asynchronous action and reports its refusal; then the answer is null.
 * @param {(...values: any[]) => any} action
 * @returns {(...values: any[]) => Promise<any>}
 */
export function attempt(action) {
  return async (...values) => {
    try {
      return await action(...values);
    } catch (error) {
      report(error);
      return null;
    }
  };
}
