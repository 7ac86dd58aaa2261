/** Keeps the page still under a press, so that press and release meet the same button. */

/** A press that lasts longer is a hold. */
const LONGEST_MS = 2000;

/** Presses that are on. */
let count = 0;

/**
 * Shows nothing new of the state between a press on a button and its release; then the newest.
 * @param {{hold: (isOn: boolean) => void}} store
 * @param {HTMLElement} element whose buttons are meant
 */
export function stillWhilePressed(store, element) {
  element.addEventListener("pointerdown", ({ target, pointerId: pressed }) => {
    if (!(/** @type {Element} */ (target).closest("button, summary, a"))) return;
    const ended = new AbortController();
    const letGo = () => {
      if (ended.signal.aborted) return;
      ended.abort();
      count -= 1;
      if (!count) store.hold(false);
    };
    const timer = setTimeout(letGo, LONGEST_MS);
    const release = (/** @type {PointerEvent} */ { pointerId }) => {
      if (pointerId !== pressed) return;
      clearTimeout(timer);
      // The click comes after the release.
      setTimeout(letGo);
    };
    count += 1;
    store.hold(true);
    window.addEventListener("pointerup", release, { signal: ended.signal });
    window.addEventListener("pointercancel", release, { signal: ended.signal });
  });
}
