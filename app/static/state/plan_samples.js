/** The robot's time and commanded strokes on a plan. */

import { clamp } from "../lib/clamp.js";

/**
 * The robot's time on the plan, s: from the server, else from the waypoints that it reached.
 * @param {any} robot
 * @param {any} view
 * @returns {number|null} null while it is not streaming this plan
 */
export function robotTime(robot, view) {
  const run = robot?.run;
  const plan = view?.plan;
  if (!run || !plan?.times?.length || run.gait !== view.id || run.waypoints_hash !== plan.waypoints_hash)
    return null;
  if (run.phase === "ended" && !["done", "stopped", "fault"].includes(robot.robot)) return null;
  if (typeof run.plan_time === "number") return run.plan_time;
  const times = plan.waypoint_times ?? [];
  return times[clamp(run.reached - 1, 0, times.length - 1)] ?? null;
}

/** The strokes of the waypoint sent last, mm, or null if unknown. @param {any} robot @param {any} view */
export function commandedStrokes(robot, view) {
  if (robot?.commanded_mm) return robot.commanded_mm;
  const run = robot?.run;
  const plan = view?.plan;
  if (!run || run.phase !== "streaming" || !plan?.waypoint_strokes_mm?.length) return null;
  if (run.waypoints_hash !== plan.waypoints_hash) return null;
  return plan.waypoint_strokes_mm[clamp(run.sent - 1, 0, run.count - 1)] ?? null;
}
