/** Bars over the cells with each swing's mark and duration, and each foot's duty factor at its row's end. */

import { h, setText } from "../lib/dom.js";
import { columnTime, placeOf } from "../state/time_axis.js";

/** Least width of a swing that shows its duration, and of one that shows its mark, px. */
const LEAST_WORDS = 56;
const LEAST_MARK = 14;

/** Swings in a row of cells, which are 1 for stance and 0 for swing. */
export function swingSpans(steps) {
  return [...steps.matchAll(/0+/g)].map(({ index, 0: span }) => ({
    first: index,
    last: index + span.length - 1,
  }));
}

const seconds = (time) => `${time.toFixed(time < 9.95 ? 2 : 1)} s`;

/** Share of the drawn time that the foot is on the ground. */
function dutyOf(axis, spans) {
  const whole = columnTime(axis, axis.samples) - columnTime(axis, 0);
  const air = spans.reduce(
    (sum, { first, last }) => sum + columnTime(axis, last + 1) - columnTime(axis, first),
    0,
  );
  return whole > 0 ? 1 - air / whole : 1;
}

/** The elements of a row: the layer over its cells, which scrolls with them, and its duty factor. */
export function buildBars() {
  return {
    layer: h("div", { class: "swing-bars", "aria-hidden": "true" }),
    duty: h("span", { class: "row-duty" }),
    seen: "",
  };
}

const buildBar = () => h("div", { class: "swing-bar" }, h("span", {}, h("i", { class: "foot-dot" }), h("b")));

/**
 * Draws a row's bars.
 * @param {Record<string, any>} bars of `buildBars`
 * @param {string} steps the row, 1 and 0
 * @param {ReturnType<typeof import("../state/time_axis.js").axisOf>} axis
 * @param {number} width of the window, px
 */
export function drawBars(bars, steps, axis, width) {
  const key = `${steps} ${axis.shown} ${axis.step} ${axis.borders ?? ""} ${Math.round(width)}`;
  if (bars.seen === key) return;
  bars.seen = key;
  const spans = swingSpans(steps);
  const duty = `${Math.round(100 * dutyOf(axis, spans))} %`;
  setText(bars.duty, duty);
  bars.duty.title = `Duty factor: this foot is on the ground ${duty} of the time`;
  const place = (column) => placeOf(axis, column) / axis.samples;
  const wide = ({ first, last }) => ((placeOf(axis, last + 1) - placeOf(axis, first)) / axis.shown) * width;
  const shown = spans.filter((span) => wide(span) >= LEAST_MARK);
  while (bars.layer.childElementCount > shown.length) bars.layer.lastElementChild.remove();
  while (bars.layer.childElementCount < shown.length) bars.layer.append(buildBar());
  shown.forEach((span, at) => {
    const bar = bars.layer.children[at];
    const { first, last } = span;
    setText(
      bar.firstElementChild.lastElementChild,
      wide(span) < LEAST_WORDS ? "" : seconds(columnTime(axis, last + 1) - columnTime(axis, first)),
    );
    bar.style.left = `${100 * place(first)}%`;
    bar.style.width = `${100 * (place(last + 1) - place(first))}%`;
  });
}
