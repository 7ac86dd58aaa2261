/** What a person works on in the inspector stays under the hand while something above it grows or shrinks. */

import { byId } from "./dom.js";

/**
 * @param {HTMLElement[]} above What may grow.
 * @param {() => number} edge Where they end, px; grows as they do.
 * @param {() => boolean} isWorking Whether a person works on something below them.
 */
export function keepPlace(above, edge, isWorking) {
  const panel = byId("sections");
  let was = edge();
  const observer = new ResizeObserver(() => {
    const now = edge();
    if (isWorking()) panel.scrollTop += now - was;
    was = now;
  });
  above.forEach((element) => observer.observe(element));
}
