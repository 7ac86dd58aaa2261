/** The front of a search as a plot: speed over margin, a mark for each stop bound; each can be chosen. */

import { h, svg } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { choiceText, priceOf, speedText } from "./fastest_words.js";

const FRAME = { width: 620, height: 210, left: 44, right: 12, top: 12, bottom: 34 };
const SIZE = 5;
const DEGREES = 180 / Math.PI;
const CAPTION =
  "Large marks are the Pareto-optimal gaits for speed, stability margin and stop bound. "
  + "Small dots are the other gaits that the search has tried. Choose a large mark to use its values.";

/** Outlines of the marks, by the place of their stop bound. */
const OUTLINES = [
  (x, y) => `M${x - SIZE} ${y}a${SIZE} ${SIZE} 0 1 0 ${2 * SIZE} 0a${SIZE} ${SIZE} 0 1 0 ${-2 * SIZE} 0z`,
  (x, y) => `M${x} ${y - SIZE - 1}l${SIZE + 1} ${2 * SIZE}h${-2 * SIZE - 2}z`,
  (x, y) => `M${x - SIZE} ${y - SIZE}h${2 * SIZE}v${2 * SIZE}h${-2 * SIZE}z`,
  (x, y) =>
    `M${x} ${y - SIZE - 2}l${SIZE + 2} ${SIZE + 2}l${-SIZE - 2} ${SIZE + 2}l${-SIZE - 2} ${-SIZE - 2}z`,
];

const inUnits = ({ pace, on_the_spot: onTheSpot }) => (onTheSpot ? pace * DEGREES : pace * 1000);

/**
 * What a mark stands for.
 * @param {Record<string, any>} one
 * @param {(order: number[]) => string|null} nameOf
 */
export function pointText(one, nameOf) {
  const { order, margin, stop_bound: bound, on_the_spot: onTheSpot } = one;
  const limits = `stability margin ${mm(margin, 0)} mm, stop bound ${fixed(bound, 1)} s`;
  return `${speedText(priceOf(one))}, ${limits}: ${choiceText(one, nameOf(order), onTheSpot)}`;
}

/** An even step of an axis with at most five of them. */
const stepOf = (most) => [0.5, 1, 2, 5, 10, 20].find((step) => most / step <= 5) ?? most / 5;

function axes(toX, toY, most, unit) {
  const [mostX, mostY] = most;
  const text = (x, y, content, anchor) => svg("text", { x, y, "text-anchor": anchor, text: content });
  const bottom = FRAME.height - FRAME.bottom;
  const parts = [];
  for (let y = 0; y <= mostY + 1e-9; y += stepOf(mostY)) {
    parts.push(
      svg("line", { class: "grid", x1: FRAME.left, x2: FRAME.width - FRAME.right, y1: toY(y), y2: toY(y) }),
      text(FRAME.left - 6, toY(y) + 4, fixed(y, stepOf(mostY) < 1 ? 1 : 0), "end"),
    );
  }
  for (let x = 0; x <= mostX + 1e-9; x += 2) parts.push(text(toX(x), bottom + 14, fixed(x, 0), "middle"));
  parts.push(
    text(FRAME.width - FRAME.right, FRAME.height - 4, "horizontal: stability margin, mm", "end"),
    text(FRAME.left, FRAME.height - 4, `vertical: speed, ${unit}`, "start"),
  );
  return parts;
}

function legend(bounds) {
  return h(
    "p",
    { class: "fast-legend quiet" },
    "Stop bound",
    ...bounds.map((bound, place) =>
      h(
        "span",
        {},
        svg(
          "svg",
          { viewBox: "0 0 16 16", "aria-hidden": "true" },
          svg("path", { class: "fast-mark", d: OUTLINES[place % 4](8, 8) }),
        ),
        `${fixed(bound, 1)} s`,
      ),
    ),
  );
}

/** A mark for each gait of the front. */
function marksOf(front, bounds, at, nameOf) {
  return front.map((one, place) => {
    const [x, y] = at(one);
    const mark = svg("path", { class: "fast-mark", d: OUTLINES[bounds.indexOf(one.stop_bound) % 4](x, y) });
    const label = pointText(one, nameOf);
    return svg(
      "g",
      { role: "option", tabindex: place ? "-1" : "0", "aria-selected": "false", "aria-label": label },
      svg("title", { text: label }),
      svg("circle", { class: "reach", cx: x, cy: y, r: 12 }),
      mark,
    );
  });
}

/** Makes marks a list of which one can be chosen, by the pointer or by keys. */
function mountChoice(marks, choose) {
  const reach = (place) => {
    marks.forEach((mark, other) => mark.setAttribute("tabindex", other === place ? "0" : "-1"));
    marks[place].focus();
  };
  const select = (place) => {
    marks.forEach((mark, other) => mark.setAttribute("aria-selected", String(other === place)));
    reach(place);
    choose(place);
  };
  marks.forEach((mark, place) => {
    mark.addEventListener("click", () => select(place));
    mark.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (!way && !["Enter", " "].includes(event.key)) return;
      event.preventDefault();
      if (way) reach(Math.min(Math.max(place + way, 0), marks.length - 1));
      else select(place);
    });
  });
}

/**
 * Builds the plot.
 * @param {Record<string, any>[]} front the gaits that no other one beats
 * @param {Record<string, any>[]} tried all gaits of the search
 * @param {(order: number[]) => string|null} nameOf
 * @param {(one: Record<string, any>) => void} choose
 */
export function frontPlot(front, tried, nameOf, choose) {
  const all = tried.filter(({ speed }) => speed !== null);
  const bounds = [...new Set(front.map((one) => one.stop_bound))].sort((a, b) => a - b);
  const most = [11, Math.max(...all.concat(front).map((one) => inUnits(priceOf(one)))) * 1.1];
  const toX = (x) => FRAME.left + (x / most[0]) * (FRAME.width - FRAME.left - FRAME.right);
  const toY = (y) => FRAME.height - FRAME.bottom - (y / most[1]) * (FRAME.height - FRAME.top - FRAME.bottom);
  const at = (one) => [toX(one.margin * 1000), toY(inUnits(priceOf(one)))];
  const dots = all.map((one) => {
    const [cx, cy] = at(one);
    return svg("circle", { class: "fast-dot", cx, cy, r: 2 });
  });
  const marks = marksOf(front, bounds, at, nameOf);
  mountChoice(marks, (place) => choose(front[place]));
  const unit = front.some((one) => priceOf(one).on_the_spot) ? "°/s" : "mm/s";
  const drawing = svg(
    "svg",
    {
      viewBox: `0 0 ${FRAME.width} ${FRAME.height}`,
      role: "listbox",
      "aria-label": "Pareto front of speed, stability margin and stop bound",
    },
    ...axes(toX, toY, most, unit),
    ...dots,
    ...marks,
  );
  return h(
    "figure",
    { class: "fast-front" },
    drawing,
    legend(bounds),
    h("figcaption", { class: "quiet", text: CAPTION }),
  );
}
