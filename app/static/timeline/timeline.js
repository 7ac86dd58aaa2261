/** The footfall timeline: an ARIA grid, a row a foot, a cell a sample. */

import { missingMotionByCell } from "../document/missing_motion.js";
import { byId, h } from "../lib/dom.js";
import { mountSelection } from "../state/selection.js";
import { previewedDocument, shownDocument, shownPlan } from "../state/store.js";
import { axisKey, axisOf, columnFraction, fractionAt, labelEvery, timeAt } from "../state/time_axis.js";
import { mountTimelineInput } from "./timeline_input.js";
import { buildRow, DENSE, drawRow, findingsByCell, fitRow } from "./timeline_rows.js";

function showNote(store, edits) {
  const note = byId("edit-note");
  const { refused, view } = store.state;
  const plan = shownPlan(store.state);
  const refusal = plan?.live?.status === "infeasible" ? null : plan?.refusal?.sentence;
  const sentence = refused ?? refusal ?? view?.notice ?? null;
  if (!sentence) return note.replaceChildren();
  const text = h("p", { text: refused ? `Not accepted: ${refused}` : sentence, title: sentence, data: { toneText: refused || refusal ? "bad" : "caution" } });
  return note.replaceChildren(text, ...(refused ? [h("button", { text: "Take it back", on: { click: edits.dropRefused } })] : []));
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

  function place({ samples, shown, first }) {
    grid.toggleAttribute("data-dense", shown > DENSE);
    for (const { strip } of parts) {
      strip.style.width = `${(100 * samples) / shown}%`;
      strip.style.transform = first ? `translateX(${(-100 * first) / samples}%)` : "";
    }
  }

  function render(state) {
    const gait = previewedDocument(state);
    if (!gait) return;
    const { feet, locked } = gait.timeline;
    if (parts.length !== feet.length || parts[0].cells.length !== feet[0].length) fit(feet.length, feet[0].length);
    const before = state.preview ? shownDocument(state).timeline : null;
    const [findings, lacks] = [findingsOf(state.live ? null : state.view.verdict), missingOf(shownPlan(state))];
    parts.forEach((part, foot) => drawRow(part, {
      foot, steps: feet[foot], locked: locked?.[foot], findings, lacks, periodic: gait.options?.boundary === "periodic",
      before: before && { steps: before.feet[foot], locked: before.locked?.[foot] }, role: state.view.roles?.[foot] ?? "",
    }));
    grid.toggleAttribute("data-refused", Boolean(state.refused));
  }

  store.watch((state) => [state.view, state.pending, state.gesture, state.preview, state.refused, shownPlan(state)], render);
  store.watch((state) => [axisKey(state), parts.length], (state) => place(axisOf(state)));
  store.watch((state) => [state.view, state.refused, shownPlan(state)], () => showNote(store, edits));
  store.watch(({ selected }) => [selected], () => store.set({ selection: null, preview: null, zoom: null }));
  store.watch(({ view, pending }) => [view, pending], ({ preview }) => { if (preview) store.set({ preview: null }); });
  mountSelection(store, marks, () => parts);
  mountRuler(store, playback);
  return input;
}

const percent = (fraction) => `${100 * fraction}%`;
const isShown = (fraction) => fraction >= -1e-9 && fraction <= 1 + 1e-9;

function placed(element, left, width = null) {
  element.style.left = percent(left);
  if (width !== null) element.style.width = percent(width);
  return element;
}

function missingMotionMarks(axis, plan) {
  return (plan?.live?.lacks ?? []).slice().reverse().map((missing) => {
    const mark = h("b", { class: "lack", title: missing.sentence, data: { tone: missing === plan.live.lacks[0] ? "bad" : "caution" } });
    return placed(mark, columnFraction(axis, missing.first), (missing.last + 1 - missing.first) / axis.shown);
  });
}

function ticks(axis, width) {
  const every = labelEvery(axis, width);
  const marks = [];
  const end = (axis.columns - 1) * axis.step + 1e-9;
  for (let count = 0; count * every <= end; count += 1) {
    const time = count * every;
    const left = fractionAt(axis, time);
    if (isShown(left)) marks.push(placed(h("span", { text: time === 0 ? "0 s" : String(Math.round(time * 10) / 10) }), left), placed(h("i"), left));
  }
  return marks;
}

/** Marks of findings; where several fall on one sample the errors lie on top. */
function findingMarks(axis, verdict) {
  const placeable = (verdict?.findings ?? []).filter(({ sample, foot }) => sample !== null && foot === null);
  return placeable.sort((a, b) => (a.severity === "error") - (b.severity === "error"))
    .map((finding) => placed(h("b", { class: "mark", title: finding.sentence, data: { severity: finding.severity } }), fractionAt(axis, finding.sample * axis.step)));
}

function loopMark(axis, [start, end]) {
  const from = Math.max(0, fractionAt(axis, start));
  return placed(h("b", { class: "loop", title: `Plays from ${start.toFixed(1)} to ${end.toFixed(1)} s over and over (L ends it)` }), from, Math.min(1, fractionAt(axis, end)) - from);
}

function draw(state, playback, width) {
  const [axis, plan] = [axisOf(state), shownPlan(state)];
  const loop = playback.loop && (playback.loop[0] > 0 || playback.loop[1] < playback.duration - 1e-9) ? [loopMark(axis, playback.loop)] : [];
  byId("ruler").replaceChildren(...loop, ...missingMotionMarks(axis, plan), ...ticks(axis, width), ...findingMarks(axis, state.live ? null : state.view?.verdict));
}

function mountScrubbing(store, playback) {
  const ruler = byId("ruler");
  const scrub = (event) => {
    const box = ruler.getBoundingClientRect();
    playback.setTime(timeAt(axisOf(store.state), (event.clientX - box.left) / box.width));
  };
  ruler.addEventListener("pointerdown", (event) => {
    ruler.setPointerCapture(event.pointerId);
    scrub(event);
  });
  ruler.addEventListener("pointermove", (event) => {
    if (ruler.hasPointerCapture(event.pointerId)) scrub(event);
  });
}

/** Draws the ruler and keeps it current; it scrubs `playback`. */
function mountRuler(store, playback) {
  let width = byId("ruler").clientWidth;
  const again = () => draw(store.state, playback, width || 1000);
  store.watch((state) => [state.view?.id, shownPlan(state), state.view?.verdict, axisKey(state)], again);
  playback.addEventListener("state", again);
  new ResizeObserver(([{ contentRect }]) => {
    width = contentRect.width;
    again();
  }).observe(byId("ruler"));
  mountScrubbing(store, playback);
}
