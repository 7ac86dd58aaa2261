/** The footfalls of a gait as small as a line of a list. */

import { svg } from "../lib/dom.js";

/**
 * The swings of a row as [first, length].
 * @returns {[number, number][]}
 */
const swingsOf = (row) => [...row.matchAll(/0+/g)].map((found) => [found.index, found[0].length]);

const bits = (digit) => parseInt(digit, 16).toString(2).padStart(4, "0");

/** The bits of hexadecimal digits, as a row of 1 and 0. */
const bitsOf = (digits) => [...digits].map(bits).join("");

/** A bar of the picture. */
function bar([x, width], foot) {
  return svg("rect", { class: "swing", "data-foot": foot + 1, x, y: foot + 0.1, width, height: 0.8 });
}

/**
 * The picture, one row a foot, a bar a swing.
 * @param {string[]} feet rows of 1 (stance) and 0 (swing)
 */
export function footfalls(feet) {
  const bars = feet.flatMap((row, foot) => swingsOf(row).map((swing) => bar(swing, foot)));
  const viewBox = `0 0 ${feet[0].length} ${feet.length}`;
  return svg(
    "svg",
    { class: "footfalls", viewBox, preserveAspectRatio: "none", "aria-hidden": "true" },
    ...bars,
  );
}

/**
 * The picture of a line of the list of gaits.
 * @param {string[]} columns for each foot hexadecimal digits, a bit a column: 1 (stance) and 0 (swing)
 */
export const thumbnail = (columns) => footfalls(columns.map(bitsOf));
