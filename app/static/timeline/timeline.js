/** The footfall timeline: an ARIA grid, a row per foot, a cell per sample. */

import { missingMotionByCell } from "../document/missing_motion.js";
import { byId, h, icon } from "../lib/dom.js";
import { mountSelection } from "../state/selection.js";
import { isRefusedDrawing } from "../state/live_plan.js";
import { previewedDocument, shownDocument, shownPlan } from "../state/store.js";
import { axisKey, axisOf } from "../state/time_axis.js";
import { mountPhaseFlags } from "./phase_flags.js";
import { mountRuler } from "./ruler.js";
import { drawBars } from "./swing_bars.js";
import { mountTimelineInput } from "./timeline_input.js";
import { buildRow, DENSE, drawRow, findingsByCell, fitRow } from "./timeline_rows.js";

/** The notice on an edit that a person has read and sent away. */
let dismissed = null;

/** What the studio refuses of the shown plan, as a sentence; nothing where the page says it elsewhere. */
function planRefusal(state) {
  const plan = shownPlan(state);
  // An adapted motion may be out of reach; its search says whether the gait is. Of a drawing and of a
  // recording the inspector says why.
  const isSaid =
    plan?.live?.status === "infeasible"
    || plan?.source === "adapted"
    || plan?.misfit
    || isRefusedDrawing(state);
  return isSaid ? null : plan?.refusal?.sentence;
}

const dismissButton = (dismiss) =>
  h(
    "button",
    { class: "plain icon-only", "aria-label": "Dismiss the note", on: { click: dismiss } },
    icon("close"),
  );

function showNote(store, edits) {
  const note = byId("edit-note");
  const { refused, view } = store.state;
  const refusal = planRefusal(store.state);
  const notice = view?.notice === dismissed ? null : view?.notice;
  const sentence = refused ?? refusal ?? notice ?? null;
  if (!sentence) return note.replaceChildren();
  const dismiss = () => {
    dismissed = view.notice;
    showNote(store, edits);
  };
  const text = h("p", {
    text: refused ? `Not accepted: ${refused}` : sentence,
    title: sentence,
    data: { toneText: refused || refusal ? "bad" : "caution" },
  });
  return note.replaceChildren(
    text,
    ...(refused ? [h("button", { text: "Take it back", on: { click: () => edits.takeBack() } })] : []),
    ...(sentence === notice ? [dismissButton(dismiss)] : []),
  );
}

/** Gives back what a function made of a value the last time, as long as the value is the same. */
function memoised(make) {
  let last = [];
  return (value) => {
    if (last.length === 0 || !Object.is(last[0], value)) last = [value, make(value)];
    return last[1];
  };
}

/**
 * What is drawn: `parts` (rows) and `marks` (the layer over them) of `grid`; the window is `width` px wide.
 * @typedef {{grid: HTMLElement, marks: HTMLElement, width: number,
 *   parts: ReturnType<typeof buildRow>[]}} Drawn
 */

/**
 * Gives the grid as many rows and cells as a gait has.
 * @param {Drawn} drawn
 */
function fit(drawn, feet, samples) {
  const { grid, marks } = drawn;
  if (drawn.parts.length !== feet) {
    drawn.parts = Array.from({ length: feet }, (_, foot) => buildRow(foot));
    grid.replaceChildren(...drawn.parts.map(({ row }) => row), marks);
    grid.dataset.feet = feet;
    grid.setAttribute("aria-rowcount", feet);
  }
  drawn.parts.forEach((part) => fitRow(part, samples));
  grid.setAttribute("aria-colcount", samples);
}

/** Brings the shown window of the time axis into sight. */
function place({ grid, parts }, { samples, shown, first, borders }) {
  grid.toggleAttribute("data-dense", shown > DENSE);
  for (const { strip, cells, bars } of parts) {
    cells.forEach((cell, sample) => {
      cell.style.flexGrow = borders ? borders[sample + 1] - borders[sample] : "";
    });
    for (const { style } of [strip, bars.layer]) {
      style.width = `${(100 * samples) / shown}%`;
      style.transform = first ? `translateX(${(-100 * first) / samples}%)` : "";
    }
  }
}

/** Shows the marks, durations and duty factors of what is shown. */
function showBars({ parts, width }, state) {
  const gait = previewedDocument(state);
  const axis = axisOf(state);
  if (gait && parts.length === gait.timeline.feet.length)
    parts.forEach(({ bars }, foot) => drawBars(bars, gait.timeline.feet[foot], axis, width));
}

/** Draws the rows of a gait, with the `findings` and `lacks` of its cells. */
function drawRows(parts, state, { findings, lacks }) {
  const gait = previewedDocument(state);
  const { feet, locked } = gait.timeline;
  const before = state.preview ? shownDocument(state).timeline : null;
  parts.forEach((part, foot) =>
    drawRow(part, {
      foot,
      steps: feet[foot],
      locked: locked?.[foot],
      findings,
      lacks,
      periodic: gait.options?.boundary === "periodic",
      before: before && { steps: before.feet[foot], locked: before.locked?.[foot] },
      role: state.view.roles?.[foot] ?? "",
    }),
  );
}

/** Takes back what belongs to another gait, or to the gait before an edit. */
function watchLeft(store) {
  store.watch(
    ({ selected }) => [selected],
    () => store.set({ selection: null, preview: null, zoom: null }),
  );
  store.watch(
    ({ view, pending }) => [view, pending],
    ({ preview }) => {
      if (preview) store.set({ preview: null });
    },
  );
}

/**
 * Builds the grid and keeps it current. The ruler scrubs `playback`; `reveal` brings a sample into the shown
 * window.
 */
export function mountTimeline(store, edits, playback, reveal) {
  const grid = byId("timeline");
  const marks = h("div", { class: "timeline-marks", "aria-hidden": "true" });
  const [findingsOf, missingOf] = [memoised(findingsByCell), memoised(missingMotionByCell)];
  /** @type {Drawn} */
  const drawn = { grid, marks, parts: [], width: 0 };
  const input = mountTimelineInput(store, edits, grid, () => drawn.parts, reveal);

  function render(state) {
    const gait = previewedDocument(state);
    if (!gait) return;
    const { feet } = gait.timeline;
    if (drawn.parts.length !== feet.length || drawn.parts[0].cells.length !== feet[0].length) {
      const hadFocus = grid.contains(document.activeElement);
      fit(drawn, feet.length, feet[0].length);
      input.rebuilt(hadFocus && !grid.contains(document.activeElement));
    }
    const findings = findingsOf(state.live ? null : state.view.verdict);
    drawRows(drawn.parts, state, { findings, lacks: missingOf(shownPlan(state)) });
    showBars(drawn, store.state);
    grid.toggleAttribute("data-refused", Boolean(state.refused));
  }

  store.watch(
    (state) => [state.view, state.pending, state.gesture, state.preview, state.refused, shownPlan(state)],
    render,
  );
  store.watch(
    (state) => [axisKey(state), drawn.parts.length],
    (state) => {
      place(drawn, axisOf(state));
      showBars(drawn, store.state);
    },
  );
  store.watch(
    (state) => [state.view, state.refused, shownPlan(state), isRefusedDrawing(state)],
    () => showNote(store, edits),
  );
  watchLeft(store);
  new ResizeObserver(([{ contentRect }]) => {
    drawn.width = contentRect.width;
    showBars(drawn, store.state);
  }).observe(marks);
  mountPhaseFlags(store, marks);
  mountSelection(store, marks, () => drawn.parts);
  mountRuler(store, playback);
  return input;
}
