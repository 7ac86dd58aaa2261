/**
 * The body of the pose under the playhead as a handle over the 3D scene, in a gait for the robot's clock. Dragged on the
 * floor it pins the pose there; the live plan follows, and letting go makes one edit.
 */

import { pinOf, pinWords, wayOf, withPinned } from "../document/pinned_poses.js";
import { byId, h } from "../lib/dom.js";
import { shownDocument, shownPlan } from "../state/store.js";
import { ARROWS, SNAP, floorOf, handle, movable, place, snapped } from "./handle.js";

/** Index of the pose at which the playhead stands; null where it is none that can be moved. */
function poseAt({ times }, time) {
  const index = times.reduce((best, one, at) => (Math.abs(one - time) < Math.abs(times[best] - time) ? at : best), 0);
  return index > 0 && index < times.length - 1 ? index : null;
}

/** Where the body is from an even travel at a pose, m along and to the left. */
function offsetOf({ body }, index) {
  const way = wayOf(body);
  const [x, y] = way.even(index);
  return way.toOffset([body[index][0] - x, body[index][1] - y]);
}

/**
 * What dragging and keys change. A gesture stays with the pose at which it began, though the pose may come to lie at
 * another moment meanwhile.
 */
function poseDrag(store, edits, preview, poseHere) {
  let index = null;
  const pin = (offset) => (document) => withPinned(document, index + 1, offset);
  const begun = () => {
    if (!store.state.gesture) index = poseHere();
    return index === null ? null : shownPlan(store.state);
  };
  return {
    name: () => `Pin pose ${index + 1}`,
    held: () => index,
    begin(pointer) {
      const at = floorOf(preview)?.ofPointer(pointer);
      const plan = at && begun();
      return plan ? { at, from: offsetOf(plan, index), way: wayOf(plan.body) } : null;
    },
    drag(pointer, { at, from, way }, free) {
      const now = floorOf(preview)?.ofPointer(pointer);
      if (!now) return null;
      const moved = way.toOffset([now[0] - at[0], now[1] - at[1]]);
      return pin(from.map((value, axis) => (free ? value + moved[axis] : snapped(value + moved[axis], SNAP))));
    },
    key({ key, shiftKey }) {
      const way = ARROWS[key];
      const plan = way && begun();
      if (!plan) return null;
      const known = pinOf(edits.shown(), index + 1);
      const from = known ? [known.along, known.sideways] : offsetOf(plan, index);
      const moved = wayOf(plan.body).toOffset(way.map((value) => value * SNAP * (shiftKey ? 10 : 1)));
      return pin(from.map((value, axis) => value + moved[axis]));
    },
  };
}

/** Lays the handle over the scene and keeps it where the camera sees the pose. */
export function mountPoseHandle(store, edits, playback, preview) {
  const layer = byId("pose");
  const knob = handle("pose-place", "Pose", "Drag it on the floor to move the body at this pose, which is then pinned; arrow keys move it by 0.5 mm, with Shift by 5 mm");
  const label = h("span", { class: "goal-label" });
  layer.append(label, knob);
  let drawn = null;
  const poseHere = () => {
    const [document, plan] = [shownDocument(store.state), shownPlan(store.state)];
    const isPosed = Boolean(document?.poses) && plan?.times.length > 2 && !store.state.iterate;
    return !isPosed || layer.hidden || playback.playing ? null : poseAt(plan, playback.time);
  };
  const drag = poseDrag(store, edits, preview, poseHere);
  const cancel = movable(knob, store, edits, drag);

  function follow() {
    requestAnimationFrame(follow);
    const plan = shownPlan(store.state);
    const index = "held" in knob.dataset ? drag.held() : poseHere();
    const floor = index === null ? null : floorOf(preview);
    const at = floor?.toStage(plan.body[index]) ?? null;
    layer.toggleAttribute("data-off", at === null);
    if (at === null) { drawn = null; return; }
    const pin = pinOf(shownDocument(store.state), index + 1);
    const key = `${floor.key} ${plan.hash} ${index} ${JSON.stringify(pin)}`;
    if (key === drawn) return;
    drawn = key;
    [knob, label].forEach((element) => place(element, at));
    knob.toggleAttribute("data-pinned", pin !== null);
    label.textContent = `pose ${index + 1}${pin ? ", pinned" : ""}`;
    const [along, sideways] = pin ? [pin.along, pin.sideways] : offsetOf(plan, index);
    knob.setAttribute("aria-valuenow", (sideways * 1000).toFixed(2));
    knob.setAttribute("aria-valuetext", `pose ${index + 1}${pin ? ", pinned" : ""}: ${pinWords({ along, sideways })} of an even travel`);
  }

  window.addEventListener("keydown", (event) => { if (event.key === "Escape") cancel(); }, true);
  follow();
}
