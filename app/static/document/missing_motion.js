/** Where an infeasible plan misses its limits: for the timeline's cells, its flags, and the marks in 3D. */

import { fixed } from "../lib/format.js";

/** Limits on where the robot's weight is carried: the feet in the air break them, not those that stand. */
const BALANCE = new Set(["body_torque", "margin"]);
/** Fewest feet that an area lies between. */
const LEAST_STANDING = 3;
/** Phases that the timeline outlines. */
const SHOWN_PHASES = 3;

const feetThat = (row, stands) => (row ?? []).flatMap((isDown, foot) => (isDown === stands ? [foot] : []));

/** "1", "1 and 3" or "1, 2 and 4": feet counted from 1. */
const numbers = (feet) =>
  feet
    .map((foot) => foot + 1)
    .join(", ")
    .replace(/, ([^,]*)$/, " and $1");

/** "foot 1" or "feet 1 and 3". */
const named = (feet) => `${feet.length === 1 ? "foot" : "feet"} ${numbers(feet)}`;

/** The feet whose cells miss a limit at a sample: of balance those in the air, else those that are named; or all that stand. */
function offenders({ family, feet }, row) {
  const inAir = feetThat(row, false);
  if (BALANCE.has(family) && inAir.length) return inAir;
  if (feet.length) return feet;
  const standing = feetThat(row, true);
  return standing.length ? standing : (row ?? []).map((_, foot) => foot);
}

/** Calls `act` with each sample of an entry and the row of contacts there. */
function eachSample({ first, last }, contact, act) {
  for (let sample = first; sample <= last; sample += 1) act(sample, contact[sample] ?? contact[0] ?? []);
}

/** "foot,sample" to `{sentence, tone}`; the worst entry wins. Cells of a phase that are not to blame have no tone. */
export function missingMotionByCell(plan) {
  const found = new Map();
  const lacks = plan?.live?.lacks ?? [];
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

const size = ({ amount, unit }) => `${fixed(amount, amount < 0.1 ? 2 : 1)} ${unit}`;
const footOf = ({ feet }) => (feet.length ? `foot ${feet[0] + 1}` : "body");

/** What an entry says in a few words, by its family. */
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

/** Why an entry is one, in a few words. */
export function wordsOf(missing, contact) {
  if (!BALANCE.has(missing.family)) return WORDS[missing.family]?.(missing) ?? "a limit is violated";
  const row = contact[missing.first];
  const inAir = feetThat(row, false);
  const isLine = inAir.length > 0 && feetThat(row, true).length < LEAST_STANDING;
  return isLine ? `${named(inAir)} in the air` : `margin ${size(missing)} short`;
}

/** What such words begin with, where there is no room for all: "foot 1" of "foot 1: rise 3.1 mm short". */
export const shortWords = (words) => words.split(/: | in the air| too | off | \d+(?:\.\d+)? mm/)[0];

/** Joins two phases; the worse one says why. */
function joined(one, other) {
  const { rank, words } = one.rank < other.rank ? one : other;
  return { first: Math.min(one.first, other.first), last: Math.max(one.last, other.last), rank, words };
}

/** Whether a phase goes on in a later one: they overlap, or it follows at once for the same reason. */
const goesOn = (phase, next) =>
  next.first <= phase.last || (next.first === phase.last + 1 && next.words === phase.words);

/**
 * The phases that miss a limit, in their order in time; the three worst of them.
 * @returns {{first: number, last: number, words: string}[]} samples, and why in a few words
 */
export function missingPhases(plan) {
  const entries = (plan?.live?.lacks ?? []).map((missing, rank) => ({
    first: missing.first,
    last: missing.last,
    rank,
    words: wordsOf(missing, plan.contact),
  }));
  const phases = [];
  for (const entry of entries.sort((a, b) => a.first - b.first)) {
    if (phases.length && goesOn(phases.at(-1), entry)) phases.push(joined(phases.pop(), entry));
    else phases.push(entry);
  }
  const worst = phases.sort((a, b) => a.rank - b.rank).slice(0, SHOWN_PHASES);
  return worst.sort((a, b) => a.first - b.first).map(({ first, last, words }) => ({ first, last, words }));
}

/** The entries that the preview marks, with where their first foot is in the nearest motion. */
export const missingMotionOf = (plan) =>
  (plan?.live?.lacks ?? []).map((missing) => ({
    ...missing,
    places: missing.feet.length
      ? plan.feet.slice(missing.first, missing.last + 1).map((feet) => feet[missing.feet[0]])
      : [],
  }));
