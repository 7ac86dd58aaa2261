/** The pointer on the footfall grid: one gesture is one edit. */

import { axisOf, columnFraction } from "../state/time_axis.js";
import { cellFinder, cellOf } from "./cells.js";
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
import { spanning } from "../document/region.js";
import { isSelected } from "../state/selection.js";
import { whyNotDrawn } from "../document/drawable.js";
import { shownDocument } from "../state/store.js";
import { partOf } from "../document/swings.js";
import { toast } from "../lib/toasts.js";

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

const isSwing = ({ timeline }, [foot, sample]) => timeline.feet[foot][sample] === "0";

/** Makes a cell swing or stance. */
export function toggleCell({ store, edits }, cell) {
  const document = shownDocument(store.state);
  if (isLocked(document, cell)) reportLocked(cell);
  else edits.paint([cell], !isSwing(document, cell));
}

/** Which end of a swing is held; one of a single sample is held by the half that was touched. */
function partHeld({ store, rows }, [foot, sample], x) {
  const part = partOf(shownDocument(store.state).timeline.feet[foot], sample);
  const box = rows()[foot].cells[sample].getBoundingClientRect();
  return part === "only" ? (x < box.left + box.width / 2 ? "first" : "last") : part;
}

const isForSelection = (event) => event.ctrlKey || event.metaKey;

/** The drag that a press with the tool Select begins. */
function selectDrag({ store, edits, selection }, start, copies) {
  const tap = () => selection.between(start, start);
  return isSelected(store.state, start)
    ? carrying(store, edits, start, { copies, tap })
    : selecting(selection, start);
}

/** The drag that a press with the tool Paint begins. */
function paintDrag(page, event, start) {
  const { store, edits } = page;
  const document = shownDocument(store.state);
  page.selection.clear();
  if (isLocked(document, start)) return reportLocked(start);
  return !isSwing(document, start) || event.altKey || page.brush()
    ? painting(store, edits, start)
    : moving(store, edits, start, partHeld(page, start, event.clientX));
}

/** The drag that a press begins, after the tool and the keys that are held; nothing where there is none. */
function dragOf(page, event, start, from) {
  const { store, edits, selection } = page;
  const { tool } = store.state;
  const whyNot = whyNotDrawn(shownDocument(store.state));
  if (whyNot) return isForSelection(event) || tool === "select" ? selecting(selection, start) : toast(whyNot);
  if (event.shiftKey) return locking(store, edits, start, () => selection.extendTo(start, from));
  if (isForSelection(event)) return selecting(selection, start);
  if (tool === "lock") return locking(store, edits, start);
  return tool === "select" ? selectDrag(page, start, event.altKey) : paintDrag(page, event, start);
}

function chooseRow({ selection, roving }, foot, extends_) {
  const [from] = selection.head() && extends_ ? roving.place() : [foot];
  selection.row(foot, from);
  roving.move([from, roving.place()[1]]);
}

/** A drag that leaves the shown window takes it along. */
function scrollAlong({ store, reveal }, sample) {
  const fraction = columnFraction(axisOf(store.state), sample);
  if (fraction < 0 || fraction >= 1) reveal(sample);
}

/** The course of drags; `begun` is called where a press on a cell begins one or is refused. */
function createDrags(page, begun) {
  const { store, grid, rows, roving } = page;
  let drag = null;

  function begin(event) {
    if (event.button !== 0 || drag || !shownDocument(store.state)) return;
    const label = event.target.closest?.("[role=rowheader]");
    if (label) {
      chooseRow(page, Number(label.closest("[role=row]").dataset.foot) - 1, event.shiftKey);
      return;
    }
    const start = cellOf(event.target);
    if (!start) return;
    const from = roving.place();
    roving.move(start);
    begun();
    const next = dragOf(page, event, start, from);
    if (!next) return;
    drag = { ...next, pointer: event.pointerId, cellAt: cellFinder(store, rows) };
    grid.setPointerCapture(event.pointerId);
    drag.to(start);
  }

  function move(event) {
    if (!drag || event.pointerId !== drag.pointer) return;
    const points = event.getCoalescedEvents?.() ?? [];
    for (const point of points.length ? points : [event]) drag.to(drag.cellAt(point.clientX, point.clientY));
    if (store.state.zoom) scrollAlong(page, drag.cellAt(event.clientX, event.clientY)[1]);
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

  return { begin, move, end, isOn: () => drag !== null };
}

/** What a click does to a cell, for each tool. */
const CLICKS = {
  paint: toggleCell,
  select: ({ selection }, cell) => selection.between(cell, cell),
  lock: ({ store, edits }, cell) => {
    const document = shownDocument(store.state);
    lockRegion(edits, document, spanning(cell, cell), !isLocked(document, cell));
  },
};

/**
 * Listens to the pointer.
 * @param {Record<string, any>} page `store`, `edits`, `grid`, `rows`, `reveal`, `selection` and `roving`
 * @returns {{cancel: () => boolean, isOn: () => boolean}} of the drag under way
 */
export function mountTimelinePointer(page) {
  const { store, grid, selection, roving } = page;
  let swallowClick = false;
  const drags = createDrags({ ...page, brush: heldBrush() }, () => {
    grid.dataset.pointed = "";
    swallowClick = true;
  });

  grid.addEventListener("pointerdown", drags.begin);
  grid.addEventListener("pointermove", drags.move);
  grid.addEventListener("pointerup", () => {
    drags.end(true);
    setTimeout(() => {
      swallowClick = false;
    });
  });
  grid.addEventListener("pointercancel", () => drags.end(false));
  // A click without a pointer, as assistive tools send them; a mouse click is a gesture of no length.
  grid.addEventListener("click", (event) => {
    const here = cellOf(event.target);
    if (here && !swallowClick) CLICKS[store.state.tool](page, here);
    swallowClick = false;
  });
  // A double click comes from the grid, which holds the pointer; the cell under it has the focus by then.
  grid.addEventListener("dblclick", (event) => {
    const isOnLabel = event.target.closest("[role=rowheader]");
    if (!isOnLabel && (store.state.tool === "select" || isForSelection(event)))
      selection.swing(roving.place());
  });
  return { cancel: () => drags.end(false), isOn: drags.isOn };
}
