/** Builds the panels that are needed later, and the 3D preview, which is slow to load. */

import { mountCheck } from "./check/check.js";
import { mountFirstSteps } from "./first_steps/first_steps.js";
import { mountRobot } from "./robot/robot.js";
import { mountRuns } from "./runs/runs.js";
import { mountSegments } from "./segments/segments.js";
import { mountSequence } from "./sequence/sequence.js";
import { mountSequenceBand } from "./sequence/sequence_band.js";
import { mountSimulate } from "./check/simulate.js";
import { mountStage } from "./stage/stage.js";
import { attempt } from "./lib/toasts.js";
import { byId } from "./lib/dom.js";
import { mountTrialEntry } from "./lab/entry.js";
import { mountPublishedEntry } from "./published/entry.js";
import { mountNextActs } from "./steps/next_act.js";
import { openStep } from "./steps/steps.js";
import { selectGait } from "./shell/gait_list.js";
import { mountVersions } from "./shell/versions.js";

const ROTATE = "Make a gait that turns the robot on the spot, by as many degrees as you want";

/** The dialogs for a rotation and for the fastest gait, loaded when first opened: by New, one by Jobs too. */
function mountFastest(store, gaitTools) {
  const open = attempt(async (job = null) => {
    const { askFastest } = await import("./fastest/fastest.js");
    const id = await askFastest(store, job);
    if (!id) return;
    await selectGait(store, id);
    openStep("design");
  });
  const rotate = attempt(async () => {
    const { askRotation } = await import("./fastest/rotate.js");
    const id = await askRotation(store);
    if (id) await selectGait(store, id);
  });
  const help =
    "Make a gait that is as fast as the robot's firmware allows. "
    + "The dialog shows the robot's speed for each option";
  gaitTools.addNew({ text: "Rotate…", help: ROTATE, act: rotate });
  gaitTools.addNew({ text: "Fastest gait…", help, act: () => open() });
  store.watch(
    ({ fastestWanted }) => [fastestWanted],
    ({ fastestWanted }) => {
      if (!fastestWanted) return;
      store.set({ fastestWanted: null });
      open(fastestWanted);
    },
  );
}

/** The dialog Atlases, loaded when it is first opened: from the drawer Jobs, and from a job in it. */
function mountAtlases(store) {
  const open = attempt(async (name = null) => {
    const { askAtlas } = await import("./atlas/atlases.js");
    await askAtlas(store, name);
  });
  const button = byId("open-atlases");
  button.disabled = false;
  button.addEventListener("click", () => open());
  store.watch(
    ({ atlasWanted }) => [atlasWanted],
    ({ atlasWanted }) => {
      if (!atlasWanted) return;
      store.set({ atlasWanted: null });
      open(atlasWanted);
    },
  );
}

/**
 * Builds them.
 * @param {{store: import("./state/store.js").Store, edits: import("./state/edits.js").Edits,
 *   playback: import("./preview/playback.js").Playback, goTo: Function,
 *   gaitTools: ReturnType<typeof import("./shell/gait_menu.js").mountGaitTools>}} page
 * @returns {Record<"segments"|"sequence"|"countdown"|"runs", () => boolean>} what each does on Escape; true
 *   where it did something
 */
export function mountPanels({ store, edits, playback, goTo, gaitTools }) {
  const sequence = mountSequence(store, edits, playback, gaitTools);
  mountSequenceBand(store, playback);
  mountFastest(store, gaitTools);
  mountAtlases(store);
  const segments = mountSegments(store, edits);
  mountCheck(store, edits, goTo);
  mountSimulate(store, (time) => {
    playback.pause();
    playback.setTime(time);
  });
  const countdown = mountRobot(store, edits, playback);
  mountVersions(store, edits);
  const trials = mountTrialEntry(store);
  const published = mountPublishedEntry(store);
  const runs = mountRuns(store);
  mountNextActs(store);
  mountFirstSteps(store, playback);
  mountStage(store, edits, playback);
  const drawers = () => runs() || trials() || published();
  return { segments: segments.escape, sequence: sequence.cancel, countdown, runs: drawers };
}
