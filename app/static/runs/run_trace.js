/** Measured strokes of the run that is on, a row each time a waypoint is reached, as the plots draw them. */

import { planIsOn } from "../state/store.js";

/** A trace with another row; an iteration begins where the plan's time goes back. */
function longer(trace, { plan_time: time, reached }, strokes) {
  const last = trace.plan_times.at(-1);
  const lap = (trace.laps.at(-1) ?? 0) + (last !== undefined && time < last ? 1 : 0);
  return { ...trace, reached, plan_times: [...trace.plan_times, time], laps: [...trace.laps, lap], measured_mm: [...trace.measured_mm, strokes] };
}

/** True if a trace is current: its run is on, or has ended with the gait unchanged and no other run open. */
function isCurrent(trace, { robot, view, run: open }) {
  const run = robot?.run;
  if (!run || planIsOn(robot)) return Boolean(run);
  return trace?.id === run.id && !open && run.waypoints_hash === view?.plan?.waypoints_hash;
}

/** Keeps `trace` in the store while a run is on and until something else is looked at; a page that comes later begins where the run is then. */
export function mountTrace(store) {
  store.watch(({ robot, view, run: open }) => [robot?.run?.phase, robot?.run?.id, robot?.run?.reached, view?.plan, open], (state) => {
    const { robot, trace } = state;
    if (!isCurrent(trace, state)) {
      if (trace) store.set({ trace: null });
      return;
    }
    const run = robot.run;
    const own = trace?.id === run.id ? trace : { id: run.id, gait: run.gait, reached: 0, plan_times: [], laps: [], measured_mm: [] };
    const isNew = run.reached > own.reached && (trace === own || run.phase === "streaming");
    if (isNew && typeof run.plan_time === "number" && robot.strokes_mm) store.set({ trace: longer(own, run, robot.strokes_mm) });
    else if (trace && trace !== own) store.set({ trace: null });
  });
}
