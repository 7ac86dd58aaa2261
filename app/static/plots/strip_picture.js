/** What a strip plot draws, in numbers: its scale, curves, grid, ticks and marks. The page paints it, files are made of it. */

import { GREY } from "../state/worked_plan.js";
import { fractionAt } from "../state/time_axis.js";
import { HEIGHT, WIDTH, pathOf, rangeOf, scaleOf, ticksOf } from "./curves.js";
import { measuredCurves, measuredRange } from "./measured.js";

/** Rounding of the figures that come from the server: a limit passed by less is kept. */
export const ROUNDING = 0.006;
/** What a planned curve looks like under a simulated or a measured one. */
const DOTTED = [2, 3];
/** A limit that is further from the values than this share of their span is named, not drawn. */
const FAR = 0.75;
/** Line widths of a foot's motors 1, 2 and 3. */
const MOTOR_WIDTHS = [2, 1.25, 0.75];
/** Feet whose curves lie on each other for so many samples share one line, in turns of so many pixels. */
const TOGETHER = 3;
const TURN = 7;
const MOST_TICKS = 4;
/** Least distance of two texts or marks, as a share of a plot's height, %. */
export const APART = 16;

const isKnown = (value) => value !== null && Number.isFinite(value);

/** The band of each foot where every foot has a row of its own, else one band for all. */
function bandsOf({ lanes, series }) {
  if (!lanes) return () => ({ top: 0, bottom: HEIGHT });
  const feet = new Set(series.map(({ foot }) => foot)).size;
  return (foot) => ({ top: (HEIGHT * foot) / feet, bottom: (HEIGHT * (foot + 1)) / feet });
}

/** What the scale spans: every value, what the strip always shows, and limits that are not far. */
function spanOf(content, overs, count) {
  const ranges = [rangeOf(content.series, count), ...overs.map(measuredRange)];
  const range = [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, greatest]) => greatest))];
  const always = [content.floor, content.wanted, content.most ?? 0].filter((value) => isKnown(value) && !content.lanes);
  const [low, high] = [Math.min(range[0], ...always), Math.max(range[1], ...always)];
  const near = [content.low, content.high].filter((limit) => isKnown(limit) && limit > low - FAR * (high - low) && limit < high + FAR * (high - low));
  return { range, low: Math.min(low, ...near), high: Math.max(high, ...near) };
}

/** Where values pass a limit: curves are drawn there once more in the bad colour. */
function beyond({ low = null, high = null }, scaleFor, bands, [least, most]) {
  const over = high !== null && most > high + ROUNDING;
  const under = low !== null && least < low - ROUNDING;
  return bands.flatMap(({ foot, top, bottom }) => [
    over && { y: top, height: Math.max(scaleFor(foot)(high) - top, 0) },
    under && { y: scaleFor(foot)(low), height: Math.max(bottom - scaleFor(foot)(low), 0) },
  ]).filter(Boolean);
}

/** Where a value is missing in the midst of a motion, such as a stroke whose rod is too short. */
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

/** Of a foot that stands only the rise and the way down are drawn: feet that stand would lie on each other. */
function risen({ valueAt }, count) {
  const stands = (index) => index < 0 || index >= count || Math.abs(valueAt(index) ?? 1) < ROUNDING;
  return (index) => (stands(index - 1) && stands(index) && stands(index + 1) ? null : valueAt(index));
}

/** Feet whose curves lie on each other, as one list for each foot; alone, a list of itself. */
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
        joined.forEach((at) => { groups[at] = joined; });
      }
    }
  }
  return groups;
}

/** The planned curves; where something lies over them they are dotted. */
function plannedCurves(content, across, scaleFor, { isUnder, grey, count, span }) {
  const { series, lanes, rises } = content;
  const values = series.map((one) => (rises ? risen(one, count) : one.valueAt));
  const groups = rises && !isUnder ? companionsOf(values, across, (span.high - span.low) * 0.01) : series.map((_, at) => [at]);
  return series.map(({ foot, motor }, at) => {
    const [group, turn] = [groups[at], groups[at].indexOf(at)];
    const shared = group.length > 1 ? { dash: [TURN, TURN * (group.length - 1)], offset: -TURN * turn } : { dash: [], offset: 0 };
    return {
      d: pathOf(across, values[at], scaleFor(foot)), foot, motor, tone: grey ? "grey" : foot === null ? "fine" : foot + 1,
      width: lanes ? MOTOR_WIDTHS[motor] : 1.5, alpha: 1, ...(isUnder ? { dash: DOTTED, offset: 0 } : shared),
    };
  });
}

/** The highest sample of each rise in view, for the foot's mark. */
function peaksOf({ series }, across, scaleFor) {
  return series.flatMap(({ foot, valueAt }) => {
    const peaks = [];
    let top = null;
    for (let index = across.first; index <= across.last + 1; index += 1) {
      const value = index <= across.last ? valueAt(index) ?? 0 : 0;
      if (value > 0.5) top = top === null || value > valueAt(top) ? index : top;
      else if (top !== null) {
        peaks.push({ foot, x: across.x[top], y: scaleFor(foot)(valueAt(top)) });
        top = null;
      }
    }
    return peaks.filter(({ x }) => x >= 0 && x <= WIDTH);
  });
}

/** Rises that have their highest sample at one place share a mark, with each of their feet. */
function peakMarks(peaks) {
  const marks = [];
  for (const { foot, x, y } of peaks) {
    const mark = marks.find((one) => Math.abs(one.x - x) < 0.02 * WIDTH && Math.abs(one.y - y) < APART);
    if (mark) mark.feet.push(foot);
    else marks.push({ feet: [foot], x, y });
  }
  return marks;
}

/** Of a gait for the robot's clock: a line at each pose, and a short one from where Stop is heard in each move. */
export function rulesOf(axis, { poses, times }) {
  if (!poses) return [];
  const at = (from) => (time) => ({ x: fractionAt(axis, time) * WIDTH, from });
  return [...times.map(at(0)), ...poses.heard.map(at(0.8))].filter(({ x }) => x >= 0 && x <= WIDTH);
}

/** Limits and what the gait asks for: drawn where they are in sight, named in any case. */
function namedValues({ low = null, high = null, wanted = null }, { range, low: bottom, high: top }) {
  const named = [{ value: high, name: "limit", kind: "limit" }, { value: wanted, name: "asked", kind: "wanted" }, { value: low, name: "limit", kind: "limit" }];
  return named.filter(({ value }) => isKnown(value) && range[0] <= range[1]).map((one) => ({ ...one, away: one.value > top ? "up" : one.value < bottom ? "down" : null }));
}

/**
 * What a strip draws.
 * @param {object} content of a strip's `of` (see strips.js)
 * @param {{axis: object, across: object, count: number, overs: object[], rules: object[], grey: string|null}} view
 * @returns {object} `scaleFor(foot)`, `range` of all values, `bands` of the feet {foot, top, bottom}, `ticks` {value, y}, `named` values,
 *   `peaks` {foot, x, y}, and `drawing` as `stripCanvas` takes it
 */
export function stripPicture(content, { axis, across, count, overs, rules, grey }) {
  const span = spanOf(content, overs, count);
  const bandOf = bandsOf(content);
  const scales = new Map();
  const scaleFor = (foot) => {
    if (!scales.has(foot)) scales.set(foot, scaleOf(span.low, span.high, bandOf(foot)));
    return scales.get(foot);
  };
  const feet = content.lanes ? [...new Set(content.series.map(({ foot }) => foot))] : [content.series[0]?.foot ?? null];
  const bands = feet.map((foot) => ({ foot, ...bandOf(foot) }));
  const values = ticksOf(span.low, span.high, content.lanes ? 2 : MOST_TICKS);
  const named = namedValues(content, span);
  const peaks = content.rises ? peaksOf(content, across, scaleFor) : [];
  return {
    scaleFor, range: span.range, bands, peaks,
    ticks: values.map((value) => ({ value, y: scaleFor(bands[0].foot)(value) })),
    named: named.map((one) => ({ ...one, y: one.away === "up" ? 0 : one.away === "down" ? HEIGHT : scaleFor(bands[0].foot)(one.value) })),
    drawing: {
      bands: missing(content, across), rules,
      grid: bands.flatMap(({ foot }) => values.map((value) => scaleFor(foot)(value))), borders: bands.slice(1).map(({ top }) => top),
      lines: named.filter(({ away }) => !away).flatMap(({ value, kind }) => bands.map(({ foot }) => ({ y: scaleFor(foot)(value), kind }))),
      curves: [...plannedCurves(content, across, scaleFor, { isUnder: overs.length > 0, grey, count, span }), ...overs.flatMap((over) => measuredCurves(over, axis, scaleFor))],
      clips: grey === "worked" ? [] : beyond(content, scaleFor, bands, span.range), isGrey: grey !== null,
      marks: bands.length > 1 ? bands.map(({ foot, top, bottom }) => ({ feet: [foot], x: null, y: (top + bottom) / 2 })) : peakMarks(peaks),
    },
  };
}

/** The names of the lines of the plots: a line style with a word. */
export function lineNames(grey, overs) {
  if (!grey && !overs.length) return [];
  const planned = { word: grey ? GREY[grey].plot : "planned", dash: overs.length ? DOTTED : [] };
  return [planned, ...overs.map(({ word, dash }) => ({ word, dash }))];
}
