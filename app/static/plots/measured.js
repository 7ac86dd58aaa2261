/** Measured and simulated curves over the planned ones, on the plan's time axis. */

import { acrossOf, pathOf } from "./curves.js";
import { simulationOver, traceOf } from "../state/simulation.js";

/** Strips with measured curves: the field of the run, and its values per foot (0: one for the body). */
const OVER = {
  strokes: { of: "measured_mm", aFoot: 3 },
  heights: { of: "foot_heights_mm", aFoot: 1 },
  margin: { of: "margins_mm", aFoot: 0 },
};

/** Simulated curves have long dashes; measured ones are solid, planned ones dotted. */
const SIMULATED_DASH = [8, 3];

/** A run's telemetry as iterations of the plan: rising times of the plan, with the values measured then. */
function iterations({ plan_times: times, laps }, values) {
  const byLap = new Map();
  times.forEach((time, index) => {
    if (time === null || !values[index]) return;
    if (!byLap.has(laps[index])) byLap.set(laps[index], { times: [], rows: [] });
    const lap = byLap.get(laps[index]);
    lap.times.push(time);
    lap.rows.push(values[index]);
  });
  return [...byLap.values()];
}

const known = new WeakMap();

/** The values of a run that belong to a strip, or null. */
function measuredOf(run, strip) {
  const values = run?.[OVER[strip]?.of];
  if (!values) return null;
  if (!known.has(values)) known.set(values, { laps: iterations(run, values), aFoot: OVER[strip].aFoot });
  return known.get(values);
}

/** Measured values of the shown gait: from the run in progress, else from the opened run; or null. */
export function runOver({ run, trace, selected, iterate }) {
  if (iterate) return null;
  if (trace?.gait === selected) return trace;
  return run?.strokes && run.gait === selected ? run.strokes : null;
}

/** Simulated, then measured values for a strip, each with its name and its line style. */
export function oversOf(state, strip) {
  const [simulated, measured] = [
    measuredOf(traceOf(simulationOver(state)), strip),
    measuredOf(runOver(state), strip),
  ];
  return [
    simulated && { ...simulated, word: "simulated", dash: SIMULATED_DASH },
    measured && { ...measured, word: "measured", dash: [] },
  ].filter(Boolean);
}

/** Least and greatest measured value, mm. */
export function measuredRange({ laps }) {
  const values = laps.flatMap(({ rows }) => rows.flat()).filter((value) => value !== null);
  return values.reduce(
    ([low, high], value) => [Math.min(low, value), Math.max(high, value)],
    [Infinity, -Infinity],
  );
}

/**
 * One curve for each foot, as `stripCanvas` takes them; `scaleFor(foot)` returns the scale of a foot.
 * @param {Record<string, any>} over of `oversOf`
 */
export function measuredCurves({ laps, aFoot, dash }, axis, scaleFor) {
  const each = aFoot || 1;
  const feet = Math.ceil((laps[0]?.rows[0].length ?? 0) / each);
  return Array.from({ length: feet }, (_, foot) => ({
    tone: aFoot ? foot + 1 : "fine",
    width: 1.5,
    alpha: 1,
    dash,
    d: laps
      .flatMap(({ times, rows }) => {
        const across = acrossOf(axis, times);
        return Array.from({ length: each }, (__, one) =>
          pathOf(across, (index) => rows[index][foot * each + one], scaleFor(foot)),
        );
      })
      .join(""),
  }));
}
