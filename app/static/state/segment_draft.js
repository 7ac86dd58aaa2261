/**
 * A segment table that does not fit together yet.
 *
 * Changes after which every segment starts where the one before ends become one edit of the gait at once.
 * Others are kept in this tab, on top of the gait's last good table, until a further change or a repair
 * makes them fit, or Undo takes them back.
 */

import { errorsOf, segmentSheetOf, tableOf } from "../document/segment_sheet.js";
import { shownDocument } from "./store.js";

/**
 * @typedef {import("./store.js").State} State
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 * @typedef {import("../document/segment_sheet.js").Sheet} Sheet
 */

/**
 * A change of a sheet: `kept` are the cells, `[row, foot]`, that a repair leaves alone; `moved` maps a cell
 * to its new place, or null if it is gone.
 * @typedef {{change: (sheet: Sheet) => Sheet, label: string, kept?: number[][],
 *   restored?: boolean, moved?: (cell: number[]) => number[]|null}} Step
 */

/** @type {{steps: Step[]}} */
const NONE = Object.freeze({ steps: /** @type {any} */ (Object.freeze([])) });

/**
 * The changes of the shown gait that do not fit yet.
 * @param {Pick<State, "segmentDrafts"|"view">} state
 * @returns {{steps: Step[]}}
 */
export const segmentDraftOf = ({ segmentDrafts, view }) => segmentDrafts[view?.id] ?? NONE;

/** @param {Sheet} sheet @param {Step[]} steps */
const applied = (sheet, steps) => steps.reduce((now, { change }) => change(now), sheet);

/**
 * The sheet of a document that has a table, with steps on top.
 * @param {GaitDocument} document
 * @param {Step[]} steps
 */
const sheetWith = (document, steps) => applied(/** @type {Sheet} */ (segmentSheetOf(document)), steps);

/**
 * The sheets after each of the steps, on top of a document.
 * @param {GaitDocument} document
 * @param {Step[]} steps
 */
export const segmentSheetsOf = (document, steps) =>
  steps.map((_, index) => sheetWith(document, steps.slice(0, index + 1)));

/**
 * The cells, `[row, foot]`, that steps have set and a repair leaves alone, where later steps have moved them.
 * @param {Step[]} steps
 */
export const protectedCells = (steps) =>
  steps.reduce((/** @type {number[][]} */ cells, { kept = [], moved }) => {
    const there = moved ? cells.map(moved).filter((cell) => cell !== null) : cells;
    return [...there, ...kept];
  }, []);

/** @type {{parts: any[], sheet: Sheet|null}} */
let last = { parts: [], sheet: null };

/**
 * The sheet as a person sees it: the document's, with what does not fit yet on top; null without a table.
 * @param {State} state
 * @returns {any} a Sheet, or null
 */
export function shownSegmentSheet(state) {
  const [document, { steps }] = [shownDocument(state), segmentDraftOf(state)];
  const parts = [document?.segment_table, document?.direction, document?.iterations, steps];
  if (parts.some((part, index) => part !== last.parts[index]) || !last.parts.length) {
    const sheet = segmentSheetOf(document);
    last = { parts, sheet: sheet && applied(sheet, steps) };
  }
  return last.sheet;
}

/** @param {Store} store @param {Step[]} steps */
function keep(store, steps) {
  const { view, segmentDrafts } = store.state;
  const { [view.id]: _, ...others } = segmentDrafts;
  store.set({ segmentDrafts: steps.length ? { ...others, [view.id]: { steps } } : others });
}

/** Takes the last change back that does not fit; false where there is none. @param {Store} store */
export function undoSegmentDraft(store) {
  const { steps } = segmentDraftOf(store.state);
  if (!steps.length) return false;
  keep(store, steps.slice(0, -1));
  return true;
}

/** Takes all of them back. @param {Store} store */
export const dropSegmentDraft = (store) => keep(store, []);

/**
 * Makes a change: one edit of the gait where everything fits then, else one more step of the draft.
 * @param {Store} store
 * @param {import("./edits.js").Edits} edits
 * @param {Step} step
 */
export function commit(store, edits, step) {
  const steps = [...segmentDraftOf(store.state).steps, step];
  const sheet = sheetWith(shownDocument(store.state), steps);
  if (errorsOf(sheet).some(({ stops }) => stops)) return keep(store, steps);
  keep(store, []);
  const apply = (/** @type {GaitDocument} */ document) =>
    document.segment_table ? { ...document, segment_table: tableOf(sheetWith(document, steps)) } : document;
  return edits.edit(apply, step.label, { drawing: true });
}
