/** Appends the pose of a jog's target to the segment table of the shown gait. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed } from "../lib/dom.js";
import { isSequence } from "../document/sequence_edits.js";
import { segmentDraftOf } from "../state/segment_draft.js";
import { shownDocument } from "../state/store.js";
import { attempt, toast } from "../lib/toasts.js";

const HELP = "Adds a segment to the segment table in which every foot goes to the target, or to where the robot stands; Undo takes it back";

/** Why the pose cannot be taken; null where it can. */
function whyNot(state) {
  const document = shownDocument(state);
  if (!document) return "No gait is selected.";
  if (isSequence(document)) return "A sequence follows its parts. Choose one of its gaits.";
  if (!document.segment_table) return "This gait has no segment table. Make one under Segments, or choose a gait made by hand.";
  if (segmentDraftOf(state).steps.length) return "The segment table does not fit together yet. Mend it under Segments first.";
  return state.jog?.pose_mm ? null : "The target cannot be reached, so there is no pose to take.";
}

/** Builds the button; `edits` makes the change an edit of the gait. */
export function poseToSegment(store, edits) {
  const button = h("button", { class: "wide", text: "Take this pose as a waypoint" });
  const take = attempt(async () => {
    const [document, { selected: gait }] = [shownDocument(store.state), store.state];
    const { table, name, segment, sentences } = await api.poseTable({ document, strokes_mm: store.state.jog.pose_mm });
    edits.edit((now) => ({ ...now, segment_table: table }), `Take ${name} as segment ${segment}`, { drawing: true, gait });
    toast([`${name} is segment ${segment} of the segment table.`, ...sentences].join(" "), { of: "studio" });
  });
  onPress(button, take, (why) => toast(why));
  store.watch((state) => [state.view, state.pending, state.gesture, state.segmentDrafts, state.jog], (state) => setAllowed(button, whyNot(state), HELP));
  return button;
}
