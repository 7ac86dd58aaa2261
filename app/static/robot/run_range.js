/** The waypoints that a run sends: its first pose, and how often it repeats. A new plan resets both. */

import { h, setAttribute } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

const MOST_ITERATIONS = 100;
const HERE = "here";
const WHOLE = Object.freeze({ first: 0, iterations: 1 });

/** The chosen range of the shown plan; by default all of it, once. */
export function runRangeOf({ runRange, view }) {
  return runRange && runRange.hash === view?.plan?.waypoints_hash ? runRange : WHOLE;
}

/** Whether a summary is of the chosen range. */
export const isOfRunRange = (summary, state) =>
  summary?.from === runRangeOf(state).first && summary.iterations === runRangeOf(state).iterations;

function choose(store, change) {
  const { view } = store.state;
  if (view?.plan)
    store.set({ runRange: { ...runRangeOf(store.state), ...change, hash: view.plan.waypoints_hash } });
}

function placeName({ waypoint, time }) {
  return waypoint === 0 ? "first waypoint" : `waypoint ${waypoint + 1}, at ${fixed(time)} s`;
}

/** The beginning that is nearest to a time on the plan. */
function nearestTo(places, time) {
  return places.reduce((best, place) =>
    Math.abs(place.time - time) < Math.abs(best.time - time) ? place : best,
  );
}

function showBeginnings(select, places) {
  const known = JSON.stringify(places);
  if (select.dataset.known === known) return;
  select.dataset.known = known;
  select.replaceChildren(
    ...places.map((place) => h("option", { value: String(place.waypoint), text: placeName(place) })),
    ...(places.length > 1 ? [h("option", { value: HERE, text: "waypoint nearest to the playhead" })] : []),
  );
}

/** Builds the two fields above the run's summary. */
export function runRangePart(store, playback) {
  const title =
    "The waypoint where the run begins. The robot first moves to this waypoint slowly. "
    + "You can choose only waypoints with all feet on the ground";
  const from = h("select", { "aria-label": "Run from", title });
  const times = h("input", {
    type: "number",
    min: "1",
    max: String(MOST_ITERATIONS),
    step: "1",
    value: "1",
    "aria-label": "Times to run",
  });
  const element = h(
    "div",
    { class: "run-range" },
    h("label", {}, h("span", { text: "Start at" }), from),
    h("label", {}, h("span", { text: "Repeat" }), times),
  );
  from.addEventListener("change", () => {
    const { beginnings } = store.state.runSummary;
    choose(store, {
      first: from.value === HERE ? nearestTo(beginnings, playback.time).waypoint : Number(from.value),
    });
    from.value = String(runRangeOf(store.state).first);
  });
  times.addEventListener("change", () => {
    const wanted = Math.round(Number(times.value));
    const fits = !times.readOnly && wanted >= 1 && wanted <= MOST_ITERATIONS;
    if (fits) choose(store, { iterations: wanted });
    times.value = String(runRangeOf(store.state).iterations);
  });
  store.watch(
    ({ runSummary, runRange, view, selected }) => [
      runSummary,
      runRange,
      view?.plan?.waypoints_hash,
      selected,
    ],
    (state) => {
      const { runSummary, selected } = state;
      element.hidden = runSummary?.gait !== selected || !runSummary.beginnings;
      if (element.hidden) return;
      const reason = runSummary.why_not_repeated;
      showBeginnings(from, runSummary.beginnings);
      from.value = String(runRangeOf(state).first);
      times.readOnly = Boolean(reason);
      setAttribute(times, "aria-disabled", reason ? "true" : null);
      setAttribute(times, "aria-description", reason);
      const help = `The number of times that the robot walks the gait, 1 to ${MOST_ITERATIONS}`;
      setAttribute(times, "title", reason ?? help);
      if (document.activeElement !== times) times.value = String(runRangeOf(state).iterations);
    },
  );
  return element;
}
