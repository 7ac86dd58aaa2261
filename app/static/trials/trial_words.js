/** The figure by which a trial is known, its net movement, in the same words and decimals everywhere. */

import { fixed } from "../lib/format.js";

/** Heads of the columns of a net movement. */
export const NET_HEAD = ["net cm", "angle °", "error %"];

export const NET_HELP =
  "Net movement: mean over the feet of their movement from the first to the last frame. "
  + "Angle: direction of the movement, measured from the x axis of the platform where the robot walks. "
  + "Error: deviation of the net distance from the wanted distance";

/** @param {number} cm */
export const distanceText = (cm) => fixed(cm, 2);

/** @param {number} degrees */
export const angleText = (degrees) => fixed(degrees, 1);

/** @param {number} percent */
export const errorText = (percent) => fixed(percent, 0);

/**
 * The cells of a net movement.
 * @param {{net_distance: number, net_angle_deg: number, net_error_percent: number}} movement
 */
export const netCells = ({ net_distance: distance, net_angle_deg: angle, net_error_percent: error }) => [
  distanceText(distance),
  angleText(angle),
  errorText(error),
];
