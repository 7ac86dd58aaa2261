/**
 * The operations that the timeline offers: what each would make of the document, its name in the history,
 * or why not.
 *
 * `outcomeOf` answers with `{apply, document, label, note, clipped, selection}` or with `{reason}`. `apply`
 * goes from document to document, so that it can be put on top of what another tab did meanwhile;
 * `document` is what is shown as preview, `clipped` says what does not fit.
 */

import { capital, counted } from "../lib/format.js";
import { drawnRows, isDrawn, repeatedRows } from "./drawn_timeline.js";
import { inserted, removed, repeated, stretched } from "./length_operators.js";
import { heldMirrored, heldReversed, heldTurned } from "./held_feet.js";
import { allFeet, isWhole, lengthOf, regionText, rowsOfFeet, wholeOf } from "./region.js";
import { whyNotDrawn } from "./drawable.js";
import {
  blockOf,
  heldBack,
  mirrored,
  mirroredFeet,
  reversed,
  shifted,
  stretchedInPlace,
  toStance,
  turnedRows,
  withBlock,
  withLocks,
} from "./timeline_operators.js";

/**
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 * @typedef {import("./region.js").Region} Region
 * @typedef {{document: GaitDocument, region: Region, mirror: number[]|null, amount: number,
 *   words: string}} Context
 * @typedef {Record<string, any>} Outcome
 * @typedef {{name: string, help: string, outcome: (context: Context) => Outcome, columns?: boolean,
 *   amount?: {name: string, unit: string, least: number, most: number, factor?: boolean,
 *   start: (context: {document: GaitDocument, region: Region}) => number}}} Operation
 */

const MOST_ITERATIONS = 20;
export const MOST_SAMPLES = 2000;

/** @param {GaitDocument} document */
const sampleCount = (document) => rowsOfFeet(document)[0].length;
/** @param {string} row */
const swingCount = (row) => row.split("1").filter(Boolean).length;
/** @param {GaitDocument} document @param {number} samples */
const seconds = (document, samples) =>
  `${(Math.max(0, samples - 1) * document.timeline.sample_time).toFixed(1)} s`;

/** What of a region does not fit behind a sample, in words; null where all of it does. */
const clippedText = (/** @type {number} */ over) => {
  if (over <= 0) return null;
  if (over === 1) return "The last sample of the result does not fit into the timeline and is cut off.";
  return `The last ${over} samples of the result do not fit into the timeline and are cut off.`;
};

/** @param {GaitDocument} before @param {GaitDocument} after */
const lengthNote = (before, after) => {
  const [old, now] = [sampleCount(before), sampleCount(after)];
  return (
    `The length of the timeline changes from ${old} to ${counted(now, "sample")} `
    + `(${seconds(after, now)}).`
  );
};

/**
 * Where a mirrored order draws the mirrored timeline, the order goes along.
 * @param {GaitDocument} document
 * @param {Region} region
 * @param {number[]} mirror
 * @returns {GaitDocument}
 */
function mirroredWhole(document, region, mirror) {
  if (!isWhole(document, region)) return mirrored(document, region, mirror);
  const after = heldMirrored(mirrored(document, region, mirror), mirror);
  if (!isDrawn(document)) return after;
  const legs = mirror.length;
  const turn = Math.floor((legs * (document.direction - 1)) / 4);
  const order = document.order.map(
    (/** @type {number} */ foot) => ((mirror[(foot - 1 + turn) % legs] - turn + legs) % legs) + 1,
  );
  return isDrawn({ ...after, order }) ? { ...after, order } : after;
}

/** @param {Region} region @param {number[]} mirror */
function mirrorNote(region, mirror) {
  const pairs = mirroredFeet(region, mirror)
    .filter((foot) => foot < mirror[foot])
    .map((foot) => `${foot + 1} and ${mirror[foot] + 1}`);
  return `These pairs of feet exchange their cells: ${pairs.join(", ")}.`;
}

/** @param {Context} context @returns {Outcome} */
function mirror({ region, mirror: map, words }) {
  if (!map) {
    const reason = "A gait can be mirrored only if its heading lies along a leg or halfway between two legs.";
    return { reason };
  }
  return {
    apply: (/** @type {GaitDocument} */ now) => mirroredWhole(now, region, map),
    label: `Mirror ${words}`,
    note: mirrorNote(region, map),
  };
}

/** @param {GaitDocument} before @param {GaitDocument} after */
function vanishing(before, after) {
  const rows = rowsOfFeet(after);
  const foot = rowsOfFeet(before).findIndex((row, index) => swingCount(rows[index]) < swingCount(row));
  return foot < 0
    ? null
    : `At this length, a swing of foot ${foot + 1} would disappear or touch the next swing. `
        + "Enter a larger number of samples.";
}

/** @param {Context} context @returns {Outcome} */
function stretch({ document, region, words, amount }) {
  const grows = allFeet(document, region);
  const apply = (/** @type {GaitDocument} */ now) =>
    (grows ? stretched : stretchedInPlace)(now, region, amount);
  const after = apply(document);
  const [first] = region.samples;
  const clipped = grows ? null : clippedText(first + amount - sampleCount(document));
  const note = grows ? lengthNote(document, after) : (clipped ?? `Samples ${first + 1}–${first + amount}.`);
  return {
    apply,
    note,
    clipped,
    label: `Stretch ${words} to ${counted(amount, "sample")}`,
    reason: grows && amount < lengthOf(region) ? vanishing(document, after) : null,
    selection: { ...region, samples: [first, Math.min(first + amount, sampleCount(after)) - 1] },
  };
}

/** @param {Context} context @returns {Outcome} */
function repeatWhole({ document, amount }) {
  const iterations = document.iterations * amount;
  if (iterations > MOST_ITERATIONS) {
    return {
      reason:
        `The gait would have ${iterations} iterations. `
        + `At most ${MOST_ITERATIONS} iterations are possible.`,
    };
  }
  const feet = document.segment_table
    ? null
    : isDrawn(document)
      ? drawnRows({ ...document, iterations })
      : repeatedRows(document, iterations);
  const shown = feet && {
    ...document,
    iterations,
    timeline: { ...document.timeline, feet, locked: feet.map((row) => "0".repeat(row.length)) },
  };
  if (!feet && !document.segment_table) {
    return {
      reason:
        `The whole gait cannot be repeated, because its ${document.iterations} iterations `
        + "have different lengths. Select the samples that you want to repeat.",
    };
  }
  return {
    apply: (/** @type {GaitDocument} */ now) => ({ ...now, iterations }),
    document: shown,
    label: `Iterations to ${iterations}`,
    drawing: false,
    selection: null,
    note: shown
      ? `${counted(iterations, "iteration")}. ${lengthNote(document, shown)}`
      : `The gait will have ${counted(iterations, "iteration")}.`,
  };
}

/** @param {Context} context @returns {Outcome} */
function repeat(context) {
  const { document, region, amount } = context;
  if (isWhole(document, region)) return repeatWhole(context);
  const after = repeated(document, region, amount);
  return {
    apply: (/** @type {GaitDocument} */ now) => repeated(now, region, amount),
    note: lengthNote(document, after),
    label: `Repeat samples ${region.samples[0] + 1}–${region.samples[1] + 1} ${amount}×`,
    selection: { ...region, samples: [region.samples[0], region.samples[0] + lengthOf(region) * amount - 1] },
  };
}

/** @param {Context} context @returns {Outcome} */
function rotate({ document }) {
  const direction = (document.direction % 4) + 1;
  const feet = turnedRows(rowsOfFeet(document), direction - document.direction);
  const by = Math.floor(((direction - document.direction) * feet.length) / 4);
  const shown = heldTurned({ ...document, direction, timeline: { ...document.timeline, feet } }, by);
  return {
    apply: (/** @type {GaitDocument} */ now) => ({ ...now, direction }),
    document: shown,
    label: `Direction to ${direction}`,
    drawing: false,
    note:
      `The direction changes from ${document.direction} to ${direction}. `
      + "Each foot takes the cells of another foot.",
  };
}

/** @param {Context} context @returns {Outcome} */
function duplicate({ document, region, words }) {
  const [, last] = region.samples;
  const rest = sampleCount(document) - 1 - last;
  if (rest <= 0) {
    return {
      reason:
        "The selection ends at the end of the timeline, so a copy does not fit. "
        + "Use Repeat instead, because Repeat makes the timeline longer.",
    };
  }
  const apply = (/** @type {GaitDocument} */ now) =>
    withBlock(now, [region.feet[0], last + 1], blockOf(now, region));
  const clipped = clippedText(lengthOf(region) - rest);
  return {
    apply,
    clipped,
    label: `Duplicate ${words}`,
    selection: {
      ...region,
      samples: [last + 1, Math.min(last + lengthOf(region), sampleCount(document) - 1)],
    },
    note: clipped ?? `The copy starts at sample ${last + 2}.`,
  };
}

/** @param {Context} context @returns {Outcome} */
function insert({ document, region, amount }) {
  const after = inserted(document, region, amount);
  return {
    apply: (/** @type {GaitDocument} */ now) => inserted(now, region, amount),
    label: `Insert ${counted(amount, "sample")} before sample ${region.samples[0] + 1}`,
    note: `Each foot stays in stance or swing during the new samples. ${lengthNote(document, after)}`,
    selection: { ...region, samples: [region.samples[0], region.samples[0] + amount - 1] },
  };
}

/** @param {Context} context @returns {Outcome} */
function remove({ document, region }) {
  if (sampleCount(document) - lengthOf(region) < 2) {
    return { reason: "The timeline must keep at least two samples. Select fewer samples." };
  }
  const after = removed(document, region);
  const range =
    lengthOf(region) === 1
      ? `sample ${region.samples[0] + 1}`
      : `samples ${region.samples[0] + 1}–${region.samples[1] + 1}`;
  return {
    apply: (/** @type {GaitDocument} */ now) => removed(now, region),
    label: `Remove ${range}`,
    note: lengthNote(document, after),
    selection: null,
  };
}

/** @param {boolean} locks @returns {(context: Context) => Outcome} */
const locking =
  (locks) =>
  ({ region, words }) => ({
    apply: (/** @type {GaitDocument} */ now) => withLocks(now, region, locks),
    label: `${locks ? "Lock" : "Unlock"} ${words}`,
  });

/**
 * `amount` is the number that an operation asks for; `start` gives what stands there at first. `columns`
 * are operations on samples of all feet, which never mean the whole timeline by themselves.
 * @type {Record<string, Operation>}
 */
export const OPERATIONS = {
  mirror: {
    name: "Mirror",
    outcome: mirror,
    help:
      "Mirror the cells at the heading of the gait: "
      + "each foot exchanges its cells with the foot on the other side",
  },
  stretch: {
    name: "Stretch",
    help: "Make the selection, or the whole timeline, longer or shorter",
    outcome: stretch,
    amount: {
      name: "New length",
      unit: "samples",
      least: 1,
      most: MOST_SAMPLES,
      factor: true,
      start: ({ document, region }) => lengthOf(region) + (isWhole(document, region) ? lengthOf(region) : 1),
    },
  },
  reverse: {
    name: "Reverse in time",
    help: "Reverse the order of the samples: the last sample becomes the first",
    outcome: ({ region, words }) => ({
      apply: (/** @type {GaitDocument} */ now) =>
        isWhole(now, region) ? heldReversed(reversed(now, region)) : reversed(now, region),
      label: `Reverse ${words}`,
    }),
  },
  shift: {
    name: "Shift phase",
    help: "Move the cells later in time. Cells that leave at the end come back at the beginning",
    amount: { name: "Later by", unit: "samples", least: -MOST_SAMPLES, most: MOST_SAMPLES, start: () => 1 },
    outcome: ({ region, words, amount }) => ({
      apply: (/** @type {GaitDocument} */ now) => shifted(now, region, amount),
      label: `Shift ${words} by ${amount > 0 ? "+" : "−"}${Math.abs(amount)}`,
    }),
  },
  repeat: {
    name: "Repeat",
    outcome: repeat,
    help:
      "Repeat the selected samples of all feet. Later samples move to the right. "
      + "Without a selection, the whole gait gets more iterations",
    amount: { name: "Times", unit: "", least: 2, most: MOST_ITERATIONS, start: () => 2 },
  },
  rotate: { name: "Rotate by 90°", help: "Turn the direction of the whole gait by 90°", outcome: rotate },
  duplicate: {
    name: "Duplicate",
    help:
      "Copy the selected cells to the samples right after the selection. "
      + "The copy overwrites the old cells in these samples",
    outcome: duplicate,
  },
  stance: {
    name: "To stance",
    help: "Change the selected cells to stance",
    outcome: ({ region, words }) => ({
      apply: (/** @type {GaitDocument} */ now) => toStance(now, region),
      label: `${words} to stance`,
    }),
  },
  lock: { name: "Lock", help: "Lock cells, so that no edit can change them", outcome: locking(true) },
  unlock: {
    name: "Unlock",
    help: "Unlock cells, so that edits can change them again",
    outcome: locking(false),
  },
  insert: {
    name: "Insert samples",
    outcome: insert,
    columns: true,
    help:
      "Insert samples for all feet before the selection or the focused cell. "
      + "Later samples move to the right",
    amount: { name: "How many", unit: "samples", least: 1, most: 500, start: () => 1 },
  },
  remove: {
    name: "Remove samples",
    outcome: remove,
    columns: true,
    help: "Remove the selected samples, or the focused sample, of all feet. Later samples move to the left",
  },
};

/** @param {GaitDocument} before @param {GaitDocument} after */
const refusalOf = (before, after) =>
  sampleCount(after) > MOST_SAMPLES
    ? `The timeline would have ${sampleCount(after)} samples. `
      + `A timeline can have at most ${MOST_SAMPLES} samples.`
    : heldBack(before, after);

/**
 * What an operation would make of a document.
 * @param {string} id of OPERATIONS
 * @param {{document: GaitDocument, region: Region|null, mirror: number[]|null}} state without a region the
 *   whole timeline is meant
 * @param {number} [amount] of an operation that asks for one
 * @returns {any} an Outcome
 */
export function outcomeOf(id, { document, region, mirror: map }, amount) {
  const whyNot = whyNotDrawn(document);
  if (whyNot) return { reason: whyNot };
  const chosen = region ?? wholeOf(document);
  const words = regionText(document, chosen);
  const found = OPERATIONS[id].outcome({
    document,
    region: chosen,
    mirror: map,
    amount: /** @type {number} */ (amount),
    words,
  });
  if (found.reason) return { reason: found.reason };
  const after = found.document === undefined ? found.apply(document) : found.document;
  const reason = after && refusalOf(document, after);
  return reason ? { reason } : { drawing: true, ...found, document: after, label: capital(found.label) };
}
