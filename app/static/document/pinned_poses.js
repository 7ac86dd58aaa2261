/**
 * Pinned poses of a gait for the robot's clock, whose body position a person has fixed. A position is an
 * offset from where the body would be if it moved evenly, the same way at every pose, so that it stays
 * meaningful when the step changes.
 */

import { fixed } from "../lib/format.js";

/** @typedef {import("./drawable.js").GaitDocument} GaitDocument */
/** @typedef {{pose: number, along: number, sideways: number}} Pin m along the way and to its left */

/** Farthest that a body may be put from there along either axis, m. */
const FARTHEST = 0.03;

/** Whether a pinned pose is as far away as it can be. @param {Pick<Pin, "along"|"sideways">} pin */
export const isFarthest = ({ along, sideways }) =>
  [along, sideways].some((value) => Math.abs(value) >= FARTHEST);

/** @param {number} value */
const within = (value) => Math.min(Math.max(value, -FARTHEST), FARTHEST);

/** @param {number} metres */
const distance = (metres) => `${fixed(Math.abs(metres) * 1000)} mm`;

/** The pinned poses of a document. @param {GaitDocument} document @returns {Pin[]} */
export const pinnedOf = ({ poses }) => poses?.pinned ?? [];

/**
 * One of them, by its number counted from 1; null where it is not pinned.
 * @param {GaitDocument} document
 * @param {number} pose
 */
export const pinOf = (document, pose) => pinnedOf(document).find((pin) => pin.pose === pose) ?? null;

/**
 * The document with a pose pinned, m along the way and to its left.
 * @param {GaitDocument} document
 * @param {number} pose
 * @param {number[]} offset
 */
export function withPinned(document, pose, [along, sideways]) {
  const others = pinnedOf(document).filter((pin) => pin.pose !== pose);
  const pinned = [...others, { pose, along: within(along), sideways: within(sideways) }].sort(
    (one, other) => one.pose - other.pose,
  );
  return { ...document, poses: { ...document.poses, pinned } };
}

/** The document with a pose let go. @param {GaitDocument} document @param {number} pose */
export function withoutPinned(document, pose) {
  return {
    ...document,
    poses: { ...document.poses, pinned: pinnedOf(document).filter((pin) => pin.pose !== pose) },
  };
}

/**
 * An even travel of a plan's body.
 * @param {number[][]} bodies the body's place at each pose, m
 * @returns {{at: (index: number) => number[], toOffset: (difference: number[]) => number[]}} `at` is where
 *   it has the body at a pose, `toOffset` turns a difference in x and y into [along, sideways]
 */
export function evenTravel(bodies) {
  const [first, last] = [bodies[0], bodies[bodies.length - 1]];
  const [dx, dy] = [last[0] - first[0], last[1] - first[1]];
  const length = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / length, dy / length];
  return {
    at: (index) => [
      first[0] + (dx * index) / (bodies.length - 1),
      first[1] + (dy * index) / (bodies.length - 1),
    ],
    toOffset: ([x, y]) => [x * ux + y * uy, y * ux - x * uy],
  };
}

/** Where a pinned pose is, for a person. @param {Pick<Pin, "along"|"sideways">} pin */
export const pinWords = ({ along, sideways }) =>
  `${distance(along)} ${along < 0 ? "behind" : "ahead"}, `
  + `${distance(sideways)} to the ${sideways < 0 ? "right" : "left"}`;
