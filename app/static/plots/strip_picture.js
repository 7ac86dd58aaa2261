/** Computes a strip plot: scale, curves, grid, ticks and marks. The page and saved files draw from it. */

import { GREY } from "../state/worked_plan.js";
import { fractionAt } from "../state/time_axis.js";
import { HEIGHT, WIDTH, pathOf, rangeOf, scaleOf, ticksOf } from "./curves.js";
import { measuredCurves, measuredRange } from "./measured.js";

/** The server rounds its values, so a limit passed by less than this counts as kept. */
export const ROUNDING = 0.006;
/** Dashes of a planned curve under a simulated or a measured one. */
const DOTTED = [2, 3];
/** A limit further from the values than this share of their span is named but not drawn. */
const FAR = 0.75;
/** Line widths of a foot's motors 1, 2 and 3. */
const MOTOR_WIDTHS = [2, 1.25, 0.75];
/** Curves that coincide for TOGETHER samples share one line, in which they alternate every TURN pixels. */
const TOGETHER = 3;
const TURN = 7;
const MOST_TICKS = 4;
/** Least distance of two texts or marks, % of a plot's height. */
export const APART = 16;

const isKnown = (value) => value !== null && Number.isFinite(value);

/**
 * Function from a foot to its band: its own row if the strip has lanes, else the whole height.
 * @param {Record<string, any>} content
 */
function bandsOf({ lanes, series }) {
  if (!lanes) return () => ({ top: 0, bottom: HEIGHT });
  const feet = new Set(series.map(({ foot }) => foot)).size;
  return (foot) => ({ top: (HEIGHT * foot) / feet, bottom: (HEIGHT * (foot + 1)) / feet });
}

/** Range of the scale: all values, those that the strip always shows, and limits that are not far. */
function spanOf(content, overs, count) {
  const ranges = [rangeOf(content.series, count), ...overs.map(measuredRange)];
  const range = [
    Math.min(...ranges.map(([least]) => least)),
    Math.max(...ranges.map(([, greatest]) => greatest)),
  ];
  const always = [content.floor, content.wanted, content.most ?? 0].filter(
    (value) => isKnown(value) && !content.lanes,
  );
  const [low, high] = [Math.min(range[0], ...always), Math.max(range[1], ...always)];
  const near = [content.low, content.high].filter(
    (limit) => isKnown(limit) && limit > low - FAR * (high - low) && limit < high + FAR * (high - low),
  );
  return { range, low: Math.min(low, ...near), high: Math.max(high, ...near) };
}

/**
 * Bands in which values pass a limit; the curves are painted there again in the colour of errors.
 * @param {Record<string, any>} content
 * @param {(foot: number) => (value: number) => number} scaleFor
 * @param {Record<string, any>[]} bands
 * @param {number[]} range
 */
function beyond({ low = null, high = null }, scaleFor, bands, [least, most]) {
  const over = high !== null && most > high + ROUNDING;
  const under = low !== null && least < low - ROUNDING;
  return bands
    .flatMap(({ foot, top, bottom }) => [
      over && { y: top, height: Math.max(scaleFor(foot)(high) - top, 0) },
      under && { y: scaleFor(foot)(low), height: Math.max(bottom - scaleFor(foot)(low), 0) },
    ])
    .filter(Boolean);
}

/**
 * Bands of samples with a missing value, such as a stroke for which the rod is too short.
 * @param {Record<string, any>} content
 */
function missing({ series }, across) {
  const bands = [];
  const half = across.x.length > 1 ? (across.x[1] - across.x[0]) / 2 : 0;
  let from = null;
  for (let index = across.first; index <= across.last + 1; index += 1) {
    const lacks = index <= across.last && series.some(({ valueAt }) => (valueAt(index) ?? null) === null);
    if (lacks) from ??= across.x[index] - half;
    else if (from !== null) {
      bands.push({ x: from, width: across.x[index - 1] + half - from });
      from = null;
    }
  }
  return bands;
}

/** Values without the stance phases, in which all curves would coincide. */
function risen({ valueAt }, count) {
  const stands = (index) => index < 0 || index >= count || Math.abs(valueAt(index) ?? 1) < ROUNDING;
  return (index) => (stands(index - 1) && stands(index) && stands(index + 1) ? null : valueAt(index));
}

/** For each series, the list of those whose curves coincide with it, itself included. */
function companionsOf(series, { first, last }, tolerance) {
  const groups = series.map((_, at) => [at]);
  const meet = (one, other) => {
    let run = 0;
    for (let index = first; index <= last; index += 1) {
      const [a, b] = [one(index), other(index)];
      run = isKnown(a) && isKnown(b) && Math.abs(a - b) <= tolerance ? run + 1 : 0;
      if (run >= TOGETHER) return true;
    }
    return false;
  };
  for (let one = 0; one < series.length; one += 1) {
    for (let other = one + 1; other < series.length; other += 1) {
      if (groups[one] !== groups[other] && meet(series[one], series[other])) {
        const joined = [...groups[one], ...groups[other]].sort((a, b) => a - b);
        joined.forEach((at) => {
          groups[at] = joined;
        });
      }
    }
  }
  return groups;
}

/** The planned curves; dotted if simulated or measured ones lie over them. */
function plannedCurves(content, across, scaleFor, { isUnder, grey, count, span }) {
  const { series, lanes, rises } = content;
  const values = series.map((one) => (rises ? risen(one, count) : one.valueAt));
  const groups =
    rises && !isUnder
      ? companionsOf(values, across, (span.high - span.low) * 0.01)
      : series.map((_, at) => [at]);
  return series.map(({ foot, motor }, at) => {
    const [group, turn] = [groups[at], groups[at].indexOf(at)];
    const shared =
      group.length > 1
        ? { dash: [TURN, TURN * (group.length - 1)], offset: -TURN * turn }
        : { dash: [], offset: 0 };
    return {
      d: pathOf(across, values[at], scaleFor(foot)),
      foot,
      motor,
      tone: grey ? "grey" : foot === null ? "fine" : foot + 1,
      width: lanes ? MOTOR_WIDTHS[motor] : 1.5,
      alpha: 1,
      ...(isUnder ? { dash: DOTTED, offset: 0 } : shared),
    };
  });
}

/**
 * The highest sample of each rise in view, where the foot's mark goes.
 * @param {Record<string, any>} content
 */
function peaksOf({ series }, across, scaleFor) {
  return series.flatMap(({ foot, valueAt }) => {
    const peaks = [];
    let top = null;
    for (let index = across.first; index <= across.last + 1; index += 1) {
      const value = index <= across.last ? (valueAt(index) ?? 0) : 0;
      if (value > 0.5) top = top === null || value > valueAt(top) ? index : top;
      else if (top !== null) {
        peaks.push({ foot, x: across.x[top], y: scaleFor(foot)(valueAt(top)) });
        top = null;
      }
    }
    return peaks.filter(({ x }) => x >= 0 && x <= WIDTH);
  });
}

/** Marks of the rises; rises that peak at the same place share one mark that names all their feet. */
function peakMarks(peaks) {
  const marks = [];
  for (const { foot, x, y } of peaks) {
    const mark = marks.find((one) => Math.abs(one.x - x) < 0.02 * WIDTH && Math.abs(one.y - y) < APART);
    if (mark) mark.feet.push(foot);
    else marks.push({ feet: [foot], x, y });
  }
  return marks;
}

/** For a gait on the robot's clock: a line at each pose, and a short one where the robot first hears Stop. */
export function rulesOf(axis, { poses, times }) {
  if (!poses) return [];
  const at = (from) => (time) => ({ x: fractionAt(axis, time) * WIDTH, from });
  return [...times.map(at(0)), ...poses.heard.map(at(0.8))].filter(({ x }) => x >= 0 && x <= WIDTH);
}

/** Limits and the requested value, with names; `away` is the direction of one off the scale, or null. */
function namedValues({ low = null, high = null, wanted = null }, { range, low: bottom, high: top }) {
  const named = [
    { value: high, name: "limit", kind: "limit" },
    { value: wanted, name: "asked", kind: "wanted" },
    { value: low, name: "limit", kind: "limit" },
  ];
  return named
    .filter(({ value }) => isKnown(value) && range[0] <= range[1])
    .map((one) => ({ ...one, away: one.value > top ? "up" : one.value < bottom ? "down" : null }));
}

/**
 * Computes a strip's plot.
 * @param {Record<string, any>} content of a strip's `of` (see strips.js)
 * @param {{axis: Record<string, any>, across: Record<string, any>, count: number, grey: string|null,
 *   overs: Record<string, any>[], rules: Record<string, any>[], isUnder: boolean}} view
 *   `isUnder`: whether the plan is drawn as the line under measured or simulated ones, also of another strip
 * @returns {Record<string, any>} `scaleFor(foot)`, `range` of all values, `bands` of the feet
 *   {foot, top, bottom}, `ticks` {value, y}, `named` values, `peaks` {foot, x, y}, and `drawing` as
 *   `stripCanvas` takes it
 */
export function stripPicture(content, { axis, across, count, overs, rules, grey, isUnder }) {
  const span = spanOf(content, overs, count);
  const bandOf = bandsOf(content);
  const scales = new Map();
  const scaleFor = (foot) => {
    if (!scales.has(foot)) scales.set(foot, scaleOf(span.low, span.high, bandOf(foot)));
    return scales.get(foot);
  };
  const feet = content.lanes
    ? [...new Set(content.series.map(({ foot }) => foot))]
    : [content.series[0]?.foot ?? null];
  const bands = feet.map((foot) => ({ foot, ...bandOf(foot) }));
  const values = ticksOf(span.low, span.high, content.lanes ? 2 : MOST_TICKS);
  const named = namedValues(content, span);
  const peaks = content.rises ? peaksOf(content, across, scaleFor) : [];
  return {
    scaleFor,
    range: span.range,
    bands,
    peaks,
    ticks: values.map((value) => ({ value, y: scaleFor(bands[0].foot)(value) })),
    named: named.map((one) => ({
      ...one,
      y: one.away === "up" ? 0 : one.away === "down" ? HEIGHT : scaleFor(bands[0].foot)(one.value),
    })),
    drawing: {
      bands: missing(content, across),
      rules,
      grid: bands.flatMap(({ foot }) => values.map((value) => scaleFor(foot)(value))),
      borders: bands.slice(1).map(({ top }) => top),
      lines: named
        .filter(({ away }) => !away)
        .flatMap(({ value, kind }) => bands.map(({ foot }) => ({ y: scaleFor(foot)(value), kind }))),
      curves: [
        ...plannedCurves(content, across, scaleFor, { isUnder, grey, count, span }),
        ...overs.flatMap((over) => measuredCurves(over, axis, scaleFor)),
      ],
      clips: grey === "worked" ? [] : beyond(content, scaleFor, bands, span.range),
      isGrey: grey !== null,
      marks:
        bands.length > 1
          ? bands.map(({ foot, top, bottom }) => ({ feet: [foot], x: null, y: (top + bottom) / 2 }))
          : peakMarks(peaks),
    },
  };
}

/** Entries of a legend: a word and the dashes of its line; none if all lines are planned ones. */
export function lineNames(grey, overs, isUnder) {
  if (!grey && !isUnder) return [];
  const planned = { word: grey ? GREY[grey].plot : "planned", dash: isUnder ? DOTTED : [] };
  return [planned, ...overs.map(({ word, dash }) => ({ word, dash }))];
}
