/** What is drawn over a picture of the platform: spots of a colour, and where the feet are taken to be. */

import { svg } from "./dom.js";

const ARM_PX = 9;
const LEAST_RADIUS = 3;

/** Dark and light under the foot's colour, so that it is seen on a sole of that very colour. */
const cross = ({ pixel: [x, y] }, foot) => ["dark", "light", "own"].map((line) => svg("path", { class: `camera-foot ${line}`, "data-foot": foot + 1, d: `M${x - ARM_PX} ${y}h${2 * ARM_PX}M${x} ${y - ARM_PX}v${2 * ARM_PX}` }));

/** A cross in each foot's colour. */
export function drawFeet(drawing, feet) {
  drawing.replaceChildren(...feet.flatMap((one, index) => (one ? cross(one, index) : [])));
}

/** A ring around every spot of a foot's colour, and crosses on the feet. */
export function drawSpots(drawing, { spots, chosen, feet }) {
  drawFeet(drawing, feet);
  drawing.prepend(...spots.map(({ pixel: [cx, cy], radius, fit }, index) => svg("circle", { class: `camera-spot ${index === chosen ? "chosen" : fit ? "fit" : "refused"}`, cx, cy, r: Math.max(radius, LEAST_RADIUS) })));
}
