/** The list of jobs: state, iteration, violation, cancel. A job's end is announced; the focus stays. */

import { api } from "../api/gaits.js";
import { byId, h, setText } from "../lib/dom.js";
import { clockTime, compact, fixed, seconds } from "../lib/format.js";
import { announce, attempt, toast } from "../lib/toasts.js";

const TONES = {
  queued: "quiet",
  running: "accent",
  cancelling: "caution",
  done: "good",
  infeasible: "caution",
  failed: "bad",
  cancelled: "quiet",
  interrupted: "caution",
};
const SHOWN = 12;

export const jobIsOn = (job) => ["queued", "running", "cancelling"].includes(job.state);
export const jobTone = (job) => TONES[job.state] ?? "quiet";

/** Whether a finished job's answer belongs to an older version of its gait. */
export const isOlder = (job) =>
  Boolean(job) && ["done", "infeasible", "failed"].includes(job.state) && job.fresh === false;

/** The optimisation whose curve and explanation are shown: the one picked, else the newest of this gait. */
export function jobOf({ jobs, shownJob, selected }) {
  const own = jobs.filter((job) => job.gait === selected && job.kind === "optimise");
  return own.find((job) => job.id === shownJob) ?? own[0] ?? null;
}

const isTiming = (job) => job.kind === "timing";
const isSimulation = (job) => job.kind === "simulate";
const isTracking = (job) => job.kind === "track";
const isSearch = (job) => job.kind === "fastest";
const isAtlas = (job) => job.kind === "atlas";
const NAMES = { timing: "Fastest timing of", simulate: "Simulate" };

/** What a job is called in the list: by its video, its robot or its atlas, and all others by their gait. */
function titleOf(job) {
  if (isTracking(job)) return `Tracking ${job.video_name ?? job.gait_name}`;
  if (isAtlas(job)) return `Atlas “${job.atlas}”`;
  return isSearch(job) ? `Fastest gait, ${job.gait_name}` : job.gait_name;
}
const spoken = (job) =>
  isTracking(job) || isSearch(job) || isAtlas(job)
    ? titleOf(job)
    : `${NAMES[job.kind] ?? "Optimise"} ${job.gait_name}`;
function titleHelp(job) {
  if (isSearch(job)) return "Open this search and its table of results";
  if (isAtlas(job)) return "Open the list of atlases with their maps. There you can also continue an atlas";
  if (isSimulation(job)) return "Show the gait of this job and its simulation";
  if (isTiming(job)) return "Show the gait of this job";
  if (!isTracking(job)) return "Show the convergence curve and the result of this optimisation";
  return job.result?.trial ? "Open the trial of this video" : "Open this video";
}

/** What a job has done so far, where its share is known. */
const SHARES = { track: "tracked", simulate: "simulated" };

function figures(job) {
  if (SHARES[job.kind] && job.state === "running")
    return `${SHARES[job.kind]} ${fixed((job.share ?? 0) * 100, 0)} %`;
  if (SHARES[job.kind] || isSearch(job) || isAtlas(job)) return job.sentence;
  const last = job.progress?.at(-1);
  if (jobIsOn(job))
    return last ? `iteration ${last.iteration} · violation ${compact(last.primal)}` : job.sentence;
  if (job.state !== "done" || !job.result) return job.sentence;
  return isTiming(job)
    ? `fastest ${seconds(job.result.total_seconds)} s, drawn ${seconds(job.result.drawn_seconds)} s`
    : `${job.result.iterations} iterations · ${seconds(job.result.solve_seconds)} s`;
}

function item(id, picked) {
  const title = h("button", { class: "link" });
  const dot = h("span", { class: "dot" });
  const word = h("span", { class: "word" });
  const text = h("p");
  const when = h("span");
  const cancel = h("button", {
    text: "Cancel",
    "aria-label": "Cancel job",
    on: { click: attempt(() => api.cancelJob(id)) },
  });
  title.addEventListener("click", () => picked(id));
  const element = h(
    "li",
    { class: "job" },
    h("div", { class: "head" }, dot, title, word),
    text,
    h("div", { class: "foot-line" }, when, cancel),
  );
  return { element, title, dot, word, text, when, cancel };
}

/** Opens what a job is about; `showGait` shows a gait. */
async function pick(store, id, showGait) {
  const job = store.state.jobs.find((one) => one.id === id);
  if (isTracking(job))
    return store.set({ trialWanted: job.result?.trial ? { trial: job.result.trial } : { video: job.video } });
  if (isSearch(job)) return store.set({ fastestWanted: job.id });
  if (isAtlas(job)) return store.set({ atlasWanted: job.atlas });
  if (store.state.gaits.some((gait) => gait.id === job.gait)) await showGait(job.gait);
  if (!isSimulation(job)) store.set({ shownJob: id });
  byId(isSimulation(job) ? "tab-simulate" : "tab-design").click();
  return undefined;
}

function show(part, job, shown) {
  setText(part.title, titleOf(job));
  part.title.title = titleHelp(job);
  part.dot.dataset.tone = jobTone(job);
  setText(part.word, job.state);
  part.word.dataset.toneText = jobTone(job);
  setText(part.text, figures(job));
  part.text.title = job.sentence;
  const stale = isOlder(job);
  part.when.className = stale ? "stale" : "";
  setText(part.when, stale ? "older version of the gait" : clockTime(job.created));
  part.cancel.hidden = !jobIsOn(job);
  part.cancel.toggleAttribute("disabled", job.state === "cancelling");
  part.element.toggleAttribute("data-shown", shown);
}

/** Offers the trial of a tracking job if its video's page is not open. */
function offerTrial(store, job) {
  if (document.querySelector(`[data-tracks="${job.video}"]`)) return;
  const act = () => store.set({ trialWanted: { trial: job.result.trial } });
  const done = `${titleOf(job)} is done. The studio has made a new trial from this video.`;
  toast(done, { action: { label: "Open the trial", act } });
}

function announceEnded(store, before, jobs) {
  for (const job of jobs) {
    const known = before.get(job.id);
    if (!known || !jobIsOn(known) || jobIsOn(job)) continue;
    announce(`${spoken(job)}: ${job.state}. ${job.sentence}`);
    if (isTracking(job) && job.result?.trial) offerTrial(store, job);
  }
  return new Map(jobs.map((job) => [job.id, job]));
}

/**
 * Builds the list and keeps it current.
 * @param {import("../state/store.js").Store} store
 * @param {(id: string) => Promise<void>} showGait
 */
export function mountJobs(store, showGait) {
  const list = byId("jobs");
  const parts = new Map();
  let before = new Map();
  store.watch(
    ({ jobs, shownJob, selected }) => [jobs, shownJob, selected],
    (state) => {
      before = announceEnded(store, before, state.jobs);
      const shown = jobOf(state);
      const visible = state.jobs.slice(0, SHOWN);
      const kept = new Set(visible.map(({ id }) => id));
      for (const [id, part] of parts)
        if (!kept.has(id)) {
          part.element.remove();
          parts.delete(id);
        }
      visible.forEach((job, index) => {
        if (!parts.has(job.id))
          parts.set(
            job.id,
            item(job.id, (id) => pick(store, id, showGait)),
          );
        const part = parts.get(job.id);
        show(part, job, job === shown);
        if (list.children[index] !== part.element)
          list.insertBefore(part.element, list.children[index] ?? null);
      });
      byId("jobs-empty").hidden = visible.length > 0;
    },
  );
}
