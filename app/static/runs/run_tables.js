/** Tables of the errors of a run. */

import { fixed, MOTORS } from "../lib/format.js";
import { figureTable, footName } from "../lib/tables.js";

const owner = (motor) => `foot ${Math.floor(motor / MOTORS) + 1}, motor ${(motor % MOTORS) + 1}`;

/** What a motor's row is called; `motor` counts from 0. */
export const motorName = (_, motor) => ({ text: owner(motor), foot: Math.floor(motor / MOTORS) + 1 });

/** Errors of motors and feet of one run, mm. */
export function errorTables(errors) {
  return [
    figureTable(
      "Feet, mm",
      "Mean and largest: distance of the foot from its planned position at the reached "
        + "waypoints. Path: largest distance from the planned path at any time, also between waypoints. "
        + "The studio computes foot positions from the measured strokes",
      ["", "mean", "largest", "path"],
      errors.foot_mean_mm.map((mean, foot) => [
        footName(foot),
        fixed(mean, 2),
        fixed(errors.foot_largest_mm[foot], 2),
        fixed(errors.foot_path_mm[foot], 2),
      ]),
    ),
    figureTable(
      "Motors, mm",
      "Difference between measured and commanded stroke at each reached waypoint. "
        + "The firmware does not move a motor that is within 1 mm of its target",
      ["", "mean", "largest", "waypoint"],
      errors.motor_mean_mm.map((mean, motor) => [
        motorName(mean, motor),
        fixed(mean, 2),
        fixed(errors.motor_largest_mm[motor], 2),
        errors.motor_waypoint[motor] < 0 ? "–" : String(errors.motor_waypoint[motor] + 1),
      ]),
    ),
  ];
}
