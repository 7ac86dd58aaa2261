/** Builds the editor around the list of gaits: one store, one playhead, and the parts that watch them. */

import { nameAuthor } from "./api/author.js";
import { createActions } from "./timeline/actions.js";
import { menuIsOpen } from "./lib/check_menu.js";
import { mountClipboard } from "./timeline/clipboard.js";
import { mountCopiedTables } from "./lib/copied_tables.js";
import { mountDecimalComma } from "./lib/decimal_comma.js";
import { createEdits } from "./state/edits.js";
import { mountGaitTools } from "./shell/gait_menu.js";
import { selectGait } from "./shell/gait_list.js";
import { mountJobs } from "./shell/job_list.js";
import { mountKeys } from "./shell/keys.js";
import { byId, painted } from "./lib/dom.js";
import { stillWhilePressed } from "./lib/still_while_pressed.js";
import { oneTabStop } from "./lib/tab_stop.js";
import { mountTouchHelp } from "./lib/touch_help.js";
import { mountLivePlan } from "./state/live_plan.js";
import { mountEdges } from "./shell/edges.js";
import { mountSplitter } from "./shell/splitter.js";
import { recallOperator } from "./state/operator.js";
import { mountOptimise } from "./optimise/optimise.js";
import { mountPatternEntry } from "./patterns/pattern_entry.js";
import { mountPlots } from "./plots/plots.js";
import { Playback } from "./preview/playback.js";
import { robotTime } from "./state/plan_samples.js";
import { planIsOn, shownPlan } from "./state/store.js";
import { mountOffline } from "./shell/offline.js";
import { mountFileNotice } from "./shell/file_notice.js";
import { mountStorageNotice } from "./shell/storage_notice.js";
import { mountSteps, openStep } from "./steps/steps.js";
import { mountVerdict } from "./steps/verdict.js";
import { mountWorkedPlan } from "./state/worked_plan.js";
import { mountViews } from "./timeline/views.js";
import { mountTimeline } from "./timeline/timeline.js";
import { mountTools } from "./timeline/timeline_tools.js";
import { clearRefusals, report } from "./lib/toasts.js";
import { mountTopbar } from "./shell/topbar.js";
import { mountPlayback } from "./timeline/playback_controls.js";
import { createZoom, mountZoom, zoomAtPlayhead } from "./timeline/zoom.js";

/** A tab in the background is not painted. */
const LONGEST_PAINT_MS = 400;

function goToFinding(store, playback, timeline) {
  return ({ sample, foot }) => {
    const { view } = store.state;
    playback.pause();
    playback.setTime(shownPlan(store.state)?.times?.[sample] ?? sample * view.document.timeline.sample_time);
    if (foot !== null) timeline.focusCell(foot, Math.min(sample, view.document.timeline.feet[0].length - 1));
  };
}

function mountEditor(store, edits, playback) {
  const zoom = createZoom(store);
  zoom.closer = (closer) => zoomAtPlayhead(store, playback, zoom, closer);
  const timeline = mountTimeline(store, edits, playback, zoom.reveal);
  const actions = createActions({ store, edits, playback, focused: timeline.focused });
  const tools = mountTools(store, actions, zoom, timeline.selectAll);
  mountClipboard({ copy: actions.take, cut: actions.cut, paste: actions.paste });
  mountZoom(store, playback, zoom, timeline.cancelGesture);
  return { timeline, actions, zoom, tools };
}

/** Builds the other panels once what is seen first is painted; then its result has what they do on Escape. */
function panelsAfterPaint(page) {
  const escapes = {};
  const paintedOrHidden = Promise.race([
    painted(),
    new Promise((resume) => {
      setTimeout(resume, LONGEST_PAINT_MS);
    }),
  ]);
  Promise.all([import("./panels.js"), paintedOrHidden])
    .then(([{ mountPanels }]) => Object.assign(escapes, mountPanels(page)))
    .catch(({ message }) => {
      report(new Error(`Part of the page could not be built: ${message}. Reload the page.`));
    });
  return escapes;
}

/** Whoever is at the page is named with what is asked of the studio. */
function followOperator(store) {
  recallOperator(store);
  store.watch(
    ({ operator }) => [operator],
    ({ operator }) => nameAuthor(operator),
  );
}

/** What Escape ends; each is asked in turn, and returns whether it did something. */
const escapesOf = ({ patterns, panels, timeline, tools, optimise }) => [
  patterns.cancel,
  () => panels.segments?.(),
  timeline.cancelGesture,
  () => panels.sequence?.(),
  tools.close,
  optimise.cancel,
  () => panels.countdown?.(),
  menuIsOpen,
  () => panels.runs?.(),
  timeline.clearSelection,
];

/** During a run the preview stands where the robot is, to the end, unless somebody plays the plan. */
function followRobot(store, playback) {
  let followed = null;
  store.watch(
    ({ robot, view }) => [robot?.run?.plan_time, robot?.run?.phase, view?.plan],
    ({ robot, view }) => {
      const run = robot?.run;
      const time = run && (run.phase === "streaming" || run.id === followed) ? robotTime(robot, view) : null;
      followed = run?.phase === "streaming" ? run.id : null;
      if (time !== null && !playback.playing) playback.setTime(time);
    },
  );
  store.watch(
    ({ robot }) => [planIsOn(robot)],
    ({ robot }) => {
      if (planIsOn(robot)) openStep("run");
    },
  );
}

/** Builds the parts that are seen first over a store that may have been filled already. */
export function start(store) {
  const playback = new Playback();
  const edits = createEdits(store);
  window.addEventListener("beforeunload", (event) => {
    if (edits.areUnsent()) event.preventDefault();
  });
  followOperator(store);
  mountDecimalComma();
  mountCopiedTables();
  mountWorkedPlan(store);
  mountSteps(store);
  mountVerdict(store);
  mountViews(store);
  mountTopbar(store, edits);
  mountOffline(store);
  mountStorageNotice(store);
  mountFileNotice(store, edits);
  const show = (id) => selectGait(store, id);
  const gaitTools = mountGaitTools(store, edits, show, () => openStep("design"));
  mountJobs(store, (id) => selectGait(store, id));
  const { timeline, actions, zoom, tools } = mountEditor(store, edits, playback);
  mountPlayback(store, playback, mountPlots(store), actions.loop);
  mountSplitter();
  mountEdges();
  oneTabStop(byId("gaits"));
  oneTabStop(byId("jobs"));
  oneTabStop(byId("tools"), { items: ".segmented > button, .tools > button", isToolbar: true });
  mountTouchHelp(timeline.cancelGesture);
  const goTo = goToFinding(store, playback, timeline);
  const optimise = mountOptimise(store, edits, goTo);
  mountLivePlan(store);
  // Not the step Run: what the robot says is shown at once, also while Send is held.
  for (const id of ["design", "simulate", "check"]) stillWhilePressed(store, byId(id));
  const panels = panelsAfterPaint({ store, edits, playback, goTo, gaitTools });
  const patterns = mountPatternEntry(store, {
    edits,
    playback,
    show: (id) => selectGait(store, id),
    gaitTools,
  });
  mountKeys({
    store,
    edits,
    playback,
    timeline,
    actions,
    zoom,
    escapes: escapesOf({ patterns, panels, timeline, tools, optimise }),
  });
  followRobot(store, playback);
  store.watch(
    ({ selected, view }) => [selected, view?.revision],
    () => clearRefusals(),
  );
}
