/** Trials of the real robot in a panel: the list with gaits compared, adding tracks, and one trial beside its plan. */

import { h, icon } from "./dom.js";
import { selectGait } from "./gaits.js";
import { runIsOn } from "./store.js";
import { openTab } from "./tabs.js";
import { attempt, toast } from "./toasts.js";
import { trialBand } from "./trial_band.js";
import { trialDetail } from "./trial_detail.js";
import { trialForm } from "./trial_form.js";
import { trialList } from "./trial_list.js";
import { trialApi } from "./trial_api.js";
import { tracksParts } from "./trial_tracks.js";

function addStyles() {
  const sheet = (name) => h("link", { rel: "stylesheet", href: new URL(name, import.meta.url).pathname });
  document.head.append(sheet("./trials.css"), sheet("./trial_beside.css"));
}

/**
 * Builds the panel, closed.
 * @param {object} store
 * @returns {{open: () => void, go: (wanted: object) => void, leave: () => boolean}} `leave` closes it; true where it was open
 */
export function mountTrials(store) {
  addStyles();
  const body = h("div", { class: "runs-body" });
  const close = h("button", { class: "plain icon-only", "aria-label": "Close trials", title: "Close (Esc)" }, icon("close"));
  const panel = h("section", { class: "runs-panel", "aria-label": "Trials", hidden: true }, h("header", {}, h("h2", { text: "Trials" }), close), body);
  document.querySelector("aside.right").append(panel);

  let left = () => {};

  function leaveContent() {
    const act = left;
    left = () => {};
    act();
  }

  /** `whenLeft` is called when other content comes, or the panel closes. */
  function show(content, whenLeft = () => {}) {
    leaveContent();
    left = whenLeft;
    panel.hidden = false;
    document.body.toggleAttribute("data-runs", true);
    body.replaceChildren(content);
    body.scrollTop = 0;
  }

  function leave() {
    if (panel.hidden) return false;
    leaveContent();
    panel.hidden = true;
    document.body.toggleAttribute("data-runs", false);
    return true;
  }

  const tracks = tracksParts(store, attempt((gait) => selectGait(store, gait)));
  const page = { store, show, all: () => all(), one: (id) => one(id) };
  // Videos and cameras come when they are first asked for.
  const videos = attempt(async () => (await import("./video.js")).openVideos(page));
  const cameras = attempt(async () => (await import("./camera_list.js")).openCameras(page));
  const learn = attempt(async () => (await import("./learning.js")).openLearning(page));
  const all = attempt(async () => show(await trialList({ open: one, add, band, videos, cameras, learn })));

  const one = attempt(async (id) => {
    const { element, leave: gone } = await trialDetail(id, { all, remove, tracks, video: (wanted) => go({ video: wanted }) });
    show(element, gone);
  });

  const band = attempt(async (group) => {
    const { element, leave: gone } = await trialBand(group, { all, open: one, tracks });
    show(element, gone);
  });

  function add() {
    show(trialForm({ store, all, done: (added) => (added.length === 1 ? one(added[0].id) : all()) }));
  }

  const remove = attempt(async ({ id, name }) => {
    await trialApi.remove(id);
    await all();
    toast(`The trial “${name}” is deleted.`, { action: { label: "Undo", act: attempt(async () => { await trialApi.restore(id); one(id); }) } });
  });

  close.addEventListener("click", leave);
  document.querySelector('[role="tablist"][aria-label="Inspector"]').addEventListener("click", leave);
  store.watch(({ robot }) => [runIsOn(robot)], ({ robot }) => { if (runIsOn(robot)) leave(); });

  /** Opens what another part of the page asks for: a trial, a video, a camera's picture or its setup. */
  const go = attempt(async ({ trial, video, camera, setup }) => {
    openTab("robot");
    if (trial) return one(trial);
    if (video) return (await import("./video.js")).openVideoOf(page, video);
    const { watchCamera, setUpCamera } = await import("./camera_list.js");
    return setup ? setUpCamera(page, setup) : watchCamera(page, camera);
  });
  return { open: () => { openTab("robot"); all(); }, go, leave };
}
