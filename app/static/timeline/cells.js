/** Cells of the footfall grid: which one an element or a place on the screen is, which one has the focus. */

import { clamp } from "../lib/clamp.js";
import { axisOf, columnAt } from "../state/time_axis.js";

/**
 * The nearest cell on a timeline.
 * @returns {[number, number]}
 */
export const nearestCell = ([foot, sample], feet, samples) => [
  clamp(foot, 0, feet - 1),
  clamp(sample, 0, samples - 1),
];

/**
 * The cell that an element belongs to, as [foot, sample], or null.
 * @returns {[number, number]|null}
 */
export const cellOf = (target) => {
  const cell = target.closest?.("[role=gridcell]");
  return cell
    ? [Number(cell.closest("[role=row]").dataset.foot) - 1, Number(cell.getAttribute("aria-colindex")) - 1]
    : null;
};

/** The cell under the focus: one of all cells is reached by Tab, the arrows move on from there. */
export function rovingFocus(rows, reveal) {
  /** @type {[number, number]} */
  let place = [0, 0];
  function move(cell) {
    const parts = rows();
    const next = nearestCell(cell, parts.length, parts[0].cells.length);
    parts[place[0]]?.cells[place[1]]?.setAttribute("tabindex", "-1");
    place = next;
    const element = parts[next[0]].cells[next[1]];
    element.setAttribute("tabindex", "0");
    return element;
  }
  return {
    move,
    place: () => place,
    focus(cell) {
      move(cell);
      reveal(place[1]);
      rows()[place[0]].cells[place[1]].focus({ preventScroll: true });
      return place;
    },
  };
}

/** Turns places on the screen into cells; measured once a drag, so that no move asks for the layout. */
export function cellFinder(store, rows) {
  const parts = rows();
  const [first, last] = [parts[0], parts.at(-1)].map(({ strip }) =>
    strip.parentElement.getBoundingClientRect(),
  );
  return (x, y) => {
    const axis = axisOf(store.state);
    const foot = Math.floor(((y - first.top) / (last.bottom - first.top)) * parts.length);
    return nearestCell([foot, columnAt(axis, (x - first.left) / first.width)], parts.length, axis.samples);
  };
}

/** Where the next border between stance and swing lies on a row, from a sample on. */
export function nextBorder(row, sample, way) {
  for (let at = sample + way; at > 0 && at < row.length - 1; at += way)
    if (row[at] !== row[at - way]) return at;
  return way > 0 ? row.length - 1 : 0;
}
