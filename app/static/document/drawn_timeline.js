/**
 * The timeline that follows from foot order, phases and closing stance (thesis 3.3), to detect another one.
 */

import { heldBoth } from "./held_feet.js";
import { rowsOfFeet } from "./region.js";

/** @typedef {import("./drawable.js").GaitDocument} GaitDocument */

/**
 * Rows of 1 (stance) and 0 (swing), foot 1 first; the last sample is the goal, and stance for every foot.
 * Feet that are held up at both ends are in the air throughout, and the others take turns.
 * @param {GaitDocument} document
 * @returns {string[]}
 */
export function drawnRows(document) {
  const { options, iterations, direction } = document;
  /** @type {number[]} */
  const order = document.order;
  const legs = rowsOfFeet(document).length;
  const { phase_knots: phase, closing_knots: closing } = options;
  const turn = (legs / 4) * (direction - 1);
  const held = heldBoth(document).map((foot) => foot - 1);
  const walking = order
    .map((foot) => Math.floor(foot - 1 + turn) % legs)
    .filter((foot) => !held.includes(foot));
  const count = iterations * walking.length * 2 * phase + closing;
  /** @type {string[][]} */
  const rows = Array.from({ length: legs }, () => new Array(count).fill("1"));
  for (let step = 0; step < walking.length * iterations; step += 1) {
    rows[walking[step % walking.length]].fill("0", (2 * step + 1) * phase, (2 * step + 2) * phase);
  }
  return rows.map((row, foot) => (held.includes(foot) ? "0".repeat(count) : `${row.slice(0, -1).join("")}1`));
}

/**
 * Whether the timeline is still the one generated from foot order, phases and closing stance.
 * @param {GaitDocument} document
 */
export const isDrawn = (document) => rowsOfFeet(document).join() === drawnRows(document).join();

/**
 * A timeline drawn by hand, run through another number of times, its closing stance once at the end.
 * @param {GaitDocument} document
 * @param {number} wanted
 * @returns {string[]|null} null where its iterations are not equally long
 */
export function repeatedRows(document, wanted) {
  const { options, iterations } = document;
  const feet = rowsOfFeet(document);
  // Feet that are held up throughout say nothing of its end.
  const moving = Math.max(-1, ...feet.filter((row) => row.includes("1")).map((row) => row.lastIndexOf("0")));
  const resting = Math.min(feet[0].length - 1 - moving, options.closing_knots);
  const length = (feet[0].length - resting) / iterations;
  if (!Number.isInteger(length)) return null;
  return feet.map((row) => row.slice(0, length).repeat(wanted) + row.slice(length * iterations));
}

/**
 * The foot order that a document shows: that of a painted timeline's first swings, where each foot has one.
 * @param {GaitDocument} document
 * @returns {number[]}
 */
export function drawnOrder(document) {
  const { order, direction } = document;
  if (document.poses || direction !== 1 || isDrawn(document)) return order;
  const firsts = rowsOfFeet(document).map((row) => row.indexOf("0"));
  const isPlain = firsts.every((first) => first >= 0) && new Set(firsts).size === firsts.length;
  return isPlain
    ? firsts.map((_, foot) => foot + 1).sort((one, other) => firsts[one - 1] - firsts[other - 1])
    : order;
}
