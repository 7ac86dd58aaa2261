/** The grid of the pattern: a row per foot, a cell per sample; fixed cells are purple and hatched. */

import { rovingFocus } from "../timeline/cells.js";
import { h, setAttribute, setText } from "../lib/dom.js";
import { mountPatternDrawing } from "./pattern_drawing.js";
import { DENSE, buildRow, fitRow } from "../timeline/timeline_rows.js";

const FIXED_TEXTS = { end: "given by a gait", limb: "locked limb", drawn: "drawn", given: "locked" };

function drawCell(cell, { foot, sample, value, fixed, changed }) {
  const word = value === null ? "not known" : value ? "stance" : "swing";
  cell.dataset.state = value === null ? "free" : word;
  cell.toggleAttribute("data-locked", fixed !== null);
  setAttribute(cell, "data-fixed", fixed);
  cell.toggleAttribute("data-preview", changed);
  const text = [word, fixed && FIXED_TEXTS[fixed], changed && "not as drawn"].filter(Boolean).join(", ");
  cell.setAttribute("aria-label", `foot ${foot + 1}, sample ${sample + 1}: ${text}`);
}

function drawRow(line, foot, shown, role) {
  setText(line.role, role);
  const { rows, fixed, before } = shown;
  for (let sample = 0; sample < line.cells.length; sample += 1) {
    const value = shown.fixedValue(foot, sample) ?? (rows === null ? null : Number(rows[foot][sample]));
    const why = fixed(foot, sample);
    const changed = Boolean(before) && value !== null && String(value) !== before[foot][sample];
    const key = `${value}${why}${changed}`;
    if (line.drawn[sample] === key) continue;
    line.drawn[sample] = key;
    drawCell(line.cells[sample], { foot, sample, value, fixed: why, changed });
  }
}

/**
 * Builds the grid.
 * @param {Record<string, any>} problem of `createProblem`
 * @param {{lockLimb: (foot: number) => void}} actions what a click on a row's name does
 */
export function patternGrid(problem, actions) {
  const element = h("div", {
    class: "timeline pattern-grid",
    role: "grid",
    "aria-label": "Pattern",
    "aria-description":
      "Space changes a cell between swing and stance and fixes the cell. "
      + "On a drawn cell, Space frees the cell. "
      + "K fixes the present value of a cell",
  });
  let lines = [];
  /** @type {Record<string, any>} */
  let now = {};
  const roving = rovingFocus(
    () => lines,
    () => {},
  );
  const drawing = mountPatternDrawing({
    problem,
    grid: element,
    lines: () => lines,
    roving,
    shown: () => now,
  });

  function fit(legs, samples) {
    if (lines.length !== legs) {
      lines = Array.from({ length: legs }, (_, foot) => {
        const line = buildRow(foot);
        line.label = line.row.querySelector(".row-label");
        line.label.addEventListener("click", () => actions.lockLimb(foot));
        return line;
      });
      element.replaceChildren(...lines.map(({ row }) => row));
      element.dataset.feet = legs;
      element.setAttribute("aria-rowcount", legs);
    }
    lines.forEach((line) => fitRow(line, samples));
    element.setAttribute("aria-colcount", samples);
    element.toggleAttribute("data-dense", samples > DENSE);
    if (legs) roving.move(roving.place());
  }

  return {
    element,
    cancel: drawing.cancel,
    /** @param {Record<string, any>} shown see `patternGridModel` */
    show(shown) {
      now = shown;
      element.hidden = shown.legs === 0;
      if (lines.length !== shown.legs || (lines[0]?.cells.length ?? 0) !== shown.samples)
        fit(shown.legs, shown.samples);
      lines.forEach((line, foot) => {
        drawRow(line, foot, shown, shown.roles[foot] ?? "");
        line.row.toggleAttribute("data-limb-locked", shown.isLocked(foot));
        setAttribute(line.label, "title", shown.limbHelp);
      });
      element.toggleAttribute("data-stale", shown.stale);
    },
  };
}
