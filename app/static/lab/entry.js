/** The drawer of trials, which is loaded when it is first opened. */

import { byId, h } from "../lib/dom.js";
import { attempt, report } from "../lib/toasts.js";
import { drawerIsOpen, onDrawer, openDrawer } from "../shell/drawers.js";

/** The cameras under the robot's section: a list that opens, and is read then. */
function cameraGroup(store, open) {
  const element = h("details", { class: "more after-run" }, h("summary", { text: "Cameras" }));
  let list = null;
  element.addEventListener(
    "toggle",
    attempt(async () => {
      if (!element.open) return;
      if (!list) {
        const { cameraList } = await import("../cameras/camera_list.js");
        list = cameraList(store, { watch: (camera) => open({ camera }), setUp: (setup) => open({ setup }) });
        element.append(list.element);
      }
      list.refresh();
    }),
  );
  return element;
}

/**
 * Fills the drawer of trials when it is opened, and builds the link under the robot.
 * @param {import("../state/store.js").Store} store
 * @returns {() => boolean} what Esc does
 */
export function mountTrialEntry(store) {
  let [loading, panel, isGoing] = [null, null, false];

  async function open(wanted = null) {
    isGoing = true;
    openDrawer("trials");
    isGoing = false;
    try {
      loading ??= import("./panel.js").then(({ mountTrials }) => mountTrials(store));
      panel = await loading;
      if (!drawerIsOpen("trials")) return;
      if (wanted) panel.go(wanted);
      else panel.open();
    } catch (error) {
      loading = null;
      report(error);
    }
  }

  onDrawer("trials", {
    opened: () => {
      if (!isGoing) open();
    },
    closed: () => panel?.closed(),
  });
  byId("robot").append(cameraGroup(store, open));
  store.watch(
    ({ trialWanted }) => [trialWanted],
    ({ trialWanted }) => {
      if (!trialWanted) return;
      store.set({ trialWanted: null });
      open(trialWanted);
    },
  );
  store.watch(
    ({ trialMade }) => [trialMade],
    attempt(async ({ trialMade }) => {
      if (trialMade?.id) (await import("../cameras/camera_recordings.js")).announceTrial(trialMade.id, open);
    }),
  );
  store.watch(
    ({ videoChanged }) => [videoChanged],
    attempt(async ({ videoChanged }) => {
      if (videoChanged?.run && videoChanged.state === "kept" && videoChanged.sentence)
        (await import("../cameras/camera_recordings.js")).announceRecording(videoChanged, open);
    }),
  );
  return () => Boolean(panel?.leave());
}
