/** The footfall timeline: an ARIA grid, a row a foot, a cell a sample. */

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

function showNote(store, edits) {
  const note = byId("edit-note");
  const { refused, view } = store.state;
  const plan = shownPlan(store.state);
  // An adapted motion may be out of reach; its search says whether the gait is. Of a drawing the inspector says why.
  const isSaid =
    plan?.live?.status === "infeasible" || plan?.source === "adapted" || isRefusedDrawing(store.state);
  const refusal = isSaid ? null : plan?.refusal?.sentence;
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
    ...(refused ? [h("button", { text: "Take it back", on: { click: edits.dropRefused } })] : []),
    ...(sentence === notice
      ? [
          h(
            "button",
            { class: "plain icon-only", "aria-label": "Dismiss the note", on: { click: dismiss } },
            icon("close"),
          ),
        ]
      : []),
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

/** Builds the grid and keeps it current. The ruler scrubs `playback`; `reveal` brings a sample into the shown window. */
export function mountTimeline(store, edits, playback, reveal) {
  const grid = byId("timeline");
  const marks = h("div", { class: "timeline-marks", "aria-hidden": "true" });
  const [findingsOf, missingOf] = [memoised(findingsByCell), memoised(missingMotionByCell)];
  let parts = [];
  let width = 0;
  const input = mountTimelineInput(store, edits, grid, () => parts, reveal);

  function fit(feet, samples) {
    const focused = grid.contains(document.activeElement);
    if (parts.length !== feet) {
      parts = Array.from({ length: feet }, (_, foot) => buildRow(foot));
      grid.replaceChildren(...parts.map(({ row }) => row), marks);
      grid.dataset.feet = feet;
      grid.setAttribute("aria-rowcount", feet);
    }
    parts.forEach((part) => fitRow(part, samples));
    grid.setAttribute("aria-colcount", samples);
    input.rebuilt(focused && !grid.contains(document.activeElement));
  }

  function place({ samples, shown, first, borders }) {
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
    showBars();
  }

  /** Marks, durations and duty factors of what is shown. */
  function showBars() {
    const gait = previewedDocument(store.state);
    const axis = axisOf(store.state);
    if (gait && parts.length === gait.timeline.feet.length)
      parts.forEach(({ bars }, foot) => drawBars(bars, gait.timeline.feet[foot], axis, width));
  }

  function render(state) {
    const gait = previewedDocument(state);
    if (!gait) return;
    const { feet, locked } = gait.timeline;
    if (parts.length !== feet.length || parts[0].cells.length !== feet[0].length)
      fit(feet.length, feet[0].length);
    const before = state.preview ? shownDocument(state).timeline : null;
    const [findings, lacks] = [
      findingsOf(state.live ? null : state.view.verdict),
      missingOf(shownPlan(state)),
    ];
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
    showBars();
    grid.toggleAttribute("data-refused", Boolean(state.refused));
  }

  store.watch(
    (state) => [state.view, state.pending, state.gesture, state.preview, state.refused, shownPlan(state)],
    render,
  );
  store.watch(
    (state) => [axisKey(state), parts.length],
    (state) => place(axisOf(state)),
  );
  store.watch(
    (state) => [state.view, state.refused, shownPlan(state), isRefusedDrawing(state)],
    () => showNote(store, edits),
  );
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
  new ResizeObserver(([{ contentRect }]) => {
    width = contentRect.width;
    showBars();
  }).observe(marks);
  mountPhaseFlags(store, marks);
  mountSelection(store, marks, () => parts);
  mountRuler(store, playback);
  return input;
}
