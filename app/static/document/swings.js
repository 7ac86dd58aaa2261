/** Moving a swing of the timeline, or one end of it: what a drag leads to, held where it may not go on. */

import { counted } from "../lib/format.js";

/**
 * @typedef {{first: number, last: number}} Swing samples
 * @typedef {{row: string, locked: string|undefined, foot: number}} Line
 */

/**
 * The swing of a row around a sample, or null in stance.
 * @param {string} row
 * @param {number} sample
 * @returns {Swing|null}
 */
export function swingAt(row, sample) {
  if (row[sample] !== "0") return null;
  const next = row.indexOf("1", sample);
  return { first: row.lastIndexOf("1", sample) + 1, last: (next < 0 ? row.length : next) - 1 };
}

/**
 * Which part of its swing a sample is: "first", "last", "only" (both at once), "middle", or null in stance.
 * @param {string} row
 * @param {number} sample
 */
export function partOf(row, sample) {
  if (row[sample] !== "0") return null;
  const [first, last] = [row[sample - 1] !== "0", row[sample + 1] !== "0"];
  return first && last ? "only" : first ? "first" : last ? "last" : "middle";
}

/** @param {Swing} swing @param {string} part @param {number} by @returns {Swing} */
const shifted = ({ first, last }, part, by) => ({
  first: part === "last" ? first : first + by,
  last: part === "first" ? last : last + by,
});

/**
 * Samples whose value differs between two swings: `toSwing` and `toStance`.
 * @param {Swing} from
 * @param {Swing} to
 */
export function differing(from, to) {
  const span = (/** @type {Swing} */ { first, last }) =>
    Array.from({ length: last - first + 1 }, (_, index) => first + index);
  /** @param {number[]} samples @param {Swing} swing */
  const outside = (samples, { first, last }) => samples.filter((sample) => sample < first || sample > last);
  return { toSwing: outside(span(to), from), toStance: outside(span(from), to) };
}

/**
 * Why a swing may not lie there; "" where only the border of the timeline is in the way, null where it may.
 * @param {Line} line
 * @param {Swing} from
 * @param {Swing} to
 */
function obstacle({ row, locked, foot }, from, to) {
  if (to.first < 0 || to.last >= row.length) return "";
  if (to.first > to.last) {
    return (
      `The swing of foot ${foot + 1} must keep at least one sample. ` + "To remove the swing, click its cell."
    );
  }
  const { toSwing, toStance } = differing(from, to);
  const fixed = [...toSwing, ...toStance].find((sample) => locked?.[sample] === "1");
  if (fixed !== undefined) return `Foot ${foot + 1}, sample ${fixed + 1} is locked.`;
  const next = [to.first - 1, ...toSwing, to.last + 1].find(
    (sample) => row[sample] === "0" && (sample < from.first || sample > from.last),
  );
  return next === undefined
    ? null
    : `Foot ${foot + 1} has another swing at sample ${next + 1}. `
        + "One sample of stance must stay between the two swings.";
}

/**
 * Moves a swing or one end of it as far as it may go.
 * @param {Line} line
 * @param {Swing} from
 * @param {string} part "first", "last" or "middle"
 * @param {number} by samples
 * @returns {{to: Swing, by: number, reason: string|null}} `reason` says what held it
 */
export function moved(line, from, part, by) {
  let reached = 0;
  for (const sign = Math.sign(by); reached !== by; reached += sign) {
    const reason = obstacle(line, from, shifted(from, part, reached + sign));
    if (reason !== null) return { to: shifted(from, part, reached), by: reached, reason: reason || null };
  }
  return { to: shifted(from, part, by), by, reason: null };
}

/**
 * Name of the undo entry.
 * @param {number} foot
 * @param {string} part
 * @param {Swing} to
 * @param {number} by
 */
export function movedLabel(foot, part, to, by) {
  if (part === "middle") {
    return `Foot ${foot + 1}: swing moved by ${by > 0 ? "+" : "−"}${counted(Math.abs(by), "sample")}`;
  }
  const samples = to.first === to.last ? `sample ${to.first + 1}` : `samples ${to.first + 1}–${to.last + 1}`;
  return `Foot ${foot + 1}: swing at ${samples}`;
}
