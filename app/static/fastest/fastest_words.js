/** Words for foot orders, directions, paces and the values of options. */

import { capital, fixed, mm } from "../lib/format.js";

const DEGREES = 180 / Math.PI;

export const degrees = (radians, decimals = 0) => fixed(radians * DEGREES, decimals);

/** How fast a gait goes, or turns on the spot. */
export function paceText({ pace, on_the_spot: onTheSpot }) {
  if (pace === null) return "no gait";
  return onTheSpot ? `${fixed(pace * DEGREES, 2)} °/s` : `${fixed(pace * 1000, 2)} mm/s`;
}

/** A tried gait's pace as a price. */
export const priceOf = ({ speed, turn_rate: rate, step }) => {
  if (speed === null) return { pace: null, on_the_spot: false };
  return step === 0 ? { pace: Math.abs(rate), on_the_spot: true } : { pace: speed, on_the_spot: false };
};

/** A foot order: its name where it has one, else its feet. */
export function orderText({ order, overlap }, name = null) {
  return `${name ? capital(name) : order.join("-")}${overlap ? ", overlapping" : ""}`;
}

export const headingText = (heading) => (Math.abs(heading) < 1e-9 ? "along x" : `at ${degrees(heading)}°`);

/** Where a gait goes. */
export function wayText({ way, turn }) {
  if (way !== "walk") return `Turn ${way} on the spot`;
  if (turn === 0) return "Straight";
  return `Curve ${turn > 0 ? "left" : "right"} ${degrees(Math.abs(turn))}°`;
}

/** What each option is called, what it means, and its values in words. */
export const GROUPS = [
  { group: "way", label: "Way", help: "Where it goes: degrees are the turn a cycle", text: wayText },
  { group: "order", label: "Foot order", help: "Which foot steps when, and in which direction the robot walks" },
  { group: "stop_bound", label: "Stop bound", help: "Within this time the robot hears a stop, whenever it comes", text: (value) => `${fixed(value, 1)} s` },
  { group: "margin", label: "Stability margin", help: "Least distance of the centre of mass from the edge of the support polygon, at every place of every move", text: (value) => `${mm(value, 0)} mm` },
  { group: "step", label: "Step", help: "Travel a cycle", text: (value) => (value === null ? "fastest" : `${mm(value, 0)} mm`) },
  { group: "clearance", label: "Clearance", help: "Height of a swinging foot above the standing ones", text: (value) => `${mm(value, 0)} mm` },
  { group: "sway", label: "Sway", help: "How far the heading may leave an even turn. Soles pivot on the ground then, and nobody has tried yet how flat shoes do that", text: (value) => `${degrees(value)}°` },
];
