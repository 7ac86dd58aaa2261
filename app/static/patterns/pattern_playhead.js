/** Draws the playhead of a walking pattern over gait A, then the transition, then gait B. */

import { h } from "../lib/dom.js";
import { shownRows } from "./pattern_search.js";
import { timelineOf } from "./pattern_gaits.js";

/** Whether a limb is in the air at an end for that one sample alone: the motion then begins or ends with it twice. */
const isCut = (rows, end, beside) => rows.some((row) => row.at(end) === "0" && row.at(beside) === "1");

/** The stretches of the motion of a transition: a lane each, its samples, and which of the lane's samples comes first. */
function stretchesOf({ from, to }, [first, second], rows) {
  const [whole, after] = [first.timeline.feet[0].length, second.timeline.feet[0].length];
  const [start, end] = [Math.min(from.sample, whole - 1), Math.min(to.sample, after - 1)];
  return [
    { lane: "from", of: whole, at: 0, samples: start === 0 && isCut(rows, 0, 1) ? 1 : start },
    { lane: "sought", of: rows[0].length, at: 0, samples: rows[0].length },
    { lane: "to", of: after, at: Math.min(end + 1, after - 1), samples: Infinity },
  ];
}

/** Which lane the playhead is over, and where as a share of its width; null where the motion has other samples. */
function placeOf(store, problem, time) {
  const { iterate } = store.state;
  const rows = shownRows(problem.state);
  if (!iterate?.pattern || !rows || problem.state.mode === "limbs") return null;
  const { times } = iterate.plan;
  let sample = time / (times[1] - times[0]);
  if (problem.state.mode === "drawing") return { lane: "sought", share: (sample + 0.5) / rows[0].length };
  const gaits = [problem.state.from, problem.state.to].map(({ gait }) => timelineOf(store, problem, gait));
  if (gaits.includes(null)) return null;
  for (const { lane, of, at, samples } of stretchesOf(problem.state, gaits, rows)) {
    if (sample < samples) return { lane, share: Math.min(at + sample + 0.5, of) / of };
    sample -= samples;
  }
  return null;
}

/**
 * Shows the playhead in the lower part while a pattern walks.
 * @param {object} store
 * @param {object} problem
 * @param {Playback} playback
 * @param {{from: HTMLElement, sought: HTMLElement, to: HTMLElement}} lanes
 */
export function patternPlayhead(store, problem, playback, lanes) {
  const line = h("div", { class: "pattern-playhead", "aria-hidden": "true", hidden: true });
  const move = () => {
    const place = placeOf(store, problem, playback.time);
    line.hidden = !place;
    if (!place) return;
    if (line.parentNode !== lanes[place.lane]) lanes[place.lane].append(line);
    line.style.setProperty("--at", place.share.toFixed(5));
  };
  playback.addEventListener("time", move);
  store.watch(({ iterate }) => [iterate], move);
}
