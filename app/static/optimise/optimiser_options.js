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
  { label: "Step", name: "Step", unit: "mm", min: 0, max: 60, step: 0.5, decimals: 2, help: "How far the body moves in one iteration. Each foot steps once in an iteration",
    limit: "step", fromSI: (metres) => metres * 1000,
    read: (document) => stepLength(document) * 1000, write: (document, value) => withStepLength(document, value / 1000) },
  { label: "Turn", name: "Turn", unit: "°", min: -90, max: 90, step: 1, decimals: 2, help: "How far the body turns in one iteration. Positive angles are counter-clockwise",
    limit: "turn", fromSI: (radians) => (radians * 180) / Math.PI, read: stepTurn, write: withTurn },
];

const ITERATIONS = { label: "Iterations", name: "Iterations", unit: "", min: 1, max: 20, step: 1, decimals: 0, whole: true, help: "Number of iterations of the gait. Each foot steps once in an iteration", ...property("iterations") };

/** The step once more, by its shares along the axes. */
const SHARES = [
  { label: "Step x", name: "Step x", help: "Component of the step along the x axis of the 3D "
    + "preview", ...axis(0) },
  { label: "Step y", name: "Step y", help: "Component of the step along the y axis of the 3D "
    + "preview", ...axis(1) },
];

const SAMPLE_TIME = {
  label: "Sample time", name: "Sample time", unit: "s", min: 0.05, max: 5, step: 0.05, decimals: 3,
  help: "Time between two samples of the timeline. A smaller value makes the drawn gait faster",
  read: ({ timeline }) => timeline.sample_time, write: (document, value) => ({ ...document, timeline: { ...document.timeline, sample_time: value } }),
};

const LIMITS = [
  { label: "Body height", name: "Body height", unit: "mm", min: 53, max: 60.5, step: 0.5, decimals: 2,
    help: "Height of the body at the start: from the standing feet up to the plane of the motors", ...option("plane_height", 1000) },
  { label: "End height", name: "End height", unit: "mm", min: 53, max: 60.5, step: 0.5, decimals: 2, empty: "same", fallback: 53.5,
    help: "Height of the body at the end. Leave the field empty to keep the start height", ...option("end_plane_height", 1000) },
  { label: "Clearance", name: "Clearance", unit: "mm", min: 0, max: 15, step: 0.5, decimals: 2,
    limit: "clearance", fromSI: (metres) => metres * 1000, help: "Each foot rises at least this high in its swing", ...option("clearance", 1000) },
  { label: "Stability margin", name: "Stability margin", unit: "mm", min: 0, max: 30, step: 0.5, decimals: 2,
    limit: "margin", fromSI: (metres) => metres * 1000,
    help: "Least distance between the centre of pressure and the edge of the support polygon (the area "
      + "between the standing feet)", ...option("margin", 1000) },
];

const CHOICES = [
  { label: "Reach", name: "Workspace", options: [["stroke", "stroke"], ["cylinder", "cylinder"]],
    help: "Workspace of each foot. With “stroke”, a foot can be at every place that the motors reach. "
      + "With “cylinder”, a foot stays in a smaller cylinder, as in the DeltaWalker paper",
    ...word("workspace") },
  { label: "Cost", name: "Cost", options: [["gentle", "gentle"], ["goal", "goal"], ["goal+effort", "effort"]],
    help: "The cost “gentle” minimises the speeds, so that the body moves evenly. "
      + "“goal” minimises the distance to the goal at every sample. "
      + "“effort” minimises this distance and the forces of the legs", ...word("cost") },
];

const MORE_NUMBERS = [
  SAMPLE_TIME,
  { label: "Body speed", name: "Body speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, help: "Largest speed of the body", ...option("body_speed", 1000) },
  { label: "Foot speed", name: "Foot speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, help: "Largest speed of a foot", ...option("foot_speed", 1000) },
  { label: "Motor speed", name: "Motor speed", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1, empty: "free", fallback: 20,
    help: "Largest speed of a motor. Leave empty for no limit", ...option("motor_speed", 1000) },
  { label: "Motor acceleration", name: "Motor acceleration", unit: "mm/s²", min: 1, max: 1000, step: 5, decimals: 1, empty: "free", fallback: 100,
    help: "Largest acceleration of a motor. Leave empty for no limit", ...option("motor_acceleration", 1000) },
  { label: "Friction", name: "Friction", unit: "", min: 0.05, max: 2, step: 0.05, decimals: 2, empty: "free", fallback: 0.5,
    help: "Friction coefficient between feet and ground. If the field is empty, the "
      + "friction forces have no limit", ...option("friction") },
];

const limit = (name) => ({
  read: ({ poses }) => (poses ? poses[name] * 1000 : null),
  write: (document, value) => ({ ...document, poses: { ...document.poses, [name]: value / 1000 } }),
});

/** What only a gait for the robot's clock has. */
const POSE_CHOICES = [
  { label: "Step length", name: "Step length", options: [["true", "fastest"], ["false", "as set"]],
    help: "With “fastest”, the search chooses the step or the turn of the fastest gait. "
      + "With “as set”, the search uses Step and Turn above",
    read: ({ poses }) => String(poses?.free_step ?? false), write: (document, value) => ({ ...document, poses: { ...document.poses, free_step: value === "true" } }) },
];
const DEGREES = 180 / Math.PI;
const POSE_NUMBERS = [
  { label: "Sway", name: "Sway", unit: "°", min: 0, max: 40, step: 1, decimals: 1,
    help: "How far the body may turn to the left and right of its course. Sway makes a gait faster, "
      + "but the soles of the feet turn on the ground. Sway has not been tested with flat shoes yet",
    read: ({ poses }) => (poses ? (poses.sway ?? 0) * DEGREES : null), write: (document, value) => ({ ...document, poses: { ...document.poses, sway: value / DEGREES } }) },
  { label: "Slip", name: "Slip", unit: "mm", min: 0.05, max: 5, step: 0.1, decimals: 2,
    help: "How far a standing foot may slide from its foothold during a move. "
      + "Standing feet slide a little, because all motors start and end each move together",
    ...limit("slip") },
  { label: "Shoe distance", name: "Shoe distance", unit: "mm", min: 0, max: 60, step: 0.5, decimals: 1, help: "Least distance between the centres of two feet. A shoe is 25 mm wide", ...limit("shoe_distance") },
  { label: "Arm distance", name: "Arm distance", unit: "mm", min: 0, max: 10, step: 0.5, decimals: 1, help: "Least distance between the arms of neighbouring legs. With 0 mm the arms may touch", ...limit("arm_distance") },
];

const WITH_OVERLAP = 5;
const OVERLAP = {
  label: "Swings", name: "Overlap", options: [["false", "apart"], ["true", "overlapping"]],
  help: "With “overlapping”, the robot lifts a foot in the same move in which it lowers the previous foot. "
    + "A cycle then has fewer moves and is faster. In these moves, fewer feet carry the body",
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
    help: "Forward direction of the gait. FB: the robot walks along the diagonal between x and y, and has "
      + "feet in front and at the back. FBS: the robot walks along x, and has feet in front, at the sides and at the back. "
      + "The orientation also changes the names of the feet and the effect of Mirror. "
      + "The step of the gait does not change",
    read: ({ orientation }) => orientation, write: (document, value) => ({ ...document, orientation: value }) },
  { label: "Direction", name: "Direction", options: [1, 2, 3, 4].map((value) => [value, String(value)]),
    help: "Turns the whole gait in steps of 90°. Direction 1 is the gait as drawn",
    ...property("direction") },
  { label: "Ends", name: "Boundary", options: [["rest", "at rest"], ["periodic", "cycle"]],
    help: "Start and end of the gait (boundary). With “at rest”, the robot stands still at the start and "
      + "the end. With “cycle”, the end is like the start, so that the gait can repeat", ...word("boundary") },
  { label: "Turning", name: "Turning", options: [["steady", "steady"], ["return", "at the end"]],
    help: "When the body turns. With “steady”, the body turns during the whole gait. "
      + "With “at the end”, the body turns after each iteration, while all feet stand", ...word("turning") },
];

function orderField(store, edits) {
  return textField(store, {
    label: "Foot order", name: "Foot order", help: "The order in which the feet step. "
      + "If you change the order, the timeline is drawn again",
    read: (document) => drawnOrder(document).join(" "),
    commit(text) {
      const document = edits.shown();
      const [order, options] = [drawnOrder(document), document.options];
      const digits = text.split(/[^0-9]+/).filter(Boolean);
      const wanted = (digits.length === 1 && digits[0].length === order.length ? [...digits[0]] : digits).map(Number);
      if ([...wanted].sort((a, b) => a - b).join() !== [...order].sort((a, b) => a - b).join()) {
        return `The foot order “${text}” must contain each of the ${order.length} feet exactly once. `
          + `Type for example ${order.join(" ")}.`;
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
    { label: "Phase length", name: "Phase length", min: 2, max: 50, help: "Number of samples of each swing "
      + "and of each stance phase. If you change the number, the timeline is drawn again",
      ...knots, ...asDrawn("phase_knots"), act: (value) => redraw({ phase_knots: value }) },
    { label: "Final stance", name: "Final stance", min: 0, max: 100, help: "Number of samples with all "
      + "feet down after the last swing. If you change the number, the timeline is drawn again",
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
  if (odd !== undefined) return `“${text}” is not valid. Type feet from 1 to ${legs}, each foot at most `
    + `once. To hold up no foot, leave the field empty.`;
  return feet.length >= legs ? "The robot falls when all feet are up. Keep at least three feet down." : null;
}

function heldField(store, edits, end, words) {
  return textField(store, {
    label: words, name: `Held ${words.toLowerCase()}`,
    help: `Feet that the robot holds up at the ${end === "start" ? "first" : "last"} sample. `
      + `These feet must swing at this sample on the timeline. To hold up no foot, leave the field empty`,
    read: (document) => heldOf(document)[end].join(" "),
    commit(text) {
      const shown = edits.shown();
      const feet = text.split(/[^0-9]+/).filter(Boolean).map(Number);
      const sentence = refusal(feet, text, shown.timeline.feet.length);
      if (!sentence && feet.join() !== heldOf(shown)[end].join()) {
        edits.edit((document) => withHeld(document, { ...heldOf(document), [end]: feet }), feet.length ? `Hold up ${feet.length > 1 ? "feet" : "foot"} ${feet.join(", ")} at the ${end}` : `Hold no foot up at the ${end}`);
      }
      return sentence;
    },
  });
}

/** The fields of both ends. */
const heldFields = (store, edits) => [heldField(store, edits, "start", "Up at start"), heldField(store, edits, "end", "Up at end")];
