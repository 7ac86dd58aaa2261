/**
 * A segment table that does not fit together yet.
 *
 * Changes after which every segment starts where the one before ends become one edit of the gait at once. Others are kept in
 * this tab, on top of the gait's last good table, until a further change or a repair makes them fit, or Undo takes them back.
 */

import { errorsOf, segmentSheetOf, tableOf } from "../document/segment_sheet.js";
import { shownDocument } from "./store.js";

const NONE = Object.freeze({ steps: Object.freeze([]) });

/** The changes of the shown gait that do not fit yet: `{steps}`. */
export const segmentDraftOf = ({ segmentDrafts, view }) => segmentDrafts[view?.id] ?? NONE;

const applied = (sheet, steps) => steps.reduce((now, { change }) => change(now), sheet);

/** The sheets after each of the steps, on top of a document. */
export const segmentSheetsOf = (document, steps) =>
  steps.map((_, index) => applied(segmentSheetOf(document), steps.slice(0, index + 1)));

/** The cells, `[row, foot]`, that steps have set and a repair leaves alone, where later steps have moved them. */
export const protectedCells = (steps) =>
  steps.reduce(
    (cells, { kept = [], moved }) => [...(moved ? cells.map(moved).filter(Boolean) : cells), ...kept],
    [],
  );

let last = { parts: [], sheet: null };

/** The sheet as a person sees it: the document's, with what does not fit yet on top; null without a table. */
export function shownSegmentSheet(state) {
  const [document, { steps }] = [shownDocument(state), segmentDraftOf(state)];
  const parts = [document?.segment_table, document?.direction, document?.iterations, steps];
  if (parts.some((part, index) => part !== last.parts[index]) || !last.parts.length) {
    const sheet = segmentSheetOf(document);
    last = { parts, sheet: sheet && applied(sheet, steps) };
  }
  return last.sheet;
}

function keep(store, steps) {
  const { view, segmentDrafts } = store.state;
  const { [view.id]: _, ...others } = segmentDrafts;
  store.set({ segmentDrafts: steps.length ? { ...others, [view.id]: { steps } } : others });
}

/** Takes the last change back that does not fit; false where there is none. */
export function undoSegmentDraft(store) {
  const { steps } = segmentDraftOf(store.state);
  if (!steps.length) return false;
  keep(store, steps.slice(0, -1));
  return true;
}

/** Takes all of them back. */
export const dropSegmentDraft = (store) => keep(store, []);

/**
 * Makes a change: one edit of the gait where everything fits then, else one more step of the draft.
 * @param {{change: (sheet: Record<string, any>) => Record<string, any>, label: string, kept?: number[][], moved?: (cell: number[]) => number[]|null}} step `kept`
 *   are the cells, `[row, foot]`, that a repair leaves alone; `moved` maps a cell to its new place, or null if it is gone
 */
export function commit(store, edits, step) {
  const steps = [...segmentDraftOf(store.state).steps, step];
  const sheet = applied(segmentSheetOf(shownDocument(store.state)), steps);
  if (errorsOf(sheet).some(({ stops }) => stops)) return keep(store, steps);
  keep(store, []);
  const apply = (document) =>
    document.segment_table
      ? { ...document, segment_table: tableOf(applied(segmentSheetOf(document), steps)) }
      : document;
  return edits.edit(apply, step.label, { drawing: true });
}
