/** Runs that were kept: the newest under the jobs, all of them in a panel, and one laid over the plan. */

import { api } from "../api/gaits.js";
import { byId, h, icon, setText } from "../lib/dom.js";
import { ticket } from "../lib/latest_only.js";
import { openTab } from "../lib/tabs.js";
import { attempt, report } from "../lib/toasts.js";
import { selectGait } from "../shell/gait_list.js";
import { planIsOn, runIsOn } from "../state/store.js";
import { runDetail } from "./run_detail.js";
import { runList, runRow } from "./run_list.js";

const NEWEST = 3;
const AGAIN_MS = 400;
/** A run's end reaches the record within a moment of the robot's own. */
const MOST_TRIES = 10;

/** Compares the shown gait with the run that is laid over it. */
function standing(store, run) {
  const { view, selected } = store.state;
  if (run.gait.startsWith("file:")) return "This run was of a file, sent by a command: nothing is laid over the plots.";
  const known = store.state.gaits.some(({ id }) => id === run.gait);
  if (selected !== run.gait) return `The gait of this run is not ${known ? "the one that is shown" : "among the gaits any more"}: nothing is laid over the plots.`;
  if (view?.plan?.waypoints_hash !== run.waypoints_hash) return "The gait has changed since: measured strokes stand over what is planned now.";
  return "Measured strokes stand over the planned ones in the plots.";
}

function mountPanel(store, opening) {
  const body = h("div", { class: "runs-body" });
  const close = h("button", { class: "plain icon-only", "aria-label": "Close runs", title: "Close (Esc)" }, icon("close"));
  const panel = h("section", { class: "runs-panel", id: "runs", "aria-label": "Runs", hidden: true }, h("header", {}, h("h2", { text: "Runs" }), close), body);
  document.querySelector("aside.right").append(panel);
  const list = runList((id) => open(id));
  const begin = ticket();
  let follow = () => {};

  function show(content) {
    opening();
    panel.hidden = false;
    document.body.toggleAttribute("data-runs", true);
    body.replaceChildren(content);
    body.scrollTop = 0;
  }

  function all() {
    begin();
    store.set({ run: null });
    openTab("robot");
    show(list.element);
    return list.refresh();
  }

  function leave() {
    begin();
    if (panel.hidden) return false;
    store.set({ run: null });
    panel.hidden = true;
    document.body.toggleAttribute("data-runs", false);
    return true;
  }

  const open = attempt(async (id) => {
    openTab("robot");
    const isOld = begin();
    const run = await api.keptRun(id);
    if (isOld()) return;
    if (store.state.selected !== run.gait && store.state.gaits.some((gait) => gait.id === run.gait)) await selectGait(store, run.gait);
    const detail = await runDetail(id, { leave: all, open, standing: (one) => standing(store, one), recorded: (wanted) => store.set({ trialWanted: wanted }) });
    if (isOld()) return;
    ({ follow } = detail);
    follow();
    show(detail.element);
    const shown = run.errors ? { ...run, strokes: await api.runStrokes(id) } : null;
    if (!isOld()) store.set({ run: shown });
  });

  close.addEventListener("click", leave);
  store.watch(({ selected, view, gaits }) => [selected, view?.plan?.waypoints_hash, gaits], () => follow());
  document.querySelector('[role="tablist"][aria-label="Inspector"]').addEventListener("click", leave);
  return { all, open, leave };
}

/** Builds the newest runs under the jobs; `opening` is called when their panel opens. Returns what Esc does. */
export function mountRuns(store, opening = () => {}) {
  const panel = mountPanel(store, opening);
  mountTrace(store);
  const list = h("ul", { class: "runs-newest", role: "list", "aria-label": "Newest runs" });
  const more = h("button", { class: "link", text: "All runs", title: "Every run that was kept: filter, compare, files", on: { click: panel.all } });
  const empty = h("p", { class: "teach" });
  byId("robot").append(h("button", { class: "link runs-way", text: "Runs that were kept", title: more.title, on: { click: panel.all } }));
  byId("jobs-empty").after(h("div", { class: "runs-head" }, h("h2", { text: "Runs" }), more), list, empty);

  const begin = ticket();

  async function refresh(tries = 0) {
    const isOld = begin();
    try {
      const { runs } = await api.runs({ most: NEWEST });
      if (isOld()) return;
      list.replaceChildren(...runs.map((run) => runRow(run, panel.open)));
      setText(empty, runs.length ? "" : "No run yet. What the robot does is kept here.");
      empty.hidden = runs.length > 0;
      if (runs[0]?.state === "running" && !runIsOn(store.state.robot) && tries < MOST_TRIES) setTimeout(() => { if (!isOld()) refresh(tries + 1); }, AGAIN_MS);
    } catch (error) {
      report(error);
    }
  }

  store.watch(({ robot }) => [runIsOn(robot)], ({ robot }) => { if (runIsOn(robot)) panel.leave(); });
  store.watch(({ connected, robot }) => [connected, robot?.run?.id, runIsOn(robot)], ({ connected }) => { if (connected) refresh(); });
  return panel.leave;
}

/** A trace with another row; an iteration begins where the plan's time goes back. */
function longer(trace, { plan_time: time, reached }, strokes) {
  const last = trace.plan_times.at(-1);
  const lap = (trace.laps.at(-1) ?? 0) + (last !== undefined && time < last ? 1 : 0);
  return { ...trace, reached, plan_times: [...trace.plan_times, time], laps: [...trace.laps, lap], measured_mm: [...trace.measured_mm, strokes] };
}

/** True if a trace is current: its run is on, or has ended with the gait unchanged and no other run open. */
function isCurrent(trace, { robot, view, run: open }) {
  const run = robot?.run;
  if (!run || planIsOn(robot)) return Boolean(run);
  return trace?.id === run.id && !open && run.waypoints_hash === view?.plan?.waypoints_hash;
}

/** Keeps `trace` in the store while a run is on and until something else is looked at; a page that comes later begins where the run is then. */
export function mountTrace(store) {
  store.watch(({ robot, view, run: open }) => [robot?.run?.phase, robot?.run?.id, robot?.run?.reached, view?.plan, open], (state) => {
    const { robot, trace } = state;
    if (!isCurrent(trace, state)) {
      if (trace) store.set({ trace: null });
      return;
    }
    const run = robot.run;
    const own = trace?.id === run.id ? trace : { id: run.id, gait: run.gait, reached: 0, plan_times: [], laps: [], measured_mm: [] };
    const isNew = run.reached > own.reached && (trace === own || run.phase === "streaming");
    if (isNew && typeof run.plan_time === "number" && robot.strokes_mm) store.set({ trace: longer(own, run, robot.strokes_mm) });
    else if (trace && trace !== own) store.set({ trace: null });
  });
}
