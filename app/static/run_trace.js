/** Measured strokes of the run that is on, a row each time a waypoint is reached, as the plots draw them. */

import { runIsOn } from "./store.js";

/** A trace with another row; an iteration begins where the plan's time goes back. */
function longer(trace, { plan_time: time }, strokes) {
  const last = trace.plan_times.at(-1);
  const lap = (trace.laps.at(-1) ?? 0) + (last !== undefined && time < last ? 1 : 0);
  return { ...trace, plan_times: [...trace.plan_times, time], laps: [...trace.laps, lap], measured_mm: [...trace.measured_mm, strokes] };
}

/** Keeps `trace` in the store as long as a run is on; a page that comes later begins where the run is then. */
export function mountTrace(store) {
  store.watch(({ robot }) => [runIsOn(robot), robot?.run?.id, robot?.run?.reached], ({ robot, trace }) => {
    const run = robot?.run;
    if (!runIsOn(robot) || !run) {
      if (trace) store.set({ trace: null });
      return;
    }
    if (run.phase !== "streaming" || run.reached < 1 || typeof run.plan_time !== "number" || !robot.strokes_mm) return;
    const own = trace?.id === run.id ? trace : { id: run.id, gait: run.gait, plan_times: [], laps: [], measured_mm: [] };
    store.set({ trace: longer(own, run, robot.strokes_mm) });
  });
}
