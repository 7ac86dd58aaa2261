/** The ruler over the timeline: planned seconds, robot's seconds, loop, findings; it scrubs the playback. */

import { byId, h } from "../lib/dom.js";
import { hasRobotTimes, plannedAt } from "../state/robot_seconds.js";
import { hasNoMotion, shownPlan } from "../state/store.js";
import { axisKey, axisOf, fractionAt, labelEvery, momentOf, timeAt } from "../state/time_axis.js";

/** The label of a moment; that of the beginning stands beside the playhead, which waits there. */
const label = (time, kind = "") =>
  h("span", {
    class: `${kind}${time === 0 ? " origin" : ""}`.trim(),
    text: time === 0 ? "0 s" : String(Math.round(time * 10) / 10),
  });
const percent = (fraction) => `${100 * fraction}%`;
const isShown = (fraction) => fraction >= -1e-9 && fraction <= 1 + 1e-9;

function placed(element, left, width = null) {
  element.style.left = percent(left);
  if (width !== null) element.style.width = percent(width);
  return element;
}

function ticks(axis, width) {
  const every = labelEvery(axis, width);
  const marks = [];
  const end = (axis.times ? axis.duration : (axis.columns - 1) * axis.step) + 1e-9;
  for (let count = 0; count * every <= end; count += 1) {
    const time = count * every;
    const left = fractionAt(axis, time);
    if (isShown(left)) marks.push(placed(label(time), left), placed(h("i"), left));
  }
  return marks;
}

/** The second line of the ruler: the robot's seconds, where it is at that moment of the plan. */
function robotTicks(axis, plan, width) {
  if (!hasRobotTimes(plan) || hasNoMotion(plan)) return [];
  const { waypoint_times: planned, waypoint_seconds: takes } = plan;
  const every = labelEvery(
    { shown: axis.shown, step: (axis.step * takes.at(-1)) / planned.at(-1) },
    width,
    72,
  );
  const marks = [];
  for (let count = 0; count * every <= takes.at(-1) + 1e-9; count += 1) {
    const time = count * every;
    const left = fractionAt(axis, plannedAt(plan, time));
    if (isShown(left)) marks.push(placed(label(time, "on-robot"), left));
  }
  return marks;
}

/** In each move of a gait for the robot's clock, from when Stop is heard. */
const heardMarks = (axis, plan) =>
  (plan?.poses?.heard ?? [])
    .map((time) => [fractionAt(axis, time), time])
    .filter(([left]) => isShown(left))
    .map(([left, time]) =>
      placed(
        h("b", {
          class: "heard",
          title: `From ${time.toFixed(1)} s of the plan on, the robot can react to Stop in this move`,
        }),
        left,
      ),
    );

/** Marks of findings; where several fall on one sample the errors lie on top. */
function findingMarks(axis, verdict) {
  const placeable = (verdict?.findings ?? []).filter(({ sample, foot }) => sample !== null && foot === null);
  return placeable
    .sort((a, b) => Number(a.severity === "error") - Number(b.severity === "error"))
    .map((finding) =>
      placed(
        h("b", { class: "mark", title: finding.sentence, data: { severity: finding.severity } }),
        fractionAt(axis, momentOf(axis, finding.sample)),
      ),
    );
}

function loopMark(axis, [start, end]) {
  const from = Math.max(0, fractionAt(axis, start));
  return placed(
    h("b", {
      class: "loop",
      title: `Playback repeats from ${start.toFixed(1)} to ${end.toFixed(1)} s. Press L to end the loop`,
    }),
    from,
    Math.min(1, fractionAt(axis, end)) - from,
  );
}

function draw(state, playback, width, names) {
  const [axis, plan] = [axisOf(state), shownPlan(state)];
  const loop =
    playback.loop && (playback.loop[0] > 0 || playback.loop[1] < playback.duration - 1e-9)
      ? [loopMark(axis, playback.loop)]
      : [];
  const ruler = byId("ruler");
  // Without a motion its second line is free for the flags. It keeps its height, so that the rows stay
  // under the hand that draws.
  const hasTwoLines = hasRobotTimes(plan) || hasNoMotion(plan);
  ruler.toggleAttribute("data-robot", hasTwoLines);
  // Not a rule with :has: each change under the chart would have the style of every cell found anew.
  names.hidden = !hasTwoLines;
  ruler.replaceChildren(
    ...loop,
    ...ticks(axis, width),
    ...robotTicks(axis, plan, width),
    ...heardMarks(axis, plan),
    ...findingMarks(axis, state.live ? null : state.view?.verdict),
  );
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
  const names = h(
    "div",
    { class: "ruler-names", "aria-hidden": "true", hidden: true },
    h("span", { text: "planned" }),
    h("span", { class: "on-robot", text: "robot" }),
  );
  byId("chart-corner").append(names);
  const again = () => draw(store.state, playback, width || 1000, names);
  store.watch((state) => [state.view?.id, shownPlan(state), state.view?.verdict, axisKey(state)], again);
  playback.addEventListener("state", again);
  new ResizeObserver(([{ contentRect }]) => {
    width = contentRect.width;
    again();
  }).observe(byId("ruler"));
  mountScrubbing(store, playback);
}
