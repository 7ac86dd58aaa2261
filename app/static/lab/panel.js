/** The Trials panel: the list of trials, the gaits compared, new trials, and one trial with its plan. */

import { byId, h, icon } from "../lib/dom.js";
import { drawerIsOpen, openDrawer } from "../shell/drawers.js";
import { selectGait } from "../shell/gait_list.js";
import { ticket } from "../lib/latest_only.js";
import { runIsOn } from "../state/store.js";
import { attempt, toast } from "../lib/toasts.js";
import { trialBand } from "../trials/trial_band.js";
import { trialDetail } from "../trials/trial_detail.js";
import { trialForm } from "../trials/trial_form.js";
import { trialList } from "../trials/trial_list.js";
import { trialApi } from "../api/trials.js";
import { tracksParts } from "../trials/trial_tracks.js";

function addStyles() {
  const sheet = (name) => h("link", { rel: "stylesheet", href: new URL(name, import.meta.url).pathname });
  document.head.append(sheet("../trials/trials.css"), sheet("../trials/trial_comparison.css"));
}

/** The panel and its content; `begin()` returns whether something else was opened since. */
function buildPanel() {
  const body = h("div", { class: "runs-body" });
  const close = h(
    "button",
    { class: "plain icon-only", "aria-label": "Close trials", title: "Close (Esc)" },
    icon("close"),
  );
  byId("drawer-trials").append(h("header", {}, h("h2", { text: "Trials" }), close), body);
  const begin = ticket();
  let left = () => {};

  function leaveContent() {
    const act = left;
    left = () => {};
    act();
  }

  /** `onLeave` is called when other content comes, or the panel closes. */
  function show(content, onLeave = () => {}) {
    leaveContent();
    left = onLeave;
    openDrawer("trials");
    body.replaceChildren(content);
    body.scrollTop = 0;
  }

  const leave = () => drawerIsOpen("trials") && openDrawer(null);

  /** Ends what the content does; the drawer is closed. */
  function closed() {
    begin();
    leaveContent();
    body.replaceChildren();
  }

  close.addEventListener("click", leave);
  return { begin, show, leave, closed };
}

/** What modules of videos, cameras and learning show on the page; each is loaded when it is first needed. */
function laterParts(page) {
  const later = (load, name) =>
    attempt(async (...values) => {
      const isOld = page.begin();
      const { [name]: act } = await load();
      if (!isOld()) act(page, ...values);
    });
  const ofVideos = () => import("../videos/video.js");
  const ofCameras = () => import("../cameras/camera_list.js");
  const ofLearning = () => import("../learning/learning.js");
  return {
    videos: later(ofVideos, "openVideos"),
    video: later(ofVideos, "openVideoOf"),
    cameras: later(ofCameras, "openCameras"),
    look: later(ofCameras, "watchCamera"),
    setUp: later(ofCameras, "setUpCamera"),
    learn: later(ofLearning, "openLearning"),
  };
}

/** Deletes a trial, and offers to bring it back. */
const removeTrial = ({ all, one }) =>
  attempt(async ({ id, name }) => {
    await trialApi.remove(id);
    await all();
    const undo = attempt(async () => {
      await trialApi.restore(id);
      one(id);
    });
    toast(`The trial “${name}” is deleted.`, { action: { label: "Undo", act: undo } });
  });

/**
 * Builds the panel, closed.
 * @param {import("../state/store.js").Store} store
 * @returns {{open: () => void, go: (wanted: Record<string, any>) => void, leave: () => boolean, closed: () =>
 *   void}} `leave` closes its drawer; true where it was open; `closed` is called when the drawer was closed
 */
export function mountTrials(store) {
  addStyles();
  const { begin, show, leave, closed } = buildPanel();
  const tracks = tracksParts(
    store,
    attempt((gait) => selectGait(store, gait)),
  );
  const page = { store, show, begin, all: () => all(), one: (id) => one(id) };
  const { videos, video: oneVideo, cameras, look, setUp, learn } = laterParts(page);

  /** Shows what `make` returns, unless something else was opened meanwhile. */
  const shown = (make) =>
    attempt(async (wanted) => {
      const isOld = begin();
      const { element, leave: gone } = await make(wanted);
      if (isOld()) gone?.();
      else show(element, gone);
    });
  const all = shown(() => trialList({ store, open: one, add, band, videos, cameras, learn }));
  const one = shown((id) => trialDetail(store, id, { all, remove, tracks, video: oneVideo }));
  const band = shown((group) => trialBand(group, { all, open: one, tracks }));
  const remove = removeTrial(page);

  function add() {
    begin();
    show(trialForm({ store, all, done: (added) => (added.length === 1 ? one(added[0].id) : all()) }));
  }

  store.watch(
    ({ robot }) => [runIsOn(robot)],
    ({ robot }) => {
      if (runIsOn(robot)) leave();
    },
  );

  /** Opens a trial, a video, a camera's picture or its setup for another part of the page. */
  function go({ trial, video, camera, setup }) {
    if (trial) one(trial);
    else if (video) oneVideo(video);
    else if (camera) look(camera);
    else if (setup) setUp(setup);
  }
  return { open: () => all(), go, leave, closed };
}
