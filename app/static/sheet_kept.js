/** Changes of the segment table that do not fit yet, kept in this tab so that a reload brings them back. */

import { draftOf, sheetsOf } from "./sheet_draft.js";
import { toast } from "./toasts.js";

const keyOf = (id) => `footfall.table-draft.${id}`;

/** What the changes were made on: with another table they mean nothing. */
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

/** A change as it was kept: the whole sheet after it. */
const stepOf = ({ label, kept, sheet }) => ({ label, kept, change: ({ iterations }) => ({ ...sheet, iterations }), restored: true });

/** Keeps the drafts of `store.tableDrafts`, and puts them back when their gait is shown again. */
export function mountKept(store) {
  const bases = new Map();

  function put(id, draft) {
    const { [id]: _, ...others } = store.state.tableDrafts;
    store.set({ tableDrafts: draft ? { ...others, [id]: draft } : others });
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
    else put(view.id, { steps: content.steps.map(stepOf), kept: content.kept });
  }

  store.watch(({ view, tableDrafts }) => [view, tableDrafts], (state) => {
    const { view } = state;
    if (!view) return;
    const [base, before] = [baseOf(view), bases.get(view.id)];
    bases.set(view.id, base);
    if (before === undefined) {
      recall(view, base);
      return;
    }
    const { steps, kept } = draftOf(state);
    if (base !== before && steps.some(({ restored }) => restored)) {
      drop(view);
      return;
    }
    const sheets = steps.length ? sheetsOf(view.document, steps) : [];
    write(view.id, steps.length ? { base, kept, steps: steps.map((step, index) => ({ label: step.label, kept: step.kept ?? [], sheet: sheets[index] })) } : null);
  });
}
