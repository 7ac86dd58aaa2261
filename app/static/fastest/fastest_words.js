/** Words for foot orders, directions, paces and the values of options. */

import { fixed, mm } from "../lib/format.js";

const DEGREES = 180 / Math.PI;

export const degrees = (radians, decimals = 0) => fixed(radians * DEGREES, decimals);

/** How fast a gait goes, or turns on the spot; what a price or a tried gait says. */
export function speedText({ pace, on_the_spot: onTheSpot }) {
  if (pace === null) return "no gait";
  return onTheSpot ? `${fixed(pace * DEGREES, 2)} °/s` : `${fixed(pace * 1000, 2)} mm/s`;
}

/**
 * The price of a gait that a search has tried.
 * @param {Record<string, any>} tried
 */
export function priceOf({ speed, turn_rate: rate, on_the_spot: onTheSpot }) {
  if (speed === null) return { pace: null, on_the_spot: onTheSpot };
  return { pace: onTheSpot ? Math.abs(rate) : speed, on_the_spot: onTheSpot };
}

/** A foot order: its name where it has one, else its feet. */
export const orderText = ({ order, overlap }, name = null) =>
  `${name ?? order.join("-")}${overlap ? ", overlapping" : ""}`;

export const headingText = (heading) => (Math.abs(heading) < 1e-9 ? "along x" : `at ${degrees(heading)}°`);

/** A gait by its foot order, with its direction where it walks. */
export function choiceText(choice, name, onTheSpot) {
  return onTheSpot ? orderText(choice, name) : `${orderText(choice, name)}, ${headingText(choice.heading)}`;
}

/** Where a gait goes. */
export function courseText({ course, turn }) {
  if (course !== "walk") return `Turn ${course} on the spot`;
  if (turn === 0) return "Straight";
  return `Curve ${turn > 0 ? "left" : "right"} ${degrees(Math.abs(turn))}°`;
}

const millimetres = (value) => `${mm(value, 0)} mm`;
const STOP =
  "Longest time from a press on Stop until the robot reacts. "
  + "The robot reacts to Stop only between two moves";
const MARGIN =
  "Least distance between the centre of mass and the edge of the support polygon, during every move";
const SWAY =
  "How far the body may turn to the left and right of its course. "
  + "When the body sways, the soles of the "
  + "feet turn on the ground. Gaits with sway have not been tested with flat shoes yet";

/** The options: what each is called, what it means, and its values in words. */
export const GROUPS = [
  {
    group: "course",
    label: "Course",
    help:
      "The robot walks straight, walks a curve, or turns on the spot. "
      + "The angle of a curve is the turn of the robot in one cycle",
    text: courseText,
  },
  {
    group: "order",
    label: "Foot order",
    help: "The order in which the feet step, and the direction in which the robot walks",
  },
  { group: "stop_bound", label: "Stop bound", help: STOP, text: (value) => `${fixed(value, 1)} s` },
  { group: "margin", label: "Stability margin", help: MARGIN, text: millimetres },
  {
    group: "step",
    label: "Step",
    help: "How far the robot walks in one cycle",
    text: (value) => (value === null ? "fastest" : millimetres(value)),
  },
  {
    group: "clearance",
    label: "Clearance",
    help: "Each foot rises at least this high in its swing",
    text: millimetres,
  },
  { group: "sway", label: "Sway", help: SWAY, text: (value) => `${degrees(value)}°` },
];

/** What a search was asked for beside foot order, margin and stop bound. */
export function searchedText(request) {
  const words = [courseText(request)];
  if (request.course === "walk")
    words.push(`step ${request.step === null ? "fastest" : `${mm(request.step)} mm`}`);
  words.push(`clearance ${mm(request.clearance)} mm`, `sway ${degrees(request.sway)}°`);
  return words.join(", ");
}
