/** What is read under a pointer: a mouse's as long as it is there, a finger's until it touches elsewhere. */

/**
 * @param {GlobalEventHandlers & Node} element
 * @param {(event: PointerEvent) => void} show called wherever the pointer is, or a finger comes down
 * @param {() => void} hide
 */
export function onPointed(element, show, hide) {
  const elsewhere = (/** @type {PointerEvent} */ { target }) => {
    if (!element.contains(/** @type {Node} */ (target))) hide();
  };
  element.addEventListener("pointerdown", show);
  element.addEventListener("pointermove", show);
  element.addEventListener("pointerleave", ({ pointerType }) => {
    if (pointerType !== "touch") hide();
    else document.addEventListener("pointerdown", elsewhere, { capture: true, once: true });
  });
}
