/**
 * The time axis that timeline, plots and playhead share.
 *
 * A sample is a point in time, drawn as a column; its moment is the column's middle.
 */

import { shownDocument } from "./store.js";

/**
 * @param {object} state of the store
 * @returns {{samples: number, columns: number, step: number, duration: number}} `step` in s
 */
export function axisOf(state) {
  const document = shownDocument(state);
  const step = document?.timeline.sample_time ?? 0.4;
  const samples = document?.timeline.feet[0]?.length ?? 0;
  const planEnd = state.view?.plan?.times?.at(-1) ?? 0;
  const columns = Math.max(samples, Math.round(planEnd / step) + 1, 1);
  return { samples, columns, step, duration: planEnd || Math.max(0, samples - 1) * step };
}

/** Where a moment lies on the axis, 0 to 1. */
export const fractionAt = (axis, time) => (time / axis.step + 0.5) / axis.columns;

/** The moment at a place on the axis, held inside the duration. */
export function timeAt(axis, fraction) {
  const time = (fraction * axis.columns - 0.5) * axis.step;
  return Math.min(Math.max(time, 0), axis.duration);
}

/** Seconds between labels so that they stay at least `least` pixels apart. */
export function labelEvery(axis, width, least = 56) {
  const second = width / (axis.columns * axis.step);
  return [0.5, 1, 2, 5, 10, 20, 60, 120].find((every) => every * second >= least) ?? 300;
}
