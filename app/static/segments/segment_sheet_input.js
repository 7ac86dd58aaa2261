/**
 * Keyboard, pointer, clipboard and selection of the segment table. The selection is the timeline's: its
 * samples are those of the selected segments.
 */

import { rowsOf, samplesOf } from "../document/segment_sheet.js";
import { clamp } from "../lib/clamp.js";
import { tableCell } from "../lib/table_cell.js";
import { announce, toast } from "../lib/toasts.js";
import { commit, shownSegmentSheet } from "../state/segment_draft.js";
import { openSegmentChooser } from "./segment_sheet_chooser.js";
import {
  addLinkRow,
  fillDown,
  insertRow,
  paste,
  removeRows,
  setName,
  setWaits,
} from "./segment_sheet_edits.js";

/** @returns {[number, number]} */
const ordered = (a, b) => [Math.min(a, b), Math.max(a, b)];

/**
 * @param {Record<string, any>} sheet
 * @param {number[]} place
 * @returns {[number, number]}
 */
const nearest = ({ rows, legs }, [row, foot]) => [clamp(row, 0, rows.length - 1), clamp(foot, 0, legs - 1)];

/** The selected cells, from an anchor to the head, which has the focus. */
function selectionOf(store, grid, cells) {
  /** @type {[number, number]} */
  let anchor = [0, 0];
  /** @type {[number, number]} */
  let head = [0, 0];
  let own = null;
  const sheet = () => shownSegmentSheet(store.state);
  const range = () => ({ rows: ordered(anchor[0], head[0]), feet: ordered(anchor[1], head[1]) });

  /** Marks the cells, and puts the focus's tab stop on the head. */
  function show() {
    const now = sheet();
    if (!now) return;
    [anchor, head] = [nearest(now, anchor), nearest(now, head)];
    cells.select(range());
    grid.querySelector('[tabindex="0"]')?.setAttribute("tabindex", "-1");
    cells.cell(head)?.setAttribute("tabindex", "0");
  }

  /** Puts the focus on the head, and scrolls no further than needed. */
  function focus() {
    const cell = cells.cell(head);
    cell?.focus({ preventScroll: true });
    cell?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** Selects from a cell to a cell, here and on the timeline. */
  function select(from, to) {
    [anchor, head] = [from, to];
    show();
    const { rows, feet } = range();
    const samples = samplesOf(sheet(), rows);
    own = samples && { feet, samples };
    store.set({ selection: own });
    focus();
  }

  /** Takes over the timeline's selection. */
  function follow(selection) {
    const now = sheet();
    if (!now || selection === own) return;
    own = selection;
    const rows = selection && rowsOf(now, selection.samples);
    if (rows) {
      const [first, last] = selection.feet;
      [anchor, head] = [
        [rows[0], first],
        [rows[1], Math.min(last, now.legs - 1)],
      ];
    } else anchor = head;
    show();
  }

  function reset() {
    [anchor, head, own] = [[0, 0], [0, 0], null];
  }

  return {
    sheet,
    range,
    head: () => head,
    show,
    focus,
    select,
    go: (place, extend = false) => select(extend ? anchor : place, place),
    follow,
    reset,
  };
}

/** What is done to the selected cells. */
function actionsOf({ sheet, range, head, go }, run) {
  return {
    fill: () => run(fillDown(sheet(), range())),
    wait: () => run(setWaits(sheet(), range())),
    addLink: () => run(addLinkRow(sheet())),
    insert(above = false) {
      const [first, last] = range().rows;
      const after = above ? first - 1 : last;
      const outcome = insertRow(sheet(), after, (above ? first : last) >= sheet().count);
      run(outcome);
      if (!outcome.reason) go([after + 1, head()[1]]);
    },
    remove() {
      const { rows } = range();
      const outcome = removeRows(sheet(), rows);
      run(outcome);
      if (!outcome.reason) go(nearest(sheet(), [rows[0], head()[1]]));
    },
  };
}

/** The list of segments over the head. */
function chooserOf(cells, { sheet, head, go, focus }, run) {
  let shown = null;

  function open(text) {
    const place = head();
    const [row, foot] = place;
    const next = { right: [row, foot + 1], left: [row, foot - 1], down: [row + 1, foot] };
    go(place);
    shown = openSegmentChooser(cells.cell(place), sheet(), place, {
      text,
      choose(name, way) {
        run(setName(sheet(), { rows: [row, row], feet: [foot, foot] }, name));
        go(nearest(sheet(), next[way] ?? place));
      },
      close(keepsFocus) {
        shown = null;
        if (!keepsFocus) focus();
      },
    });
  }
  return { open, close: () => shown?.close() ?? false };
}

/** Where a key leads, or undefined. */
function goalOf(event, { rows, legs }, [row, foot]) {
  const [lastRow, lastFoot] = [rows.length - 1, legs - 1];
  const far = event.ctrlKey || event.metaKey;
  return {
    ArrowUp: [far ? 0 : row - 1, foot],
    ArrowDown: [far ? lastRow : row + 1, foot],
    ArrowLeft: [row, far ? 0 : foot - 1],
    ArrowRight: [row, far ? lastFoot : foot + 1],
    Home: [far ? 0 : row, 0],
    End: [far ? lastRow : row, lastFoot],
    PageUp: [row - 8, foot],
    PageDown: [row + 8, foot],
  }[event.key];
}

/** What a key does to the selected cells, or undefined. */
function commandOf({ key, ctrlKey, metaKey, altKey, shiftKey }, { sheet, select }, actions, choose) {
  const selectAll = () => select([0, 0], [sheet().count - 1, sheet().legs - 1]);
  if (ctrlKey || metaKey) return { delete: actions.remove, d: actions.fill, a: selectAll }[key.toLowerCase()];
  if (key === "Insert") return shiftKey ? undefined : () => actions.insert(altKey);
  if (altKey || key === " " || key === "?") return undefined;
  if (key.length === 1) return () => choose(key);
  const begin = () => choose("");
  return { Delete: actions.wait, Backspace: actions.wait, Enter: begin, F2: begin }[key];
}

/** Selects with the pointer; a second tap on a cell and a double click choose its segment. */
function mountPointer(grid, cells, { sheet, head, go, select }, choose) {
  let dragging = false;
  let pressed = false;

  function begin(event) {
    if (event.button !== 0) return undefined;
    pressed = cells.placeOf(event.target) !== null;
    const row = cells.rowOf(event.target);
    const place = cells.placeOf(event.target) ?? (row === null ? null : [row, 0]);
    if (!place) return undefined;
    event.preventDefault();
    if (row !== null) {
      const end = [row, sheet().legs - 1];
      return event.shiftKey ? go(end, true) : select(place, end);
    }
    const again =
      event.pointerType !== "mouse"
      && place.join() === head().join()
      && document.activeElement === cells.cell(head());
    go(place, event.shiftKey);
    if (again) return choose("");
    dragging = true;
    return grid.setPointerCapture(event.pointerId);
  }

  function drag(event) {
    const place = dragging && cells.placeOf(document.elementFromPoint(event.clientX, event.clientY) ?? grid);
    if (place && place.join() !== head().join()) go(place, true);
  }

  grid.addEventListener("pointerdown", begin);
  grid.addEventListener("pointermove", drag);
  for (const end of ["pointerup", "pointercancel"])
    grid.addEventListener(end, () => {
      dragging = false;
    });
  // A double click comes from the grid, which holds the pointer.
  grid.addEventListener("dblclick", () => {
    if (pressed) choose("");
  });
}

/**
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {HTMLElement} grid
 * @param {Record<string, any>} cells see `createSegmentSheetGrid`
 */
export function mountSegmentSheetInput(store, edits, grid, cells) {
  const selection = selectionOf(store, grid, cells);
  const { sheet, range, head, go, select, show, focus } = selection;

  function run(outcome) {
    if (outcome.note) toast(outcome.note);
    if (outcome.reason) return toast(outcome.reason);
    announce(outcome.label);
    return commit(store, edits, outcome);
  }

  const actions = actionsOf(selection, run);
  const chooser = chooserOf(cells, selection, run);

  grid.addEventListener("keydown", (event) => {
    if (!sheet() || !cells.placeOf(event.target)) return;
    const goal = goalOf(event, sheet(), head());
    const act = goal
      ? () => go(nearest(sheet(), goal), event.shiftKey)
      : commandOf(event, selection, actions, chooser.open);
    if (!act) return;
    event.preventDefault();
    act();
  });
  mountPointer(grid, cells, selection, chooser.open);
  mountClipboard(grid, selection, run, ({ rows, feet }) => select([rows[0], feet[0]], [rows[1], feet[1]]));

  store.watch(
    ({ selected }) => [selected],
    () => {
      chooser.close();
      selection.reset();
    },
  );
  store.watch(
    (state) => [state.selection],
    (state) => selection.follow(state.selection),
  );

  return {
    ...actions,
    show,
    range,
    escape: chooser.close,
    hasFocus: () => grid.contains(document.activeElement),
    focus,
  };
}

/** Ctrl+C, Ctrl+X and Ctrl+V while the focus is in the grid. */
function mountClipboard(grid, { sheet, range }, run, select) {
  const inside = () =>
    sheet() && document.activeElement?.matches("[role=gridcell]") && grid.contains(document.activeElement);
  for (const type of /** @type {const} */ (["copy", "cut"])) {
    document.addEventListener(type, (event) => {
      if (!inside()) return;
      const { rows, feet } = range();
      event.clipboardData.setData(
        "text/plain",
        textOf(
          sheet()
            .rows.slice(rows[0], rows[1] + 1)
            .map((row) => row.slice(feet[0], feet[1] + 1)),
        ),
      );
      event.preventDefault();
      if (type === "cut") run(setWaits(sheet(), range()));
      else announce("Copied.");
    });
  }
  document.addEventListener("paste", (event) => {
    if (!inside()) return;
    event.preventDefault();
    const { names, reason } = namesFrom(event.clipboardData.getData("text/plain"));
    /** @type {Record<string, any>} */
    const outcome = reason ? { reason } : paste(sheet(), range(), names);
    run(outcome);
    if (outcome.range) select(outcome.range);
  });
}

/** Rows of names as lines with tabs. */
const textOf = (rows) => rows.map((row) => row.map(tableCell).join("\t")).join("\n");

/**
 * The fields of one line of CSV, also those in which nothing stands; a quoted field may hold the separator,
 * and doubled quotes.
 */
function fieldsOf(line, separator) {
  const fields = [];
  const pattern = new RegExp(`${separator}[^\\S${separator}]*(?:"((?:[^"]|"")*)"|([^${separator}]*))`, "g");
  for (const [, quoted, plain] of `${separator}${line}`.matchAll(pattern))
    fields.push((quoted === undefined ? plain : quoted.replaceAll('""', '"')).trim());
  return fields;
}

/**
 * Rows of names from text with tabs, semicolons or commas between the columns; blank lines at the end are
 * passed over.
 */
function namesFrom(text) {
  const lines = text.replace(/[\r\n]+$/, "").split(/\r\n|\r|\n/);
  if (lines.join("").trim() === "") return { reason: "The clipboard is empty: copy segments first." };
  const separator = ["\t", ";", ","].find((one) => text.includes(one)) ?? "\t";
  return { names: lines.map((line) => fieldsOf(line, separator)) };
}
