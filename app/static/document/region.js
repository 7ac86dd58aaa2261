/** A rectangle of the timeline, 0-based, both ends included. */

import { clamp } from "../lib/clamp.js";

/**
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 * @typedef {{feet: number[], samples: number[]}} Region each [first, last]
 */

/** The rows of the timeline's cells, a row per foot. @param {GaitDocument} document @returns {string[]} */
export const rowsOfFeet = ({ timeline }) => timeline.feet;

/** @param {GaitDocument} document @returns {number[]} */
const sizeOf = ({ timeline }) => [timeline.feet.length, timeline.feet[0].length];

/** The whole timeline. @param {GaitDocument} document @returns {Region} */
export function wholeOf(document) {
  const [feet, samples] = sizeOf(document);
  return { feet: [0, feet - 1], samples: [0, samples - 1] };
}

/**
 * The rectangle between two cells, each [foot, sample].
 * @param {number[]} cell
 * @param {number[]} other
 * @returns {Region}
 */
export const spanning = ([foot, sample], [otherFoot, otherSample]) => ({
  feet: [Math.min(foot, otherFoot), Math.max(foot, otherFoot)],
  samples: [Math.min(sample, otherSample), Math.max(sample, otherSample)],
});

/**
 * The part of a region that lies on the timeline; null where none does.
 * @param {GaitDocument} document
 * @param {Region|null} region
 * @returns {Region|null}
 */
export function within(document, region) {
  const [feet, samples] = sizeOf(document);
  if (!region || region.feet[0] >= feet || region.samples[0] >= samples) return null;
  const clamped = (/** @type {number[]} */ ends, /** @type {number} */ count) =>
    ends.map((value) => clamp(value, 0, count - 1));
  return { feet: clamped(region.feet, feet), samples: clamped(region.samples, samples) };
}

/** @param {Region} region */
export const lengthOf = ({ samples: [first, last] }) => last - first + 1;

/** @param {Region} region */
export const feetOf = ({ feet: [first, last] }) =>
  Array.from({ length: last - first + 1 }, (_, index) => first + index);

/** @param {Region} region */
export const samplesOf = ({ samples: [first, last] }) =>
  Array.from({ length: last - first + 1 }, (_, index) => first + index);

/** @param {Region} region */
export const cellsOf = (region) =>
  feetOf(region).flatMap((foot) => samplesOf(region).map((sample) => [foot, sample]));

/** @param {Region} region @param {number[]} cell */
export const hasCell = ({ feet, samples }, [foot, sample]) =>
  foot >= feet[0] && foot <= feet[1] && sample >= samples[0] && sample <= samples[1];

/** @param {GaitDocument} document @param {Region} region */
export const allFeet = (document, { feet: [first, last] }) =>
  first === 0 && last === document.timeline.feet.length - 1;

/** @param {GaitDocument} document @param {Region} region */
export const isWhole = (document, region) =>
  allFeet(document, region) && lengthOf(region) === document.timeline.feet[0].length;

/** @param {string} one @param {string} many @param {number[]} ends */
const range = (one, many, [first, last]) =>
  first === last ? `${one} ${first + 1}` : `${many} ${first + 1}–${last + 1}`;

/** In words, counted from 1: "foot 3, samples 6–10". @param {GaitDocument} document @param {Region} region */
export function regionText(document, region) {
  if (isWhole(document, region)) return "the whole timeline";
  const feet = allFeet(document, region) ? "all feet" : range("foot", "feet", region.feet);
  return lengthOf(region) === document.timeline.feet[0].length
    ? `all of ${feet}`
    : `${feet}, ${range("sample", "samples", region.samples)}`;
}
