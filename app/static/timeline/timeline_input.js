/**
 * Pointer and keyboard of the footfall timeline. One gesture is one edit.
 *
 * A plain drag does what the chosen tool does: Paint (swings are moved, stance is painted; with Alt or the key B
 * everything is painted), Select or Lock. In every tool Shift locks, and Ctrl selects. The keyboard moves the focus,
 * with Shift it selects.
 */

import { axisOf, columnFraction } from "../state/time_axis.js";
import { cellFinder, cellOf, nearestCell, nextBorder, rovingFocus } from "./cells.js";
import {
  carrying,
  isLocked,
  locking,
  lockRegion,
  moving,
  painting,
  selecting,
  reportLocked,
} from "./drags.js";
import { spanning, regionText } from "../document/region.js";
import { createSelecting, isSelected } from "../state/selection.js";
import { whyNotDrawn } from "../document/drawable.js";
import { shownDocument } from "../state/store.js";
import { partOf } from "../document/swings.js";
import { announce, toast } from "../lib/toasts.js";

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

/** Whether the focused cell was reached by keyboard: after a pointer gesture Space plays, and changes no cell. */
const byKeyboard = (grid) => grid.dataset.pointed === undefined;

/** Whether the key B is held. */
function heldBrush() {
  let held = false;
  window.addEventListener("keydown", (event) => {
    if (event.key.toLowerCase() === "b") held = !event.ctrlKey && !event.metaKey;
  });
  window.addEventListener("keyup", (event) => {
    if (event.key.toLowerCase() === "b") held = false;
  });
  window.addEventListener("blur", () => {
    held = false;
  });
  return () => held;
}

/**
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} edits
 * @param {HTMLElement} grid
 * @param {() => Array} rows the drawn rows, each with its `cells`
 * @param {(sample: number) => void} reveal brings a sample into the shown window
 */
export function mountTimelineInput(store, edits, grid, rows, reveal) {
  let drag = null;
  let swallowClick = false;
  const selection = createSelecting(store);
  const roving = rovingFocus(rows, reveal);
  const brush = heldBrush();
  const document = () => shownDocument(store.state);
  const isSwing = ([foot, sample]) => document().timeline.feet[foot][sample] === "0";

  function toggle(cell) {
    if (isLocked(document(), cell)) reportLocked(cell);
    else edits.paint([cell], !isSwing(cell));
  }

  /** Which end of a swing is held; one of a single sample is held by the half that was touched. */
  function partHeld([foot, sample], x) {
    const part = partOf(document().timeline.feet[foot], sample);
    const box = rows()[foot].cells[sample].getBoundingClientRect();
    return part === "only" ? (x < box.left + box.width / 2 ? "first" : "last") : part;
  }

  function dragOf(event, start, from) {
    const { tool } = store.state;
    const whyNot = whyNotDrawn(document());
    if (whyNot)
      return event.ctrlKey || event.metaKey || tool === "select"
        ? selecting(selection, start)
        : toast(whyNot);
    if (event.shiftKey) return locking(store, edits, start, () => selection.extendTo(start, from));
    if (event.ctrlKey || event.metaKey) return selecting(selection, start);
    if (tool === "lock") return locking(store, edits, start);
    if (tool === "select") {
      const tap = () => selection.between(start, start);
      return isSelected(store.state, start)
        ? carrying(store, edits, start, { copies: event.altKey, tap })
        : selecting(selection, start);
    }
    selection.clear();
    if (isLocked(document(), start)) return reportLocked(start);
    return !isSwing(start) || event.altKey || brush()
      ? painting(store, edits, start)
      : moving(store, edits, start, partHeld(start, event.clientX));
  }

  function begin(event) {
    if (event.button !== 0 || drag || !document()) return;
    const label = event.target.closest?.("[role=rowheader]");
    if (label) return chooseRow(Number(label.closest("[role=row]").dataset.foot) - 1, event.shiftKey);
    const start = cellOf(event.target);
    if (!start) return;
    const from = roving.place();
    roving.move(start);
    grid.dataset.pointed = "";
    swallowClick = true;
    const begun = dragOf(event, start, from);
    if (!begun) return;
    drag = { ...begun, pointer: event.pointerId, cellAt: cellFinder(store, rows) };
    grid.setPointerCapture(event.pointerId);
    drag.to(start);
  }

  function move(event) {
    if (!drag || event.pointerId !== drag.pointer) return;
    const points = event.getCoalescedEvents?.() ?? [];
    for (const point of points.length ? points : [event]) drag.to(drag.cellAt(point.clientX, point.clientY));
    if (store.state.zoom) scrollAlong(drag.cellAt(event.clientX, event.clientY)[1]);
  }

  /** A drag that leaves the shown window takes it along. */
  function scrollAlong(sample) {
    const fraction = columnFraction(axisOf(store.state), sample);
    if (fraction < 0 || fraction >= 1) reveal(sample);
  }

  function end(commit) {
    if (!drag) return false;
    const done = drag;
    drag = null;
    if (grid.hasPointerCapture(done.pointer)) grid.releasePointerCapture(done.pointer);
    store.set({ gesture: null });
    if (commit) done.commit();
    else done.drop?.();
    return true;
  }

  function chooseRow(foot, extends_) {
    const [from] = selection.head() && extends_ ? roving.place() : [foot];
    selection.row(foot, from);
    roving.move([from, roving.place()[1]]);
  }

  function goalOf(event, [foot, sample]) {
    const row = document().timeline.feet[foot];
    const border = event.ctrlKey || event.metaKey;
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

  function act(event, here) {
    if (event.key === " " && event.shiftKey) return () => selection.row(here[0]);
    if (event.ctrlKey || event.metaKey) return null;
    return byKeyboard(grid) && (event.key === " " || event.key === "Enter") ? () => toggle(here) : null;
  }

  function press(event) {
    const here = cellOf(event.target);
    if (!here || event.altKey) return;
    const head = event.shiftKey ? (selection.head() ?? here) : here;
    const goal = goalOf(event, head);
    const does =
      goal === null
        ? act(event, here)
        : event.shiftKey
          ? () =>
              extendTo(
                nearestCell(goal, document().timeline.feet.length, document().timeline.feet[0].length),
                here,
              )
          : () => {
              selection.clear();
              delete grid.dataset.pointed;
              roving.focus(goal);
            };
    if (!does) return;
    does();
    event.preventDefault();
    event.stopPropagation();
  }

  function extendTo(cell, from) {
    selection.extendTo(cell, from);
    reveal(cell[1]);
    announce(`Selected: ${regionText(document(), store.state.selection)}.`);
  }

  /** A click without a pointer, as assistive tools send them; a mouse click is a gesture of no length. */
  function clickWithoutPointer(event) {
    const here = cellOf(event.target);
    if (here && !swallowClick)
      ({
        paint: toggle,
        select: (cell) => selection.between(cell, cell),
        lock: (cell) => lockRegion(edits, document(), spanning(cell, cell), !isLocked(document(), cell)),
      })[store.state.tool](here);
    swallowClick = false;
  }

  /** A double click comes from the grid, which holds the pointer; the cell under it has the focus by then. */
  function takeSwing(event) {
    if (
      !event.target.closest("[role=rowheader]")
      && (store.state.tool === "select" || event.ctrlKey || event.metaKey)
    )
      selection.swing(roving.place());
  }

  function explain(event) {
    const here = cellOf(event.target);
    if (!here || drag || !document()) return;
    const { cells, words } = rows()[here[0]];
    const part = partOf(document().timeline.feet[here[0]], here[1]);
    const help = whyNotDrawn(document()) ?? helpOf(store.state.tool, part, isLocked(document(), here));
    cells[here[1]].title = [words[here[1]], help].filter(Boolean).join(" ");
  }

  grid.addEventListener("pointerdown", begin);
  grid.addEventListener("pointermove", move);
  grid.addEventListener("pointerup", () => {
    end(true);
    setTimeout(() => {
      swallowClick = false;
    });
  });
  grid.addEventListener("pointercancel", () => end(false));
  grid.addEventListener("pointerover", explain);
  grid.addEventListener("click", clickWithoutPointer);
  grid.addEventListener("dblclick", takeSwing);
  grid.addEventListener("keydown", press);
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

  return {
    cancelGesture: () => end(false),
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
