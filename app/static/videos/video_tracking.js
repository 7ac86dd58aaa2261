/** The tracking of a video as a job: its progress, Cancel, and the trial that it ends in. */

import { api } from "../api/gaits.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { jobIsOn } from "../shell/job_list.js";
import { attempt } from "../lib/toasts.js";

/** The newest tracking of a video. */
const jobOf = ({ jobs }, video) => jobs.find((job) => job.kind === "track" && job.video === video) ?? null;

/**
 * Builds the progress of a video's tracking; hidden while there was none.
 * @param {object} store
 * @param {string} video
 * @param {{done: (trial: string) => void, changed: (isOn: boolean) => void}} acts `done` is called once, for a tracking that was
 *   begun or was under way here
 * @returns {HTMLElement}
 */
export function trackingPart(store, video, { done, changed }) {
  const bar = h("i");
  const words = h("p", { class: "number", role: "status", "aria-label": "Tracking" });
  const cancel = h("button", { type: "button", text: "Cancel", "aria-label": "Cancel tracking" });
  const progress = h("div", { class: "progress" }, bar);
  const element = h("div", { class: "video-going", hidden: true }, progress, words, cancel);
  let followed = null;

  cancel.addEventListener("click", attempt(() => api.cancelJob(followed)));
  store.watch(({ jobs }) => [jobOf({ jobs }, video)], (state) => {
    const job = jobOf(state, video);
    if (!job) return;
    const on = jobIsOn(job);
    const ended = followed === job.id && !on;
    if (on) followed = job.id;
    element.dataset.tracks = on ? video : "";
    element.hidden = !on && !ended && job.state !== "failed";
    [progress.hidden, cancel.hidden] = [!on, !on];
    bar.style.transform = `scaleX(${job.share ?? 0})`;
    setText(words, job.state === "running" ? `Tracking, ${fixed((job.share ?? 0) * 100, 0)} %` : job.sentence || job.state);
    changed(on);
    if (!ended) return;
    followed = null;
    if (job.state === "done" && job.result?.trial && element.isConnected) done(job.result.trial);
  });
  return element;
}
