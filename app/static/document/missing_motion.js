/** Where an infeasible plan misses its limits: for the timeline's cells, its flags, and the marks in 3D. */

import { fixed } from "../lib/format.js";

/**
 * An entry: where a plan misses a limit, and how much.
 * @typedef {Record<string, any>} Missing
 * @typedef {boolean[]} Contacts whether each foot stands, at a sample
 * @typedef {{first: number, last: number, rank: number, words: string}} Phase
 */

/** Limits on where the robot's weight is carried: the feet in the air break them, not those that stand. */
const BALANCE = new Set(["body_torque", "margin"]);
/** Fewest feet that an area lies between. */
const LEAST_STANDING = 3;
/** Phases that the timeline outlines. */
const SHOWN_PHASES = 3;

/** @param {Contacts|undefined} row @param {boolean} stands */
const feetThat = (row, stands) => (row ?? []).flatMap((isDown, foot) => (isDown === stands ? [foot] : []));

/** "1", "1 and 3" or "1, 2 and 4": feet counted from 1. @param {number[]} feet */
const numbers = (feet) =>
  feet
    .map((foot) => foot + 1)
    .join(", ")
    .replace(/, ([^,]*)$/, " and $1");

/** "foot 1" or "feet 1 and 3". @param {number[]} feet */
const named = (feet) => `${feet.length === 1 ? "foot" : "feet"} ${numbers(feet)}`;

/**
 * The feet whose cells miss a limit at a sample: of balance those in the air, else those that are named, or
 * all that stand.
 * @param {Missing} missing
 * @param {Contacts} row
 * @returns {number[]}
 */
function offenders({ family, feet }, row) {
  const inAir = feetThat(row, false);
  if (BALANCE.has(family) && inAir.length) return inAir;
  if (feet.length) return feet;
  const standing = feetThat(row, true);
  return standing.length ? standing : (row ?? []).map((_, foot) => foot);
}

/**
 * Calls `act` with each sample of an entry and the row of contacts there.
 * @param {Missing} missing
 * @param {Contacts[]} contact
 * @param {(sample: number, row: Contacts) => void} act
 */
function eachSample({ first, last }, contact, act) {
  for (let sample = first; sample <= last; sample += 1) act(sample, contact[sample] ?? contact[0] ?? []);
}

/** The entries of a plan, the worst first. @param {any} plan @returns {Missing[]} */
const lacksOf = (plan) => plan?.live?.lacks ?? [];

/**
 * "foot,sample" to `{sentence, tone}`; the worst entry wins. Cells that are not to blame have no tone.
 * @param {any} plan
 */
export function missingMotionByCell(plan) {
  /** @type {Map<string, {sentence: string, tone: "bad"|"caution"|null}>} */
  const found = new Map();
  const lacks = lacksOf(plan);
  /**
   * @param {number} foot
   * @param {number} sample
   * @param {string} sentence
   * @param {"bad"|"caution"|null} tone
   */
  const add = (foot, sample, sentence, tone) => {
    if (!found.has(`${foot},${sample}`)) found.set(`${foot},${sample}`, { sentence, tone });
  };
  lacks.forEach((missing, rank) =>
    eachSample(missing, plan.contact, (sample, row) => {
      offenders(missing, row).forEach((foot) =>
        add(foot, sample, missing.sentence, rank === 0 ? "bad" : "caution"),
      );
    }),
  );
  lacks.forEach((missing) =>
    eachSample(missing, plan.contact, (sample, row) =>
      row.forEach((_, foot) => add(foot, sample, missing.sentence, null)),
    ),
  );
  return found;
}

/** @param {Missing} missing */
const size = ({ amount, unit }) => `${fixed(amount, amount < 0.1 ? 2 : 1)} ${unit}`;
/** @param {Missing} missing */
const footOf = ({ feet }) => (feet.length ? `foot ${feet[0] + 1}` : "body");

/**
 * What an entry says in a few words, by its family.
 * @type {Record<string, (missing: Missing) => string>}
 */
const WORDS = {
  workspace: (missing) => `${footOf(missing)}: reach ${size(missing)} short`,
  clearance: (missing) => `${footOf(missing)}: rise ${size(missing)} short`,
  foot_speed: (missing) => `${footOf(missing)} too fast`,
  body_speed: () => "body too fast",
  body_height: (missing) => `body height off by ${size(missing)}`,
  friction: () => "too little grip",
  motor_speed: (missing) => `${footOf(missing)}: motor too fast`,
  motor_acceleration: (missing) => `${footOf(missing)}: motor speeds up too fast`,
  shoe_distance: ({ feet }) => `${named([...feet].sort((a, b) => a - b))} too close`,
  boundary: () => "start or goal not reached",
};

/** Why an entry is one, in a few words. @param {Missing} missing @param {Contacts[]} contact */
export function wordsOf(missing, contact) {
  if (!BALANCE.has(missing.family)) return WORDS[missing.family]?.(missing) ?? "a limit is violated";
  const row = contact[missing.first];
  const inAir = feetThat(row, false);
  const isLine = inAir.length > 0 && feetThat(row, true).length < LEAST_STANDING;
  return isLine ? `${named(inAir)} in the air` : `margin ${size(missing)} short`;
}

/**
 * What such words begin with, where there is no room for all: "foot 1" of "foot 1: rise 3.1 mm short".
 * @param {string} words
 */
export const shortWords = (words) => words.split(/: | in the air| too | off | \d+(?:\.\d+)? mm/)[0];

/**
 * Joins two phases; the worse one says why.
 * @param {Phase} one
 * @param {Phase} other
 * @returns {Phase}
 */
function joined(one, other) {
  const { rank, words } = one.rank < other.rank ? one : other;
  return { first: Math.min(one.first, other.first), last: Math.max(one.last, other.last), rank, words };
}

/**
 * Whether a phase goes on in a later one: they overlap, or it follows at once for the same reason.
 * @param {Phase} phase
 * @param {Phase} next
 */
const goesOn = (phase, next) =>
  next.first <= phase.last || (next.first === phase.last + 1 && next.words === phase.words);

/**
 * The phases that miss a limit, in their order in time; the three worst of them.
 * @param {any} plan
 * @returns {{first: number, last: number, words: string}[]} samples, and why in a few words
 */
export function missingPhases(plan) {
  const entries = lacksOf(plan).map((missing, rank) => ({
    first: missing.first,
    last: missing.last,
    rank,
    words: wordsOf(missing, plan.contact),
  }));
  /** @type {Phase[]} */
  const phases = [];
  for (const entry of entries.sort((a, b) => a.first - b.first)) {
    const before = phases.at(-1);
    if (before && goesOn(before, entry)) phases.splice(-1, 1, joined(before, entry));
    else phases.push(entry);
  }
  const worst = phases.sort((a, b) => a.rank - b.rank).slice(0, SHOWN_PHASES);
  return worst.sort((a, b) => a.first - b.first).map(({ first, last, words }) => ({ first, last, words }));
}

/**
 * The entries that the preview marks, with where their first foot is in the nearest motion.
 * @param {any} plan
 */
export const missingMotionOf = (plan) =>
  lacksOf(plan).map((missing) => ({
    ...missing,
    places: missing.feet.length
      ? plan.feet
          .slice(missing.first, missing.last + 1)
          .map((/** @type {number[][]} */ feet) => feet[missing.feet[0]])
      : [],
  }));
