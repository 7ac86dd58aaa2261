/** The footfalls of a gait as small as a line of a list. */

import { svg } from "../lib/dom.js";

/** The swings of a row as [first, length]. */
const swingsOf = (row) => [...row.matchAll(/0+/g)].map((found) => [found.index, found[0].length]);

/**
 * The picture, one row a foot, a bar a swing.
 * @param {string[]} feet rows of 1 (stance) and 0 (swing)
 */
export function footfalls(feet) {
  const bars = feet.flatMap((row, foot) => swingsOf(row).map(([x, width]) => svg("rect", { class: "swing", "data-foot": foot + 1, x, y: foot + 0.1, width, height: 0.8 })));
  return svg("svg", { class: "footfalls", viewBox: `0 0 ${feet[0].length} ${feet.length}`, preserveAspectRatio: "none", "aria-hidden": "true" }, ...bars);
}
