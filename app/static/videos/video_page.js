/** One video in the panel, with its picture: choose or make a camera setup, then track the feet. */

import { api } from "../api/gaits.js";
import { setupApi, videoApi, videoSource } from "../api/videos.js";
import { setupText } from "../cameras/camera_labels.js";
import { newSetup, openSetup } from "../cameras/camera_setup.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { openStage } from "../pictures/picture_stage.js";
import { jobIsOn } from "../shell/job_list.js";
import { walkFields } from "../trials/trial_form.js";
import { videoFacts } from "./video_rows.js";

const SETUP_HELP =
  "A camera setup describes the lens, the position of the platform in the picture and the "
  + "colours of the feet.";

/** The choice of a setup, with what is missing from it. */
function setupChoice({ setups, chosen, changed, edit, make }) {
  const select = h(
    "select",
    { "aria-label": "Camera setup", title: "Choose the setup of the camera that recorded this video" },
    ...setups.map(({ id, setup }) => h("option", { value: id, text: setup.name })),
    setups.length ? null : h("option", { value: "", text: "none yet" }),
  );
  const state = h("p", { class: "why", role: "status" });
  const change = h("button", { type: "button", class: "link", text: "Change this setup…" });
  const made = h("button", { type: "button", class: "link", text: "New setup…", on: { click: make } });
  const now = () => setups.find(({ id }) => id === select.value) ?? null;
  const show = () => {
    const one = now();
    change.hidden = !one;
    setText(state, one ? `${one.setup.name}, version ${one.revision}: ${setupText(one)}` : SETUP_HELP);
    changed(one);
  };
  select.addEventListener("change", show);
  change.addEventListener("click", () => edit(now()));
  if (setups.some(({ id }) => id === chosen)) select.value = chosen;
  return {
    element: h(
      "div",
      { class: "camera-part" },
      h("label", {}, h("span", { text: "Camera setup" }), select),
      state,
      h("div", { class: "camera-row" }, change, made),
    ),
    now,
    show,
  };
}

function removeButton(video, back) {
  const remove = attempt(async () => {
    await videoApi.remove(video.id);
    back();
    const undo = attempt(async () => {
      await videoApi.restore(video.id);
      back();
    });
    const deleted = `The video “${video.name}” is deleted, but its trials are kept.`;
    toast(deleted, { action: { label: "Undo", act: undo } });
  });
  return h("button", {
    type: "button",
    class: "link",
    text: "Delete",
    "aria-label": "Delete this video",
    on: { click: remove },
  });
}

/**
 * Ways to change a setup and to make one, from the picture that is shown; `again` gets the setup to come back
 * with.
 */
function setupWays(page, video, stage, again) {
  const edit = (answer) =>
    openSetup(page, {
      answer,
      source: stage.source,
      frame: stage.frame,
      back: { text: `Back to ${video.name}`, act: () => again(answer.id) },
    });
  const make = attempt(async () => {
    const isOld = page.begin();
    const answer = await newSetup();
    if (!isOld()) edit(answer);
  });
  return { edit, make };
}

/**
 * The button that tracks the feet with a setup, and the progress; `allow` says anew whether it can be
 * pressed.
 */
function trackPart(page, video, { setup, start }) {
  const button = h("button", { class: "primary", text: "Track the feet" });
  let tracking = false;

  function allow() {
    const one = setup();
    const lack = !one ? "Choose or make a camera setup first." : one.ready ? null : setupText(one);
    const why = tracking ? "The studio is already tracking the feet in this video." : lack;
    setAllowed(button, why, "Find the four feet in every frame and make a trial");
  }

  const progress = trackingPart(page.store, video.id, {
    done: page.one,
    changed: (isOn) => {
      tracking = isOn;
      allow();
    },
  });
  onPress(button, start, (why) => toast(why, { of: "studio" }));
  return { elements: [progress, button], allow };
}

/** What is known of a video, and the ways to its trials. */
function videoParts(video, open) {
  return [
    h("div", { class: "run-line run-title" }, h("b", { text: video.name })),
    h("p", { class: "quiet", text: videoFacts(video) }),
    video.sentence ? h("p", { class: "why", data: { toneText: "caution" }, text: video.sentence }) : null,
    ...video.trials.map(({ id, name }) =>
      h("button", {
        type: "button",
        class: "link",
        text: video.trials.length > 1 ? `Open its trial “${name}”` : "Open its trial",
        title: name,
        on: { click: () => open(id) },
      }),
    ),
  ];
}

function fileLine(video, back) {
  const href = `/api/videos/${encodeURIComponent(video.id)}/file`;
  const link = h("a", { href, download: "", text: "Download the file" });
  return h("div", { class: "run-files" }, link, removeButton(video, back));
}

/**
 * Opens a video in the panel.
 * @param {Record<string, any>} page of the trials' panel: `store`, `show`, `one` opens a trial
 * @param {import("./video_rows.js").Video} video
 * @param {{back: () => void, chosen?: string, frame?: number, kept?: Record<string, any>}} ways `chosen` is
 *   the setup that was chosen before, `kept` what was written in the form
 */
export async function openVideo(page, video, { back, chosen = "", frame = 0, kept = {} }) {
  const isOld = page.begin();
  const { setups } = await setupApi.list();
  if (isOld()) return;
  const stage = openStage(videoSource(video), frame);
  const name = h("input", {
    "aria-label": "Trial name",
    required: true,
    maxlength: "120",
    value: kept.name ?? video.name.replace(/\.\w+$/, ""),
  });
  const walk = walkFields(page.store, { ...kept, run: kept.run ?? video.run });
  const words = () => ({ name: name.value.trim(), ...walk.values() });
  const again = (setup) => openVideo(page, video, { back, chosen: setup, frame: stage.frame, kept: words() });
  const choice = setupChoice({
    setups,
    chosen,
    ...setupWays(page, video, stage, again),
    changed: () => tracking.allow(),
  });
  const begin = attempt(() =>
    videoApi.track(video.id, { setup: choice.now().id, note: "", gait: "", run: "", ...words() }),
  );
  const tracking = trackPart(page, video, {
    setup: choice.now,
    start: () => {
      if (form.reportValidity()) begin();
    },
  });
  const form = h(
    "form",
    { class: "trial-form", on: { submit: (event) => event.preventDefault() } },
    h("button", { type: "button", class: "link", text: "All videos", on: { click: back } }),
    ...videoParts(video, page.one),
    choice.element,
    h("label", {}, h("span", { text: "Trial name" }), name),
    ...walk.labels,
    ...tracking.elements,
    fileLine(video, back),
  );
  page.show(form, () => stage.close());
  choice.show();
}

const progressText = ({ state, share, sentence }) =>
  state === "running" ? `Tracking, ${fixed((share ?? 0) * 100, 0)} %` : sentence || state;

/** The newest tracking of a video. */
const jobOf = ({ jobs }, video) => jobs.find((job) => job.kind === "track" && job.video === video) ?? null;

/**
 * Builds the progress of a video's tracking; hidden while there was none.
 * @param {import("../state/store.js").Store} store
 * @param {string} video
 * @param {{done: (trial: string) => void, changed: (isOn: boolean) => void}} acts `done` is called once, for
 *   a tracking that was begun or was under way here
 * @returns {HTMLElement}
 */
function trackingPart(store, video, { done, changed }) {
  const bar = h("i");
  const words = h("p", { class: "number", role: "status", "aria-label": "Tracking" });
  const cancel = h("button", { type: "button", text: "Cancel", "aria-label": "Cancel tracking" });
  const progress = h("div", { class: "progress" }, bar);
  const element = h("div", { class: "video-going", hidden: true }, progress, words, cancel);
  let followed = null;

  cancel.addEventListener(
    "click",
    attempt(() => api.cancelJob(followed)),
  );
  store.watch(
    ({ jobs }) => [jobOf({ jobs }, video)],
    (state) => {
      const job = jobOf(state, video);
      if (!job) return;
      const on = jobIsOn(job);
      const ended = followed === job.id && !on;
      if (on) followed = job.id;
      element.dataset.tracks = on ? video : "";
      element.hidden = !on && !ended && job.state !== "failed";
      [progress.hidden, cancel.hidden] = [!on, !on];
      bar.style.transform = `scaleX(${job.share ?? 0})`;
      setText(words, progressText(job));
      changed(on);
      if (!ended) return;
      followed = null;
      if (job.state === "done" && job.result?.trial && element.isConnected) done(job.result.trial);
    },
  );
  return element;
}
