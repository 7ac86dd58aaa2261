/** The rows of the footfall grid: a cell a sample. Only cells that changed are touched. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { partOf } from "../document/swings.js";
import { buildBars } from "./swing_bars.js";

/** With more columns in the window the cells stand without gaps. */
export const DENSE = 140;

const name = (foot, sample, swing, locked) =>
  `foot ${foot + 1}, sample ${sample + 1}: ${swing ? "swing" : "stance"}${locked ? ", locked" : ""}`;

const buildCell = (_, sample) =>
  h("div", {
    role: "gridcell",
    class: "cell",
    tabindex: "-1",
    "aria-colindex": sample + 1,
    "aria-selected": "false",
  });

/** An empty row of a foot. */
export function buildRow(foot) {
  const role = h("span", { class: "role" });
  const strip = h("div", { class: "cells", role: "presentation" });
  const label = h(
    "div",
    {
      class: "row-label",
      role: "rowheader",
      title: "Click to select this row. Click with Shift to select several rows",
    },
    h("span", { class: "foot-dot" }),
    h("span", { text: `Foot ${foot + 1}` }),
    role,
  );
  const bars = buildBars();
  const row = h(
    "div",
    { class: "timeline-row", role: "row", "aria-label": `Foot ${foot + 1}`, data: { foot: foot + 1 } },
    label,
    h("div", { class: "cells-window", role: "presentation" }, strip, bars.layer),
    bars.duty,
  );
  return { row, role, strip, bars, cells: [], words: [], drawn: [], seen: [] };
}

/** Gives a row as many cells as there are samples; those that stay are left as they are. */
export function fitRow(line, samples) {
  line.cells.splice(samples).forEach((cell) => cell.remove());
  const added = Array.from({ length: samples }, buildCell).slice(line.cells.length);
  line.strip.append(...added);
  line.cells.push(...added);
  line.drawn.length = samples;
  line.seen = [];
}

const same = (one, other) =>
  one.length === other.length && one.every((value, index) => Object.is(value, other[index]));

function drawCell(cell, key) {
  const { foot, sample, part, fixed, finding, lack, preview, wraps } = key;
  const swing = part !== null;
  cell.toggleAttribute("data-end", swing && part !== "middle");
  cell.dataset.state = swing ? "swing" : "stance";
  cell.toggleAttribute("data-locked", fixed);
  cell.toggleAttribute("data-preview", preview);
  setAttribute(cell, "data-wraps", wraps);
  setAttribute(cell, "aria-readonly", fixed ? "true" : null);
  setAttribute(cell, "data-finding", finding?.severity);
  setAttribute(cell, "data-lack", lack?.tone);
  cell.setAttribute("aria-label", name(foot, sample, swing, fixed));
}

/** Where a swing of a cycle crosses the border: "out" at the end, "in" at the beginning, null elsewhere. */
function wrapsOf(steps, sample, periodic) {
  if (!periodic || steps[0] !== "0" || steps.at(-1) !== "0") return null;
  return sample === steps.length - 1 ? "out" : sample === 0 ? "in" : null;
}

/** Whether a preview changes a cell; `before` is null without one. */
const isChanged = (before, { steps, locked }, sample) =>
  before !== null
  && (before.steps[sample] !== steps[sample]
    || (before.locked?.[sample] ?? "0") !== (locked?.[sample] ?? "0"));

/**
 * Draws a foot's row.
 * @param {Record<string, any>} line of `buildRow`
 * @param {Record<string, any>} what `foot`, `steps` and `locked` (rows of 1 and 0), `before` (the same two
 *   before a preview, or null), `findings` and `lacks` by "foot,sample", `periodic`, `role`
 */
export function drawRow(line, { foot, steps, locked, before, findings, lacks, periodic, role }) {
  setText(line.role, role);
  const seen = [steps, locked, before?.steps, before?.locked, findings, lacks, periodic];
  if (same(seen, line.seen)) return;
  line.seen = seen;
  for (let sample = 0; sample < line.cells.length; sample += 1) {
    const fixed = locked?.[sample] === "1";
    const [finding, lack] = [findings.get(`${foot},${sample}`), lacks.get(`${foot},${sample}`)];
    const part = partOf(steps, sample);
    const preview = isChanged(before, { steps, locked }, sample);
    const wraps = wrapsOf(steps, sample, periodic);
    const why = `${finding?.sentence ?? ""}${lack ? lack.tone + lack.sentence : ""}`;
    const key = `${part}${fixed}${preview}${wraps}${why}`;
    if (line.drawn[sample] === key) continue;
    line.drawn[sample] = key;
    line.words[sample] = [finding?.sentence, lack?.sentence].filter(Boolean).join(" ");
    line.cells[sample].title = line.words[sample];
    drawCell(line.cells[sample], { foot, sample, part, fixed, finding, lack, preview, wraps });
  }
}

/** Findings by "foot,sample"; an error wins over a warning. */
export function findingsByCell(verdict) {
  const found = new Map();
  for (const finding of verdict?.findings ?? []) {
    if (finding.sample === null || finding.foot === null) continue;
    const key = `${finding.foot},${finding.sample}`;
    if (found.get(key)?.severity !== "error") found.set(key, finding);
  }
  return found;
}
