/** Held feet at the ends of a gait, counted from 1, also after turning, mirroring or reversing the gait. */

export const heldOf = ({ held }) => ({ start: held?.start ?? [], end: held?.end ?? [] });

/** Feet that are held up at both ends. */
export function heldBoth(document) {
  const { start, end } = heldOf(document);
  return start.filter((foot) => end.includes(foot));
}

/** The document with other feet held up. */
export function withHeld({ held: _, ...document }, { start, end }) {
  const sorted = (feet) => [...feet].sort((a, b) => a - b);
  return start.length || end.length
    ? { ...document, held: { start: sorted(start), end: sorted(end) } }
    : document;
}

function renamed(document, name) {
  const { start, end } = heldOf(document);
  return withHeld(document, { start: start.map(name), end: end.map(name) });
}

/** Each foot's hold goes so many feet further round the ring. */
export function heldTurned(document, by) {
  const legs = document.timeline.feet.length;
  return renamed(document, (foot) => ((((foot - 1 + by) % legs) + legs) % legs) + 1);
}

/** Each foot changes places with its mirror image. */
export const heldMirrored = (document, mirror) => renamed(document, (foot) => mirror[foot - 1] + 1);

/** The end becomes the start. */
export function heldReversed(document) {
  const { start, end } = heldOf(document);
  return withHeld(document, { start: end, end: start });
}
