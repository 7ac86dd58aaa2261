/** Outlines around the phases of a drawing that miss a limit, each with a flag that says why. */

import { missingPhases, shortWords } from "../document/missing_motion.js";
import { h, setText } from "../lib/dom.js";
import { shownPlan } from "../state/store.js";
import { axisKey, axisOf, columnFraction } from "../state/time_axis.js";

/** Room of a flag beside its words, between two flags, and of a flag that is a mark alone, px. */
const PADDING = 14;
const GAP = 2;
const MARK = 16;

/**
 * Where flags stand over their phases so that none lies on another or is cut.
 * @param {{left: number, right: number, width: number, short: number}[]} phases in view, in their order:
 *   borders, and the width of the flag with all its words and with the short ones, px
 * @param {number} total width of the window, px
 * @returns {{left: number, width: number}[]} as wide as all words, the short ones, or a mark
 */
export function flagPlaces(phases, total) {
  let free = 0;
  return phases.map(({ left, width, short }, index) => {
    const next = phases[index + 1];
    const end = next ? Math.max(Math.min(next.left, total) - GAP, free) : total;
    const start = Math.max(free, Math.min(Math.max(left, 0), end - width));
    const room = end - start;
    const own = [width, short].find((wide) => wide <= room) ?? MARK;
    const at = Math.max(free, Math.min(Math.max(left, 0), end - own));
    const place = { left: Math.max(Math.min(at, total - own), 0), width: own };
    free = place.left + place.width + GAP;
    return place;
  });
}

/** Measures words in the flags' type, without the layout of the page. */
function measurer() {
  const pen = document.createElement("canvas").getContext("2d");
  const known = new Map();
  return (words) => {
    if (!known.has(words)) {
      pen.font = `600 11px ${getComputedStyle(document.body).fontFamily}`;
      known.set(words, Math.ceil(pen.measureText(words).width) + PADDING);
    }
    return known.get(words);
  };
}

function build(marks) {
  const [box, flag] = [
    h("div", { class: "phase-box", hidden: true }),
    h("div", { class: "phase-flag", hidden: true }),
  ];
  marks.append(box, flag);
  return { box, flag };
}

/** Where a phase lies on the window, px; null where it is out of sight. */
function placeOn(axis, width, { first, last, words }, widthOf) {
  const short = shortWords(words);
  const [left, right] = [first, last + 1].map(
    (column) => columnFraction(axis, Math.min(column, axis.samples)) * width,
  );
  return right <= left || right <= 0 || left >= width
    ? null
    : { left, right, words, short: widthOf(short), width: widthOf(words), shortWords: short };
}

function span({ style }, left, width) {
  const [from, wide] = [left, width].map((value) => `${value.toFixed(1)}px`);
  if (style.left !== from) style.left = from;
  if (style.width !== wide) style.width = wide;
}

function show({ box, flag }, phase, place) {
  box.hidden = flag.hidden = !phase;
  if (!phase) return;
  span(box, phase.left, phase.right - phase.left);
  span(flag, place.left, place.width);
  const words = new Map([
    [phase.short, phase.shortWords],
    [phase.width, phase.words],
  ]);
  setText(flag, words.get(place.width) ?? "!");
}

/** Keeps outlines and flags current; `marks` lies over the cells. */
export function mountPhaseFlags(store, marks) {
  const widthOf = measurer();
  const parts = [];
  let [width, phases] = [0, []];

  function place() {
    const axis = axisOf(store.state);
    const inView = phases.map((phase) => placeOn(axis, width, phase, widthOf)).filter(Boolean);
    const places = flagPlaces(inView, width);
    while (parts.length < inView.length) parts.push(build(marks));
    parts.forEach((part, index) => show(part, inView[index], places[index]));
  }

  store.watch(
    (state) => [shownPlan(state)?.live?.lacks],
    (state) => {
      phases = missingPhases(shownPlan(state));
      if (phases.length || parts.length) place();
    },
  );
  store.watch(
    (state) => [axisKey(state)],
    () => {
      if (phases.length) place();
    },
  );
  new ResizeObserver(([{ contentRect }]) => {
    width = contentRect.width;
    if (phases.length) place();
  }).observe(marks);
}
