/** One plot of two runs over the waypoints that both reached, with a legend. */

import { h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { onPointed } from "../lib/pointed.js";

const [WIDTH, HEIGHT] = [276, 132];
const [LEFT, RIGHT, TOP, BOTTOM] = [38, 6, 8, 20];
const TICKS = 4;

const WORDS = { this: "this run", other: "the other run" };

/** Round numbers between two values, about as many as fit. */
export function ticksOf(low, high) {
  const rough = (high - low) / TICKS || 1;
  const size = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * size).find((one) => one >= rough);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from(
    { length: Math.floor(high / step + 1e-9) - first + 1 },
    (_, index) => (first + index) * step,
  );
}

const key = (kind) =>
  h(
    "span",
    {},
    svg(
      "svg",
      { class: "run-key", viewBox: "0 0 22 8", "aria-hidden": "true" },
      svg("polyline", { class: `run-${kind}`, points: "1,4 21,4" }),
    ),
    WORDS[kind],
  );

/** The values of both runs at the waypoint under the pointer, in the caption. */
function pointed(picture, reading, { places, series, unit }, placeAt) {
  const empty = "Point at a waypoint to read the values of both runs.";
  reading.textContent = empty;
  onPointed(
    picture,
    (event) => {
      const box = picture.getBoundingClientRect();
      const index = placeAt(((event.clientX - box.left) / box.width) * WIDTH);
      const figures = series.map(({ kind, values }) => `${kind} ${fixed(values[index], 2)}`);
      reading.textContent = `${places[index]}: ${figures.join(", ")} ${unit}`;
    },
    () => {
      reading.textContent = empty;
    },
  );
}

/**
 * Builds the plot.
 * @param {{title: string, unit: string, places: string[], series: {kind: string, values: number[]}[]}} shown
 *   `kind` is "this" or "other"
 * @returns {HTMLElement}
 */
export function waypointPlot(shown) {
  const { title, places, series } = shown;
  const all = series.flatMap(({ values }) => values);
  const [low, high] = [Math.min(...all), Math.max(...all)];
  const last = Math.max(places.length - 1, 1);
  const toX = (index) => LEFT + (index / last) * (WIDTH - LEFT - RIGHT);
  const toY = (value) => HEIGHT - BOTTOM - ((value - low) / (high - low || 1)) * (HEIGHT - TOP - BOTTOM);
  const ticks = ticksOf(low, high).flatMap((value) => [
    svg("line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: toY(value), y2: toY(value) }),
    svg("text", {
      x: LEFT - 4,
      y: toY(value) + 3,
      "text-anchor": "end",
      text: String(Number(value.toPrecision(3))),
    }),
  ]);
  const ends = [0, places.length - 1].map((index) =>
    svg("text", {
      x: toX(index),
      y: HEIGHT - 6,
      "text-anchor": index ? "end" : "start",
      text: places[index],
    }),
  );
  const lines = series.map(({ kind, values }) =>
    svg("polyline", {
      class: `run-${kind}`,
      points: values.map((value, index) => `${toX(index).toFixed(1)},${toY(value).toFixed(1)}`).join(" "),
    }),
  );
  const summary = series
    .map(({ kind, values }) => `${WORDS[kind]} ends at ${fixed(values.at(-1), 2)}`)
    .join(", ");
  const picture = svg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `${title}: ${summary}` },
    ...ticks,
    ...ends,
    ...lines,
  );
  const reading = h("span", { class: "quiet number" });
  const placeAt = (x) =>
    Math.min(Math.max(Math.round(((x - LEFT) / (WIDTH - LEFT - RIGHT)) * last), 0), places.length - 1);
  pointed(picture, reading, shown, placeAt);
  const legend = h(
    "span",
    { class: "run-legend", role: "note", "aria-label": "Lines of the comparison" },
    ...series.map(({ kind }) => key(kind)),
  );
  return h("figure", { class: "run-plot" }, picture, h("figcaption", {}, legend, reading));
}
