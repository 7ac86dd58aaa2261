/** Steps by hand as the page keeps them: what can be stepped, and steps of the same thing added up. */

/** What can be moved, with its name. */
export const PARTS = [
  ["motor", "Motor"],
  ["foot", "Foot"],
  ["body", "Body"],
];

/** Longest single step, mm. */
const LONGEST_MM = 20;

const AXES = ["x", "y", "z"];
const NOTHING_MM = 1e-9;

const isOf = (one, other) => ["part", "foot", "motor", "axis"].every((key) => one[key] === other[key]);

/** The three things that can be stepped of a part: motors of a foot, or axes of a foot or the body. */
export function handlesOf({ part, foot }) {
  if (part === "motor") return [1, 2, 3].map((motor) => ({ part, foot, motor, axis: null }));
  return AXES.map((axis) => ({ part, foot: part === "foot" ? foot : null, motor: null, axis }));
}

/** Steps with one more: it is added to the last of the same thing; what adds up to nothing is left out. */
export function withStep(steps, handle, by) {
  const before = steps.find((one) => isOf(one, handle) && Math.abs(one.by_mm + by) <= LONGEST_MM);
  if (!before) return [...steps, { ...handle, by_mm: by }];
  const sum = before.by_mm + by;
  return steps.flatMap((one) =>
    one !== before ? [one] : Math.abs(sum) < NOTHING_MM ? [] : [{ ...one, by_mm: sum }],
  );
}

/** A name for a person: "Foot 2, x", "Motor 3 of foot 2", "Body, height". */
export function handleName({ part, foot, motor, axis }) {
  if (part === "motor") return `Motor ${motor} of foot ${foot}`;
  if (part === "foot") return `Foot ${foot}, ${axis}`;
  return axis === "z" ? "Body, height" : `Body, ${axis}`;
}

/** The same inside its group. */
export function shortName({ part, motor, axis }) {
  if (part === "motor") return `Motor ${motor}`;
  if (axis === "z") return part === "body" ? "height" : "z, up";
  return axis;
}
