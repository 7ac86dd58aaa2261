/** The feet of a trial from above: tracked, simulated and planned in one plot, and what the lines mean. */

import { h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

const SIZE = 276;
const PAD = 16;

/** Lines of a grid; ways that go farther have lines 10 cm apart, or 1 m, and so on. */
const MOST_LINES = 100;

/** Sources in the order of painting; the first lies lowest. */
export const SOURCES = ["planned", "simulated", "tracked"];

export const points = (xs, ys) => xs.map((x, index) => `${x.toFixed(1)},${ys[index].toFixed(1)}`).join(" ");

/**
 * A drawing area of the ground with equal scales, big enough for all ways.
 * @param {{x: number[], y: number[]}[]} ways cm
 */
export function ground(ways) {
  const [xs, ys] = [ways.flatMap(({ x }) => x), ways.flatMap(({ y }) => y)];
  const ends = (values) =>
    values.reduce(
      ([low, high], value) => [Math.min(low, value), Math.max(high, value)],
      [Infinity, -Infinity],
    );
  const [[left, right], [low, high]] = [ends(xs), ends(ys)];
  const scale = (SIZE - 2 * PAD) / Math.max(right - left, high - low, 1);
  const toX = (x) => SIZE / 2 + (x - (left + right) / 2) * scale;
  const toY = (y) => SIZE / 2 - (y - (low + high) / 2) * scale;
  const step = gridStep(Math.max(right - left, high - low));
  return { toX, toY, size: SIZE, step, lines: grid({ left, right, low, high, step }, toX, toY) };
}

/** The distance of grid lines, cm. */
export function gridStep(range) {
  let step = 1;
  while (range / step > MOST_LINES) step *= 10;
  return step;
}

/** Where lines are between two places, cm. */
export function gridPlaces(low, high, step) {
  const first = Math.ceil(low / step);
  return Array.from(
    { length: Math.max(Math.floor(high / step) - first + 1, 0) },
    (_, index) => (first + index) * step,
  );
}

/** Lines of the platform's grid. */
function grid({ left, right, low, high, step }, toX, toY) {
  return [
    ...gridPlaces(left, right, step).map((x) =>
      svg("line", { class: "grid", x1: toX(x), x2: toX(x), y1: toY(low), y2: toY(high) }),
    ),
    ...gridPlaces(low, high, step).map((y) =>
      svg("line", { class: "grid", x1: toX(left), x2: toX(right), y1: toY(y), y2: toY(y) }),
    ),
  ];
}

/** What the lines mean: one line a source, colours are the feet's. */
export function legend(kinds, words = {}) {
  const mark = (kind) =>
    svg(
      "svg",
      { class: "way-key", viewBox: "0 0 22 8", "aria-hidden": "true" },
      svg("polyline", { class: `way-${kind}`, points: "1,4 21,4" }),
    );
  return h(
    "span",
    { class: "way-legend" },
    ...kinds.map((kind) => h("span", {}, mark(kind), words[kind] ?? kind)),
  );
}

/** The feet from above: a ring at the beginning and a dot at the end of what was tracked. */
export function pathPlot(sources) {
  const kinds = SOURCES.filter((kind) => sources[kind]);
  const { toX, toY, size, step, lines } = ground(kinds.flatMap((kind) => sources[kind].feet));
  const way =
    (kind) =>
    ({ x, y }, index) =>
      svg("polyline", {
        class: `way-${kind}`,
        "data-foot": index + 1,
        points: points(x.map(toX), y.map(toY)),
      });
  const { feet } = sources.tracked;
  const marks = feet.flatMap(({ x, y }, index) => [
    svg("circle", { class: "begin", "data-foot": index + 1, r: 3, cx: toX(x[0]), cy: toY(y[0]) }),
    svg("circle", { class: "end", "data-foot": index + 1, r: 3, cx: toX(x.at(-1)), cy: toY(y.at(-1)) }),
  ]);
  const at = (xs, ys, index) => `${fixed(xs.at(index), 1)}, ${fixed(ys.at(index), 1)}`;
  const text = feet
    .map(({ x, y }, index) => `foot ${index + 1} from ${at(x, y, 0)} to ${at(x, y, -1)} cm`)
    .join("; ");
  return h(
    "figure",
    { class: "trial-plot" },
    svg(
      "svg",
      { viewBox: `0 0 ${size} ${size}`, role: "img", "aria-label": `Feet from above: ${text}` },
      ...lines,
      ...kinds.flatMap((kind) => sources[kind].feet.map(way(kind))),
      ...marks,
    ),
    h(
      "figcaption",
      { class: "quiet" },
      `Feet on the platform, seen from above. Grid: ${step} cm.`,
      legend([...kinds].reverse()),
    ),
  );
}
