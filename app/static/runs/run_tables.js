/** Tables of a run's figures, and of two runs compared. */

import { figureTable, footName } from "../lib/tables.js";
import { h } from "../lib/dom.js";
import { MOTORS, fixed, seconds } from "../lib/format.js";

const owner = (motor) => `foot ${Math.floor(motor / MOTORS) + 1}, motor ${(motor % MOTORS) + 1}`;

const motorName = (_, motor) => ({ text: owner(motor), foot: Math.floor(motor / MOTORS) + 1 });

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

const change = (a, b, decimals) => (Number.isFinite(a) && Number.isFinite(b) && a !== null && b !== null ? `${b > a ? "+" : ""}${fixed(b - a, decimals)}` : "–");

function rowsOf(names, a, b, decimals = 2) {
  return names.map((name, index) => [name, fixed(a[index], decimals), fixed(b[index], decimals), change(a[index], b[index], decimals)]);
}

/** Times and errors of two runs compared. */
export function comparison(one, other) {
  const [a, b] = [one.errors, other.errors];
  if (!a || !b) return [h("p", { class: "why", text: "One of the two was kept without its plan: there are no figures to compare." })];
  const head = ["", "this", "other", "change"];
  const words = (names) => names.map((text) => ({ text }));
  return [
    figureTable("Times, s", "From the first waypoint's message to the last arrival, and what the ramp law lets expect", head,
      rowsOf(words(["duration", "expected", "to the start pose"]), [a.seconds, a.estimate, a.start_seconds], [b.seconds, b.estimate, b.start_seconds], 1)),
    figureTable("Whole run, mm", "Largest errors of any motor, of any foot, and of the body", head,
      rowsOf(words(["motors, largest", "feet, largest", "body, largest"]), [a.largest_mm, Math.max(...a.foot_largest_mm), a.body_largest_mm], [b.largest_mm, Math.max(...b.foot_largest_mm), b.body_largest_mm])),
    figureTable("Feet, largest, mm", "Distance of each foot at arrivals from where the waypoint puts it", head, rowsOf(a.foot_largest_mm.map((_, foot) => footName(foot)), a.foot_largest_mm, b.foot_largest_mm)),
    figureTable("Motors, largest, mm", "Measured minus commanded stroke at arrivals", head, rowsOf(a.motor_largest_mm.map(motorName), a.motor_largest_mm, b.motor_largest_mm)),
  ];
}

/** The duration of a run and the expected one. */
export function durationSummary({ errors, seconds: elapsed }) {
  if (!errors || errors.seconds === null) return elapsed === null || elapsed === undefined ? "–" : `${seconds(elapsed)} s`;
  return `${seconds(errors.seconds)} s, expected ${seconds(errors.estimate)} s`;
}
