/** The stage: loads a plan's poses once, follows the playhead, and mounts the parts over the scene. */

import { CONFLICT, api } from "../api/gaits.js";
import { byId, painted, setText } from "../lib/dom.js";
import { mountGhosts } from "../preview/ghosts.js";
import { mountGoal } from "../preview/goal.js";
import { missingMotionOf } from "../document/missing_motion.js";
import { mountJogGhost } from "../preview/jog_ghost.js";
import { latestOnly } from "../lib/latest_only.js";
import { measured } from "../state/live_plan.js";
import { mountPoseHandle } from "../preview/pose_handle.js";
import { mountMeasuredRobot } from "../robot/measured_robot.js";
import { Preview } from "../preview/preview.js";
import { fitByItself } from "./refit.js";
import { FloorGuides } from "./floor_guides.js";
import { followScene } from "./follow_scene.js";
import { FootLabels } from "./foot_labels.js";
import { mountLegend } from "./legend.js";
import { mountTools } from "./stage_tools.js";
import { ViewCube, frontOf } from "./view_cube.js";
import { shownDocument, shownPlan } from "../state/store.js";
import { drawnPlan, greyOf } from "../state/worked_plan.js";

function message(text) {
  byId("stage-message").hidden = !text;
  setText(byId("stage-message"), text ?? "");
}

async function openPreview(dark) {
  const preview = new Preview(byId("viser"));
  dark.addEventListener("change", () => preview.setDark(dark.matches));
  await preview.ready();
  preview.setDark(dark.matches);
  message(null);
  return preview;
}

/** Mounts tools, labels, arrow, scale and cube over the scene, and fits the view. */
function mountOverScene(store, preview, legend) {
  const look = (view) => {
    byId("camera").value = view;
    preview.setView(view, frontOf(shownDocument(store.state)));
  };
  const labels = new FootLabels(byId("foot-labels"), preview);
  store.watch(
    ({ view }) => [view?.roles],
    ({ view }) => labels.setRoles(view?.roles ?? []),
  );
  store.watch(
    (state) => [greyOf(state)],
    (state) => byId("foot-labels").toggleAttribute("data-grey", greyOf(state) !== null),
  );
  mountTools(store, preview, look, legend.show);
  followScene(preview, [new ViewCube(store, look), new FloorGuides(byId("guides"), store, preview), labels]);
  fitByItself(preview, () => look(byId("camera").value));
}

/** The missing motion of the current plan, to be marked on the drawn one; empty if their samples differ. */
function troubleOf(state) {
  const [own, drawn] = [shownPlan(state), drawnPlan(state)];
  return own === drawn || own?.times.length === drawn.times.length ? missingMotionOf(own) : [];
}

function followPlan(store, playback, preview) {
  let drawn = Promise.resolve();
  let missed = null;
  let loaded = null;
  const offer = latestOnly(async ({ id, plan, trouble, isGrey, since }) => {
    missed = null;
    const key = `${id} ${plan.hash}`;
    try {
      if (loaded === key) preview.setTrouble(trouble);
      else {
        // Without a GPU drawing is slow: first the plots are painted and the previous poses drawn.
        const [poses] = await Promise.all([api.poses(id, plan.hash), painted(), drawn]);
        await preview.loadPoses(poses, trouble);
        loaded = key;
        preview.setTime(playback.time);
      }
      preview.setGrey(isGrey);
      message(null);
      drawn = preview.drawn();
      if (since !== null) drawn.then(() => measured("edit to 3D", since));
    } catch (error) {
      // The plan was replaced meanwhile: its error does not matter.
      if (drawnPlan(store.state) !== plan) return;
      if (isGrey && error.status === CONFLICT) {
        // The server no longer has the last plan that worked: show the nearest motion, or keep what is shown.
        preview.setGrey(true);
        store.set({ worked: null });
        return;
      }
      message(`The 3D view cannot show the plan: ${error.message}`);
      missed = { id, plan, trouble, isGrey, since: null };
    }
  });
  store.watch(
    ({ connected }) => [connected],
    ({ connected }) => {
      if (connected && missed) offer(missed);
    },
  );
  followHand(store, preview);
  store.watch(
    (state) => [state.view?.id, drawnPlan(state)?.hash, shownPlan(state)?.live?.lacks, greyOf(state)],
    (state) => {
      const plan = drawnPlan(state);
      const since = state.live && state.live.plan === shownPlan(state) ? state.live.since : null;
      if (plan?.times.length)
        offer({ id: state.view.id, plan, trouble: troubleOf(state), isGrey: greyOf(state) !== null, since });
    },
  );
}

/** Sets the preview busy during an edit, and while the pointer or the focus is where an edit may begin. */
function followHand(store, preview) {
  const near = new Set();
  const tell = () => preview.setBusy(near.size > 0 || store.state.gesture !== null);
  for (const id of ["timeline", "design", "goal", "pose"]) {
    const note = (kind, on) => () => {
      if (on) near.add(`${id} ${kind}`);
      else near.delete(`${id} ${kind}`);
      tell();
    };
    for (const [kind, comes, goes] of [
      ["pointer", "pointerover", "pointerleave"],
      ["keyboard", "focusin", "focusout"],
    ]) {
      byId(id).addEventListener(comes, note(kind, true));
      byId(id).addEventListener(goes, note(kind, false));
    }
  }
  store.watch(({ gesture }) => [gesture !== null], tell);
}

/** Opens the preview; if that fails, shows a message and returns null, and the rest of the page works. */
export async function mountStage(store, edits, playback) {
  const legend = mountLegend(store, playback);
  let preview;
  try {
    preview = await openPreview(matchMedia("(prefers-color-scheme: dark)"));
  } catch (error) {
    message(`The 3D scene could not be loaded: ${error.message}`);
    return null;
  }
  preview.addEventListener("opening", () => message("The 3D scene of this robot is loading."));
  preview.addEventListener("ready", () => message(null));
  mountMeasuredRobot(store, preview);
  mountOverScene(store, preview, legend);
  mountGhosts(store, preview);
  mountJogGhost(store, preview, playback);
  store.watch(
    ({ tracks, view }) => [tracks, view?.document.robot],
    ({ tracks, view }) => preview.setTracks(tracks.filter(({ robot }) => robot === view?.document.robot)),
  );
  playback.addEventListener("time", ({ detail }) => preview.setTime(detail.time, detail.cause === "clock"));
  followPlan(store, playback, preview);
  mountGoal(store, edits, preview);
  mountPoseHandle(store, edits, playback, preview);
  return preview;
}
