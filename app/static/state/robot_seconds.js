/** The robot's own seconds at a moment of the plan, and the other way round. */

import { clamp } from "../lib/clamp.js";
import { hasNoMotion } from "./store.js";

/**
 * The place in `to` of a value that lies in `from`: straight between two waypoints.
 * @param {number} value
 * @param {number[]} from
 * @param {number[]} to
 */
function between(value, from, to) {
  if (value >= from[from.length - 1]) return to[to.length - 1];
  const after = clamp(
    from.findIndex((known) => known >= value),
    1,
    from.length - 1,
  );
  const share = (value - from[after - 1]) / (from[after] - from[after - 1] || 1);
  return to[after - 1] + share * (to[after] - to[after - 1]);
}

/**
 * Whether a plan's own seconds are others than the robot's; those of poses are the robot's already.
 * @param {any} plan
 */
export const hasRobotTimes = (plan) => plan?.poses === null && plan.waypoint_seconds?.length > 1;

/**
 * The moment of the plan at which the robot has been on its way for so long, s.
 * @param {Record<string, any>} plan
 * @param {number} seconds
 */
export const plannedAt = ({ waypoint_times: planned, waypoint_seconds: takes }, seconds) =>
  between(seconds, takes, planned);

/**
 * How long the robot has been on its way at a moment of the plan, s; null where that is not known.
 * @param {any} plan
 * @param {number} time
 */
export function robotSecondsAt(plan, time) {
  if (plan?.poses) return time;
  if (!hasRobotTimes(plan) || hasNoMotion(plan)) return null;
  return between(time, plan.waypoint_times, plan.waypoint_seconds);
}
