/** Which timelines can be drawn on. */

import { isSequence } from "./sequence_edits.js";

/** Why a gait's timeline cannot be drawn on, or null where it can. */
export function whyNotDrawn(document) {
  if (isSequence(document)) {
    return "The timeline of a sequence follows from its parts. "
      + "Change the gait of a part, then press “take over” at this part.";
  }
  if (document?.poses) {
    return "You cannot draw in this timeline, because it follows from the poses of the gait. "
      + "Change foot order, step, cycles or another field in Design instead.";
  }
  return null;
}
