/** Contents of the strip plots: series, limits, and the value at the playhead. */

import { MOTORS, fixed } from "../lib/format.js";
import { isDrawing } from "../state/live_plan.js";

const known = (values) => values.filter((value) => value !== null && Number.isFinite(value));
const columns = (rows, count, seriesOf) =>
  rows ? Array.from({ length: count(rows[0]) }, (_, at) => seriesOf(rows, at)) : null;
const aMotor = (rows) =>
  columns(
    rows,
    (row) => row.length,
    (all, motor) => ({
      foot: Math.floor(motor / MOTORS),
      motor: motor % MOTORS,
      valueAt: (index) => all[index][motor],
    }),
  );
const aFoot = (rows, valueOf) =>
  columns(
    rows,
    (row) => row.length,
    (all, foot) => ({ foot, motor: null, valueAt: (index) => valueOf(all[index][foot]) }),
  );

/** The greatest of some values and its index; null if no value is known. */
function greatest(values) {
  const all = known(values);
  if (!all.length) return null;
  const value = Math.max(...all);
  return { at: values.indexOf(value), value };
}

const footAndValue = (top, foot, unit) =>
  top ? `foot ${foot(top.at) + 1}: ${fixed(top.value)} ${unit}` : "–";
/** Heights of the feet, mm; of a robot with shared actuators, those that its real strokes give. */
const heightsAt = ({ real_heights_mm: real, feet }, index) =>
  real?.[index] ?? (feet?.[index] ?? []).map((foot) => foot[2] * 1000);
const mmRequested = (value) => (value ? value * 1000 : null);

/**
 * The limit of the feet's speed, mm/s; null where a motion is not computed, so that none holds. For a
 * sequence, the highest limit of its parts and of the steps between them.
 */
function footSpeedLimit({ parts }, document) {
  const computed = document.sequence?.length ? document.sequence.map(({ gait }) => gait) : [document];
  if (!computed.every(isDrawing)) return null;
  if (parts?.some((part) => part.is_transition)) computed.push(document);
  return Math.max(...computed.map(({ options }) => options.foot_speed)) * 1000;
}

/**
 * The strips in their order. `of(plan, document)` returns the content, or null for the reason `lack`. A
 * content has `series` {foot, motor, valueAt(index)}, `low` and `high` (limits, null for none), `wanted`
 * (requested by the gait), `floor` and `most` (values that the scale always includes), `lanes` (each foot
 * has its own row) and `rises` (feet at 0 are not drawn, and each rise has its foot's mark).
 * `now(plan, index)` returns the text for a sample.
 */
export const STRIPS = [
  {
    key: "margin",
    name: "Stability margin",
    title: "Margin, mm",
    unit: "mm",
    shown: true,
    lack: "No stability margin.",
    help:
      "Distance of the centre of mass from the edge of the support polygon, in mm. "
      + "Below 0, the robot tips",
    of: (plan, { options }) =>
      plan.margin
        ? {
            series: [
              {
                foot: null,
                motor: null,
                valueAt: (index) => (plan.margin[index] === null ? null : plan.margin[index] * 1000),
              },
            ],
            low: 0,
            high: null,
            wanted: mmRequested(options.margin),
            most: 1,
          }
        : null,
    now: ({ margin }, index) =>
      (margin?.[index] ?? null) === null ? "–" : `${fixed(margin[index] * 1000)} mm`,
    isBad: ({ margin }, index) => (margin?.[index] ?? 0) < 0,
  },
  {
    key: "strokes",
    name: "Strokes",
    title: "Strokes, mm",
    unit: "mm",
    shown: true,
    lack: "No strokes to plot, because the legs cannot reach the positions of this motion.",
    help:
      "Stroke of every motor in mm, with one row for each foot. Motor 1 has a thick line, "
      + "motor 2 a medium line, motor 3 a thin line",
    of: ({ strokes_mm: strokes, stroke_limits_mm: limits }) =>
      strokes ? { series: aMotor(strokes), low: limits[0], high: limits[1], lanes: true } : null,
    now({ strokes_mm: strokes }, index) {
      const values = known(strokes?.[index] ?? []);
      return values.length ? `${fixed(Math.min(...values))} … ${fixed(Math.max(...values))} mm` : "–";
    },
  },
  {
    key: "heights",
    name: "Foot heights",
    title: "Height, mm",
    unit: "mm",
    shown: true,
    lack: "No feet.",
    help: "Height of each foot above the ground, in mm",
    of: (plan) => {
      const rows = (plan.feet ?? []).map((_, index) => heightsAt(plan, index));
      return rows.length
        ? { series: aFoot(rows, (value) => value), low: null, high: null, floor: 0, most: 2, rises: true }
        : null;
    },
    now: (plan, index) => footAndValue(greatest(heightsAt(plan, index)), (at) => at, "mm"),
  },
  {
    key: "foot_speeds",
    name: "Foot speeds",
    title: "Foot speed, mm/s",
    unit: "mm/s",
    shown: false,
    lack: "No feet.",
    help: "Speed of each foot in mm/s. If there is a limit line, the optimiser keeps the speed below it",
    of(plan, document) {
      if (!plan.foot_speeds_mm_s) return null;
      const series = aFoot(plan.foot_speeds_mm_s, (value) => value);
      return { series, low: null, high: footSpeedLimit(plan, document), floor: 0, rises: true };
    },
    now: ({ foot_speeds_mm_s: speeds }, index) =>
      footAndValue(greatest(speeds?.[index] ?? []), (at) => at, "mm/s"),
  },
  {
    key: "motor_speeds",
    name: "Motor speeds",
    title: "Motor speed, mm/s",
    unit: "mm/s",
    shown: false,
    lack: "No strokes to plot, because the legs cannot reach the positions of this motion.",
    help:
      "Speed of every motor in mm/s, with one row for each foot. Motor 1 has a thick line, "
      + "motor 2 a medium line, motor 3 a thin line",
    of: ({ motor_speeds_mm_s: speeds, motor_speed_limit_mm_s: high }, { options }) =>
      speeds
        ? { series: aMotor(speeds), low: null, high, wanted: mmRequested(options.motor_speed), lanes: true }
        : null,
    now: ({ motor_speeds_mm_s: speeds }, index) =>
      footAndValue(greatest(speeds?.[index] ?? []), (at) => Math.floor(at / MOTORS), "mm/s"),
  },
];

/**
 * Values of a sample, mm: `lifts` of the feet, `strokes` of the motors (null if out of reach), `margin`
 * (null for none).
 */
export function valuesAt(plan, index) {
  const margin = plan.margin?.[index] ?? null;
  return {
    lifts: heightsAt(plan, index),
    strokes: plan.strokes_mm?.[index] ?? null,
    margin: margin === null ? null : margin * 1000,
  };
}
