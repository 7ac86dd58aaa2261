/** The Segments section: the segment table of a gait as a spreadsheet, its numbers and its vocabulary. */

import { errorsOf } from "../document/segment_sheet.js";
import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { toast } from "../lib/toasts.js";
import { numberField } from "../state/fields.js";
import {
  commit,
  protectedCells,
  segmentDraftOf,
  segmentSheetsOf,
  shownSegmentSheet,
} from "../state/segment_draft.js";
import { shownDocument } from "../state/store.js";
import { createDefinitions, isTyped } from "./segment_definitions.js";
import { mountSegmentSheetCreation } from "./segment_sheet_creation.js";
import { setNumber } from "./segment_sheet_edits.js";
import { createSegmentSheetGrid } from "./segment_sheet_grid.js";
import { mountSegmentSheetInput } from "./segment_sheet_input.js";
import { mountSegmentSheetRepairs } from "./segment_sheet_repairs.js";

/** The table's three numbers, each an edit of its own. */
function numberFields(store, edits, run) {
  const field = (label, name, key, most, help) =>
    numberField(store, edits, {
      label,
      name,
      unit: "",
      min: key === "samples" ? 2 : 1,
      max: most,
      step: 1,
      decimals: 0,
      whole: true,
      help,
      read: () => shownSegmentSheet(store.state)?.[key] ?? null,
      act: (value) => run(setNumber(shownSegmentSheet(store.state), key, value)),
    });
  return [
    field(
      "Samples",
      "Samples a segment",
      "samples",
      200,
      "Number of samples of each segment, including its first and last sample",
    ),
    field(
      "Repeat",
      "Repeat from segment",
      "from",
      999,
      "First segment of the part that every iteration repeats",
    ),
    field("to", "Repeat to segment", "to", 999, "Last segment of the part that every iteration repeats"),
  ];
}

function tools(input, toggleDefinitions) {
  const button = (text, title, act) => h("button", { text, title, on: { click: act } });
  const words = h("button", {
    text: "Vocabulary",
    title: "Shows the named positions and segments of this table",
    "aria-expanded": "false",
    "aria-controls": "segment-words",
    on: { click: () => toggleDefinitions(words) },
  });
  const bar = h(
    "div",
    { class: "sheet-tools", role: "toolbar", "aria-label": "Segment table" },
    button(
      "Insert",
      "Adds a segment in which every foot waits, after the selected segments (key Insert) "
        + "or before them (Alt+Insert)",
      () => input.insert(),
    ),
    button("Remove", "Removes the selected segments for all feet (Ctrl+Delete)", () => input.remove()),
    button("Fill down", "Copies the first selected row into the selected rows below it (Ctrl+D)", () =>
      input.fill(),
    ),
    words,
  );
  oneTabStop(bar, { isToolbar: true });
  return bar;
}

/** The section's parts that show the sheet. */
function sheetParts() {
  return {
    title: h("h2", {}, "Segment table", h("span")),
    notice: h("p", { class: "box-note", data: { tone: "caution" } }),
    grid: h("div", {
      class: "sheet",
      role: "grid",
      "aria-label": "Segment table",
      "aria-multiselectable": "true",
    }),
    note: h("div", { class: "box-note", role: "status", "aria-label": "Segment table note" }),
    panel: h("div", {
      id: "segment-words",
      class: "words",
      role: "region",
      "aria-label": "Vocabulary",
      hidden: true,
    }),
  };
}

/** Undo and redo of edits in the vocabulary, where nothing is being typed. */
function mountHistoryKeys(panel, edits) {
  panel.addEventListener("keydown", (event) => {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || !"zy".includes(key) || isTyped(event.target)) return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) edits.redo();
    else edits.undo();
  });
}

/** Tells the grid's style how much room there is beside the note; the focus stays in view. */
function mountSizes(grid, note, hasFocus) {
  const section = byId("segments");
  const showView = () => grid.style.setProperty("--view", `${section.clientHeight}px`);
  new ResizeObserver(showView).observe(section);
  new ResizeObserver(() => {
    grid.style.setProperty("--note", `${note.offsetHeight}px`);
    if (hasFocus()) document.activeElement.scrollIntoView({ block: "nearest" });
  }).observe(note);
}

/** What of a document the section shows. */
const shownParts = (document) => [
  document?.segment_table,
  document?.direction,
  document?.iterations,
  document?.timeline.sample_time,
];

/** Builds the section; `escape` closes what is open in it, and returns whether anything was. */
export function mountSegments(store, edits) {
  const { title, notice, grid, note, panel } = sheetParts();
  const run = (outcome) => {
    if (outcome.reason) toast(outcome.reason);
    else commit(store, edits, outcome);
  };
  const strokes = () => store.state.view?.plan.stroke_limits_mm.map((limit) => Number(limit.toFixed(3)));
  const drawDefinitions = createDefinitions(panel, { run, refuse: toast, strokes });
  const cells = createSegmentSheetGrid(grid, () => input.addLink());
  const input = mountSegmentSheetInput(store, edits, grid, cells);
  const numbers = numberFields(store, edits, run);
  const bar = tools(input, (button) => {
    panel.hidden = !panel.hidden;
    setAttribute(button, "aria-expanded", String(!panel.hidden));
    show(store.state);
    // Once it has been filled.
    if (!panel.hidden) setTimeout(() => panel.scrollIntoView({ block: "nearest" }));
  });
  mountHistoryKeys(panel, edits);
  const numberRow = h("div", { class: "sheet-numbers" }, ...numbers.map(({ element }) => element));
  const making = mountSegmentSheetCreation(store, edits);
  byId("segments").replaceChildren(title, notice, making, bar, grid, note, numberRow, panel);

  function drawSheet(sheet, roles) {
    const hadFocus = input.hasFocus();
    const isNew = cells.draw(sheet, roles, errorsOf(sheet));
    input.show();
    if (isNew && (input.escape() || hadFocus)) input.focus();
  }

  function show(state) {
    const sheet = shownSegmentSheet(state);
    const { view } = state;
    making.hidden = Boolean(sheet) || !view;
    for (const part of [bar, numberRow]) part.hidden = !sheet;
    notice.hidden = !view?.notice;
    setText(notice, view?.notice ?? "");
    panel.toggleAttribute("data-none", !sheet);
    if (!view) return;
    if (!sheet) {
      setText(title.lastChild, "");
      cells.forget();
      input.escape();
      grid.hidden = true;
      return;
    }
    grid.hidden = false;
    const document = shownDocument(state);
    setText(title.lastChild, `${sheet.count} × ${fixed(sheet.samples * document.timeline.sample_time, 1)} s`);
    drawSheet(sheet, view.roles ?? []);
    numbers.forEach((one) => one.show(document));
    if (!panel.hidden) drawDefinitions(sheet);
  }

  mountSizes(grid, note, input.hasFocus);
  mountSegmentSheetRepairs(store, edits, note, input.focus);
  mountSegmentDrafts(store);
  store.watch((state) => [state.view, state.segmentDrafts, ...shownParts(shownDocument(state))], show);
  store.watch(
    (state) => [segmentDraftOf(state).steps.length > 0],
    (state) => grid.toggleAttribute("data-draft", segmentDraftOf(state).steps.length > 0),
  );
  return { escape: input.escape };
}

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
const stepOf = ({ label, kept, sheet }) => ({
  label,
  kept,
  moved: () => null,
  change: ({ iterations }) => ({ ...sheet, iterations }),
  restored: true,
});

/** Keeps the drafts of `store.segmentDrafts`, and restores them when their gait is shown again. */
function mountSegmentDrafts(store) {
  const bases = new Map();

  function put(id, draft) {
    const { [id]: _, ...others } = store.state.segmentDrafts;
    store.set({ segmentDrafts: draft ? { ...others, [id]: draft } : others });
  }

  function drop(view) {
    put(view.id, null);
    write(view.id, null);
    toast(
      `The segment table of “${view.document.name}” was changed in another window. `
        + `Your changes in this window still had errors and were discarded.`,
    );
  }

  function recall(view, base) {
    const content = read(view.id);
    if (!content) return;
    if (content.base !== base) drop(view);
    else put(view.id, { steps: content.steps.map(stepOf) });
  }

  store.watch(
    ({ view, segmentDrafts }) => [view, segmentDrafts],
    (state) => {
      const { view } = state;
      if (!view) return;
      const [base, before] = [baseOf(view), bases.get(view.id)];
      bases.set(view.id, base);
      if (before === undefined) {
        recall(view, base);
        return;
      }
      const { steps } = segmentDraftOf(state);
      // Restored changes are whole sheets, which stand on the table that they were made on; all need one.
      if (
        view.document.segment_table ? base !== before && steps.some(({ restored }) => restored) : steps.length
      ) {
        drop(view);
        return;
      }
      const sheets = steps.length ? segmentSheetsOf(view.document, steps) : [];
      write(
        view.id,
        steps.length
          ? {
              base,
              steps: steps.map(({ label }, index) => ({
                label,
                kept: protectedCells(steps.slice(0, index + 1)),
                sheet: sheets[index],
              })),
            }
          : null,
      );
    },
  );
}
