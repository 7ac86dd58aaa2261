/** The simulation of the shown gait: fetched once, laid over the plan as long as it is of the very plan. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { shownPlan } from "./store.js";
import { report } from "../lib/toasts.js";

/** @typedef {import("./store.js").State} State */

const SIMULATE = "simulate";

/**
 * The simulation of the shown gait, also one of an older version; null where none is there yet.
 * @param {{simulation?: any, view?: any}} state
 */
export function simulationOf({ simulation, view }) {
  return simulation && view?.simulation?.key === simulation.key ? simulation : null;
}

/**
 * The simulation of exactly the plan that is shown; an edit, an iteration and another plan have none.
 * @param {{simulation?: any, view?: any, iterate?: any, tryout?: any, live?: any}} state
 */
export function simulationOver(state) {
  const simulation = simulationOf(state);
  if (!simulation || !state.view.simulation.fresh) return null;
  return simulation.waypoints_hash === shownPlan(state)?.waypoints_hash ? simulation : null;
}

/**
 * The plan's time of a moment of the simulated robot, straight between samples.
 * @param {Record<string, any>} simulation
 * @param {number} moment
 * @returns {number}
 */
export function planTimeOf({ motion: { times, ...motion } }, moment) {
  /** @type {number[]} */
  const robot = motion.robot_times;
  let at = robot.findIndex((time) => time >= moment);
  if (at < 0) at = robot.length - 1;
  if (at === 0 || robot[at] === robot[at - 1]) return times[at];
  const part = Math.min((moment - robot[at - 1]) / (robot[at] - robot[at - 1]), 1);
  return times[at - 1] + part * (times[at] - times[at - 1]);
}

/** The simulation that is on for the shown gait, or null. @param {Pick<State, "jobs"|"selected">} state */
export const simulationJob = ({ jobs, selected }) =>
  jobs.find(
    (job) =>
      job.gait === selected
      && job.kind === SIMULATE
      && ["queued", "running", "cancelling"].includes(job.state),
  ) ?? null;

/** @type {WeakMap<object, Record<string, any>>} */
const traces = new WeakMap();

/**
 * A simulation in the form in which a run is laid over the plots.
 * @param {any} simulation
 * @returns {any} the trace, or null
 */
export function traceOf(simulation) {
  if (!simulation) return null;
  const { motion } = simulation;
  if (!traces.has(motion)) {
    traces.set(motion, {
      plan_times: motion.times,
      laps: motion.times.map(() => 0),
      measured_mm: motion.strokes_mm,
      foot_heights_mm: motion.feet.map((/** @type {number[][]} */ feet) =>
        feet.map((foot) => foot[2] * 1000),
      ),
      margins_mm: motion.margins_mm.map((/** @type {number} */ margin) => [margin]),
    });
  }
  return traces.get(motion);
}

/** Keeps the store's `simulation` that of the shown gait. @param {import("./store.js").Store} store */
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

/** Whether a finding is an error. @param {Record<string, any>} finding */
export const isError = ({ severity }) => severity === "error";

const TIPS = ["simulated_fall", "simulated_tilt", "simulated_swing"];

/** Whether a finding is that the robot tips or falls. @param {Record<string, any>} finding */
export const isTip = ({ rule }) => TIPS.includes(rule);

/**
 * Word and tone of a simulation.
 * @param {Record<string, any>} simulation
 * @returns {string[]}
 */
export function simulationText({ report: outcome, findings }) {
  if (outcome.fell) return ["Falls over", "bad"];
  if (outcome.ended_early) return ["Ended early", "bad"];
  const errors = findings.filter(isError);
  if (findings.some(isTip)) return errors.length ? ["Tips", "bad"] : ["Walks, but rocks", "caution"];
  if (errors.length) return ["Does not walk", "bad"];
  return findings.length ? ["Walks, with warnings", "caution"] : ["Walks", "good"];
}
