/**
 * Pointer and keyboard of the footfall timeline. One gesture is one edit.
 *
 * A plain drag does what the chosen tool does: Paint (swings are moved, stance is painted; with Alt or the
 * key B everything is painted), Select or Lock. In every tool Shift locks, and Ctrl selects. The keyboard
 * moves the focus, with Shift it selects.
 */

import { cellOf, nearestCell, nextBorder, rovingFocus } from "./cells.js";
import { isLocked } from "./drags.js";
import { mountTimelinePointer, toggleCell } from "./timeline_pointer.js";
import { regionText } from "../document/region.js";
import { createSelecting } from "../state/selection.js";
import { whyNotDrawn } from "../document/drawable.js";
import { shownDocument } from "../state/store.js";
import { partOf } from "../document/swings.js";
import { announce } from "../lib/toasts.js";

const PAINTS = "Hold Alt or B and drag to paint.";
const ELSEWHERE = "Drag with Shift to lock cells. Drag with Ctrl to select cells.";
const PAINT_HELP = {
  stance: `Click to change this cell to swing. Drag to paint cells. ${ELSEWHERE}`,
  middle: `Drag to move the swing. Click to change this cell to stance. ${PAINTS}`,
  end: `Drag to move this end of the swing. Click to change this cell to stance. ${PAINTS}`,
  locked: "This cell is locked. To unlock cells, drag from here with Shift.",
};
const TOOL_HELP = {
  select:
    "Drag to select cells. Double-click to select a swing. "
    + "Drag selected cells to move them. Drag selected cells with Alt to copy them.",
  lock: "Drag to lock cells. To unlock cells, start the drag on a locked cell.",
};

function helpOf(tool, part, fixed) {
  return (
    TOOL_HELP[tool]
    ?? PAINT_HELP[fixed ? "locked" : part === null ? "stance" : part === "middle" ? "middle" : "end"]
  );
}

/** Says in the title of the cell under the pointer what can be done there. */
function explain({ store, rows }, [foot, sample]) {
  const document = shownDocument(store.state);
  const { cells, words } = rows()[foot];
  const part = partOf(document.timeline.feet[foot], sample);
  const help = whyNotDrawn(document) ?? helpOf(store.state.tool, part, isLocked(document, [foot, sample]));
  cells[sample].title = [words[sample], help].filter(Boolean).join(" ");
}

/** Whether the focused cell was reached by keyboard: after a gesture Space plays, and changes no cell. */
const byKeyboard = (grid) => grid.dataset.pointed === undefined;

/** The cell that a key leads to, perhaps beside the timeline; null where it leads nowhere. */
function goalOf(event, [foot, sample], { feet }) {
  const row = feet[foot];
  const border = event.ctrlKey || event.metaKey;
  /** @type {Record<string, [number, number]>} */
  const goals = {
    ArrowLeft: [foot, border ? nextBorder(row, sample, -1) : sample - 1],
    ArrowRight: [foot, border ? nextBorder(row, sample, 1) : sample + 1],
    ArrowUp: [foot - 1, sample],
    ArrowDown: [foot + 1, sample],
    Home: [border ? 0 : foot, 0],
    End: [border ? Infinity : foot, Infinity],
    PageUp: [0, sample],
    PageDown: [Infinity, sample],
  };
  return goals[event.key] ?? null;
}

function extendTo({ store, selection, reveal }, cell, from) {
  selection.extendTo(cell, from);
  reveal(cell[1]);
  announce(`Selected: ${regionText(shownDocument(store.state), store.state.selection)}.`);
}

/** What a key does that leads to no other cell; null for nothing. */
function actOf(page, event, here) {
  if (event.key === " " && event.shiftKey) return () => page.selection.row(here[0]);
  if (event.ctrlKey || event.metaKey) return null;
  const isPress = event.key === " " || event.key === "Enter";
  return byKeyboard(page.grid) && isPress ? () => toggleCell(page, here) : null;
}

/** What a key does on a cell; null for nothing. */
function keyAct(page, event, here) {
  const { store, grid, selection, roving } = page;
  const { timeline } = shownDocument(store.state);
  const head = event.shiftKey ? (selection.head() ?? here) : here;
  const goal = goalOf(event, head, timeline);
  if (goal === null) return actOf(page, event, here);
  if (event.shiftKey)
    return () => extendTo(page, nearestCell(goal, timeline.feet.length, timeline.feet[0].length), here);
  return () => {
    selection.clear();
    delete grid.dataset.pointed;
    roving.focus(goal);
  };
}

function mountKeyboard(page) {
  const { grid, roving } = page;
  grid.addEventListener("keydown", (event) => {
    const here = cellOf(event.target);
    if (!here || event.altKey) return;
    const does = keyAct(page, event, here);
    if (!does) return;
    does();
    event.preventDefault();
    event.stopPropagation();
  });
  window.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Tab") delete grid.dataset.pointed;
    },
    true,
  );
  grid.addEventListener("focusin", (event) => {
    if (cellOf(event.target)) roving.move(cellOf(event.target));
  });
}

/**
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {HTMLElement} grid
 * @param {() => Array} rows the drawn rows, each with its `cells`
 * @param {(sample: number) => void} reveal brings a sample into the shown window
 */
export function mountTimelineInput(store, edits, grid, rows, reveal) {
  const selection = createSelecting(store);
  const roving = rovingFocus(rows, reveal);
  const page = { store, edits, grid, rows, reveal, selection, roving };
  const pointer = mountTimelinePointer(page);
  mountKeyboard(page);
  grid.addEventListener("pointerover", (event) => {
    const here = cellOf(event.target);
    if (here && !pointer.isOn() && shownDocument(store.state)) explain(page, here);
  });
  return {
    cancelGesture: pointer.cancel,
    clearSelection: () => selection.clear(),
    selectAll: () => selection.all(),
    focused: () => roving.place(),
    /** The cells are others now; `focused` says that one of them had the focus. */
    rebuilt: (focused) => {
      const cell = roving.move(roving.place());
      if (focused) cell.focus({ preventScroll: true });
    },
    focusCell: (foot, sample) => roving.focus([foot, sample]),
  };
}
