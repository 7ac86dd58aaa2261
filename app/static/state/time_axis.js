/**
 * The time axis that ruler, timeline, plots and playhead share, and the window of it that is shown.
 *
 * A sample is a point in time, drawn as a column; its moment lies within the column. Of most gaits samples
 * are evenly apart, and the moment is the column's middle. Of a gait for the robot's clock a sample is a
 * pose: columns meet half way between two poses, so that each is as wide as the robot is on its way. Places
 * on the axis are counted in columns of mean width. What draws on the axis goes through `axisOf`,
 * `fractionAt` and `timeAt`, and draws anew when `axisKey` changes: then it follows zoom and preview.
 */

import { clamp } from "../lib/clamp.js";
import { previewedDocument, shownPlan } from "./store.js";

/**
 * @typedef {import("./store.js").State} State
 * @typedef {{times: number[]|null, borders: number[]|null}} Uneven of samples and of the borders of their
 *   columns, s; null where samples are evenly apart
 */

/**
 * `step` is a column's mean width and `start` the left edge of the first, s; the window begins at column
 * `first` and is `shown` columns wide, both may be broken numbers.
 * @typedef {Uneven & {samples: number, columns: number, step: number, duration: number, first: number,
 *   shown: number, start: number}} Axis
 */

/** Fewest columns that a zoomed window shows. */
export const LEAST_SHOWN = 8;

/** Width of a column where there is no document, s. */
const USUAL_STEP = 0.4;

/** @type {{times: number[]|null, borders: number[]}} */
let known = { times: null, borders: [] };

/**
 * Borders of the columns of uneven samples, s: half way between two of them.
 * @param {number[]} times at least two
 */
function bordersOf(times) {
  if (known.times !== times) {
    const middles = times.slice(1).map((time, index) => (time + times[index]) / 2);
    const end = times.length - 1;
    const first = times[0] - (times[1] - times[0]) / 2;
    const last = times[end] + (times[end] - times[end - 1]) / 2;
    known = { times, borders: [first, ...middles, last] };
  }
  return known.borders;
}

/**
 * When the samples of a gait for the robot's clock are; null for another gait.
 * @param {any} document
 * @param {number[]} times of the plan
 * @param {number} samples
 */
const poseTimes = (document, times, samples) =>
  document?.poses && times.length === samples && samples > 1 ? times : null;

/**
 * The part of the columns that is shown.
 * @param {Pick<State, "zoom">} state
 * @param {number} columns
 */
function windowOf({ zoom }, columns) {
  const shown = clamp(zoom?.shown ?? columns, Math.min(LEAST_SHOWN, columns), columns);
  return { first: clamp(zoom?.first ?? 0, 0, columns - shown), shown };
}

/**
 * @param {State} state
 * @returns {Axis}
 */
export function axisOf(state) {
  const document = previewedDocument(state);
  const samples = document?.timeline.feet[0]?.length ?? 0;
  /** @type {number[]} */
  const planTimes = shownPlan(state)?.times ?? [];
  const planEnd = planTimes.at(-1) ?? 0;
  const times = poseTimes(document, planTimes, samples);
  const borders = times && bordersOf(times);
  const step = borders
    ? (borders[samples] - borders[0]) / samples
    : (document?.timeline.sample_time ?? USUAL_STEP);
  const columns = borders ? samples : Math.max(samples, Math.round(planEnd / step) + 1, 1);
  return {
    samples,
    columns,
    step,
    duration: planEnd || Math.max(0, samples - 1) * step,
    ...windowOf(state, columns),
    start: borders?.[0] ?? -step / 2,
    times,
    borders,
  };
}

/** What a drawing on the axis depends on, as one value to be watched. @param {State} state */
export function axisKey(state) {
  const { samples, columns, step, first, shown, borders } = axisOf(state);
  return `${samples} ${columns} ${step} ${first} ${shown} ${borders ?? ""}`;
}

/** Where a moment lies on the axis, in columns of mean width. @param {Axis} axis @param {number} time */
export const placeAt = (axis, time) => (time - axis.start) / axis.step;

/**
 * Where a column's left edge lies on the axis, in columns of mean width; of a broken number, a place within.
 * @param {Axis} axis
 * @param {number} column
 */
export function placeOf(axis, column) {
  if (!axis.borders) return column;
  const index = clamp(Math.floor(column), 0, axis.samples - 1);
  const [from, to] = [axis.borders[index], axis.borders[index + 1]];
  return placeAt(axis, from + (column - index) * (to - from));
}

/** When a column begins, s. @param {Axis} axis @param {number} column */
export const columnTime = (axis, column) => axis.start + placeOf(axis, column) * axis.step;

/**
 * Where a moment lies on the shown window, 0 to 1; outside of it less or more.
 * @param {Axis} axis
 * @param {number} time
 */
export const fractionAt = (axis, time) => (placeAt(axis, time) - axis.first) / axis.shown;

/**
 * Where the left edge of a column lies on the shown window, 0 to 1.
 * @param {Axis} axis
 * @param {number} column
 */
export const columnFraction = (axis, column) => (placeOf(axis, column) - axis.first) / axis.shown;

/**
 * The moment at a place on the shown window, held inside the duration.
 * @param {Axis} axis
 * @param {number} fraction
 */
export function timeAt(axis, fraction) {
  return clamp(axis.start + (axis.first + fraction * axis.shown) * axis.step, 0, axis.duration);
}

/** The moment of a sample, s. @param {Axis} axis @param {number} sample */
export const momentOf = (axis, sample) => axis.times?.[sample] ?? sample * axis.step;

/**
 * The column at a place on the shown window, which may lie outside of the samples.
 * @param {Axis} axis
 * @param {number} fraction
 */
export function columnAt(axis, fraction) {
  const place = axis.first + fraction * axis.shown;
  if (!axis.borders) return Math.floor(place);
  const time = axis.start + place * axis.step;
  return axis.borders.findLastIndex((border) => border <= time);
}

/**
 * Seconds between labels so that they stay at least `least` pixels apart.
 * @param {Pick<Axis, "shown"|"step">} axis
 * @param {number} width
 */
export function labelEvery(axis, width, least = 56) {
  const second = width / (axis.shown * axis.step);
  return [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60, 120].find((every) => every * second >= least) ?? 300;
}
