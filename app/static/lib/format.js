/** Numbers and words for people: units, rounding, times of day. */

/** Motors of a leg. */
export const MOTORS = 3;

const MINUS = "\u2212";

/**
 * A number with a fixed count of decimals and a true minus sign.
 * @param {number|null|undefined} value
 * @param {number} [decimals]
 */
export function fixed(value, decimals = 1) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

/**
 * Metres as millimetres, without the unit.
 * @param {number|null} metres
 * @param {number} [decimals]
 */
export const mm = (metres, decimals = 1) => fixed(metres === null ? null : metres * 1000, decimals);

/**
 * A small or large number as people write it: 3e−9, 0.06, 128.
 * @param {number|null|undefined} value
 */
export function compact(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(0).replace("-", MINUS);
  return fixed(value, size >= 100 ? 0 : size >= 1 ? 1 : 3);
}

/**
 * Seconds, with as many decimals as they deserve.
 * @param {number|null} value
 */
export const seconds = (value) => fixed(value, value !== null && Math.abs(value) < 1 ? 2 : 1);

/**
 * First characters of a content hash, enough to compare by eye.
 * @param {string|null|undefined} hash
 */
export const shortHash = (hash) => (hash ? hash.slice(0, 10) : "–");

/**
 * Time of day of an ISO string, of Unix seconds or of a date; the date too unless it is today.
 * @param {string|number|Date|null|undefined} moment
 */
export function clockTime(moment) {
  if (moment === null || moment === undefined) return "";
  const date = typeof moment === "number" ? new Date(moment * 1000) : new Date(moment);
  if (Number.isNaN(date.getTime())) return String(moment);
  const time = date.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit", hour12: false });
  if (date.toDateString() === new Date().toDateString()) return time;
  return `${date.toLocaleDateString([], { day: "numeric", month: "short" })} ${time}`;
}

/**
 * Value and unit of a margin given in SI: metres become millimetres, radians degrees; no value has no unit.
 * @param {number|null} value
 * @param {string|null|undefined} unit
 */
export function readable(value, unit) {
  if (value === null) return { value: fixed(value), unit: "" };
  if (unit === "m") return { value: mm(value, 2), unit: "mm" };
  if (unit === "m/s") return { value: mm(value, 2), unit: "mm/s" };
  if (unit === "m/s²") return { value: mm(value, 2), unit: "mm/s²" };
  if (unit === "feet") return { value: fixed(value, 0), unit };
  if (unit === "rad") return { value: fixed((value * 180) / Math.PI, 2), unit: "°" };
  return { value: compact(value), unit: unit ?? "" };
}

/**
 * The text with a capital first letter.
 * @param {string} text
 */
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/**
 * The text with a small first letter.
 * @param {string} text
 */
export const lowered = (text) => text.charAt(0).toLowerCase() + text.slice(1);

/**
 * A count with its noun: "1 cell", "2 cells".
 * @param {number} count
 * @param {string} noun
 */
export const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

/**
 * "body_height" as "Body height".
 * @param {string} rule
 */
export const ruleName = (rule) => capital(rule.replace(/[_-]/g, " "));

export const SPEED_UNIT = "mm/s";
/** A body that is slower only turns, mm/s. */
const LEAST_SPEED = 0.005;

/**
 * Value and unit of a gait's speed on the robot, or of its turn where it only turns; null where not known.
 * @param {{speed?: number|null, turn_rate?: number|null}} gait m/s and rad/s
 */
export function pace({ speed, turn_rate: turn }) {
  if (speed && speed * 1000 >= LEAST_SPEED) return { value: fixed(speed * 1000, 2), unit: SPEED_UNIT };
  return turn ? { value: fixed((Math.abs(turn) * 180) / Math.PI, 1), unit: "°/s" } : null;
}

/**
 * The same in words; "" where it is not known.
 * @param {Record<string, any>} gait
 */
export function paceText(gait) {
  const known = pace(gait);
  if (!known) return "";
  return known.value + (known.unit === SPEED_UNIT ? " " : "") + known.unit;
}

/**
 * How long a gait lasts as planned and on the robot, and how fast it goes; "" where that is not known.
 * @param {Record<string, any>} gait
 */
export function timesText(gait) {
  const { plan_seconds: planned, robot_seconds: takes } = gait;
  if (takes === null) return "";
  const lasts = `Takes ${fixed(planned)} s as planned · ${fixed(takes)} s on the robot`;
  return [lasts, paceText(gait)].filter(Boolean).join(" · ");
}
