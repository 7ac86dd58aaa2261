/**
 * The body of the pose under the playhead as a handle over the 3D scene, in a gait for the robot's clock.
 * Dragged on the floor it pins the pose there; the live plan follows, and letting go makes one edit.
 */

import { evenTravel, isFarthest, pinOf, pinWords, withPinned } from "../document/pinned_poses.js";
import { byId, h } from "../lib/dom.js";
import { shownDocument, shownPlan } from "../state/store.js";
import { ARROWS, SNAP, floorOf, handle, movable, place, snapped } from "./handle.js";

/** Index of the pose that is nearest to a moment; null where it is none that can be moved. */
function poseAt({ times }, time) {
  const index = times.reduce(
    (best, one, at) => (Math.abs(one - time) < Math.abs(times[best] - time) ? at : best),
    0,
  );
  return index > 0 && index < times.length - 1 ? index : null;
}

/**
 * Where the body is from an even travel at a pose, m along and to the left.
 * @param {Record<string, any>} plan
 * @param {number} index
 */
function offsetOf({ body }, index) {
  const even = evenTravel(body);
  const [x, y] = even.at(index);
  return even.toOffset([body[index][0] - x, body[index][1] - y]);
}

const pin = (index, offset) => (document) => withPinned(document, index + 1, offset);

/**
 * What dragging and keys change.
 * @param {object} parts
 * @param {Record<string, any>} parts.edits
 * @param {Record<string, any>} parts.preview
 * @param {() => Record<string, any>} parts.plan
 * @param {() => number|null} parts.held index of the pose that is being moved
 * @param {() => number|null} parts.take takes up the pose under the playhead
 */
function poseDrag({ edits, preview, plan, held, take }) {
  return {
    name: () => `Pin pose ${held() + 1}`,
    begin(pointer) {
      const at = floorOf(preview)?.ofPointer(pointer);
      const index = at ? take() : null;
      return index === null
        ? null
        : { at, index, from: offsetOf(plan(), index), even: evenTravel(plan().body) };
    },
    drag(pointer, { at, index, from, even }, free) {
      const now = floorOf(preview)?.ofPointer(pointer);
      if (!now) return null;
      const moved = even.toOffset([now[0] - at[0], now[1] - at[1]]);
      return pin(
        index,
        from.map((value, axis) => (free ? value + moved[axis] : snapped(value + moved[axis], SNAP))),
      );
    },
    key({ key, shiftKey }) {
      const arrow = ARROWS[key];
      const index = arrow ? take() : null;
      if (index === null) return null;
      const known = pinOf(edits.shown(), index + 1);
      const from = known ? [known.along, known.sideways] : offsetOf(plan(), index);
      const moved = evenTravel(plan().body).toOffset(
        arrow.map((value) => value * SNAP * (shiftKey ? 10 : 1)),
      );
      return pin(
        index,
        from.map((value, axis) => value + moved[axis]),
      );
    },
  };
}

/** The pose that is being moved: the nearest to the playhead, until somebody moves the playhead. */
function poseUnderHand(store, playback, plan) {
  let index = null;
  let isOwn = false;
  const isPinnable = () => {
    const known = plan();
    return (
      Boolean(shownDocument(store.state)?.poses)
      && known?.poses?.pinnable !== false
      && known?.times.length > 2
      && !store.state.iterate
      && !playback.playing
    );
  };
  playback.addEventListener("time", ({ detail }) => {
    if (!isOwn && detail.cause !== "plan") index = null;
  });
  store.watch(
    ({ selected }) => [selected],
    () => {
      index = null;
    },
  );
  const here = () => {
    if (!isPinnable()) return null;
    return index !== null && index < plan().times.length - 1 ? index : poseAt(plan(), playback.time);
  };
  return {
    here,
    held: () => index,
    take: () => {
      index = here();
      return index;
    },
    /** Moves come to last longer or shorter: the playhead goes along with the pose. */
    follow() {
      const time = here() === null || index === null ? null : plan().times[index];
      if (time === null || Math.abs(time - playback.time) < 1e-6) return;
      isOwn = true;
      playback.setTime(time);
      isOwn = false;
    },
  };
}

function describe({ knob, label }, plan, index, pinned) {
  const name = `pose ${index + 1}${pinned ? ", pinned" : ""}`;
  const [along, sideways] = pinned ? [pinned.along, pinned.sideways] : offsetOf(plan, index);
  label.textContent = pinned && isFarthest(pinned) ? `${name}, at the limit of 30 mm` : name;
  knob.toggleAttribute("data-pinned", pinned !== null);
  knob.setAttribute("aria-valuenow", (sideways * 1000).toFixed(2));
  const offset = pinWords({ along, sideways });
  knob.setAttribute("aria-valuetext", `${name}: ${offset}, compared with a body that moves evenly`);
}

/** Lays the handle over the scene and keeps it where the camera sees the pose. */
export function mountPoseHandle(store, edits, playback, preview) {
  const layer = byId("pose");
  const knob = handle(
    "pose-place",
    "Pose",
    "Drag this handle on the floor to move the body in this pose. "
      + "The pose is then pinned: the search keeps the body at this place. "
      + "The arrow keys move the body by 0.5 mm, with Shift by 5 mm",
  );
  knob.setAttribute("aria-valuemin", "-30");
  knob.setAttribute("aria-valuemax", "30");
  const label = h("span", { class: "goal-label" });
  layer.append(label, knob);
  const plan = () => shownPlan(store.state);
  const pose = poseUnderHand(store, playback, plan);
  const cancel = movable(
    knob,
    store,
    edits,
    poseDrag({ edits, preview, plan, held: pose.held, take: pose.take }),
  );
  let drawn = null;

  function follow() {
    requestAnimationFrame(follow);
    const index = layer.hidden ? null : pose.here();
    const floor = index === null ? null : floorOf(preview);
    const at = floor?.toStage(plan().body[index]) ?? null;
    // What is refused has no motion; while it is dragged on the mark stays where it was.
    if (at === null && store.state.gesture) return;
    layer.toggleAttribute("data-off", at === null);
    if (at === null) {
      drawn = null;
      return;
    }
    pose.follow();
    const pinned = pinOf(shownDocument(store.state), index + 1);
    const key = `${floor.key} ${plan().hash} ${index} ${JSON.stringify(pinned)}`;
    if (key === drawn) return;
    drawn = key;
    [knob, label].forEach((element) => place(element, at));
    describe({ knob, label }, plan(), index, pinned);
  }

  window.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Escape") cancel();
    },
    true,
  );
  follow();
}
