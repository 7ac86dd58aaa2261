/** The step of a gait: the body's displacement in an iteration, in the world's axes and along its heading. */

/** @typedef {import("./drawable.js").GaitDocument} GaitDocument */

const HALF_TURN = 180;

/** [x, y] turned by quarter turns. @param {number[]} xy @param {number} quarters */
function turned([x, y], quarters) {
  return [
    [x, y],
    [-y, x],
    [-x, -y],
    [y, -x],
  ][((quarters % 4) + 4) % 4];
}

/** Body travel an iteration, m. @param {GaitDocument} document */
export const stepLength = ({ step }) => Math.hypot(step[0], step[1]);

/** Whether the body stays where it is, and at most turns. @param {GaitDocument} document */
export const isOnTheSpot = (document) => stepLength(document) === 0;

/** Body travel an iteration in the world's axes, [x, y] in m. @param {GaitDocument} document */
export const worldStep = ({ step, direction }) => turned([step[0], step[1]], direction - 1);

/** The document with that travel. @param {GaitDocument} document @param {number[]} xy */
export function withWorldStep(document, xy) {
  const [dx, dy] = turned(xy, 1 - document.direction);
  return { ...document, step: [dx, dy, document.step[2]] };
}

/**
 * The document with a longer or shorter step the same way; one of no length gets the gait's own heading.
 * @param {GaitDocument} document
 * @param {number} metres
 */
export function withStepLength(document, metres) {
  const length = stepLength(document);
  const own = document.orientation === "FB" ? [Math.SQRT1_2, Math.SQRT1_2] : [1, 0];
  const [x, y] = length > 1e-9 ? [document.step[0] / length, document.step[1] / length] : own;
  return { ...document, step: [x * metres, y * metres, document.step[2]] };
}

/** Turn of the body an iteration, degrees. @param {GaitDocument} document */
export const stepTurn = ({ step }) => (step[2] * HALF_TURN) / Math.PI;

/** The document with that turn. @param {GaitDocument} document @param {number} degrees */
export const withTurn = (document, degrees) => ({
  ...document,
  step: [document.step[0], document.step[1], (degrees * Math.PI) / HALF_TURN],
});
