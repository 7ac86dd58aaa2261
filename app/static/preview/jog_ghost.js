/** The jog target as a ghost robot in 3D, placed where the shown plan has its body at the playhead. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { shownPlan } from "../state/store.js";

const KIND = "jog";
const ORIGIN = { x: 0, y: 0, heading: 0 };

/** Where the plan's body is at a time: at the knot before it. */
function placeAt(plan, time) {
  const knot = plan?.times.findLastIndex((one) => one <= time + 1e-6) ?? -1;
  if (knot < 0) return ORIGIN;
  const [x, y] = plan.body[knot];
  return { x, y, heading: plan.heading[knot] };
}

/** The place after steps of the body, which go along its own axes. */
function stepped({ x, y, heading }, steps) {
  const along = (axis) =>
    steps
      .filter((step) => step.part === "body" && step.axis === axis)
      .reduce((sum, step) => sum + step.by_mm / 1000, 0);
  const [forwards, left] = [along("x"), along("y")];
  const [cosine, sine] = [Math.cos(heading), Math.sin(heading)];
  return { x: x + cosine * forwards - sine * left, y: y + sine * forwards + cosine * left, heading };
}

/** Follows the target. */
export function mountJogGhost(store, preview, playback) {
  let shown = null;
  const offer = latestOnly(async ({ target, key }) => {
    let poses = null;
    try {
      poses = await api.jogGhost(target);
    } catch {
      // The robot cannot go there: the panel says why, and there is nothing to be drawn.
    }
    if (shown === key) preview.setGhost(KIND, poses);
  });
  const follow = () => {
    const { jog } = store.state;
    const target = jog?.target_mm
      ? {
          robot: jog.robot,
          steps: [],
          from_mm: jog.target_mm,
          ...stepped(placeAt(shownPlan(store.state), playback.time), jog.steps),
        }
      : null;
    const key = target && JSON.stringify(target);
    if (key === shown) return;
    shown = key;
    if (target) offer({ target, key });
    else preview.setGhost(KIND, null);
  };
  store.watch((state) => [state.jog, shownPlan(state)], follow);
  playback.addEventListener("time", follow);
}
