/**
 * Changes of the segment table: each gives `{change, label, kept, moved}` (see `commit`), `change` from sheet
 * to sheet, or `{reason}`.
 */

import { capital, counted } from "../lib/format.js";
import { clamp } from "../lib/clamp.js";
import { plainCell } from "../lib/table_cell.js";
import {
  errorSentence,
  errorsOf,
  placeAfter,
  placeBefore,
  rowName,
  waitAt,
  walked,
} from "../document/segment_sheet.js";

const MOST_SAMPLES = 2000;

const span = ([first, last]) => (first === last ? `${first + 1}` : `${first + 1}–${last + 1}`);

/** "foot 2, segments 3–5" */
function rangeName(sheet, { rows, feet }) {
  const foot = feet[0] === feet[1] ? `foot ${feet[0] + 1}` : `feet ${span(feet)}`;
  if (rows[1] < sheet.count) return `${foot}, segment${rows[0] === rows[1] ? "" : "s"} ${span(rows)}`;
  return `${foot}, ${rowName(sheet, rows[0])}${rows[0] === rows[1] ? "" : ` to ${rowName(sheet, rows[1])}`}`;
}

/** Names into cells, `[row, foot, name]`. */
const withCells = (cells) => (sheet) => {
  const rows = sheet.rows.map((row) => [...row]);
  for (const [row, foot, name] of cells) if (rows[row]?.[foot] !== undefined) rows[row][foot] = name;
  return { ...sheet, rows };
};

const put = (sheet, cells, label) => {
  const changed = cells.filter(([row, foot, name]) => sheet.rows[row][foot] !== name);
  if (!changed.length) return { reason: "The selected cells already have this segment." };
  return { change: withCells(changed), label, kept: changed.map(([row, foot]) => [row, foot]) };
};

const cellsOf = ({ rows, feet }) => {
  const cells = [];
  for (let row = rows[0]; row <= rows[1]; row += 1)
    for (let foot = feet[0]; foot <= feet[1]; foot += 1) cells.push([row, foot]);
  return cells;
};

/** One segment into every cell of a range. */
export const setName = (sheet, range, name) =>
  put(
    sheet,
    cellsOf(range).map(([row, foot]) => [row, foot, name]),
    `${capital(rangeName(sheet, range))} to ${name}`,
  );

/** Waits at the position where each foot is, as Delete does. */
export function setWaits(sheet, range) {
  const cells = [];
  for (let foot = range.feet[0]; foot <= range.feet[1]; foot += 1) {
    const first = range.rows[0];
    const place = placeBefore(sheet, first, foot) ?? sheet.words.segments[sheet.rows[first][foot]]?.start;
    const name = waitAt(sheet, place);
    if (!name)
      return {
        reason:
          `Foot ${foot + 1} cannot wait in ${rowName(sheet, first)}. `
          + `Before this segment, foot ${foot + 1} is at ${place}, and no segment waits at ${place}. `
          + "Add such a segment under Vocabulary.",
      };
    for (let row = first; row <= range.rows[1]; row += 1) cells.push([row, foot, name]);
  }
  return put(sheet, cells, `${capital(rangeName(sheet, range))} to waiting`);
}

/** The range's first row into its other rows; a single row takes over the one above it. */
export function fillDown(sheet, range) {
  const from = range.rows[0] === range.rows[1] ? range.rows[0] - 1 : range.rows[0];
  if (from < 0) return { reason: "The first row cannot be filled, because no row is above the first row." };
  return put(
    sheet,
    cellsOf(range).map(([row, foot]) => [row, foot, sheet.rows[from][foot]]),
    `Fill down ${rangeName(sheet, range)}`,
  );
}

/**
 * Names from a clipboard, written from the range's first cell on; a single name fills the range.
 * @param {string[][]} names rows of names as they were typed
 */
export function paste(sheet, range, names) {
  const known = new Map(Object.keys(sheet.words.segments).map((name) => [name.toLowerCase(), name]));
  const nameOf = (cell) => known.get(plainCell(cell).toLowerCase()) ?? known.get(cell.toLowerCase());
  const [top, left] = [range.rows[0], range.feet[0]];
  const alone = names.length === 1 && names[0].length === 1;
  const block = alone
    ? cellsOf(range).map(([row, foot]) => [row, foot, names[0][0]])
    : names.flatMap((row, down) => row.map((name, right) => [top + down, left + right, name]));
  const fitting = block.filter(([row, foot]) => row < sheet.rows.length && foot < sheet.legs);
  const wrong = fitting.find(([, , name]) => !nameOf(name));
  if (wrong)
    return {
      reason:
        `Not pasted. Foot ${wrong[1] + 1}, ${rowName(sheet, wrong[0])}: `
        + `there is no segment “${wrong[2]}”. The known segments are ${[...known.values()].join(", ")}.`,
    };
  const cells = fitting.map(([row, foot, name]) => [row, foot, nameOf(name)]);
  const [below, beside] = [
    top + names.length - sheet.rows.length,
    left + Math.max(...names.map((row) => row.length)) - sheet.legs,
  ];
  const missing = alone
    ? []
    : [
        below > 0 && `${counted(below, "row")} below the last segment`,
        beside > 0 && `${counted(beside, "column")} after the last foot`,
      ].filter(Boolean);
  const last = [
    Math.min(top + names.length, sheet.rows.length) - 1,
    Math.min(left + Math.max(...names.map((row) => row.length)), sheet.legs) - 1,
  ];
  const filled = alone ? range : { rows: [top, last[0]], feet: [left, last[1]] };
  const outcome = put(sheet, cells, `Paste into ${rangeName(sheet, filled)}`);
  const broken = outcome.change && errorsOf(outcome.change(sheet)).find(({ stops }) => stops);
  if (broken) return { reason: `Not pasted. ${errorSentence(sheet, broken)} The table has not changed.` };
  return {
    ...outcome,
    range: filled,
    note: missing.length
      ? `Some of the copied segments did not fit and were not pasted: ${missing.join(" and ")}.`
      : null,
  };
}

/**
 * A new row after a row (−1: before the first), in which every foot waits where it is; `inLink` if it is the
 * link's.
 */
export function insertRow(sheet, after, inLink = false) {
  const names = [];
  const before = inLink && after < sheet.count ? sheet.to - 1 : after;
  for (let foot = 0; foot < sheet.legs; foot += 1) {
    const place =
      before < 0 ? sheet.words.segments[sheet.rows[0][foot]]?.start : placeAfter(sheet, before, foot);
    const name = waitAt(sheet, place);
    if (!name)
      return {
        reason:
          "No segment can be inserted here. "
          + `Foot ${foot + 1} is in the air at ${place} after ${rowName(sheet, Math.max(before, 0))}, and no `
          + `segment waits at ${place}. Insert before or after the step of foot ${foot + 1} instead.`,
      };
    names.push(name);
  }
  const change = (now) => {
    const rows = [...now.rows.slice(0, after + 1), names, ...now.rows.slice(after + 1)];
    if (inLink) return { ...now, rows };
    return {
      ...now,
      rows,
      count: now.count + 1,
      from: now.from + Number(after + 2 <= now.from),
      to: now.to + Number(after + 1 <= now.to),
    };
  };
  const moved = ([row, foot]) => [row + Number(row > after), foot];
  return { change, moved, label: insertLabel(sheet, after, inLink), kept: [] };
}

function insertLabel(sheet, after, inLink) {
  if (after < 0) return "Insert a segment at the beginning";
  return inLink && after < sheet.count
    ? `Insert before ${rowName(sheet, after + 1)}`
    : `Insert after ${rowName(sheet, after)}`;
}

/** The sheet without some rows; the repeating part shrinks with them. */
export function removeRows(sheet, [first, last]) {
  const lastRow = Math.min(last, sheet.count - 1);
  const inTable = Math.max(lastRow - first + 1, 0);
  if (inTable === sheet.count) return { reason: "A table needs at least one segment." };
  const change = (now) => {
    const rows = now.rows.filter((_, row) => row < first || row > last);
    const count = now.count - inTable;
    const gone = (bound) => Math.max(0, Math.min(bound, lastRow + 1) - first);
    const from = clamp(now.from - gone(now.from - 1), 1, count);
    return { ...now, rows, count, from, to: clamp(now.to - gone(now.to), from, count) };
  };
  const moved = ([row, foot]) =>
    row < first ? [row, foot] : row > last ? [row - (last - first + 1), foot] : null;
  return {
    change,
    moved,
    label:
      first === last
        ? `Remove ${rowName(sheet, first)}`
        : `Remove ${rowName(sheet, first)} to ${rowName(sheet, last)}`,
    kept: [],
  };
}

/** A first row of the link, in which every foot goes or waits so that the table goes on. */
export function addLinkRow(sheet) {
  const names = Array.from({ length: sheet.legs }, (_, foot) => {
    const last = (sheet.rows.length > sheet.count ? sheet.rows.length : sheet.to) - 1;
    return waitAt(sheet, placeAfter(sheet, last, foot)) ?? sheet.rows[last][foot];
  });
  return {
    change: (now) => ({ ...now, rows: [...now.rows, names] }),
    label: "Add a segment to the link",
    kept: [],
  };
}

/** One of the table's numbers: `samples`, `from` or `to`. */
export function setNumber(sheet, field, value) {
  const words = { samples: "Samples a segment", from: "Repeat from segment", to: "Repeat to segment" };
  const [least, most, why] = {
    samples: [
      2,
      Math.floor(MOST_SAMPLES / walked(sheet).length),
      `a timeline has at most ${MOST_SAMPLES} samples`,
    ],
    from: [1, sheet.to, `the repeating part ends with segment ${sheet.to}`],
    to: [
      sheet.from,
      sheet.count,
      `the repeating part begins with segment ${sheet.from} `
        + `and the table has ${counted(sheet.count, "segment")}`,
    ],
  }[field];
  if (sheet[field] === value) return { reason: "The field already has this value." };
  if (value < least || value > most)
    return {
      reason:
        `“${words[field]}” cannot be ${value}. `
        + `The value must lie between ${least} and ${most}, because ${why}.`,
    };
  return {
    change: (now) => ({ ...now, [field]: value, toEnd: field === "to" ? false : now.toEnd }),
    label: `${words[field]} ${field === "samples" ? "to " : ""}${value}`,
    kept: [],
  };
}
