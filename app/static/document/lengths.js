/** What changes the number of samples: functions from gait document to gait document, over all feet at once. */

import { lengthOf } from "./region.js";
import { resampled } from "./timeline_operators.js";

/** Replaces the region's samples of all feet by what `change` makes of each row of them; locks there are gone. */
function spliced(document, { samples: [first, last] }, change) {
  const cut = (row, make) => row.slice(0, first) + make(row.slice(first, last + 1)) + row.slice(last + 1);
  const { feet, locked } = document.timeline;
  const rows = feet.map((row) => cut(row, change));
  const unlocked = (text) => "0".repeat(change(text).length);
  return { ...document, timeline: { ...document.timeline, feet: rows, locked: locked && locked.map((row) => cut(row, unlocked)) } };
}

/** Inserts samples before the region; in them every foot does what it did in the sample before. */
export function inserted(document, region, count) {
  const [first] = region.samples;
  const { feet, locked } = document.timeline;
  const grown = (row, value) => row.slice(0, first) + value.repeat(count) + row.slice(first);
  const rows = feet.map((row) => grown(row, row[Math.max(0, first - 1)]));
  return { ...document, timeline: { ...document.timeline, feet: rows, locked: locked && locked.map((row) => grown(row, "0")) } };
}

export const removed = (document, region) => spliced(document, region, () => "");

/** The region's samples a number of times one after the other. */
export const repeated = (document, region, times) => spliced(document, region, (text) => text.repeat(times));

/** The region's samples over another number of samples; what is behind moves along. */
export const stretched = (document, region, length) =>
  spliced(document, region, (text) => (length === lengthOf(region) ? text : resampled(text, length)));
