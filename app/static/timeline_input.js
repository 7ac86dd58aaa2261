/** Pointer and keyboard of the footfall timeline: toggle, paint, move the focus. One gesture is one edit. */

import { paintCells } from "./edits.js";
import { shownDocument } from "./store.js";
import { announce } from "./toasts.js";

const between = (from, to) => {
  const count = Math.abs(to - from);
  return Array.from({ length: count + 1 }, (_, index) => from + Math.sign(to - from) * index);
};

/**
 * @param {object} store
 * @param {object} edits
 * @param {HTMLElement} grid
 * @param {() => Array} rows the drawn rows, each with its `cells`
 */
export function mountTimelineInput(store, edits, grid, rows) {
  let drag = null;
  let roving = [0, 0];
  let swallowClick = false;

  const timeline = () => shownDocument(store.state).timeline;
  const isSwing = (foot, sample) => timeline().feet[foot][sample] === "0";
  const isLocked = (foot, sample) => timeline().locked?.[foot]?.[sample] === "1";

  function cellOf(target) {
    const cell = target.closest?.("[role=gridcell]");
    const foot = rows().findIndex((row) => row.cells.includes(cell));
    return foot < 0 ? null : [foot, rows()[foot].cells.indexOf(cell)];
  }

  function cellAt(x, y) {
    const parts = rows();
    const [first, last] = [parts[0].strip.getBoundingClientRect(), parts.at(-1).strip.getBoundingClientRect()];
    const foot = Math.floor(((y - first.top) / (last.bottom - first.top)) * parts.length);
    const sample = Math.floor(((x - first.left) / first.width) * parts[0].cells.length);
    const held = (value, count) => Math.min(Math.max(value, 0), count - 1);
    return [held(foot, parts.length), held(sample, parts[0].cells.length)];
  }

  function tellLocked([foot, sample]) {
    announce(`Foot ${foot + 1}, sample ${sample + 1} is locked.`);
  }

  function toggle([foot, sample]) {
    if (isLocked(foot, sample)) return tellLocked([foot, sample]);
    return edits.paint([[foot, sample]], !isSwing(foot, sample));
  }

  function moveFocus([foot, sample]) {
    const parts = rows();
    const next = [Math.min(Math.max(foot, 0), parts.length - 1), Math.min(Math.max(sample, 0), parts[0].cells.length - 1)];
    parts[roving[0]]?.cells[roving[1]]?.setAttribute("tabindex", "-1");
    roving = next;
    const cell = parts[next[0]].cells[next[1]];
    cell.setAttribute("tabindex", "0");
    return cell;
  }

  function paintTo([foot, sample]) {
    const [lastFoot, lastSample] = drag.last;
    const reached = foot === lastFoot ? between(lastSample, sample).map((one) => [foot, one]) : [[foot, sample]];
    drag.last = [foot, sample];
    let grown = false;
    for (const [row, column] of reached) {
      if (isLocked(row, column) || drag.cells.has(`${row},${column}`)) continue;
      drag.cells.set(`${row},${column}`, [row, column]);
      grown = true;
    }
    if (!grown) return;
    const [cells, swing] = [[...drag.cells.values()], drag.swing];
    store.set({ gesture: { apply: (document) => paintCells(document, cells, swing) } });
  }

  function begin(event) {
    const start = event.button === 0 ? cellOf(event.target) : null;
    if (!start) return;
    moveFocus(start);
    swallowClick = true;
    if (isLocked(...start)) return tellLocked(start);
    drag = { swing: !isSwing(...start), cells: new Map(), last: start, pointer: event.pointerId };
    grid.setPointerCapture(event.pointerId);
    return paintTo(start);
  }

  function move(event) {
    if (!drag || event.pointerId !== drag.pointer) return;
    const points = event.getCoalescedEvents?.() ?? [];
    for (const point of points.length ? points : [event]) paintTo(cellAt(point.clientX, point.clientY));
  }

  function end(commit) {
    if (!drag) return false;
    const { cells, swing, pointer } = drag;
    drag = null;
    if (grid.hasPointerCapture(pointer)) grid.releasePointerCapture(pointer);
    store.set({ gesture: null });
    const before = timeline();
    const changed = [...cells.values()].filter(([foot, sample]) => (before.feet[foot][sample] === "0") !== swing);
    if (commit && changed.length) edits.paint(changed, swing);
    return true;
  }

  function press(event) {
    const here = cellOf(event.target);
    if (!here || event.ctrlKey || event.metaKey || event.altKey) return;
    const [foot, sample] = here;
    const far = event.shiftKey ? 10 : 1;
    const goals = {
      ArrowLeft: [foot, sample - far], ArrowRight: [foot, sample + far], ArrowUp: [foot - 1, sample], ArrowDown: [foot + 1, sample],
      Home: [foot, 0], End: [foot, Infinity], PageUp: [0, sample], PageDown: [Infinity, sample],
    };
    if (goals[event.key]) moveFocus(goals[event.key]).focus();
    else if (event.key === " " || event.key === "Enter") toggle(here);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  function click(event) {
    const here = cellOf(event.target);
    const handled = swallowClick;
    swallowClick = false;
    if (here && !handled) toggle(here);
  }

  grid.addEventListener("pointerdown", begin);
  grid.addEventListener("pointermove", move);
  grid.addEventListener("pointerup", () => {
    end(true);
    setTimeout(() => { swallowClick = false; });
  });
  grid.addEventListener("pointercancel", () => end(false));
  grid.addEventListener("click", click);
  grid.addEventListener("keydown", press);

  return {
    cancelGesture: () => end(false),
    rebuilt: () => moveFocus(roving),
    focusCell: (foot, sample) => moveFocus([foot, sample]).focus(),
  };
}
