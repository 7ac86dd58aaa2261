/** The simulation of the shown gait: fetched once, laid over the plan as long as it is of the very plan. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { shownPlan } from "./store.js";
import { report } from "../lib/toasts.js";

const SIMULATE = "simulate";

/** The simulation of the shown gait, also one of an older version; null where there is none, or it is not there yet. */
export function simulationOf({ simulation, view }) {
  return simulation && view?.simulation?.key === simulation.key ? simulation : null;
}

/** The simulation of exactly the plan that is shown, or null: an edit, an iteration and another plan have none. */
export function simulationOver(state) {
  const simulation = simulationOf(state);
  if (!simulation || !state.view.simulation.fresh) return null;
  return simulation.waypoints_hash === shownPlan(state)?.waypoints_hash ? simulation : null;
}

/** The plan's time of a moment of the simulated robot, straight between samples. */
export function planTimeOf({ motion: { robot_times: robot, times } }, moment) {
  let at = robot.findIndex((time) => time >= moment);
  if (at < 0) at = robot.length - 1;
  if (at === 0 || robot[at] === robot[at - 1]) return times[at];
  const part = Math.min((moment - robot[at - 1]) / (robot[at] - robot[at - 1]), 1);
  return times[at - 1] + part * (times[at] - times[at - 1]);
}

/** The simulation that is on for the shown gait, or null. */
export const simulationJob = ({ jobs, selected }) =>
  jobs.find(
    (job) =>
      job.gait === selected
      && job.kind === SIMULATE
      && ["queued", "running", "cancelling"].includes(job.state),
  ) ?? null;

const traces = new WeakMap();

/** A simulation in the form in which a run is laid over the plots. */
export function traceOf(simulation) {
  if (!simulation) return null;
  const { motion } = simulation;
  if (!traces.has(motion)) {
    traces.set(motion, {
      plan_times: motion.times,
      laps: motion.times.map(() => 0),
      measured_mm: motion.strokes_mm,
      foot_heights_mm: motion.feet.map((feet) => feet.map((foot) => foot[2] * 1000)),
      margins_mm: motion.margins_mm.map((margin) => [margin]),
    });
  }
  return traces.get(motion);
}

/** Keeps the store's `simulation` that of the shown gait. */
export function followSimulation(store) {
  const offer = latestOnly(async (key) => {
    try {
      const simulation = await api.simulation(key);
      if (store.state.view?.simulation?.key === key) store.set({ simulation });
    } catch (error) {
      if (store.state.view?.simulation?.key === key) report(error);
    }
  });
  // A simulation of the same again, as with variations, has the same key and another time.
  store.watch(
    ({ view }) => [view?.simulation?.key, view?.simulation?.made],
    ({ view, simulation }) => {
      const key = view?.simulation?.key ?? null;
      if (simulation && simulation.key !== key) store.set({ simulation: null });
      if (key) offer(key);
    },
  );
}

/** Word and tone of a simulation. */
export function simulationText({ report, findings }) {
  if (report.fell) return ["Falls over", "bad"];
  if (report.ended_early) return ["Ended early", "bad"];
  if (findings.some(({ severity }) => severity === "error")) return ["Tips", "bad"];
  return findings.length ? ["Walks, with warnings", "caution"] : ["Walks", "good"];
}
