/** Which timelines can be drawn on. */

import { isSequence } from "./sequence_edits.js";

/** Why a gait's timeline cannot be drawn on, or null where it can. */
export function whyNotDrawn(document) {
  if (isSequence(document)) return "The timeline of a sequence follows from its parts. Change the gait that a part comes from, and take it over.";
  if (document?.poses) return "This timeline follows from the poses. Change foot order, step, cycles or another field under Optimise.";
  return null;
}
