/** The page: one store, one playhead, and the parts that watch them. */

import { mountCheck } from "./check.js";
import { createEdits } from "./edits.js";
import { listen } from "./events.js";
import { mountGaits, selectAfterHello } from "./gaits.js";
import { mountJobs } from "./jobs.js";
import { mountKeys } from "./keys.js";
import { recallOperator } from "./operator.js";
import { mountOptimise } from "./optimise.js";
import { mountPlots } from "./plots.js";
import { Playback } from "./preview/playback.js";
import { mountRobot } from "./robot.js";
import { robotTime } from "./samples.js";
import { mountSegments } from "./segments.js";
import { mountStage } from "./stage.js";
import { createStore, runIsOn } from "./store.js";
import { mountTabs, openTab } from "./tabs.js";
import { mountTimeline } from "./timeline.js";
import { clearRefusals } from "./toasts.js";
import { mountTopbar } from "./topbar.js";
import { mountTransport } from "./transport.js";

function goToFinding(store, playback, timeline) {
  return ({ sample, foot }) => {
    const { view } = store.state;
    playback.pause();
    playback.setTime(view.plan?.times?.[sample] ?? sample * view.document.timeline.sample_time);
    if (foot !== null) timeline.focusCell(foot, Math.min(sample, view.document.timeline.feet[0].length - 1));
  };
}

function start() {
  const store = createStore();
  const playback = new Playback();
  const edits = createEdits(store);
  recallOperator(store);
  mountTabs();
  mountTopbar(store, edits);
  mountGaits(store);
  mountJobs(store);
  const timeline = mountTimeline(store, edits, playback);
  mountTransport(store, playback, mountPlots(store));
  mountOptimise(store, edits);
  mountSegments(store);
  mountCheck(store, goToFinding(store, playback, timeline));
  const cancelCountdown = mountRobot(store);
  mountKeys({ store, edits, playback, escapes: [timeline.cancelGesture, cancelCountdown] });

  // During a run the preview stands where the robot is, unless somebody plays the plan.
  store.watch(({ robot, view }) => [robot?.run?.plan_time, view?.plan], ({ robot, view }) => {
    const time = runIsOn(robot) && robot.run?.phase === "streaming" ? robotTime(robot, view) : null;
    if (time !== null && !playback.playing) playback.setTime(time);
  });
  store.watch(({ selected, view }) => [selected, view?.revision], () => clearRefusals());
  store.watch(({ robot }) => [runIsOn(robot)], ({ robot }) => { if (runIsOn(robot)) openTab("robot"); });
  listen(store, () => selectAfterHello(store));
  mountStage(store, playback);
}

start();
