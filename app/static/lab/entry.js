/** The buttons that open the Trials panel, which is loaded when it is first opened. */

import { byId, h } from "../lib/dom.js";
import { attempt, report } from "../lib/toasts.js";

const HELP = "What the real robot did: foot tracks beside their plan, iteration by iteration, and gaits compared";

/** The cameras under the robot's section: a list that opens, and is read then. */
function cameraGroup(store, open) {
  const element = h("details", { class: "more" }, h("summary", { text: "Cameras" }));
  let list = null;
  element.addEventListener("toggle", attempt(async () => {
    if (!element.open) return;
    if (!list) {
      const { cameraList } = await import("../cameras/camera_list.js");
      list = cameraList(store, { watch: (camera) => open({ camera }), setUp: (setup) => open({ setup }) });
      element.append(list.element);
    }
    list.refresh();
  }));
  return element;
}

/**
 * Builds the links under the runs and under the robot.
 * @param {object} store
 * @param {() => void} opening called when the panel opens
 * @returns {() => boolean} what Esc does
 */
export function mountTrialEntry(store, opening) {
  let [loading, panel] = [null, null];

  async function open(wanted = null) {
    try {
      loading ??= import("./panel.js").then(({ mountTrials }) => mountTrials(store));
      panel = await loading;
      opening();
      if (wanted) panel.go(wanted);
      else panel.open();
    } catch (error) {
      loading = null;
      report(error);
    }
  }

  const link = (text) => h("button", { class: "link", text, title: HELP, on: { click: () => open() } });
  byId("jobs").parentElement.append(h("div", { class: "runs-head" }, h("h2", { text: "Trials" }), link("All trials")));
  const below = link("Trials of the real robot");
  below.classList.add("runs-way");
  byId("robot").append(below, cameraGroup(store, open));
  store.watch(({ trialWanted }) => [trialWanted], ({ trialWanted }) => {
    if (!trialWanted) return;
    store.set({ trialWanted: null });
    open(trialWanted);
  });
  store.watch(({ trialMade }) => [trialMade], attempt(async ({ trialMade }) => {
    if (trialMade?.id) (await import("../cameras/camera_recordings.js")).announceTrial(trialMade.id, open);
  }));
  store.watch(({ videoChanged }) => [videoChanged], attempt(async ({ videoChanged }) => {
    if (videoChanged?.run && videoChanged.state === "kept" && videoChanged.sentence) (await import("../cameras/camera_recordings.js")).announceRecording(videoChanged, open);
  }));
  return () => Boolean(panel?.leave());
}
