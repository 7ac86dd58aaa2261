/** The figures of a simulation for people: tables of the whole and of the feet, and what the rules found. */

import { figureTable, footName } from "../lib/tables.js";
import { h } from "../lib/dom.js";
import { MOTORS, fixed, mm } from "../lib/format.js";
import { planTimeOf } from "../state/simulation.js";

const degrees = (radians, decimals = 1) => fixed((radians * 180) / Math.PI, decimals);

/** A button to a moment of the simulated robot; `after` follows its time. */
function goTo(simulation, moment, goToTime, what, after = "") {
  const time = planTimeOf(simulation, moment);
  return h("button", {
    class: "link",
    text: `${fixed(time)} s${after}`,
    on: { click: () => goToTime(time) },
    "aria-label": `Go to ${what}, ${fixed(time)} s`,
    title:
      "Moves the playhead to this time of the plan. "
      + `The simulated robot is at this point after ${fixed(moment)} s`,
  });
}

/** Foot, motor and value of the greatest of a value a motor. */
function greatestMotor(values) {
  const all = values.flat();
  const at = all.indexOf(Math.max(...all));
  return { foot: Math.floor(at / MOTORS), motor: at % MOTORS, value: all[at] };
}

const motorText = ({ foot, motor }) => `foot ${foot + 1}, motor ${motor + 1}`;

/** Rows of figures: name, value, unit, button to their moment or null, and help. `at` builds the button. */
function motionRows(report, at) {
  const feetMean = report.feet_error.reduce((sum, error) => sum + error, 0) / report.feet_error.length;
  return [
    [
      "Body, mean error",
      mm(report.body_error),
      "mm",
      null,
      "Mean distance between the simulated and the planned position of the body. "
        + "The distance is measured at the end of each move",
    ],
    [
      "Feet, mean error",
      mm(feetMean),
      "mm",
      null,
      "Mean distance between the simulated and the planned positions of the feet. "
        + "The distance is measured at the end of each move",
    ],
    [
      "Way",
      report.way.asked ? `${mm(report.way.made)} of ${mm(report.way.asked)}` : "none asked",
      report.way.asked ? "mm" : "",
      null,
      "How far the robot goes along the plan's way, in the simulation and in the plan",
    ],
    [
      "Turn",
      `${degrees(report.heading)} of ${degrees(report.planned_heading)}`,
      "°",
      null,
      "Angle by which the body turns, in the simulation and in the plan",
    ],
    [
      "Largest tilt",
      degrees(report.max_tilt),
      "°",
      at(report.max_tilt_time, "largest tilt"),
      "Largest angle between the body's upward axis and the vertical",
    ],
    [
      "Smallest margin",
      mm(report.min_margin),
      "mm",
      at(report.min_margin_time, "smallest margin"),
      "Smallest distance between the centre of mass and the edge of the support polygon. "
        + "The corners of this polygon are the feet that carry load. "
        + "Below 0, only the width of the soles keeps the robot from tipping",
    ],
  ];
}

function motorRows(report, at) {
  const [behind, force] = [greatestMotor(report.motor_error), greatestMotor(report.saturation)];
  return [
    [
      "Motor behind",
      mm(behind.value, 2),
      "mm",
      at(report.motor_error_times[behind.foot][behind.motor], "motor behind"),
      `Largest lag of ${motorText(behind)} behind the position that the firmware commands. `
        + "No other motor lags more",
    ],
    [
      "Motor at limit",
      fixed(force.value * 100, 0),
      "%",
      force.value > 0 ? at(report.peak_force_times[force.foot][force.motor], "motor at its limit") : null,
      `Share of the time during which ${motorText(force)} is at its force limit. `
        + "No other motor is at its limit for longer",
    ],
  ];
}

function wholeTable(simulation, goToTime) {
  const { report } = simulation;
  const at = (moment, what) => (moment === null ? null : goTo(simulation, moment, goToTime, what));
  return h(
    "table",
    { class: "run-table simulated-table", "aria-label": "Simulation" },
    h(
      "tbody",
      {},
      ...[...motionRows(report, at), ...motorRows(report, at)].map(([name, value, unit, place, help]) =>
        h(
          "tr",
          { title: help },
          h("th", { scope: "row", text: name }),
          h("td", { text: value }),
          h("td", { class: "unit", text: unit }),
          h("td", { class: "place" }, place),
        ),
      ),
    ),
  );
}

const FEET_HELP =
  "Error: mean distance between a foot and its planned position, at the waypoints. "
  + "Slip: distance that the sole slides while the foot should stand still";

/** @param {Record<string, any>} simulation */
const feetTable = ({ report }) =>
  figureTable(
    "Feet, mm",
    FEET_HELP,
    ["", "error", "slip"],
    report.feet_error.map((error, foot) => [footName(foot), mm(error), mm(report.slip[foot])]),
  );

function findingItem(simulation, finding, goToTime) {
  const [tone, word] = finding.severity === "error" ? ["bad", "Error: "] : ["caution", "Warning: "];
  return h(
    "li",
    { class: "finding" },
    h("span", { class: "dot", data: { tone } }),
    h("span", {}, h("b", { text: word }), finding.sentence),
    h(
      "span",
      { class: "where" },
      finding.time !== null
        && goTo(simulation, finding.time, goToTime, finding.rule.replaceAll("_", " "), " of the plan"),
    ),
  );
}

/**
 * A simulation's figures.
 * @param {Record<string, any>} simulation as the studio keeps it
 * @param {(time: number) => void} goToTime
 * @returns {HTMLElement[]}
 */
export function reportParts(simulation, goToTime) {
  const { report, findings, physics } = simulation;
  return [
    h("p", {
      class: "quiet number simulated-line",
      role: "status",
      "aria-label": "Simulated",
      text: physics.title,
      title:
        `Friction coefficient ${fixed(physics.friction, 2)}. `
        + `The simulation ran ${fixed(report.realtime_factor, 0)} times as fast as the robot`,
    }),
    ...(report.ended_early ? [h("p", { class: "why", text: report.ended_early })] : []),
    wholeTable(simulation, goToTime),
    feetTable(simulation),
    ...(findings.length
      ? [
          h(
            "ul",
            { class: "findings", role: "list", "aria-label": "Findings of the simulation" },
            ...findings.map((finding) => findingItem(simulation, finding, goToTime)),
          ),
        ]
      : []),
  ];
}
