/** What is read under a pointer: of a mouse as long as it is there, of a finger until the next touch elsewhere. */

/**
 * @param {Element} element
 * @param {(event: PointerEvent) => void} show called wherever the pointer is, or a finger comes down
 * @param {() => void} hide
 */
export function onPointed(element, show, hide) {
  const elsewhere = ({ target }) => {
    if (!element.contains(target)) hide();
  };
  for (const type of ["pointerdown", "pointermove"]) element.addEventListener(type, show);
  element.addEventListener("pointerleave", ({ pointerType }) => {
    if (pointerType !== "touch") hide();
    else document.addEventListener("pointerdown", elsewhere, { capture: true, once: true });
  });
}
