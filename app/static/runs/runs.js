/** Runs that were kept: all of them in a drawer, and one laid over the plan. */

import { api } from "../api/gaits.js";
import { byId, h, icon } from "../lib/dom.js";
import { ticket } from "../lib/latest_only.js";
import { attempt } from "../lib/toasts.js";
import { drawerIsOpen, onDrawer, openDrawer } from "../shell/drawers.js";
import { selectGait } from "../shell/gait_list.js";
import { planIsOn, runIsOn } from "../state/store.js";
import { runDetail } from "./run_detail.js";
import { runList } from "./run_list.js";

const AGAIN_MS = 400;
/** A run's end reaches the record within a moment of the robot's own. */
const MOST_TRIES = 10;

/** Compares the shown gait with the run that is laid over it. */
function standing(store, run) {
  const { view, selected } = store.state;
  if (run.gait.startsWith("file:"))
    return (
      "The waypoints of this run came from a file on the command line. "
      + "The plots cannot show the measured strokes of such a run."
    );
  const known = store.state.gaits.some(({ id }) => id === run.gait);
  if (selected !== run.gait) {
    const why = known ? "The page shows another gait" : "The gait of this run does not exist any more";
    return `${why}, so the plots do not show the measured strokes of this run.`;
  }
  if (view?.plan?.waypoints_hash !== run.waypoints_hash) {
    return (
      "The gait has changed since this run. "
      + "The plots show the measured strokes of this run and the plan of the changed gait."
    );
  }
  return "The plots show the measured strokes together with the planned strokes.";
}

/** The drawer's own elements, without what they do. */
function drawerParts() {
  const body = h("div", { class: "runs-body" });
  const close = h(
    "button",
    { class: "plain icon-only", "aria-label": "Close runs", title: "Close (Esc)" },
    icon("close"),
  );
  byId("drawer-runs").append(h("header", {}, h("h2", { text: "Runs" }), close), body);
  return { body, close };
}

/** The drawer's content: all runs, or one of them. */
function mountPanel(store) {
  const { body, close } = drawerParts();
  const list = runList((id) => open(id));
  const begin = ticket();
  let follow = () => {};
  let isOpening = false;

  function show(content) {
    isOpening = true;
    openDrawer("runs");
    isOpening = false;
    body.replaceChildren(content);
    body.scrollTop = 0;
  }

  function all() {
    begin();
    store.set({ run: null });
    show(list.element);
    return list.refresh();
  }

  const leave = () => drawerIsOpen("runs") && openDrawer(null);

  const open = attempt(async (id) => {
    const isOld = begin();
    const run = await api.keptRun(id);
    if (isOld()) return;
    if (store.state.selected !== run.gait && store.state.gaits.some((gait) => gait.id === run.gait))
      await selectGait(store, run.gait);
    const detail = await runDetail(id, {
      leave: all,
      open,
      standing: (one) => standing(store, one),
      recorded: (wanted) => store.set({ trialWanted: wanted }),
    });
    if (isOld()) return;
    ({ follow } = detail);
    follow();
    show(detail.element);
    const shown = run.errors ? { ...run, strokes: await api.runStrokes(id) } : null;
    if (!isOld()) store.set({ run: shown });
  });

  close.addEventListener("click", leave);
  onDrawer("runs", {
    opened: () => {
      if (!isOpening) all();
    },
    closed: () => {
      begin();
      store.set({ run: null });
    },
  });
  store.watch(
    ({ selected, view, gaits }) => [selected, view?.plan?.waypoints_hash, gaits],
    () => follow(),
  );
  return {
    all,
    leave,
    isAtList: () => drawerIsOpen("runs") && body.contains(list.element),
    refresh: list.refresh,
  };
}

/** Builds the drawer of runs. Returns what Esc does. */
export function mountRuns(store) {
  const panel = mountPanel(store);
  mountTrace(store);
  const begin = ticket();

  /** Reads the list again until the record of the run that has ended is whole. */
  async function refresh(tries = 0) {
    const isOld = begin();
    if (!panel.isAtList()) return;
    const runs = await panel.refresh();
    if (isOld()) return;
    if (runs?.[0]?.state === "running" && !runIsOn(store.state.robot) && tries < MOST_TRIES)
      setTimeout(() => {
        if (!isOld()) refresh(tries + 1);
      }, AGAIN_MS);
  }

  store.watch(
    ({ robot }) => [runIsOn(robot)],
    ({ robot }) => {
      if (runIsOn(robot)) panel.leave();
    },
  );
  store.watch(
    ({ connected, robot }) => [connected, robot?.run?.id, runIsOn(robot)],
    ({ connected }) => {
      if (connected) refresh();
    },
  );
  return panel.leave;
}

/** A trace with another row; an iteration begins where the plan's time goes back. */
function longer(trace, { plan_time: time, reached }, strokes) {
  const last = trace.plan_times.at(-1);
  const lap = (trace.laps.at(-1) ?? 0) + (last !== undefined && time < last ? 1 : 0);
  return {
    ...trace,
    reached,
    plan_times: [...trace.plan_times, time],
    laps: [...trace.laps, lap],
    measured_mm: [...trace.measured_mm, strokes],
  };
}

/** True if a trace is current: its run is on, or has ended with the gait unchanged and no other run open. */
function isCurrent(trace, { robot, view, run: open }) {
  const run = robot?.run;
  if (!run || planIsOn(robot)) return Boolean(run);
  return trace?.id === run.id && !open && run.waypoints_hash === view?.plan?.waypoints_hash;
}

/**
 * Keeps `trace` in the store while a run is on and until something else is looked at. A page that comes later
 * begins where the run is then.
 */
export function mountTrace(store) {
  store.watch(
    ({ robot, view, run: open }) => [
      robot?.run?.phase,
      robot?.run?.id,
      robot?.run?.reached,
      view?.plan,
      open,
    ],
    (state) => {
      const { robot, trace } = state;
      if (!isCurrent(trace, state)) {
        if (trace) store.set({ trace: null });
        return;
      }
      const run = robot.run;
      const own =
        trace?.id === run.id
          ? trace
          : { id: run.id, gait: run.gait, reached: 0, plan_times: [], laps: [], measured_mm: [] };
      const isNew = run.reached > own.reached && (trace === own || run.phase === "streaming");
      if (isNew && typeof run.plan_time === "number" && robot.strokes_mm)
        store.set({ trace: longer(own, run, robot.strokes_mm) });
      else if (trace && trace !== own) store.set({ trace: null });
    },
  );
}
