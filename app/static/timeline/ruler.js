/** The ruler over the timeline: seconds, marks of an infeasible plan, findings about the body, the loop; dragging scrubs. */

import { axisKey, axisOf, columnFraction, fractionAt, labelEvery, timeAt } from "../state/time_axis.js";
import { byId, h } from "../lib/dom.js";
import { shownPlan } from "../state/store.js";

const percent = (fraction) => `${100 * fraction}%`;
const isShown = (fraction) => fraction >= -1e-9 && fraction <= 1 + 1e-9;

function placed(element, left, width = null) {
  element.style.left = percent(left);
  if (width !== null) element.style.width = percent(width);
  return element;
}

function missingMotionMarks(axis, plan) {
  return (plan?.live?.lacks ?? []).slice().reverse().map((missing) => {
    const mark = h("b", { class: "lack", title: missing.sentence, data: { tone: missing === plan.live.lacks[0] ? "bad" : "caution" } });
    return placed(mark, columnFraction(axis, missing.first), (missing.last + 1 - missing.first) / axis.shown);
  });
}

function ticks(axis, width) {
  const every = labelEvery(axis, width);
  const marks = [];
  const end = (axis.columns - 1) * axis.step + 1e-9;
  for (let count = 0; count * every <= end; count += 1) {
    const time = count * every;
    const left = fractionAt(axis, time);
    if (isShown(left)) marks.push(placed(h("span", { text: time === 0 ? "0 s" : String(Math.round(time * 10) / 10) }), left), placed(h("i"), left));
  }
  return marks;
}

/** Marks of findings; where several fall on one sample the errors lie on top. */
function findingMarks(axis, verdict) {
  const placeable = (verdict?.findings ?? []).filter(({ sample, foot }) => sample !== null && foot === null);
  return placeable.sort((a, b) => (a.severity === "error") - (b.severity === "error"))
    .map((finding) => placed(h("b", { class: "mark", title: finding.sentence, data: { severity: finding.severity } }), fractionAt(axis, finding.sample * axis.step)));
}

function loopMark(axis, [start, end]) {
  const from = Math.max(0, fractionAt(axis, start));
  return placed(h("b", { class: "loop", title: `Plays from ${start.toFixed(1)} to ${end.toFixed(1)} s over and over (L ends it)` }), from, Math.min(1, fractionAt(axis, end)) - from);
}

function draw(state, playback, width) {
  const [axis, plan] = [axisOf(state), shownPlan(state)];
  const loop = playback.loop && (playback.loop[0] > 0 || playback.loop[1] < playback.duration - 1e-9) ? [loopMark(axis, playback.loop)] : [];
  byId("ruler").replaceChildren(...loop, ...missingMotionMarks(axis, plan), ...ticks(axis, width), ...findingMarks(axis, state.live ? null : state.view?.verdict));
}

function mountScrubbing(store, playback) {
  const ruler = byId("ruler");
  const scrub = (event) => {
    const box = ruler.getBoundingClientRect();
    playback.setTime(timeAt(axisOf(store.state), (event.clientX - box.left) / box.width));
  };
  ruler.addEventListener("pointerdown", (event) => {
    ruler.setPointerCapture(event.pointerId);
    scrub(event);
  });
  ruler.addEventListener("pointermove", (event) => {
    if (ruler.hasPointerCapture(event.pointerId)) scrub(event);
  });
}

/** Draws the ruler and keeps it current; it scrubs `playback`. */
export function mountRuler(store, playback) {
  let width = byId("ruler").clientWidth;
  const again = () => draw(store.state, playback, width || 1000);
  store.watch((state) => [state.view?.id, shownPlan(state), state.view?.verdict, axisKey(state)], again);
  playback.addEventListener("state", again);
  new ResizeObserver(([{ contentRect }]) => {
    width = contentRect.width;
    again();
  }).observe(byId("ruler"));
  mountScrubbing(store, playback);
}
