/** Keeps changes of the segment table that do not fit yet, so that a reload of the tab restores them. */

import { segmentDraftOf, protectedCells, segmentSheetsOf } from "../state/segment_draft.js";
import { toast } from "../lib/toasts.js";

const keyOf = (id) => `footfall.table-draft.${id}`;

/** What the changes were made on; they do not apply to another table. */
const baseOf = ({ document }) => JSON.stringify([document.segment_table, document.direction]);

function read(id) {
  try {
    return JSON.parse(sessionStorage.getItem(keyOf(id)) ?? "null");
  } catch {
    return null;
  }
}

function write(id, content) {
  try {
    if (content) sessionStorage.setItem(keyOf(id), JSON.stringify(content));
    else sessionStorage.removeItem(keyOf(id));
  } catch {
    // Without the browser's memory a draft lives as long as the page.
  }
}

/** A restored change: the whole sheet after it, with the cells that repairs leave alone. */
const stepOf = ({ label, kept, sheet }) => ({ label, kept, moved: () => null, change: ({ iterations }) => ({ ...sheet, iterations }), restored: true });

/** Keeps the drafts of `store.segmentDrafts`, and restores them when their gait is shown again. */
export function mountSegmentDrafts(store) {
  const bases = new Map();

  function put(id, draft) {
    const { [id]: _, ...others } = store.state.segmentDrafts;
    store.set({ segmentDrafts: draft ? { ...others, [id]: draft } : others });
  }

  function drop(view) {
    put(view.id, null);
    write(view.id, null);
    toast(`The changes of the segment table of “${view.document.name}” that did not fit yet are dropped: its table was changed meanwhile.`);
  }

  function recall(view, base) {
    const content = read(view.id);
    if (!content) return;
    if (content.base !== base) drop(view);
    else put(view.id, { steps: content.steps.map(stepOf) });
  }

  store.watch(({ view, segmentDrafts }) => [view, segmentDrafts], (state) => {
    const { view } = state;
    if (!view) return;
    const [base, before] = [baseOf(view), bases.get(view.id)];
    bases.set(view.id, base);
    if (before === undefined) {
      recall(view, base);
      return;
    }
    const { steps } = segmentDraftOf(state);
    // Restored changes are whole sheets, which stand on the table that they were made on; all of them need one.
    if (view.document.segment_table ? base !== before && steps.some(({ restored }) => restored) : steps.length) {
      drop(view);
      return;
    }
    const sheets = steps.length ? segmentSheetsOf(view.document, steps) : [];
    write(view.id, steps.length ? { base, steps: steps.map(({ label }, index) => ({ label, kept: protectedCells(steps.slice(0, index + 1)), sheet: sheets[index] })) } : null);
  });
}
