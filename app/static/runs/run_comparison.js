/** Two runs side by side, aligned by waypoint: one plot and tables, up to the last waypoint of both. */

import { h, setText } from "../lib/dom.js";
import { counted, fixed, MOTORS } from "../lib/format.js";
import { figureTable, footName } from "../lib/tables.js";
import { motorName } from "./run_tables.js";
import { waypointPlot } from "./waypoint_plot.js";

/** Commanded strokes of two runs that differ by more are of other waypoints, mm. */
const SAME_MM = 0.01;

/**
 * @typedef {{id: string, state: string, reached: number|null, count: number|null, seconds: number[],
 *   move_seconds: number[], error_mm: number[], measured_mm: number[][], commanded_mm: number[][],
 *   figures: Record<string, any>}} AlignedRun
 * @typedef {{waypoints: number[], laps: number[], apart_mm: number, runs: [AlignedRun, AlignedRun]}}
 *   RunComparison
 */

/** What of both runs can be plotted over the waypoints: a name, a unit, and the values of a run. */
const LINES = [
  { name: "Time", unit: "s", of: ({ seconds }) => seconds },
  { name: "Time of each move", unit: "s", of: (run) => run.move_seconds },
  { name: "Largest motor error", unit: "mm", of: (run) => run.error_mm },
];

const strokeLine = (motor) => ({
  name: `Stroke of foot ${Math.floor(motor / MOTORS) + 1}, motor ${(motor % MOTORS) + 1}`,
  unit: "mm",
  of: ({ measured_mm: rows }) => rows.map((row) => row[motor]),
});

/** "Waypoint 12", and which lap where the waypoints were gone through several times. */
const placeText = ({ waypoints, laps }, index) =>
  `waypoint ${waypoints[index] + 1}${laps.at(-1) > 0 ? `, iteration ${laps[index] + 1}` : ""}`;

/** What is compared: "up to waypoint 9, the last that both reached". */
function extentText(both) {
  const { waypoints, runs, apart_mm: apart } = both;
  const stopped = runs.some(({ reached, count }) => reached !== count);
  const [count, last] = [counted(waypoints.length, "waypoint"), placeText(both, waypoints.length - 1)];
  const end = stopped ? ` The shorter run ended at ${last}.` : ` The last of these is ${last}.`;
  const other =
    apart > SAME_MM
      ? " The two runs had different waypoints. "
        + `Their commanded strokes differ by up to ${fixed(apart, 2)} mm.`
      : "";
  return `The comparison covers the ${count} that both runs reached.${end}${other}`;
}

function plotPart(both) {
  const lines = [...LINES, ...both.runs[0].measured_mm[0].map((_, motor) => strokeLine(motor))];
  const select = h(
    "select",
    { "aria-label": "Plot of both runs" },
    ...lines.map(({ name, unit }, index) => h("option", { value: index, text: `${name}, ${unit}` })),
  );
  const place = h("div");
  const show = () => {
    const line = lines[Number(select.value)];
    place.replaceChildren(
      waypointPlot({
        title: `${line.name}, ${line.unit}, at each waypoint`,
        unit: line.unit,
        places: both.waypoints.map((_, index) => placeText(both, index)),
        series: ["this", "other"].map((kind, index) => ({ kind, values: line.of(both.runs[index]) })),
      }),
    );
  };
  select.addEventListener("change", show);
  show();
  return h("div", { class: "run-plot-part" }, select, place);
}

const change = (a, b, decimals) =>
  Number.isFinite(a) && Number.isFinite(b) ? `${b > a ? "+" : ""}${fixed(b - a, decimals)}` : "–";

const rowsOf = (names, a, b, decimals = 2) =>
  names.map((name, index) => [
    name,
    fixed(a[index], decimals),
    fixed(b[index], decimals),
    change(a[index], b[index], decimals),
  ]);

function tables({ runs: [one, other] }) {
  const [a, b] = [one.figures, other.figures];
  const head = ["", "this", "other", "change"];
  const words = (names) => names.map((text) => ({ text }));
  const times = ({ figures, move_seconds: moves }) => [
    figures.seconds,
    figures.estimate,
    Math.max(...moves),
    figures.start_seconds,
  ];
  const largest = (figures) => [
    figures.largest_mm,
    Math.max(...figures.foot_largest_mm),
    figures.body_largest_mm,
  ];
  return [
    figureTable(
      "Times, s",
      "The table covers only the waypoints that both runs reached. "
        + "Duration: from sending the first waypoint until the robot reached the last waypoint. "
        + "Expected: the duration computed from the firmware's speed ramps",
      head,
      rowsOf(
        words(["duration", "expected", "slowest move", "to the start pose"]),
        times(one),
        times(other),
        1,
      ),
    ),
    figureTable(
      "Largest errors, mm",
      "Largest error of any motor, any foot and the body. "
        + "The table covers only the waypoints that both runs reached",
      head,
      rowsOf(words(["motors, largest", "feet, largest", "body, largest"]), largest(a), largest(b)),
    ),
    figureTable(
      "Feet, largest, mm",
      "Largest distance of each foot from its planned position. "
        + "The table covers only the waypoints that both runs reached",
      head,
      rowsOf(
        a.foot_largest_mm.map((_, foot) => footName(foot)),
        a.foot_largest_mm,
        b.foot_largest_mm,
      ),
    ),
    figureTable(
      "Motors, largest, mm",
      "Largest difference between measured and commanded stroke. "
        + "The table covers only the waypoints that both runs reached",
      head,
      rowsOf(a.motor_largest_mm.map(motorName), a.motor_largest_mm, b.motor_largest_mm),
    ),
  ];
}

/**
 * The comparison of two runs.
 * @param {RunComparison} both
 * @returns {HTMLElement[]}
 */
export function runComparison(both) {
  const text = h("p", { class: "why", role: "status", "aria-label": "Comparison" });
  if (!both.waypoints.length) {
    setText(
      text,
      "The two runs cannot be compared, because they have reached no waypoint in common. "
        + "Choose another run.",
    );
    return [text];
  }
  setText(text, extentText(both));
  return [text, plotPart(both), ...tables(both)];
}
