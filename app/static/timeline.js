/** The footfall timeline: an ARIA grid, a row a foot, a cell a sample. Only cells that changed are touched. */

import { axisOf, fractionAt, labelEvery, timeAt } from "./axis.js";
import { byId, h, setAttribute, setText } from "./dom.js";
import { shownDocument } from "./store.js";
import { mountTimelineInput } from "./timeline_input.js";

const name = (foot, sample, swing, locked) => `foot ${foot + 1}, sample ${sample + 1}: ${swing ? "swing" : "stance"}${locked ? ", locked" : ""}`;

function buildRow(foot, samples) {
  const role = h("span", { class: "role" });
  const cells = Array.from({ length: samples }, (_, sample) =>
    h("div", { role: "gridcell", class: "cell", tabindex: "-1", "aria-colindex": sample + 1 }));
  const strip = h("div", { class: "cells", role: "presentation" }, ...cells);
  const row = h("div", { class: "timeline-row", role: "row", "aria-label": `Foot ${foot + 1}`, data: { foot: foot + 1 } },
    h("div", { class: "row-label", role: "rowheader" }, h("span", { class: "foot-dot" }), h("span", { text: `Foot ${foot + 1}` }), role), strip);
  return { row, role, cells, strip, drawn: new Array(samples).fill("") };
}

function drawRow(part, foot, steps, locked, findings) {
  for (let sample = 0; sample < part.cells.length; sample += 1) {
    const swing = steps[sample] === "0";
    const fixed = locked?.[sample] === "1";
    const finding = findings.get(`${foot},${sample}`);
    const key = `${swing}${fixed}${finding?.sentence ?? ""}`;
    if (part.drawn[sample] === key) continue;
    part.drawn[sample] = key;
    const cell = part.cells[sample];
    cell.dataset.state = swing ? "swing" : "stance";
    cell.toggleAttribute("data-locked", fixed);
    setAttribute(cell, "aria-readonly", fixed ? "true" : null);
    setAttribute(cell, "data-finding", finding?.severity);
    setAttribute(cell, "title", finding?.sentence);
    cell.setAttribute("aria-label", name(foot, sample, swing, fixed));
  }
}

function findingsByCell(verdict) {
  const found = new Map();
  for (const finding of verdict?.findings ?? []) {
    if (finding.sample === null || finding.foot === null) continue;
    const key = `${finding.foot},${finding.sample}`;
    if (found.get(key)?.severity !== "error") found.set(key, finding);
  }
  return found;
}

function drawRuler(axis, verdict) {
  const ruler = byId("ruler");
  const every = labelEvery(axis, ruler.clientWidth || 1000);
  const marks = [];
  for (let time = 0; time <= (axis.columns - 1) * axis.step + 1e-9; time += every) {
    const left = `${100 * fractionAt(axis, time)}%`;
    const label = h("span", { text: time === 0 ? "0 s" : String(Math.round(time * 10) / 10) });
    const tick = h("i");
    [label.style.left, tick.style.left] = [left, left];
    marks.push(label, tick);
  }
  for (const finding of verdict?.findings ?? []) {
    if (finding.sample === null || finding.foot !== null) continue;
    const mark = h("b", { class: "mark", title: finding.sentence, data: { severity: finding.severity } });
    mark.style.left = `${100 * fractionAt(axis, finding.sample * axis.step)}%`;
    marks.push(mark);
  }
  ruler.replaceChildren(...marks);
}

function showNote(store, edits) {
  const note = byId("edit-note");
  const { refused, view } = store.state;
  const sentence = refused ?? view?.plan?.refusal?.sentence ?? view?.notice ?? null;
  if (!sentence) return note.replaceChildren();
  const text = h("p", { text: refused ? `Not accepted: ${refused}` : sentence, title: sentence, data: { toneText: refused || view?.plan?.refusal ? "bad" : "caution" } });
  return note.replaceChildren(text, ...(refused ? [h("button", { text: "Take it back", on: { click: edits.dropRefused } })] : []));
}

/** Builds the grid and keeps it current. `playback` is scrubbed by the ruler. */
export function mountTimeline(store, edits, playback) {
  const grid = byId("timeline");
  let parts = [];
  const input = mountTimelineInput(store, edits, grid, () => parts);

  function rebuild(document) {
    const samples = document.timeline.feet[0].length;
    parts = document.timeline.feet.map((_, foot) => buildRow(foot, samples));
    grid.replaceChildren(...parts.map(({ row }) => row));
    grid.dataset.feet = parts.length;
    grid.setAttribute("aria-colcount", samples);
    grid.setAttribute("aria-rowcount", parts.length);
    input.rebuilt();
  }

  function render(state) {
    const document = shownDocument(state);
    if (!document) return;
    if (parts.length !== document.timeline.feet.length || parts[0].cells.length !== document.timeline.feet[0].length) rebuild(document);
    const axis = axisOf(state);
    const findings = findingsByCell(state.view.verdict);
    parts.forEach((part, foot) => {
      setText(part.role, state.view.roles?.[foot] ?? "");
      part.strip.style.width = `${(100 * axis.samples) / axis.columns}%`;
      drawRow(part, foot, document.timeline.feet[foot], document.timeline.locked?.[foot], findings);
    });
    grid.toggleAttribute("data-refused", Boolean(state.refused));
  }

  const ruler = () => drawRuler(axisOf(store.state), store.state.view?.verdict);
  store.watch(({ view, pending, gesture, refused }) => [view, pending, gesture, refused], render);
  store.watch(({ view }) => [view?.id, view?.plan, view?.verdict, view?.document.timeline.sample_time], ruler);
  store.watch(({ view, refused }) => [view, refused], () => showNote(store, edits));
  new ResizeObserver(ruler).observe(byId("ruler"));
  mountScrubbing(store, playback);
  return input;
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
