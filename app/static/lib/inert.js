/** Parts of the page that cannot be used for a while. Several may have a reason at the same time; the last one frees the part. */

/** @type {WeakMap<HTMLElement, Set<string>>} */
const reasons = new WeakMap();

/**
 * Locks a part for a reason, or takes that reason back.
 * @param {HTMLElement} element
 * @param {string} reason
 * @param {boolean} isLocked
 */
export function setInert(element, reason, isLocked) {
  const known = reasons.get(element) ?? new Set();
  if (isLocked) known.add(reason);
  else known.delete(reason);
  reasons.set(element, known);
  element.inert = known.size > 0;
}
