/** Changes of a sequence: each a function from document to document, and what its undo entry is called. */

/**
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 * @typedef {Record<string, any>} Part
 */

/**
 * @param {(parts: Part[]) => Part[]} change
 * @returns {(document: GaitDocument) => GaitDocument}
 */
const withParts = (change) => (document) => ({ ...document, sequence: change(document.sequence ?? []) });

/** How often a part may run. */
export const MOST_TIMES = 20;

/** Whether a document chains gaits. @param {any} document */
export const isSequence = (document) => Boolean(document?.sequence?.length);

/**
 * Adds a gait at the end; one that is itself a sequence stands for its parts.
 * @param {GaitDocument} gait its document
 * @param {string} source its id
 */
export function added(gait, source) {
  const parts = isSequence(gait) ? gait.sequence : [{ gait, times: 1, source }];
  return { apply: withParts((before) => [...before, ...parts]), label: `Add ${gait.name}` };
}

/** Takes a part out. @param {GaitDocument} document @param {number} index */
export function removed(document, index) {
  return {
    apply: withParts((parts) => parts.filter((_, at) => at !== index)),
    label: `Take out ${document.sequence[index].gait.name}`,
  };
}

/**
 * Moves a part to another place, counted from 0.
 * @param {GaitDocument} document
 * @param {number} from
 * @param {number} to
 */
export function moved(document, from, to) {
  const apply = withParts((parts) => {
    if (!parts[from]) return parts;
    const rest = parts.filter((_, at) => at !== from);
    return [...rest.slice(0, to), parts[from], ...rest.slice(to)];
  });
  return { apply, label: `Move ${document.sequence[from].gait.name} to place ${to + 1}` };
}

/**
 * Lets a part run so often.
 * @param {GaitDocument} document
 * @param {number} index
 * @param {number} times
 */
export function repeated(document, index, times) {
  const apply = withParts((parts) => parts.map((part, at) => (at === index ? { ...part, times } : part)));
  return { apply, label: `Run ${document.sequence[index].gait.name} ${times}×` };
}

/**
 * Lets the repetitions of parts each start from rest with the gait's own motion, or follow each other
 * without a pause.
 * @param {GaitDocument} document
 * @param {number[]} indices
 * @param {boolean} restarts
 */
export function restarted(document, indices, restarts) {
  const one = (/** @type {Part} */ { restarts: _, ...part }) => (restarts ? { ...part, restarts } : part);
  const apply = withParts((parts) => parts.map((part, at) => (indices.includes(at) ? one(part) : part)));
  const names = indices.map((index) => document.sequence[index].gait.name).join(", ");
  const label = restarts ? `Start each repetition of ${names} from rest` : `Run ${names} without a pause`;
  return { apply, label };
}
