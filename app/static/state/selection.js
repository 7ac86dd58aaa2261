/**
 * The selection of the timeline: a rectangle of feet and samples in the store's field `selection`, or null.
 *
 * `{feet: [first, last], samples: [first, last]}`, 0-based, both ends included. Whoever sets it (the segment
 * table too) gives whole numbers on the timeline; what lies outside of it is cut here.
 */

import { axisKey, axisOf, columnFraction } from "./time_axis.js";
import { h } from "../lib/dom.js";
import { hasCell, spanning, within, wholeOf } from "../document/region.js";
import { previewedDocument, shownDocument } from "./store.js";
import { swingAt } from "../document/swings.js";

/**
 * @typedef {import("./store.js").State} State
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("../document/region.js").Region} Region
 */

/** The selected region of the shown document, or null. @param {State} state @returns {Region|null} */
export const selectedRegion = (state) => {
  const document = shownDocument(state);
  return document && within(document, state.selection);
};

/**
 * Choosing with a fixed corner: the anchor stays while the other corner moves. Cells are [foot, sample].
 * @param {Store} store
 */
export function createSelecting(store) {
  /** @type {{anchor: number[], head: number[], selection: Region}|null} */
  let corners = null;
  const document = () => shownDocument(store.state);
  const set = (/** @type {Region|null} */ selection) => store.set({ selection });
  /** @param {number[]} anchor @param {number[]} head */
  const between = (anchor, head) => {
    corners = { anchor, head, selection: spanning(anchor, head) };
    set(corners.selection);
  };
  /** @param {number[]} cell */
  const anchorFor = (cell) =>
    corners && corners.selection === store.state.selection ? corners.anchor : cell;

  return {
    /**
     * From the anchor to a cell; `from` becomes the anchor where there is none.
     * @param {number[]} cell
     * @param {number[]} from
     */
    extendTo: (cell, from) => between(store.state.selection ? anchorFor(from) : from, cell),
    /** The corner that moves; null where nothing was chosen with a fixed corner. */
    head: () => (corners && corners.selection === store.state.selection ? corners.head : null),
    between,
    /** @param {number} foot @param {number} [from] */
    row: (foot, from = foot) => between([from, 0], [foot, document().timeline.feet[0].length - 1]),
    all: () => set(wholeOf(document())),
    /** The swing around a cell; false in stance. @param {number[]} cell */
    swing: ([foot, sample]) => {
      const swing = swingAt(document().timeline.feet[foot], sample);
      if (swing) between([foot, swing.first], [foot, swing.last]);
      return swing !== null;
    },
    clear: () => {
      if (!store.state.selection) return false;
      set(null);
      return true;
    },
  };
}

/** @param {HTMLElement} box @param {State} state @param {Region|null} region */
function placeBox(box, state, region) {
  box.hidden = !region;
  if (!region) return;
  const [axis, { timeline }] = [axisOf(state), previewedDocument(state)];
  const rows = timeline.feet.length;
  const [left, right] = [region.samples[0], region.samples[1] + 1].map((column) =>
    columnFraction(axis, column),
  );
  box.style.left = `${100 * left}%`;
  box.style.width = `${100 * (right - left)}%`;
  box.style.top = `${(100 * region.feet[0]) / rows}%`;
  box.style.height = `${(100 * (region.feet[1] - region.feet[0] + 1)) / rows}%`;
}

/**
 * Shows the selection: `aria-selected` on its cells and a frame around them.
 * @param {Store} store
 * @param {HTMLElement} marks
 * @param {() => {cells: HTMLElement[]}[]} rows
 */
export function mountSelection(store, marks, rows) {
  const box = h("div", { class: "selection-box", hidden: true });
  marks.append(box);
  /** @type {Set<HTMLElement>} */
  let marked = new Set();

  /** @param {Region|null} region */
  function mark(region) {
    /** @type {Set<HTMLElement>} */
    const now = new Set();
    for (const [foot, { cells }] of rows().entries()) {
      if (!region || foot < region.feet[0] || foot > region.feet[1]) continue;
      cells.slice(region.samples[0], region.samples[1] + 1).forEach((cell) => now.add(cell));
    }
    for (const cell of marked) if (!now.has(cell)) cell.setAttribute("aria-selected", "false");
    for (const cell of now) if (!marked.has(cell)) cell.setAttribute("aria-selected", "true");
    marked = now;
  }

  store.watch(
    (state) => [state.selection, state.view, state.pending, axisKey(state)],
    (state) => {
      const region = selectedRegion(state);
      mark(region);
      placeBox(box, state, region);
    },
  );
}

/** Whether a cell is selected. @param {State} state @param {number[]} cell */
export function isSelected(state, cell) {
  const region = selectedRegion(state);
  return region !== null && hasCell(region, cell);
}
