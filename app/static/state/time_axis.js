/**
 * The time axis that ruler, timeline, plots and playhead share, and the window of it that is shown.
 *
 * A sample is a point in time, drawn as a column; its moment is the column's middle. What draws on the axis goes
 * through `axisOf`, `fractionAt` and `timeAt`, and draws anew when `axisKey` changes: then it follows zoom and preview.
 */

import { clamp } from "../lib/clamp.js";
import { previewedDocument, shownPlan } from "./store.js";

/** Fewest columns that a zoomed window shows. */
export const LEAST_SHOWN = 8;

/**
 * @param {object} state of the store
 * @returns {{samples: number, columns: number, step: number, duration: number, first: number, shown: number}} `step` in
 *   s; the window begins at column `first` and is `shown` columns wide, both may be broken numbers
 */
export function axisOf(state) {
  const document = previewedDocument(state);
  const step = document?.timeline.sample_time ?? 0.4;
  const samples = document?.timeline.feet[0]?.length ?? 0;
  const planEnd = shownPlan(state)?.times?.at(-1) ?? 0;
  const columns = Math.max(samples, Math.round(planEnd / step) + 1, 1);
  const shown = clamp(state.zoom?.shown ?? columns, Math.min(LEAST_SHOWN, columns), columns);
  const first = clamp(state.zoom?.first ?? 0, 0, columns - shown);
  return { samples, columns, step, duration: planEnd || Math.max(0, samples - 1) * step, first, shown };
}

/** What a drawing on the axis depends on, as one value to be watched. */
export function axisKey(state) {
  const { samples, columns, step, first, shown } = axisOf(state);
  return `${samples} ${columns} ${step} ${first} ${shown}`;
}

/** Where a moment lies on the shown window, 0 to 1; outside of it less or more. */
export const fractionAt = (axis, time) => columnFraction(axis, time / axis.step + 0.5);

/** Where the left edge of a column lies on the shown window, 0 to 1. */
export const columnFraction = (axis, column) => (column - axis.first) / axis.shown;

/** The moment at a place on the shown window, held inside the duration. */
export function timeAt(axis, fraction) {
  const time = (axis.first + fraction * axis.shown - 0.5) * axis.step;
  return clamp(time, 0, axis.duration);
}

/** Seconds between labels so that they stay at least `least` pixels apart. */
export function labelEvery(axis, width, least = 56) {
  const second = width / (axis.shown * axis.step);
  return [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60, 120].find((every) => every * second >= least) ?? 300;
}
