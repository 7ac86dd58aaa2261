/** Recordings of a run by cameras: the trial made from them, and their videos. */

import { h } from "../lib/dom.js";
import { attempt, toast } from "../lib/toasts.js";
import { trialApi } from "../api/trials.js";
import { distanceText } from "../trials/trial_words.js";
import { videoApi } from "../api/videos.js";
import "../pictures/picture_style.js";

/** Announces a trial made from a run's recording. A person who makes another trial knows of it. */
export const announceTrial = attempt(async (id, open) => {
  const trial = await trialApi.read(id);
  if (!trial.run || !trial.source?.camera) return;
  const walked =
    `The robot walked ${distanceText(trial.figures.net_distance)} cm. `
    + `The wanted distance was ${distanceText(trial.expected_cm)} cm.`;
  const recorded = `A camera recorded the run of “${trial.gait_name}”.`;
  const sentences = [recorded, walked, trial.plan?.astray_sentence];
  toast(sentences.filter(Boolean).join(" "), {
    action: { label: "Trial of this run", act: () => open({ trial: id }) },
  });
});

/** Announces a note on a recording once, such as why there is no trial of it. */
const announced = new Set();
export function announceRecording({ id, name, sentence }, open) {
  if (announced.has(id)) return;
  announced.add(id);
  toast(`Recording of ${name}: ${sentence}`, {
    action: { label: "Open the recording", act: () => open({ video: id }) },
  });
}

/**
 * A line with the trials and recordings of a run; empty where there are none.
 * @param {string} run
 * @param {(wanted: {trial: string}|{video: string}) => void} open
 */
export function recordingLine(run, open) {
  const line = h("div", { class: "run-recorded", role: "group", "aria-label": "Recordings of this run" });
  const link = (text, wanted, title) =>
    h("button", { class: "link", text, title, on: { click: () => open(wanted) } });
  attempt(async () => {
    const [{ trials }, videos] = await Promise.all([trialApi.list(), videoApi.ofRun(run)]);
    const own = trials.filter((trial) => trial.run === run);
    line.append(
      ...own.map(({ id, name }) =>
        link(own.length > 1 ? `Trial of this run: ${name}` : "Trial of this run", { trial: id }, name),
      ),
      ...videos
        .filter(({ state }) => state !== "removed")
        .map(({ id, camera }) =>
          link(
            `Recording of ${camera}`,
            { video: id },
            "Open the video that this camera recorded of the run",
          ),
        ),
      ...videos
        .filter(({ sentence }) => sentence)
        .map(({ camera, sentence }) => h("p", { class: "why", text: `${camera}: ${sentence}` })),
    );
  })();
  return line;
}
