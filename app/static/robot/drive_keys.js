/**
 * The keys that drive the robot by hand, by their place on the keyboard (`KeyboardEvent.code`), which is the
 * same on every layout: two rows for the twelve motors, and arrows for the body or a foot.
 */

/** @typedef {{part: string, foot: number|null, motor: number|null, axis: string|null, by_mm: number}} Step */

const DIGITS = ["1", "2", "3", "4", "5", "6", "7", "8", "9", "0"].map((digit) => `Digit${digit}`);
const LETTERS = [..."QWERTYUIOP"].map((letter) => `Key${letter}`);

/** Keys that draw each motor up, and below them those that let it down; motor 1 first. */
export const MOTOR_ROWS = {
  up: [...DIGITS, "Minus", "Equal"],
  down: [...LETTERS, "BracketLeft", "BracketRight"],
};

/**
 * Keys that move the body or a foot: axis of the robot, and which way.
 * @type {Record<string, [string, number]>}
 */
export const AXIS_KEYS = {
  ArrowUp: ["x", 1],
  ArrowDown: ["x", -1],
  ArrowLeft: ["y", 1],
  ArrowRight: ["y", -1],
  PageUp: ["z", 1],
  PageDown: ["z", -1],
};

/**
 * Keys that choose what the arrows move: a foot, or 0 for the body. They move nothing.
 * @type {Record<string, number>}
 */
export const CHOICE_KEYS = { KeyA: 1, KeyS: 2, KeyD: 3, KeyF: 4, KeyG: 0 };

/**
 * Marks on the keys of a US keyboard, for browsers that do not give their layout.
 * @type {Record<string, string>}
 */
const MARKS = {
  Minus: "-",
  Equal: "=",
  BracketLeft: "[",
  BracketRight: "]",
  ArrowUp: "↑",
  ArrowDown: "↓",
  ArrowLeft: "←",
  ArrowRight: "→",
  PageUp: "Pg↑",
  PageDown: "Pg↓",
};

/**
 * What stands on a key.
 * @param {string} code
 * @param {{get: (code: string) => string|undefined}} [layout] the browser's, where it tells it
 */
export const markOf = (code, layout) =>
  layout?.get(code)?.toUpperCase() ?? MARKS[code] ?? code.replace(/^(Digit|Key)/, "");

/**
 * The step that a key makes; null where it makes none.
 * @param {string} code
 * @param {number} chosen what the arrows move: a foot, or 0 for the body
 * @param {number} size mm
 * @returns {Step|null}
 */
export function stepOf(code, chosen, size) {
  for (const [row, sign] of /** @type {[string[], number][]} */ ([
    [MOTOR_ROWS.up, -1],
    [MOTOR_ROWS.down, 1],
  ])) {
    const index = row.indexOf(code);
    if (index >= 0)
      return {
        part: "motor",
        foot: Math.floor(index / 3) + 1,
        motor: (index % 3) + 1,
        axis: null,
        by_mm: sign * size,
      };
  }
  const along = AXIS_KEYS[code];
  if (!along) return null;
  const [axis, sign] = along;
  return { part: chosen ? "foot" : "body", foot: chosen || null, motor: null, axis, by_mm: sign * size };
}
