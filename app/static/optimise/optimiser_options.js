/** The optimiser's options: every number and choice, with its unit, range and help. */

import { drawnOrder, isDrawn } from "../document/drawn_timeline.js";
import { heldOf, withHeld } from "../document/held_feet.js";
import { stepLength, stepTurn, withStepLength, withTurn, withWorldStep, worldStep } from "../document/step.js";
import { robotField } from "../shell/robots.js";
import { choiceField, numberField, textField } from "../state/fields.js";
import { notesField } from "./notes_field.js";

const option = (name, factor = 1) => ({
  read: ({ options }) => (options[name] === null ? null : options[name] * factor),
  write: (document, value) => ({ ...document, options: { ...document.options, [name]: value === null ? null : value / factor } }),
});

const word = (name) => ({
  read: ({ options }) => options[name],
  write: (document, value) => ({ ...document, options: { ...document.options, [name]: value } }),
});

const property = (name) => ({ read: (document) => document[name], write: (document, value) => ({ ...document, [name]: Number(value) }) });

const axis = (index) => ({
  unit: "mm", min: -60, max: 60, step: 0.5, decimals: 2,
  read: (document) => worldStep(document)[index] * 1000,
  write: (document, value) => withWorldStep(document, worldStep(document).map((old, at) => (at === index ? value / 1000 : old))),
});

const STEP = [
  { label: "Step", name: "Step", unit: "mm", min: 0, max: 60, step: 0.5, decimals: 2, help: "How far the body goes in one iteration, in which each foot steps once",
    limit: "step", fromSI: (metres) => metres * 1000,
    read: (document) => stepLength(document) * 1000, write: (document, value) => withStepLength(document, value / 1000) },
  { label: "Turn", name: "Turn", unit: "°", min: -90, max: 90, step: 1, decimals: 2, help: "How far the body turns in one iteration, counter-clockwise",
    limit: "turn", fromSI: (radians) => (radians * 180) / Math.PI, read: stepTurn, write: withTurn },
];

const ITERATIONS = { label: "Iterations", name: "Iterations", unit: "", min: 1, max: 20, step: 1, decimals: 0, whole: true, help: "How often every foot steps", ...property("iterations") };

/** The step once more, by its shares along the axes. */
const SHARES = [
  { label: "Step x", name: "Step x", help: "Part of the step along the scene's x axis", ...axis(0) },
  { label: "Step y", name: "Step y", help: "Part of the step along the scene's y axis", ...axis(1) },
];

const SAMPLE_TIME = {
  label: "Sample time", name: "Sample time", unit: "s", min: 0.05, max: 5, step: 0.05, decimals: 3, help: "Time between two samples of the timeline: the same drawing, faster or slower",
  read: ({ timeline }) => timeline.sample_time, write: (document, value) => ({ ...document, timeline: { ...document.timeline, sample_time: value } }),
};

const LIMITS = [
  { label: "Body height", name: "Body height", unit: "mm", min: 53, max: 60.5, step: 0.5, decimals: 2,
    help: "Height of the plane of the motors above the standing feet at the start", ...option("plane_height", 1000) },
  { label: "End height", name: "End height", unit: "mm", min: 53, max: 60.5, step: 0.5, decimals: 2, empty: "same", fallback: 53.5,
    help: "Height of the plane of the motors at the goal; empty: as at the start", ...option("end_plane_height", 1000) },
  { label: "Clearance", name: "Clearance", unit: "mm", min: 0, max: 15, step: 0.5, decimals: 2,
    limit: "clearance", fromSI: (metres) => metres * 1000, help: "Each foot rises at least this high in its swing", ...option("clearance", 1000) },
  { label: "Stability margin", name: "Stability margin", unit: "mm", min: 0, max: 30, step: 0.5, decimals: 2,
    limit: "margin", fromSI: (metres) => metres * 1000,
    help: "How far the balance point (centre of pressure) stays inside the area between the standing feet", ...option("margin", 1000) },
];

const CHOICES = [
  { label: "Reach", name: "Workspace", options: [["stroke", "stroke"], ["cylinder", "cylinder"]],
    help: "Workspace. stroke: what the motors truly reach; cylinder: the paper's simpler, smaller space", ...word("workspace") },
  { label: "Cost", name: "Cost", options: [["gentle", "gentle"], ["goal", "goal"], ["goal+effort", "effort"]],
    help: "What is minimised. gentle: the body moves evenly over the time there is; goal: distance to the goal, at every sample; effort: the legs' forces as well", ...word("cost") },
];

const MORE_NUMBERS = [
  SAMPLE_TIME,
  { label: "Body speed", name: "Body speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, help: "Largest speed of the body", ...option("body_speed", 1000) },
  { label: "Foot speed", name: "Foot speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, help: "Largest speed of a foot", ...option("foot_speed", 1000) },
  { label: "Motor speed", name: "Motor speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, empty: "free", fallback: 20,
    help: "Largest speed of a motor; empty for no limit", ...option("motor_speed", 1000) },
  { label: "Motor acceleration", name: "Motor acceleration", unit: "mm/s²", min: 1, max: 1000, step: 5, decimals: 1, empty: "free", fallback: 100,
    help: "Largest acceleration of a motor; empty for no limit", ...option("motor_acceleration", 1000) },
  { label: "Friction", name: "Friction", unit: "", min: 0.05, max: 2, step: 0.05, decimals: 2, empty: "free", fallback: 0.5,
    help: "Friction of the feet on the ground (coefficient); empty for no limit", ...option("friction") },
];

const limit = (name) => ({
  read: ({ poses }) => (poses ? poses[name] * 1000 : null),
  write: (document, value) => ({ ...document, poses: { ...document.poses, [name]: value / 1000 } }),
});

/** What only a gait for the robot's clock has. */
const POSE_CHOICES = [
  { label: "Step length", name: "Step length", options: [["true", "fastest"], ["false", "as set"]],
    help: "fastest: the search chooses the step of the fastest walk, and on the spot the fastest turn; as set: step and turn above",
    read: ({ poses }) => String(poses?.free_step ?? false), write: (document, value) => ({ ...document, poses: { ...document.poses, free_step: value === "true" } }) },
];
const DEGREES = 180 / Math.PI;
const POSE_NUMBERS = [
  { label: "Sway", name: "Sway", unit: "°", min: 0, max: 40, step: 1, decimals: 1, help: "How far the heading may differ from an even turn. Sway makes a gait faster, but soles pivot on the ground, which is not tested with flat shoes yet",
    read: ({ poses }) => (poses ? (poses.sway ?? 0) * DEGREES : null), write: (document, value) => ({ ...document, poses: { ...document.poses, sway: value / DEGREES } }) },
  { label: "Slip", name: "Slip", unit: "mm", min: 0.05, max: 5, step: 0.1, decimals: 2, help: "How far a standing foot may slide off its foothold within a move: motors that move in proportion do not hold the foot exactly", ...limit("slip") },
  { label: "Shoe distance", name: "Shoe distance", unit: "mm", min: 0, max: 60, step: 0.5, decimals: 1, help: "Least distance between the middles of two feet; a shoe is 25 mm across", ...limit("shoe_distance") },
  { label: "Arm distance", name: "Arm distance", unit: "mm", min: 0, max: 10, step: 0.5, decimals: 1, help: "Least room between the arms of neighbouring legs; 0 where they may touch", ...limit("arm_distance") },
];

const WITH_OVERLAP = 5;
const OVERLAP = {
  label: "Swings", name: "Overlap", options: [["false", "apart"], ["true", "overlapping"]],
  help: "overlapping: a foot is lifted in the move that lowers the one before it, where the others balance the "
    + "body. A cycle has fewer moves and is faster; the price is that one foot fewer carries the body in these moves",
  read: ({ poses }) => String(poses?.overlap ?? false),
  write: (document, value) => ({ ...document, poses: { ...document.poses, overlap: value === "true" } }),
};

/** The other fields that such a gait has as well. */
const OF_POSES = new Set(["Robot", "Foot order", "Step", "Turn", "Clearance", "Stability margin", "Iterations", "Orientation", "Direction", "Notes"]);
const ONLY_POSES = new Set([...POSE_CHOICES, ...POSE_NUMBERS, OVERLAP].map(({ name }) => name));

/** Whether a gait has a field, by its accessible name. */
export function hasField({ poses, timeline }, name) {
  // With two of four feet in the air the others balance nothing.
  if (name === OVERLAP.name && timeline.feet.length < WITH_OVERLAP) return false;
  return poses ? OF_POSES.has(name) || ONLY_POSES.has(name) : !ONLY_POSES.has(name);
}

const MORE_CHOICES = [
  { label: "Orientation", name: "Orientation", options: [["FB", "FB"], ["FBS", "FBS"]],
    help: "Heading of the gait. FB: along the diagonal between x and y, feet in front and back pairs; FBS: along x, feet front, sides and back. Names of the feet and Mirror follow; the step does not change",
    read: ({ orientation }) => orientation, write: (document, value) => ({ ...document, orientation: value }) },
  { label: "Direction", name: "Direction", options: [1, 2, 3, 4].map((value) => [value, String(value)]),
    help: "The gait turned by quarter turns: 1 as drawn", ...property("direction") },
  { label: "Ends", name: "Boundary", options: [["rest", "at rest"], ["periodic", "cycle"]],
    help: "Boundary. at rest: begins and ends standing still; cycle: ends as it begins, so that it can be repeated", ...word("boundary") },
  { label: "Turning", name: "Turning", options: [["steady", "steady"], ["return", "at the end"]],
    help: "When the body turns. steady: during the whole gait; at the end: while every foot stands", ...word("turning") },
];

function orderField(store, edits) {
  return textField(store, {
    label: "Foot order", name: "Foot order", help: "Which foot steps when. Another order draws the timeline anew",
    read: (document) => drawnOrder(document).join(" "),
    commit(text) {
      const document = edits.shown();
      const [order, options] = [drawnOrder(document), document.options];
      const digits = text.split(/[^0-9]+/).filter(Boolean);
      const wanted = (digits.length === 1 && digits[0].length === order.length ? [...digits[0]] : digits).map(Number);
      if ([...wanted].sort((a, b) => a - b).join() !== [...order].sort((a, b) => a - b).join()) {
        return `The foot order "${text}" does not name each of the ${order.length} feet once. Write for example ${order.join(" ")}.`;
      }
      if (wanted.join() !== order.join()) edits.redraw({ order: wanted, phase_knots: options.phase_knots, closing_knots: options.closing_knots });
      return null;
    },
  });
}

function phaseFields(store, edits) {
  const redraw = (change) => {
    const { order, options } = edits.shown();
    edits.redraw({ order, phase_knots: options.phase_knots, closing_knots: options.closing_knots, ...change });
  };
  const knots = { unit: "samples", step: 1, decimals: 0, whole: true, fallback: 5, unsaid: "as drawn" };
  const asDrawn = (name) => ({ read: (document) => (isDrawn(document) ? document.options[name] : null) });
  return [
    { label: "Phase length", name: "Phase length", min: 2, max: 50, help: "Samples of each stance phase and of each swing. Another length draws the timeline anew",
      ...knots, ...asDrawn("phase_knots"), act: (value) => redraw({ phase_knots: value }) },
    { label: "Final stance", name: "Final stance", min: 0, max: 100, help: "Samples with all feet down after the last swing. Another length draws the timeline anew",
      ...knots, ...asDrawn("closing_knots"), act: (value) => redraw({ closing_knots: value }) },
  ].map((field) => numberField(store, edits, field));
}

/**
 * Builds all fields.
 * @param {object} store
 * @param {object} edits
 * @param {(robot: object, document: object) => void} makeNew offers a new gait for a robot with other legs
 * @returns {{robot: object, order: object, main: object[], more: object[]}} fields with `element` and `show(document)`
 */
export function optimiserOptions(store, edits, makeNew) {
  const number = (field) => numberField(store, edits, field);
  const choice = (field) => choiceField(edits, field);
  return {
    robot: robotField(edits, makeNew),
    order: orderField(store, edits),
    main: [...STEP.map(number), ...POSE_CHOICES.map(choice), number(ITERATIONS), ...phaseFields(store, edits), ...LIMITS.map(number)],
    more: [
      choice(OVERLAP), ...[...POSE_NUMBERS, ...SHARES].map(number), ...CHOICES.map(choice), ...MORE_NUMBERS.map(number),
      ...MORE_CHOICES.map(choice), ...heldFields(store, edits), notesField(store, edits),
    ],
  };
}

function refusal(feet, text, legs) {
  const odd = feet.find((foot, at) => foot < 1 || foot > legs || feet.indexOf(foot) !== at);
  if (odd !== undefined) return `“${text}” must name feet 1 to ${legs}, each once; leave it empty for none.`;
  return feet.length >= legs ? "The robot would fall with every foot up: keep at least three down." : null;
}

function heldField(store, edits, end, words) {
  return textField(store, {
    label: words, name: `Held ${words.toLowerCase()}`,
    help: `Feet that rest in the air at the ${end === "start" ? "first" : "last"} sample, where their rows must swing; empty for none`,
    read: (document) => heldOf(document)[end].join(" "),
    commit(text) {
      const shown = edits.shown();
      const feet = text.split(/[^0-9]+/).filter(Boolean).map(Number);
      const sentence = refusal(feet, text, shown.timeline.feet.length);
      if (!sentence && feet.join() !== heldOf(shown)[end].join()) {
        edits.edit((document) => withHeld(document, { ...heldOf(document), [end]: feet }), feet.length ? `Hold up ${feet.join(", ")} at the ${end}` : `Hold no foot up at the ${end}`);
      }
      return sentence;
    },
  });
}

/** The fields of both ends. */
const heldFields = (store, edits) => [heldField(store, edits, "start", "Up at start"), heldField(store, edits, "end", "Up at end")];
