/** What is done to a region of the timeline and changes its length: functions from document to document. */

import { lengthOf, rowsOfFeet } from "./region.js";
import { resampled } from "./timeline_operators.js";

/**
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 * @typedef {import("./region.js").Region} Region
 */

/**
 * Replaces the region's samples of all feet by what `change` makes of each row of them; locks there are gone.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {(text: string) => string} change
 */
function spliced(document, { samples: [first, last] }, change) {
  /** @param {string} row @param {(text: string) => string} make */
  const cut = (row, make) => row.slice(0, first) + make(row.slice(first, last + 1)) + row.slice(last + 1);
  /** @type {{locked?: string[]}} */
  const { locked } = document.timeline;
  const rows = rowsOfFeet(document).map((row) => cut(row, change));
  const unlocked = (/** @type {string} */ text) => "0".repeat(change(text).length);
  return {
    ...document,
    timeline: { ...document.timeline, feet: rows, locked: locked && locked.map((row) => cut(row, unlocked)) },
  };
}

/**
 * Inserts samples before the region; in them every foot does what it did in the sample before.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} count
 */
export function inserted(document, region, count) {
  const [first] = region.samples;
  /** @type {{locked?: string[]}} */
  const { locked } = document.timeline;
  /** @param {string} row @param {string} value */
  const grown = (row, value) => row.slice(0, first) + value.repeat(count) + row.slice(first);
  const rows = rowsOfFeet(document).map((row) => grown(row, row[Math.max(0, first - 1)]));
  return {
    ...document,
    timeline: { ...document.timeline, feet: rows, locked: locked && locked.map((row) => grown(row, "0")) },
  };
}

/** @param {GaitDocument} document @param {Region} region */
export const removed = (document, region) => spliced(document, region, () => "");

/**
 * The region's samples a number of times one after the other.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} times
 */
export const repeated = (document, region, times) => spliced(document, region, (text) => text.repeat(times));

/**
 * The region's samples over another number of samples; what is behind moves along.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} length
 */
export const stretched = (document, region, length) =>
  spliced(document, region, (text) => (length === lengthOf(region) ? text : resampled(text, length)));
