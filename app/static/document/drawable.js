/** Which timelines can be drawn on. */

import { isSequence } from "./sequence_edits.js";

/**
 * A gait as it is saved.
 * @typedef {Record<string, any>} GaitDocument
 */

/**
 * Why a gait's timeline cannot be drawn on, or null where it can.
 * @param {GaitDocument|null|undefined} document
 */
export function whyNotDrawn(document) {
  if (isSequence(document)) {
    return (
      "You cannot draw in the timeline of a sequence. "
      + "Change the gait of a part, then press “update” beside this part in Design."
    );
  }
  if (document?.poses) {
    return (
      "You cannot draw in this timeline, because the studio computes it from the poses of the gait. "
      + "Instead, change foot order, step, cycles or another field in Design."
    );
  }
  return null;
}
