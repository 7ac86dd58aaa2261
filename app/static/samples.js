/** Figures of a plan: at a moment, and over all of it. */

function indexAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-9) low = middle;
    else high = middle - 1;
  }
  return low < times.length - 1 && times[low + 1] - time < time - times[low] ? low + 1 : low;
}

const finite = (values) => values.filter((value) => value !== null && Number.isFinite(value));

/** Margin (m), range of strokes (mm) and highest foot (m) at the sample nearest to `time`. */
export function plotsAt(plan, time) {
  const nothing = { margin: null, strokes: null, height: null };
  if (!plan?.times?.length) return nothing;
  const index = indexAt(plan.times, time);
  const strokes = plan.strokes_mm?.[index];
  const heights = plan.feet?.[index]?.map((foot) => foot[2]) ?? [];
  const top = heights.indexOf(Math.max(...heights));
  return {
    margin: plan.margin?.[index] ?? null,
    strokes: strokes ? [Math.min(...strokes), Math.max(...strokes)] : null,
    height: heights.length ? { foot: top, value: heights[top] } : null,
  };
}

/** Smallest margin (m), least and greatest stroke (mm) of a plan, null where it has none. */
export function extremes(plan) {
  const margins = finite(plan?.margin ?? []);
  const strokes = finite(plan?.strokes_mm?.flat() ?? []);
  return {
    margin: margins.length ? Math.min(...margins) : null,
    strokes: strokes.length ? [Math.min(...strokes), Math.max(...strokes)] : null,
  };
}

/**
 * Where on the plan the robot is, s: as the server says, else from the waypoints that it reached.
 * @returns {number|null} null while it is not streaming this plan
 */
export function robotTime(robot, view) {
  const run = robot?.run;
  const plan = view?.plan;
  if (!run || !plan?.times?.length || run.gait !== view.id || run.waypoints_hash !== plan.waypoints_hash) return null;
  if (run.phase === "ended" && !["done", "stopped", "fault"].includes(robot.robot)) return null;
  if (typeof run.plan_time === "number") return run.plan_time;
  const last = Math.max(1, run.count - 1);
  return plan.times.at(-1) * Math.min(1, Math.max(0, run.reached - 1) / last);
}

/** The strokes asked for by the waypoint sent last, mm, where they can be known. */
export function commandedStrokes(robot, view) {
  if (robot?.commanded_mm) return robot.commanded_mm;
  const run = robot?.run;
  const plan = view?.plan;
  if (!run || run.phase !== "streaming" || !plan?.strokes_mm || run.count !== plan.strokes_mm.length) return null;
  if (run.waypoints_hash !== plan.waypoints_hash) return null;
  return plan.strokes_mm[Math.min(Math.max(run.sent - 1, 0), run.count - 1)];
}
