/** Plots predicted over measured distances; a point on the line was predicted exactly. */

import { h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { gridPlaces, gridStep } from "../trials/trial_plot.js";

const SIZE = { width: 276, height: 220, left: 30, right: 8, top: 8, bottom: 30 };

/** Numbers need so many times the room of lines. */
const TICK_ROOM = 5;

/** The predictions that are drawn, each with its own mark, so that they differ not only by colour. */
const MARKS = [
  { name: "as planned", mark: (x, y) => svg("circle", { class: "said-plan", r: 3, cx: x, cy: y }) },
  { name: "default", mark: (x, y) => svg("path", { class: "said-default", d: `M${x - 3} ${y - 3}l6 6m0 -6l-6 6` }) },
  { name: "fitted", mark: (x, y) => svg("rect", { class: "said-fitted", x: x - 3, y: y - 3, width: 6, height: 6 }) },
  { name: "left out", mark: (x, y) => svg("circle", { class: "said-left-out", r: 3.4, cx: x, cy: y }) },
];

const label = (x, y, text, anchor = "middle") => svg("text", { x, y, "text-anchor": anchor, text });

function legend(foretold) {
  return h("span", { class: "said-legend" }, ...MARKS.map(({ name, mark }) => h("span", {},
    svg("svg", { viewBox: "0 0 10 10", "aria-hidden": "true" }, mark(5, 5)), foretold.find((prediction) => prediction.name === name).title)));
}

/** @param {{gaits: object[], foretold: object[]}} result of a job */
export function predictionPlot({ gaits, foretold }) {
  const drawn = MARKS.map((one) => ({ ...one, prediction: foretold.find(({ name }) => name === one.name) }));
  const measured = gaits.map(({ distance_cm: distance }) => distance);
  const all = [...measured, ...drawn.flatMap(({ prediction }) => prediction.distances_cm)];
  const [low, high] = [Math.floor(Math.min(...all)), Math.ceil(Math.max(...all))];
  const scale = (from, to) => (value) => Number((from + ((value - low) / Math.max(high - low, 1)) * (to - from)).toFixed(1));
  const toX = scale(SIZE.left, SIZE.width - SIZE.right);
  const toY = scale(SIZE.height - SIZE.bottom, SIZE.top);
  const ticks = gridPlaces(low, high, gridStep((high - low) * TICK_ROOM));
  const values = gaits.map(({ name, distance_cm: distance }, place) => `${name}: ${fixed(distance)} measured, ${drawn.map(({ prediction }) => `${fixed(prediction.distances_cm[place])} ${prediction.title}`).join(", ")}`);
  return h("figure", { class: "trial-plot" },
    svg("svg", { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, class: "said-plot", role: "img", "aria-label": `Distances in cm. ${values.join("; ")}` },
      ...ticks.flatMap((tick) => [
        svg("line", { class: "grid", x1: toX(tick), x2: toX(tick), y1: toY(low), y2: toY(high) }),
        svg("line", { class: "grid", x1: toX(low), x2: toX(high), y1: toY(tick), y2: toY(tick) }),
        label(toX(tick), SIZE.height - SIZE.bottom + 12, String(tick)), label(SIZE.left - 5, toY(tick) + 3, String(tick), "end")]),
      svg("line", { class: "right-line", x1: toX(low), y1: toY(low), x2: toX(high), y2: toY(high) }),
      label((SIZE.left + SIZE.width) / 2, SIZE.height - 4, "measured, cm"),
      ...drawn.flatMap(({ prediction, mark }) => measured.map((value, place) => mark(toX(value), toY(prediction.distances_cm[place]))))),
    h("figcaption", { class: "quiet" }, h("span", { text: "Foretold over measured distance, cm; on the line it was foretold rightly" }), legend(foretold)));
}
