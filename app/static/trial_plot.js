/** Drawings of a trial: the feet's ways from above, and how far they are over time with the ends of iterations. */

import { h, svg } from "./dom.js";
import { fixed } from "./format.js";

const SIZE = 276;
const WAY = { width: 276, height: 96, left: 26, right: 6, top: 8, bottom: 16 };
const PAD = 16;

const points = (xs, ys) => xs.map((x, index) => `${x.toFixed(1)},${ys[index].toFixed(1)}`).join(" ");

function bounds(groups) {
  const xs = groups.flatMap(({ feet }) => feet.flatMap(({ x }) => x));
  const ys = groups.flatMap(({ feet }) => feet.flatMap(({ y }) => y));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const span = Math.max(right - left, high - low, 1);
  return { x: (left + right) / 2, y: (low + high) / 2, scale: (SIZE - 2 * PAD) / span, left, right, low, high };
}

/** Lines of the platform's grid, 1 cm apart. */
function grid({ left, right, low, high }, toX, toY) {
  const lines = [];
  for (let x = Math.ceil(left); x <= right; x += 1) lines.push(svg("line", { class: "grid", x1: toX(x), x2: toX(x), y1: toY(low), y2: toY(high) }));
  for (let y = Math.ceil(low); y <= high; y += 1) lines.push(svg("line", { class: "grid", x1: toX(left), x2: toX(right), y1: toY(y), y2: toY(y) }));
  return lines;
}

/** The feet from above: tracked solid, planned dotted, a ring at the beginning and a dot at the end. */
export function pathPlot({ track, plan }) {
  const box = bounds(plan ? [track, plan] : [track]);
  const toX = (x) => SIZE / 2 + (x - box.x) * box.scale;
  const toY = (y) => SIZE / 2 - (y - box.y) * box.scale;
  const way = (kind) => ({ x, y }, index) => svg("polyline", { class: kind, "data-foot": index + 1, points: points(x.map(toX), y.map(toY)) });
  const marks = track.feet.flatMap(({ x, y }, index) => [
    svg("circle", { class: "begin", "data-foot": index + 1, r: 3, cx: toX(x[0]), cy: toY(y[0]) }),
    svg("circle", { class: "end", "data-foot": index + 1, r: 3, cx: toX(x.at(-1)), cy: toY(y.at(-1)) }),
  ]);
  const text = track.feet.map(({ x, y }, index) => `foot ${index + 1} from ${fixed(x[0], 1)}, ${fixed(y[0], 1)} to ${fixed(x.at(-1), 1)}, ${fixed(y.at(-1), 1)} cm`).join("; ");
  return h("figure", { class: "trial-plot" },
    svg("svg", { viewBox: `0 0 ${SIZE} ${SIZE}`, role: "img", "aria-label": `Feet from above: ${text}` },
      ...grid(box, toX, toY), ...(plan ? plan.feet.map(way("planned")) : []), ...track.feet.map(way("tracked")), ...marks),
    h("figcaption", { class: "quiet", text: plan ? "From above, 1 cm grid: tracked, and planned (dotted)" : "From above, 1 cm grid" }));
}

/** How far each foot is along the robot's direction, cm, frame by frame. */
function waysAlong({ feet }) {
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [dx, dy] = [mean(feet.map(({ x }) => x.at(-1) - x[0])), mean(feet.map(({ y }) => y.at(-1) - y[0]))];
  const length = Math.hypot(dx, dy) || 1;
  return feet.map(({ x, y }) => x.map((value, index) => ((value - x[0]) * dx + (y[index] - y[0]) * dy) / length));
}

function handle({ part, end, frames, rate, toX, fromX, moved }) {
  const label = `End of iteration ${part + 1}`;
  const line = svg("line", { y1: WAY.top, y2: WAY.height - WAY.bottom, x1: 0, x2: 0 });
  const grip = svg("rect", { x: -4, y: WAY.top - 4, width: 8, height: 12, rx: 2 });
  const group = svg("g", { class: "end-handle", "data-arrows": "", role: "slider", tabindex: "0", "aria-label": label, "aria-valuemin": "1", "aria-valuemax": String(frames - 1) }, line, grip);
  let at = end;
  const place = () => {
    group.setAttribute("transform", `translate(${toX(at)} 0)`);
    group.setAttribute("aria-valuenow", String(at));
    group.setAttribute("aria-valuetext", `${fixed(at / rate, 1)} s`);
  };
  const go = (frame) => { at = Math.min(frames - 1, Math.max(1, Math.round(frame))); place(); };
  group.addEventListener("pointerdown", (event) => { group.setPointerCapture(event.pointerId); event.preventDefault(); group.focus(); });
  group.addEventListener("pointermove", (event) => { if (group.hasPointerCapture(event.pointerId)) go(fromX(event.clientX)); });
  group.addEventListener("pointerup", () => { if (at !== end) moved(part, at); });
  group.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    go(at + step * (event.shiftKey ? rate : 1));
    moved(part, at);
  });
  place();
  return group;
}

/**
 * The feet's way over time, with a handle at the end of each iteration but the last, which is the track's.
 * @param {object} track of the paths
 * @param {{frames: number, frame_rate: number, parts: {end: number}[]}} trial
 * @param {(part: number, frame: number) => void} moved
 */
export function wayPlot(track, trial, moved) {
  const ways = waysAlong(track);
  const [low, high] = [Math.min(0, ...ways.flat()), Math.max(...ways.flat(), 0.1)];
  const inner = WAY.width - WAY.left - WAY.right;
  const toX = (frame) => WAY.left + (frame / (trial.frames - 1)) * inner;
  const toY = (value) => WAY.height - WAY.bottom - ((value - low) / (high - low)) * (WAY.height - WAY.top - WAY.bottom);
  const text = (x, y, words, anchor) => { const label = svg("text", { x, y, "text-anchor": anchor }); label.textContent = words; return label; };
  const drawing = svg("svg", { viewBox: `0 0 ${WAY.width} ${WAY.height}`, class: "way" },
    svg("line", { class: "grid", x1: WAY.left, x2: WAY.width - WAY.right, y1: toY(0), y2: toY(0) }),
    ...ways.map((way, index) => svg("polyline", { class: "tracked", "data-foot": index + 1, points: points(track.frames.map(toX), way.map(toY)) })),
    text(WAY.left - 4, toY(high) + 4, fixed(high, 1), "end"), text(WAY.left - 4, toY(0) + 4, "0", "end"),
    text(WAY.width - WAY.right, WAY.height - 4, `${fixed((trial.frames - 1) / trial.frame_rate, 0)} s`, "end"), text(WAY.left, WAY.height - 4, "cm over time", "start"));
  const fromX = (client) => {
    const { left, width } = drawing.getBoundingClientRect();
    return (((client - left) / width) * WAY.width - WAY.left) / inner * (trial.frames - 1);
  };
  drawing.append(...trial.parts.slice(0, -1).map(({ end }, part) => handle({ part, end, frames: trial.frames, rate: trial.frame_rate, toX, fromX, moved })));
  return h("figure", { class: "trial-plot" }, drawing,
    h("figcaption", { class: "quiet", text: trial.parts.length > 1 ? "Way of each foot; drag a mark, or use the arrow keys, to move the end of an iteration" : "Way of each foot" }));
}
