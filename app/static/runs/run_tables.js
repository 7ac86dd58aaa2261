/** Tables of the errors of a run. */

import { fixed, MOTORS } from "../lib/format.js";
import { figureTable, footName } from "../lib/tables.js";

const owner = (motor) => `foot ${Math.floor(motor / MOTORS) + 1}, motor ${(motor % MOTORS) + 1}`;

/** What a motor's row is called; `motor` counts from 0. */
export const motorName = (_, motor) => ({ text: owner(motor), foot: Math.floor(motor / MOTORS) + 1 });

/** Errors of motors and feet of one run, mm. */
export function errorTables(errors) {
  return [
    figureTable("Feet, mm", "By forward kinematics with the plan's standing feet on the ground. Mean and largest: distance at arrivals from where the waypoint puts the foot. Way: largest distance from the planned way at any time, with what merging left out",
      ["", "mean", "largest", "way"],
      errors.foot_mean_mm.map((mean, foot) => [footName(foot), fixed(mean, 2), fixed(errors.foot_largest_mm[foot], 2), fixed(errors.foot_path_mm[foot], 2)])),
    figureTable("Motors, mm", "Measured minus commanded stroke where the robot said that it had arrived. The firmware leaves a motor within 1 mm of its target where it is",
      ["", "mean", "largest", "waypoint"],
      errors.motor_mean_mm.map((mean, motor) => [motorName(mean, motor), fixed(mean, 2), fixed(errors.motor_largest_mm[motor], 2), errors.motor_waypoint[motor] < 0 ? "–" : String(errors.motor_waypoint[motor] + 1)])),
  ];
}
