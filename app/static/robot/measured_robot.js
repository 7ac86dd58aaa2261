/**
 * While a plan is carried out the 3D view shows the robot by its measured strokes, and says so with their
 * age; else the plan, or what is grey instead.
 */

import { api } from "../api/gaits.js";
import { byId, h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { latestOnly } from "../lib/latest_only.js";
import { planIsOn } from "../state/store.js";
import { GREY, greyOf, isStuck } from "../state/worked_plan.js";

const TICK_MS = 200;

/** Whether the robot walks the gait that is shown. */
const isShown = ({ robot, selected, connected }) =>
  connected && planIsOn(robot) && robot.run.phase === "streaming" && robot.run.gait === selected;

/** Follows the robot. */
export function mountMeasuredRobot(store, preview) {
  const badge = byId("badge");
  const [word, age] = [h("b"), h("span", { class: "quiet" })];
  badge.replaceChildren(word, age);
  let measuredAt = null;

  function show() {
    const isMeasured = measuredAt !== null;
    badge.toggleAttribute("data-measured", isMeasured);
    const isBad = !isMeasured && isStuck(store.state);
    badge.toggleAttribute("data-bad", isBad);
    setText(
      word,
      isMeasured
        ? "Robot, measured"
        : store.state.iterate
          ? store.state.iterate.pattern
            ? "Pattern"
            : "An iteration"
          : isBad
            ? "No motion"
            : "Plan",
    );
    setText(
      age,
      isMeasured
        ? `${fixed((performance.now() - measuredAt) / 1000)} s ago`
        : isBad
          ? (GREY[greyOf(store.state)]?.stage ?? "")
          : "",
    );
  }

  const offer = latestOnly(async (at) => {
    let poses = null;
    try {
      poses = await api.measuredPoses();
    } catch {
      // The run has ended, or its strokes are not known: the plan is shown, and the badge says so.
    }
    const isOn = poses !== null && isShown(store.state);
    preview.setMeasured(isOn ? poses : null);
    measuredAt = isOn ? at : null;
    show();
  });

  store.watch(
    (state) => [isShown(state), state.robot?.strokes_mm, state.robot?.run?.reached],
    (state) => {
      if (isShown(state) && state.robot.strokes_mm) offer(performance.now());
      else if (measuredAt !== null) {
        measuredAt = null;
        preview.setMeasured(null);
        show();
      }
    },
  );
  store.watch((state) => [state.iterate, isStuck(state), greyOf(state)], show);
  setInterval(() => {
    if (measuredAt !== null) show();
  }, TICK_MS);
}
