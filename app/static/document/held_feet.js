/** Held feet at the ends of a gait, counted from 1, also after turning, mirroring or reversing the gait. */

/** @typedef {import("./drawable.js").GaitDocument} GaitDocument */
/** @typedef {{start: number[], end: number[]}} Held */

/** @param {GaitDocument} document @returns {Held} */
export const heldOf = ({ held }) => ({ start: held?.start ?? [], end: held?.end ?? [] });

/** Feet that are held up at both ends. @param {GaitDocument} document */
export function heldBoth(document) {
  const { start, end } = heldOf(document);
  return start.filter((foot) => end.includes(foot));
}

/**
 * The document with other feet held up.
 * @param {GaitDocument} document
 * @param {Held} held
 * @returns {GaitDocument}
 */
export function withHeld({ held: _, ...document }, { start, end }) {
  const sorted = (/** @type {number[]} */ feet) => [...feet].sort((a, b) => a - b);
  return start.length || end.length
    ? { ...document, held: { start: sorted(start), end: sorted(end) } }
    : document;
}

/** @param {GaitDocument} document @param {(foot: number) => number} name */
function renamed(document, name) {
  const { start, end } = heldOf(document);
  return withHeld(document, { start: start.map(name), end: end.map(name) });
}

/**
 * Each foot's hold goes so many feet further round the ring.
 * @param {GaitDocument} document
 * @param {number} by
 */
export function heldTurned(document, by) {
  const legs = document.timeline.feet.length;
  return renamed(document, (foot) => ((((foot - 1 + by) % legs) + legs) % legs) + 1);
}

/** Each foot changes places with its mirror image. @param {GaitDocument} document @param {number[]} mirror */
export const heldMirrored = (document, mirror) => renamed(document, (foot) => mirror[foot - 1] + 1);

/** The end becomes the start. @param {GaitDocument} document */
export function heldReversed(document) {
  const { start, end } = heldOf(document);
  return withHeld(document, { start: end, end: start });
}
