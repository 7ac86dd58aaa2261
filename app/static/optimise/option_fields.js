/** Numbers and choices of every gait as fields, with unit, range and help. */

import {
  stepLength,
  stepTurn,
  withStepLength,
  withTurn,
  withWorldStep,
  worldStep,
} from "../document/step.js";

const option = (name, factor = 1) => ({
  read: ({ options }) => (options[name] === null ? null : options[name] * factor),
  write: (document, value) => ({
    ...document,
    options: { ...document.options, [name]: value === null ? null : value / factor },
  }),
});

const word = (name) => ({
  read: ({ options }) => options[name],
  write: (document, value) => ({ ...document, options: { ...document.options, [name]: value } }),
});

const property = (name) => ({
  read: (document) => document[name],
  write: (document, value) => ({ ...document, [name]: Number(value) }),
});

const axis = (index) => ({
  unit: "mm",
  min: -60,
  max: 60,
  step: 0.5,
  decimals: 2,
  read: (document) => worldStep(document)[index] * 1000,
  write: (document, value) =>
    withWorldStep(
      document,
      worldStep(document).map((old, at) => (at === index ? value / 1000 : old)),
    ),
});

export const STEP = [
  {
    label: "Step",
    name: "Step",
    unit: "mm",
    min: 0,
    max: 60,
    step: 0.5,
    decimals: 2,
    help: "How far the body moves in one iteration. Each foot steps once in an iteration",
    limit: "step",
    fromSI: (metres) => metres * 1000,
    read: (document) => stepLength(document) * 1000,
    write: (document, value) => withStepLength(document, value / 1000),
  },
  {
    label: "Turn",
    name: "Turn",
    unit: "°",
    min: -90,
    max: 90,
    step: 1,
    decimals: 2,
    help: "How far the body turns in one iteration. Positive angles are counter-clockwise",
    limit: "turn",
    fromSI: (radians) => (radians * 180) / Math.PI,
    read: stepTurn,
    write: withTurn,
  },
];

export const ITERATIONS = {
  label: "Iterations",
  name: "Iterations",
  unit: "",
  min: 1,
  max: 20,
  step: 1,
  decimals: 0,
  whole: true,
  help: "Number of iterations of the gait. Each foot steps once in an iteration",
  ...property("iterations"),
};

/** The step once more, by its shares along the axes. */
export const SHARES = [
  {
    label: "Step x",
    name: "Step x",
    help: "Component of the step along the x axis of the 3D preview",
    ...axis(0),
  },
  {
    label: "Step y",
    name: "Step y",
    help: "Component of the step along the y axis of the 3D preview",
    ...axis(1),
  },
];

export const SAMPLE_TIME = {
  label: "Sample time",
  name: "Sample time",
  unit: "s",
  min: 0.05,
  max: 5,
  step: 0.05,
  decimals: 3,
  help: "Time between two samples of the timeline. A smaller value makes the drawn gait faster",
  read: ({ timeline }) => timeline.sample_time,
  write: (document, value) => ({ ...document, timeline: { ...document.timeline, sample_time: value } }),
};

export const LIMITS = [
  {
    label: "Body height",
    name: "Body height",
    unit: "mm",
    min: 53,
    max: 60.5,
    step: 0.5,
    decimals: 2,
    help: "Height of the body at the start: from the standing feet up to the plane of the motors",
    ...option("plane_height", 1000),
  },
  {
    label: "End height",
    name: "End height",
    unit: "mm",
    min: 53,
    max: 60.5,
    step: 0.5,
    decimals: 2,
    empty: "same",
    fallback: 53.5,
    help: "Height of the body at the end. Leave the field empty to keep the start height",
    ...option("end_plane_height", 1000),
  },
  {
    label: "Clearance",
    name: "Clearance",
    unit: "mm",
    min: 0,
    max: 15,
    step: 0.5,
    decimals: 2,
    limit: "clearance",
    fromSI: (metres) => metres * 1000,
    help: "Each foot rises at least this high in its swing",
    ...option("clearance", 1000),
  },
  {
    label: "Stability margin",
    name: "Stability margin",
    unit: "mm",
    min: 0,
    max: 30,
    step: 0.5,
    decimals: 2,
    limit: "margin",
    fromSI: (metres) => metres * 1000,
    help:
      "Least distance between the centre of pressure and the edge of the support polygon (the area "
      + "between the standing feet)",
    ...option("margin", 1000),
  },
];

export const CHOICES = [
  {
    label: "Reach",
    name: "Workspace",
    options: [
      ["stroke", "stroke"],
      ["cylinder", "cylinder"],
    ],
    help:
      "Workspace of each foot. With “stroke”, a foot can be at every place that the motors reach. "
      + "With “cylinder”, a foot stays in a smaller cylinder, as in the DeltaWalker paper",
    ...word("workspace"),
  },
  {
    label: "Cost",
    name: "Cost",
    options: [
      ["gentle", "gentle"],
      ["goal", "goal"],
      ["goal+effort", "effort"],
    ],
    help:
      "The cost “gentle” minimises the speeds, so that the body moves evenly. "
      + "“goal” minimises the distance to the goal at every sample. "
      + "“effort” minimises this distance and the forces of the legs",
    ...word("cost"),
  },
];

export const MORE_NUMBERS = [
  SAMPLE_TIME,
  {
    label: "Body speed",
    name: "Body speed",
    unit: "mm/s",
    min: 1,
    max: 60,
    step: 1,
    decimals: 1,
    help: "Largest speed of the body",
    ...option("body_speed", 1000),
  },
  {
    label: "Foot speed",
    name: "Foot speed",
    unit: "mm/s",
    min: 1,
    max: 60,
    step: 1,
    decimals: 1,
    help: "Largest speed of a foot",
    ...option("foot_speed", 1000),
  },
  {
    label: "Motor speed",
    name: "Motor speed",
    unit: "mm/s",
    min: 1,
    max: 60,
    step: 1,
    decimals: 1,
    empty: "free",
    fallback: 20,
    help: "Largest speed of a motor. Leave empty for no limit",
    ...option("motor_speed", 1000),
  },
  {
    label: "Motor acceleration",
    name: "Motor acceleration",
    unit: "mm/s²",
    min: 1,
    max: 1000,
    step: 5,
    decimals: 1,
    empty: "free",
    fallback: 100,
    help: "Largest acceleration of a motor. Leave empty for no limit",
    ...option("motor_acceleration", 1000),
  },
  {
    label: "Friction",
    name: "Friction",
    unit: "",
    min: 0.05,
    max: 2,
    step: 0.05,
    decimals: 2,
    empty: "free",
    fallback: 0.5,
    help:
      "Friction coefficient between feet and ground. If the field is empty, the "
      + "friction forces have no limit",
    ...option("friction"),
  },
];

export const MORE_CHOICES = [
  {
    label: "Orientation",
    name: "Orientation",
    options: [
      ["FB", "FB"],
      ["FBS", "FBS"],
    ],
    help:
      "Forward direction of the gait. FB: the robot walks along the diagonal between x and y, and has "
      + "feet in front and at the back. "
      + "FBS: the robot walks along x, and has feet in front, at the sides and at the back. "
      + "The orientation also changes the names of the feet and the effect of Mirror. "
      + "The step of the gait does not change",
    read: ({ orientation }) => orientation,
    write: (document, value) => ({ ...document, orientation: value }),
  },
  {
    label: "Direction",
    name: "Direction",
    options: [1, 2, 3, 4].map((value) => [value, String(value)]),
    help: "Turns the whole gait in steps of 90°. Direction 1 is the gait as drawn",
    ...property("direction"),
  },
  {
    label: "Ends",
    name: "Boundary",
    options: [
      ["rest", "at rest"],
      ["periodic", "cycle"],
    ],
    help:
      "Start and end of the gait (boundary). With “at rest”, the robot stands still at the start and "
      + "the end. With “cycle”, the end is like the start, so that the gait can repeat",
    ...word("boundary"),
  },
  {
    label: "Turning",
    name: "Turning",
    options: [
      ["steady", "steady"],
      ["return", "at the end"],
    ],
    help:
      "When the body turns. With “steady”, the body turns during the whole gait. "
      + "With “at the end”, the body turns after each iteration, while all feet stand",
    ...word("turning"),
  },
];
