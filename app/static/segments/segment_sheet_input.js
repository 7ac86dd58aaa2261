/**
 * Keyboard, pointer, clipboard and selection of the segment table. The selection is the timeline's: its samples are those of the
 * selected segments.
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

const ordered = (a, b) => [Math.min(a, b), Math.max(a, b)];
const nearest = ({ rows, legs }, [row, foot]) => [clamp(row, 0, rows.length - 1), clamp(foot, 0, legs - 1)];

/**
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} edits
 * @param {HTMLElement} grid
 * @param {Record<string, any>} cells see `createSegmentSheetGrid`
 */
export function mountSegmentSheetInput(store, edits, grid, cells) {
  let [anchor, head] = [
    [0, 0],
    [0, 0],
  ];
  let own = null;
  let chooser = null;
  let dragging = false;
  let pressed = false;
  const sheet = () => shownSegmentSheet(store.state);
  const range = () => ({ rows: ordered(anchor[0], head[0]), feet: ordered(anchor[1], head[1]) });

  /** Marks the cells, and puts the focus's tab stop on the head. */
  function show() {
    const now = sheet();
    if (!now) return;
    [anchor, head] = [anchor, head].map((place) => nearest(now, place));
    cells.select(range());
    grid.querySelector('[tabindex="0"]')?.setAttribute("tabindex", "-1");
    cells.cell(head)?.setAttribute("tabindex", "0");
  }

  /** Puts the focus on the head, and scrolls no further than needed. */
  function takeFocus() {
    const cell = cells.cell(head);
    cell?.focus({ preventScroll: true });
    cell?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** Selects from the anchor to a cell, here and on the timeline. */
  function go(place, extend = false, focus = true) {
    head = place;
    if (!extend) anchor = place;
    show();
    const { rows, feet } = range();
    const samples = samplesOf(sheet(), rows);
    own = samples && { feet, samples };
    store.set({ selection: own });
    if (focus) takeFocus();
  }

  function run(outcome) {
    if (outcome.note) toast(outcome.note);
    if (outcome.reason) return toast(outcome.reason);
    announce(outcome.label);
    return commit(store, edits, outcome);
  }

  const actions = {
    fill: () => run(fillDown(sheet(), range())),
    wait: () => run(setWaits(sheet(), range())),
    addLink: () => run(addLinkRow(sheet())),
    insert(above = false) {
      const [first, last] = range().rows;
      const after = above ? first - 1 : last;
      const outcome = insertRow(sheet(), after, (above ? first : last) >= sheet().count);
      run(outcome);
      if (!outcome.reason) go([after + 1, head[1]]);
    },
    remove() {
      const { rows } = range();
      const outcome = removeRows(sheet(), rows);
      run(outcome);
      if (!outcome.reason) go(nearest(sheet(), [rows[0], head[1]]));
    },
  };

  function choose(text) {
    const place = head;
    const chosen = { rows: [place[0], place[0]], feet: [place[1], place[1]] };
    const next = {
      right: [place[0], place[1] + 1],
      left: [place[0], place[1] - 1],
      down: [place[0] + 1, place[1]],
    };
    go(place);
    chooser = openSegmentChooser(cells.cell(place), sheet(), place, {
      text,
      choose(name, way) {
        run(setName(sheet(), chosen, name));
        go(nearest(sheet(), next[way] ?? place));
      },
      close(keepsFocus) {
        chooser = null;
        if (!keepsFocus) takeFocus();
      },
    });
  }

  function goalOf(event) {
    const [row, foot] = head;
    const [lastRow, lastFoot] = [sheet().rows.length - 1, sheet().legs - 1];
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

  function commandOf({ key, ctrlKey, metaKey, altKey, shiftKey }) {
    const control = ctrlKey || metaKey;
    if (control && key === "Delete") return actions.remove;
    if (control && key.toLowerCase() === "d") return actions.fill;
    if (control && key.toLowerCase() === "a")
      return () => {
        anchor = [0, 0];
        go([sheet().count - 1, sheet().legs - 1], true);
      };
    if (control) return null;
    if (key === "Insert") return shiftKey ? null : () => actions.insert(altKey);
    if (altKey) return null;
    if (key === "Delete" || key === "Backspace") return actions.wait;
    if (key === "Enter" || key === "F2") return () => choose("");
    return key.length === 1 && key !== " " && key !== "?" ? () => choose(key) : null;
  }

  function press(event) {
    if (!sheet() || !cells.placeOf(event.target)) return;
    const goal = goalOf(event);
    const act = goal ? () => go(nearest(sheet(), goal), event.shiftKey) : commandOf(event);
    if (!act) return;
    event.preventDefault();
    act();
  }

  function begin(event) {
    if (event.button !== 0) return undefined;
    pressed = cells.placeOf(event.target) !== null;
    const row = cells.rowOf(event.target);
    const place = cells.placeOf(event.target) ?? (row === null ? null : [row, 0]);
    if (!place) return undefined;
    event.preventDefault();
    if (row !== null) {
      if (!event.shiftKey) anchor = [row, 0];
      return go([row, sheet().legs - 1], true);
    }
    const again =
      event.pointerType !== "mouse"
      && place.join() === head.join()
      && document.activeElement === cells.cell(head);
    go(place, event.shiftKey);
    if (again) return choose("");
    dragging = true;
    return grid.setPointerCapture(event.pointerId);
  }

  function drag(event) {
    const place = dragging && cells.placeOf(document.elementFromPoint(event.clientX, event.clientY) ?? grid);
    if (place && place.join() !== head.join()) go(place, true);
  }

  grid.addEventListener("keydown", press);
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
  mountClipboard(grid, sheet, range, run, (filled) => {
    anchor = [filled.rows[0], filled.feet[0]];
    go([filled.rows[1], filled.feet[1]], true);
  });

  store.watch(
    ({ selected }) => [selected],
    () => {
      chooser?.close();
      [anchor, head, own] = [[0, 0], [0, 0], null];
    },
  );
  store.watch(
    (state) => [state.selection],
    ({ selection }) => {
      const now = sheet();
      if (!now || selection === own) return;
      own = selection;
      const rows = selection && rowsOf(now, selection.samples);
      if (rows)
        [anchor, head] = [
          [rows[0], selection.feet[0]],
          [rows[1], Math.min(selection.feet[1], now.legs - 1)],
        ];
      else anchor = head;
      show();
    },
  );

  return {
    ...actions,
    show,
    range,
    escape: () => chooser?.close() ?? false,
    hasFocus: () => grid.contains(document.activeElement),
    focus: takeFocus,
  };
}

/** Ctrl+C, Ctrl+X and Ctrl+V while the focus is in the grid. */
function mountClipboard(grid, sheet, range, run, select) {
  const inside = () =>
    sheet() && document.activeElement?.matches("[role=gridcell]") && grid.contains(document.activeElement);
  for (const type of ["copy", "cut"]) {
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
    const outcome = reason ? { reason } : paste(sheet(), range(), names);
    run(outcome);
    if (outcome.range) select(outcome.range);
  });
}

/** Rows of names as lines with tabs. */
const textOf = (rows) => rows.map((row) => row.map(tableCell).join("\t")).join("\n");

/** The fields of one line of CSV, also those in which nothing stands; a quoted field may hold the separator, and doubled quotes. */
function fieldsOf(line, separator) {
  const fields = [];
  const pattern = new RegExp(`${separator}[^\\S${separator}]*(?:"((?:[^"]|"")*)"|([^${separator}]*))`, "g");
  for (const [, quoted, plain] of `${separator}${line}`.matchAll(pattern))
    fields.push((quoted === undefined ? plain : quoted.replaceAll('""', '"')).trim());
  return fields;
}

/** Rows of names from text with tabs, semicolons or commas between the columns; blank lines at the end are passed over. */
function namesFrom(text) {
  const lines = text.replace(/[\r\n]+$/, "").split(/\r\n|\r|\n/);
  if (lines.join("").trim() === "") return { reason: "The clipboard is empty: copy segments first." };
  const separator = ["\t", ";", ","].find((one) => text.includes(one)) ?? "\t";
  return { names: lines.map((line) => fieldsOf(line, separator)) };
}
