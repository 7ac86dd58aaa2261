/** Curves of a strip plot: values over time as path data, no finer than the pixels. */

import { fractionAt } from "../state/time_axis.js";

/** Width and height of a strip's drawing before it is stretched to its box. */
export const WIDTH = 1000;
export const HEIGHT = 100;

const MOST_POINTS = 2 * WIDTH;
const tenth = (value) => Math.round(value * 10) / 10;
const isKnown = (value) => value !== null && Number.isFinite(value);

/** Share of the values' span that stays free above and below them. */
const ROOM = 0.1;

/**
 * A scale: maps a value to a height in the drawing, 0 (top) to HEIGHT (bottom).
 * @param {number} low least value
 * @param {number} high greatest value
 * @param {{top: number, bottom: number}} [band] the part of the height that the scale uses
 */
export function scaleOf(low, high, { top, bottom } = { top: 0, bottom: HEIGHT }) {
  const room = (high - low || 1) * ROOM;
  return (value) => bottom - ((bottom - top) * (value - low + room)) / (high - low + 2 * room);
}

const STEPS = [1, 2, 5, 10];

/** At most `most` round values from `low` to `high`. */
export function ticksOf(low, high, most) {
  const span = high - low;
  if (!(span > 0) || most < 1) return [];
  const unit = 10 ** Math.floor(Math.log10(span / most));
  const inside = (step) => Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1;
  const step = STEPS.map((factor) => factor * unit).find((one) => inside(one) <= most) ?? 20 * unit;
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.max(inside(step), 0) }, (_, index) => (first + index) * step);
}

/**
 * Horizontal places of a plan's samples in the drawing.
 * @returns {{x: Float64Array, first: number, last: number}}
 *   `first` to `last`: those in view and one beyond each end
 */
export function acrossOf(axis, times) {
  const x = Float64Array.from(times, (time) => fractionAt(axis, time) * WIDTH);
  let first = 0;
  let last = x.length - 1;
  while (first < last && x[first + 1] < 0) first += 1;
  while (last > first && x[last - 1] > WIDTH) last -= 1;
  return { x, first, last };
}

/** Path through the values in view; a missing value breaks the line. */
export function pathOf(across, valueAt, scale) {
  const { first, last } = across;
  return last - first > MOST_POINTS
    ? thinned(across, valueAt, scale)
    : plain(across, valueAt, scale, first, last);
}

function plain({ x }, valueAt, scale, first, last) {
  let path = "";
  let open = false;
  for (let index = first; index <= last; index += 1) {
    const value = valueAt(index);
    const known = isKnown(value);
    if (known) path += `${open ? "L" : "M"}${tenth(x[index])} ${tenth(scale(value))}`;
    open = known;
  }
  return path;
}

/** Path for more samples than pixels: the least and the greatest value in each pixel. */
function thinned({ x, first, last }, valueAt, scale) {
  let path = "";
  let open = false;
  let index = first;
  while (index <= last) {
    const pixel = Math.floor(x[index]);
    let [low, high] = [Infinity, -Infinity];
    do {
      const value = valueAt(index);
      index += 1;
      if (!isKnown(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    } while (index <= last && Math.floor(x[index]) === pixel);
    const known = low <= high;
    if (known) path += `${open ? "L" : "M"}${pixel} ${tenth(scale(low))}L${pixel} ${tenth(scale(high))}`;
    open = known;
  }
  return path;
}

/** Least and greatest known value of some series; [Infinity, -Infinity] if there is none. */
export function rangeOf(series, count) {
  let [low, high] = [Infinity, -Infinity];
  for (const { valueAt } of series) {
    for (let index = 0; index < count; index += 1) {
      const value = valueAt(index);
      if (!isKnown(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [low, high];
}

/** Index of the sample nearest to a time. */
export function indexAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-9) low = middle;
    else high = middle - 1;
  }
  return low < times.length - 1 && times[low + 1] - time < time - times[low] ? low + 1 : low;
}
