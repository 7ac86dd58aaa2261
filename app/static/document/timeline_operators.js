/**
 * What is done to a region of the timeline: functions from document to document that keep its length.
 *
 * They look at nothing but the cells; `heldBack` says which locked cell such a change would touch.
 */

import { cellsOf, feetOf, lengthOf, rowsOfFeet } from "./region.js";

/**
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 * @typedef {import("./region.js").Region} Region
 */

/** @param {GaitDocument} document @param {string[]} feet @returns {GaitDocument} */
const withFeet = (document, feet) => ({ ...document, timeline: { ...document.timeline, feet } });

/**
 * A row with other text from a sample on, as far as the row goes.
 * @param {string} row
 * @param {number} sample
 * @param {string} text
 */
const written = (row, sample, text) =>
  row.slice(0, sample) + text.slice(0, row.length - sample) + row.slice(sample + text.length);

/** Rows of 1 and 0 inside a region, a row per foot. @param {GaitDocument} document @param {Region} region */
export const blockOf = (document, { feet: [top, bottom], samples: [first, last] }) =>
  rowsOfFeet(document)
    .slice(top, bottom + 1)
    .map((row) => row.slice(first, last + 1));

/**
 * Writes a block with its first row and sample at a cell; what does not fit is left out.
 * @param {GaitDocument} document
 * @param {number[]} cell
 * @param {string[]} block
 */
export function withBlock(document, [foot, sample], block) {
  return withFeet(
    document,
    rowsOfFeet(document).map((row, index) =>
      block[index - foot] === undefined ? row : written(row, sample, block[index - foot]),
    ),
  );
}

/** @param {GaitDocument} document @param {Region} region @param {(row: string) => string} change */
const eachRow = (document, region, change) =>
  withBlock(document, [region.feet[0], region.samples[0]], blockOf(document, region).map(change));

/** @param {GaitDocument} document @param {Region} region */
export const toStance = (document, region) => eachRow(document, region, (row) => "1".repeat(row.length));

/** @param {GaitDocument} document @param {Region} region */
export const reversed = (document, region) => eachRow(document, region, (row) => [...row].reverse().join(""));

/**
 * Moves the region's samples later (earlier for a negative `by`); what leaves at one end enters at the other.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} by
 */
export function shifted(document, region, by) {
  const length = lengthOf(region);
  const cut = length - (((by % length) + length) % length);
  return eachRow(document, region, (row) => row.slice(cut) + row.slice(0, cut));
}

/**
 * Feet of the region and those that they change places with; `mirror` gives each foot's counterpart.
 * @param {Region} region
 * @param {number[]} mirror
 */
export const mirroredFeet = (region, mirror) =>
  [...new Set(feetOf(region).flatMap((foot) => [foot, mirror[foot]]))].sort((a, b) => a - b);

/**
 * Changes each foot of the region with its counterpart on the other side of the heading.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number[]} mirror
 */
export function mirrored(document, region, mirror) {
  const [first, last] = region.samples;
  const rows = rowsOfFeet(document);
  const turned = new Set(mirroredFeet(region, mirror));
  return withFeet(
    document,
    rows.map((row, foot) =>
      turned.has(foot) ? written(row, first, rows[mirror[foot]].slice(first, last + 1)) : row,
    ),
  );
}

/**
 * A row over another number of samples: each takes the value at the same share of the time.
 * @param {string} row
 * @param {number} length
 */
export const resampled = (row, length) =>
  Array.from({ length }, (_, sample) => row[Math.floor(((sample + 0.5) * row.length) / length)]).join("");

/**
 * The region's samples over another number of samples; what was behind is written over, what is left stands.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} length
 */
export function stretchedInPlace(document, region, length) {
  const cleared = toStance(document, region);
  return withBlock(
    cleared,
    [region.feet[0], region.samples[0]],
    blockOf(document, region).map((row) => resampled(row, length)),
  );
}

/**
 * Takes the region's content to other samples; where it was, its feet stand. Copies it where `keeps` says so.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number} by
 */
export function relocated(document, region, by, keeps = false) {
  const block = blockOf(document, region);
  const sample = region.samples[0] + by;
  const from = Math.max(0, -sample);
  return withBlock(
    keeps ? document : toStance(document, region),
    [region.feet[0], sample + from],
    block.map((row) => row.slice(from)),
  );
}

/**
 * Locks every cell of the region, or unlocks it.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {boolean} locked
 */
export function withLocks(document, region, locked) {
  const { locked: before } = document.timeline;
  /** @type {string[]} */
  const locks = before ?? rowsOfFeet(document).map((row) => "0".repeat(row.length));
  const rows = locks.map((row) => [...row]);
  for (const [foot, sample] of cellsOf(region)) rows[foot][sample] = locked ? "1" : "0";
  return { ...document, timeline: { ...document.timeline, locked: rows.map((row) => row.join("")) } };
}

/**
 * The direction's rows a number of quarter turns further on (four feet: a foot a quarter).
 * @param {string[]} rows
 * @param {number} quarterTurns
 */
export function turnedRows(rows, quarterTurns) {
  const by = Math.floor((quarterTurns * rows.length) / 4);
  return rows.map((_, foot) => rows[(((foot - by) % rows.length) + rows.length) % rows.length]);
}

/** @param {GaitDocument} document @returns {number[]|null} */
const firstLocked = ({ timeline }) => {
  const foot = (timeline.locked ?? []).findIndex((/** @type {string} */ row) => row.includes("1"));
  return foot < 0 ? null : [foot, timeline.locked[foot].indexOf("1")];
};

/**
 * Why a change may not be made: a locked cell would change, or nothing at all. Null where it may.
 * @param {GaitDocument} before
 * @param {GaitDocument} after
 * @returns {string|null}
 */
export function heldBack(before, after) {
  const [old, now] = [before.timeline, after.timeline];
  if (old.feet[0].length !== now.feet[0].length) {
    const cell = firstLocked(before);
    return (
      cell
      && `Foot ${cell[0] + 1}, sample ${cell[1] + 1} is locked. `
        + "Unlock all cells before you change the number of samples."
    );
  }
  for (const [foot, row] of (old.locked ?? []).entries()) {
    const sample = [...row].findIndex(
      (lock, index) =>
        lock === "1"
        && now.locked?.[foot]?.[index] === "1"
        && old.feet[foot][index] !== now.feet[foot][index],
    );
    if (sample < 0) continue;
    return (
      `This operation would change foot ${foot + 1}, sample ${sample + 1}, which is locked. `
      + "Unlock this cell first."
    );
  }
  return JSON.stringify(before) === JSON.stringify(after) ? "Nothing would change." : null;
}
