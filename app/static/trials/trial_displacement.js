/** Plots the displacement of a trial's feet over time; the marks at the ends of iterations can be moved. */

import { h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { SOURCES, legend, points } from "./trial_plot.js";

const FRAME = { width: 276, height: 96, left: 26, right: 6, top: 8, bottom: 16 };

/** The plot's frame with its axes; `toX` takes 0 to `most`. */
export function displacementFrame([low, high], most, words) {
  const inner = FRAME.width - FRAME.left - FRAME.right;
  const toX = (value) => FRAME.left + (value / most) * inner;
  const toY = (value) =>
    FRAME.height - FRAME.bottom - ((value - low) / (high - low)) * (FRAME.height - FRAME.top - FRAME.bottom);
  const text = (x, y, content, anchor) => svg("text", { x, y, "text-anchor": anchor, text: content });
  const drawing = svg(
    "svg",
    { viewBox: `0 0 ${FRAME.width} ${FRAME.height}`, class: "feet-ways" },
    svg("line", { class: "grid", x1: FRAME.left, x2: FRAME.width - FRAME.right, y1: toY(0), y2: toY(0) }),
    text(FRAME.left - 4, toY(high) + 4, fixed(high, 1), "end"),
    text(FRAME.left - 4, toY(0) + 4, "0", "end"),
    text(FRAME.width - FRAME.right, FRAME.height - 4, words.end, "end"),
    text(FRAME.left, FRAME.height - 4, words.begin, "start"),
  );
  const fromX = (client) =>
    ((new DOMPoint(client, 0).matrixTransform(drawing.getScreenCTM().inverse()).x - FRAME.left) / inner)
    * most;
  return { drawing, toX, toY, fromX };
}

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * The mean direction of the tracked feet.
 * @param {Record<string, any>} paths
 */
function directionOf({ feet }) {
  const [dx, dy] = [mean(feet.map(({ x }) => x.at(-1) - x[0])), mean(feet.map(({ y }) => y.at(-1) - y[0]))];
  const length = Math.hypot(dx, dy) || 1;
  return [dx / length, dy / length];
}

/**
 * The displacement of each foot along a direction, cm.
 * @param {Record<string, any>} paths
 * @param {number[]} direction
 */
const displacementsAlong = ({ feet }, [dx, dy]) =>
  feet.map(({ x, y }) => x.map((value, index) => (value - x[0]) * dx + (y[index] - y[0]) * dy));

/** The tracked frame at a share of a motion's time, by iteration, since the robot walks by its own clock. */
function frameAt(share, ends) {
  const place = share * ends.length;
  const part = Math.min(Math.floor(place), ends.length - 1);
  const begin = part === 0 ? 0 : ends[part - 1];
  return begin + (place - part) * (ends[part] - begin);
}

/** The value at a place, straight between rising knots and on beyond them. */
function between(knots, values, at) {
  const beyond = knots.findIndex((knot) => knot >= at);
  const after = beyond < 0 ? knots.length - 1 : Math.max(1, beyond);
  const share = (at - knots[after - 1]) / (knots[after] - knots[after - 1]);
  return values[after - 1] + share * (values[after] - values[after - 1]);
}

/**
 * Seconds of a track's frames and back; pictures need not come evenly.
 * @param {Record<string, any>} track
 * @param {number} seconds
 */
function clockOf({ frames, shares }, seconds) {
  const times = shares.map((share) => share * seconds);
  return {
    timeOf: (frame) => between(frames, times, frame),
    frameOf: (time) => between(times, frames, time),
  };
}

function handle({ part, end, frames, rate, clock, toX, fromX, top, bottom, moved }) {
  const line = svg("line", { y1: top, y2: bottom, x1: 0, x2: 0 });
  const grip = svg("rect", { x: -4, y: top - 4, width: 8, height: 12, rx: 2 });
  const reach = svg("rect", { class: "reach", x: -8, y: top - 4, width: 16, height: bottom - top + 8 });
  const group = svg(
    "g",
    {
      class: "end-handle",
      "data-arrows": "",
      role: "slider",
      tabindex: "0",
      "aria-label": `End of iteration ${part + 1}`,
      "aria-valuemin": "1",
      "aria-valuemax": String(frames - 1),
    },
    reach,
    line,
    grip,
  );
  let [at, held] = [end, 0];
  const place = () => {
    group.setAttribute("transform", `translate(${toX(clock.timeOf(at))} 0)`);
    group.setAttribute("aria-valuenow", String(at));
    group.setAttribute("aria-valuetext", `${fixed(clock.timeOf(at), 1)} s`);
  };
  const go = (frame) => {
    at = Math.min(frames - 1, Math.max(1, Math.round(frame)));
    place();
  };
  group.addEventListener("pointerdown", (event) => {
    group.setPointerCapture(event.pointerId);
    event.preventDefault();
    group.focus();
    group.toggleAttribute("data-held", true);
    held = fromX(event.clientX) - clock.timeOf(at);
  });
  group.addEventListener("pointermove", (event) => {
    if (group.hasPointerCapture(event.pointerId)) go(clock.frameOf(fromX(event.clientX) - held));
  });
  group.addEventListener("lostpointercapture", () => group.toggleAttribute("data-held", false));
  group.addEventListener("pointerup", () => {
    if (at !== end) moved(part, at);
  });
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
 * The feet's displacement over time, with a handle at the end of each iteration but the last.
 * @param {Record<string, Record<string, any>|null>} sources paths of `GET …/paths` and `…/beside`: `tracked`,
 *   `planned` and `simulated`
 * @param {{frames: number, seconds: number, frame_rate: number, parts: {end: number}[]}} trial
 * @param {(part: number, frame: number) => void} moved
 */
export function displacementPlot(sources, trial, moved) {
  const kinds = SOURCES.filter((kind) => sources[kind]);
  const direction = directionOf(sources.tracked);
  const ends = trial.parts.map(({ end }) => end);
  const drawn = kinds.map((kind) => ({
    kind,
    displacements: displacementsAlong(sources[kind], direction),
    frames:
      kind === "tracked" ? sources[kind].frames : sources[kind].shares.map((share) => frameAt(share, ends)),
  }));
  const all = drawn.flatMap(({ displacements }) => displacements.flat());
  const range = all.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [0, 0.1]);
  const clock = clockOf(sources.tracked, trial.seconds);
  const words = { begin: "cm over time", end: `${fixed(trial.seconds, 0)} s` };
  const { drawing, toX, toY, fromX } = displacementFrame(range, trial.seconds, words);
  drawing.append(
    ...drawn.flatMap(({ kind, displacements, frames }) =>
      displacements.map((way, index) =>
        svg("polyline", {
          class: `way-${kind}`,
          "data-foot": index + 1,
          points: points(
            frames.map((frame) => toX(clock.timeOf(frame))),
            way.map(toY),
          ),
        }),
      ),
    ),
    ...ends
      .slice(0, -1)
      .map((end, part) =>
        handle({
          part,
          end,
          frames: trial.frames,
          rate: trial.frame_rate,
          clock,
          toX,
          fromX,
          top: FRAME.top,
          bottom: FRAME.height - FRAME.bottom,
          moved,
        }),
      ),
  );
  const along = "Distance of each foot along the mean direction of the tracked feet";
  const help =
    ends.length > 1
      ? `${along}. `
        + "To move the end of an iteration, drag its mark, or click the mark and press the arrow keys."
      : along;
  return h(
    "figure",
    { class: "trial-plot" },
    drawing,
    h("figcaption", { class: "quiet" }, help, kinds.length > 1 && legend([...kinds].reverse())),
  );
}
