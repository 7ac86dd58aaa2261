/** The 12 measured strokes as bars in the feet's colours, with a mark where the waypoint wants each motor. */

import { clamp } from "../lib/clamp.js";
import { h, setText } from "../lib/dom.js";
import { MOTORS, fixed } from "../lib/format.js";

const STROKE_MM = 20;

function footRow(foot) {
  const bars = Array.from({ length: MOTORS }, (_, motor) => {
    const [fill, wanted, number] = [h("i"), h("u", { hidden: true }), h("span", { text: "–" })];
    return {
      fill,
      wanted,
      number,
      element: h(
        "div",
        { class: "bar", role: "img", "aria-label": `Foot ${foot + 1}, motor ${motor + 1}` },
        fill,
        wanted,
        number,
      ),
    };
  });
  const name = h("span", { class: "foot-name" }, h("i", { class: "foot-dot" }), `Foot ${foot + 1}`);
  return {
    bars,
    element: h(
      "div",
      { class: "foot-row", data: { foot: foot + 1 } },
      name,
      ...bars.map(({ element }) => element),
    ),
  };
}

/**
 * Builds the bars.
 * @returns {{element: HTMLElement, show: (measured: number[]|null, commanded: number[]|null) => void}}
 */
export function strokeBars(feet = 4) {
  const rows = Array.from({ length: feet }, (_, foot) => footRow(foot));
  const bars = rows.flatMap((row) => row.bars);
  return {
    element: h("div", { class: "strokes" }, ...rows.map(({ element }) => element)),
    show(measured, commanded) {
      bars.forEach((bar, index) => {
        const value = measured?.[index] ?? null;
        const wanted = commanded?.[index] ?? null;
        setText(bar.number, fixed(value));
        bar.fill.style.transform = `scaleX(${clamp((value ?? 0) / STROKE_MM, 0, 1)})`;
        bar.wanted.hidden = wanted === null;
        if (wanted !== null) bar.wanted.style.left = `calc(${clamp(wanted / STROKE_MM, 0, 1) * 100}% - 1px)`;
        bar.element.title =
          wanted === null ? "Measured, mm" : `Measured ${fixed(value)} mm, wanted ${fixed(wanted)} mm`;
      });
    },
  };
}
