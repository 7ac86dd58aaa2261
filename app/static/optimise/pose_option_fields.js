/** Numbers and choices of a gait for the robot's clock as fields, with unit, range and help. */

const limit = (name) => ({
  read: ({ poses }) => (poses ? poses[name] * 1000 : null),
  write: (document, value) => ({ ...document, poses: { ...document.poses, [name]: value / 1000 } }),
});

/** What only a gait for the robot's clock has. */
export const POSE_CHOICES = [
  {
    label: "Step length",
    name: "Step length",
    options: [
      ["true", "fastest"],
      ["false", "as set"],
    ],
    help:
      "With “fastest”, the search chooses the step or the turn of the fastest gait. "
      + "With “as set”, the search uses Step and Turn above",
    read: ({ poses }) => String(poses?.free_step ?? false),
    write: (document, value) => ({ ...document, poses: { ...document.poses, free_step: value === "true" } }),
  },
];
const DEGREES = 180 / Math.PI;
export const POSE_NUMBERS = [
  {
    label: "Sway",
    name: "Sway",
    unit: "°",
    min: 0,
    max: 40,
    step: 1,
    decimals: 1,
    help:
      "How far the body may turn to the left and right of its course. Sway makes a gait faster, "
      + "but the soles of the feet turn on the ground. Sway has not been tested with flat shoes yet",
    read: ({ poses }) => (poses ? (poses.sway ?? 0) * DEGREES : null),
    write: (document, value) => ({ ...document, poses: { ...document.poses, sway: value / DEGREES } }),
  },
  {
    label: "Slip",
    name: "Slip",
    unit: "mm",
    min: 0.05,
    max: 5,
    step: 0.1,
    decimals: 2,
    help:
      "How far a standing foot may slide from its foothold during a move. "
      + "Standing feet slide a little, because all motors start and end each move together",
    ...limit("slip"),
  },
  {
    label: "Shoe distance",
    name: "Shoe distance",
    unit: "mm",
    min: 0,
    max: 60,
    step: 0.5,
    decimals: 1,
    help: "Least distance between the centres of two feet. A shoe is 25 mm wide",
    ...limit("shoe_distance"),
  },
  {
    label: "Arm distance",
    name: "Arm distance",
    unit: "mm",
    min: 0,
    max: 10,
    step: 0.5,
    decimals: 1,
    help: "Least distance between the arms of neighbouring legs. With 0 mm the arms may touch",
    ...limit("arm_distance"),
  },
];

const WITH_OVERLAP = 5;
export const OVERLAP = {
  label: "Swings",
  name: "Overlap",
  options: [
    ["false", "apart"],
    ["true", "overlapping"],
  ],
  help:
    "With “overlapping”, the robot lifts a foot in the same move in which it lowers the previous foot. "
    + "A cycle then has fewer moves and is faster. In these moves, fewer feet carry the body",
  read: ({ poses }) => String(poses?.overlap ?? false),
  write: (document, value) => ({ ...document, poses: { ...document.poses, overlap: value === "true" } }),
};

/** The other fields that such a gait has as well. */
const OF_POSES = new Set([
  "Robot",
  "Foot order",
  "Step",
  "Turn",
  "Clearance",
  "Stability margin",
  "Iterations",
  "Orientation",
  "Direction",
  "Notes",
]);
const ONLY_POSES = new Set([...POSE_CHOICES, ...POSE_NUMBERS, OVERLAP].map(({ name }) => name));

/** Whether a gait has a field, by its accessible name. */
export function hasField({ poses, timeline }, name) {
  // With two of four feet in the air the others balance nothing.
  if (name === OVERLAP.name && timeline.feet.length < WITH_OVERLAP) return false;
  return poses ? OF_POSES.has(name) || ONLY_POSES.has(name) : !ONLY_POSES.has(name);
}
