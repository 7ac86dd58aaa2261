/** Builds the panels that are needed later, and the 3D preview, which is slow to load. */

import { mountCheck } from "./check/check.js";
import { mountRobot } from "./robot/robot.js";
import { mountRuns } from "./runs/runs.js";
import { mountSegments } from "./segments/segments.js";
import { mountSequence } from "./sequence/sequence.js";
import { mountSequenceBand } from "./sequence/sequence_band.js";
import { mountSimulate } from "./check/simulate.js";
import { mountStage } from "./stage/stage.js";
import { mountTrialEntry } from "./lab/entry.js";
import { mountNextActs } from "./steps/next_act.js";
import { mountVersions } from "./shell/versions.js";

/**
 * Builds them.
 * @param {{store: object, edits: object, playback: Playback, goTo: Function, gaitTools: object}} page
 * @returns {{segments: () => boolean, sequence: () => boolean, countdown: () => boolean, runs: () => boolean}} what each does on Escape; true
 *   where it did something
 */
export function mountPanels({ store, edits, playback, goTo, gaitTools }) {
  const sequence = mountSequence(store, edits, playback, gaitTools);
  mountSequenceBand(store, playback);
  const segments = mountSegments(store, edits);
  mountCheck(store, edits, goTo);
  mountSimulate(store, (time) => {
    playback.pause();
    playback.setTime(time);
  });
  const countdown = mountRobot(store, edits, playback);
  mountVersions(store, edits);
  const trials = mountTrialEntry(store);
  const runs = mountRuns(store);
  mountNextActs(store);
  mountStage(store, edits, playback);
  return { segments: segments.escape, sequence: sequence.cancel, countdown, runs: () => runs() || trials() };
}
