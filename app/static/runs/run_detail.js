/** One run: its facts, its errors against the plan, a note, its files, and a comparison with another run. */

import { api } from "../api/gaits.js";
import { h, onPress, setText } from "../lib/dom.js";
import { clockTime, fixed, seconds, shortHash } from "../lib/format.js";
import { announce, attempt, report, toast } from "../lib/toasts.js";
import { ruleNames } from "../state/override.js";
import { runComparison } from "./run_comparison.js";
import { runTone } from "./run_list.js";
import { errorTables } from "./run_tables.js";

const OTHERS = 100;

function facts(run) {
  const rows = [
    ["By", run.by],
    ["Started", clockTime(run.started)],
    ["Duration", durationSummary(run)],
    ["Reached", run.count === null ? "–" : `${run.reached} of ${run.count}`],
    ["Motors, largest", run.errors ? `${fixed(run.errors.largest_mm, 2)} mm` : "–"],
    ["Body, largest", run.errors ? `${fixed(run.errors.body_largest_mm, 2)} mm` : "–"],
    ["Stop bound", run.stop_bound === null ? "none" : `${seconds(run.stop_bound)} s`],
    ["Approved by", run.approval?.by ?? run.override?.by ?? "–"],
    ...(run.override ? [["In spite of", `${ruleNames(run.override.rules)}: ${run.override.reason}`]] : []),
    ["Hash", shortHash(run.waypoints_hash), run.waypoints_hash],
  ];
  return h(
    "dl",
    { class: "summary" },
    ...rows.flatMap(([name, value, help]) => [
      h("dt", { text: name }),
      h("dd", { text: value, title: help ?? null }),
    ]),
  );
}

function stateLog({ states }) {
  return h(
    "details",
    { class: "run-states" },
    h("summary", { text: `States (${states.length})` }),
    h(
      "ol",
      { role: "list" },
      ...states.map(({ time, link, robot, cause }) =>
        h(
          "li",
          {},
          h("span", { class: "number quiet", text: `${fixed(time, 1)} s` }),
          h("b", { text: link === "ready" ? robot : `link ${link}` }),
          h("span", { text: cause }),
        ),
      ),
    ),
  );
}

function noteField(run) {
  const placeholder = "Note, for example the floor, the load or what you saw";
  const field = h("textarea", { "aria-label": "Note", rows: "2", maxlength: "4000", placeholder });
  field.value = run.note;
  field.addEventListener(
    "change",
    attempt(async () => {
      await api.noteRun(run.id, field.value);
      announce("Note kept.");
    }),
  );
  return field;
}

function deleteButton(run, gone, back) {
  const title = "Remove this run from the list. Undo brings the run back";
  const button = h("button", { class: "link", text: "Delete", title });
  onPress(
    button,
    attempt(async () => {
      await api.deleteRun(run.id);
      gone();
      const undo = attempt(async () => {
        await api.restoreRun(run.id);
        back(run.id);
      });
      toast(`The run of “${run.gait_name}” is deleted.`, { action: { label: "Undo", act: undo } });
    }),
  );
  return button;
}

const ON = ["moving", "pausing", "paused"];

/** How the run ended: the cause of the first state that ended it. */
const endOf = (run) =>
  (run.state === "running"
    ? null
    : run.states.find(({ link, robot }) => link !== "ready" || !ON.includes(robot))?.cause) ?? run.sentence;

const holeText = ({ left_out: bytes }) =>
  `The record of this run is not complete. The studio could not write ${bytes} bytes to the data folder.`;

/** The choice of another run, and the comparison of the two. */
function comparing(run, others, tables) {
  const comparable = others.filter(({ id, errors }) => id !== run.id && errors);
  const select = h(
    "select",
    { "aria-label": "Compare with", title: "Compare this run with another run, waypoint by waypoint" },
    h("option", { value: "", text: "no other run" }),
    ...comparable.map((other) =>
      h("option", {
        value: other.id,
        text: `${other.gait_name}, ${clockTime(other.started)}, ${other.by}, ${other.state}`,
      }),
    ),
  );
  select.addEventListener(
    "change",
    attempt(async () => {
      const id = select.value;
      const shown = id ? runComparison(await api.compareRuns(run.id, id)) : errorTables(run.errors);
      if (select.value !== id) return;
      tables.replaceChildren(...shown);
      tables.scrollIntoView({ block: "nearest" });
    }),
  );
  return h("label", { class: "run-against quiet" }, "Compare with ", select);
}

const MCAP_HELP =
  "Download this run as an MCAP file for Foxglove and similar viewers. "
  + "The file contains the strokes, commands and states, and the bytes on the cable";

const file = (run, form, text, help) =>
  h("a", { href: `/api/runs/${encodeURIComponent(run.id)}/run.${form}`, download: "", text, title: help });

/** What cameras recorded with the run: a line that comes later than the page. */
function recordedPart(id, open) {
  const place = h("div");
  import("../cameras/camera_recordings.js")
    .then(({ recordingLine }) => place.replaceWith(recordingLine(id, open)))
    .catch(report);
  return place;
}

/**
 * Builds a run's page in the panel.
 * @param {string} id
 * @param {object} acts
 * @param {() => void} acts.leave
 * @param {(id: string) => void} acts.open
 * @param {(run: Record<string, any>) => string} acts.standing says how the shown gait stands to the run
 * @param {(wanted: Record<string, any>) => void} acts.recorded opens a trial or a video of it
 * @returns {Promise<{element: HTMLElement, follow: () => void}>} `follow` says again what `standing` says
 */
export async function runDetail(id, { leave, open, standing, recorded }) {
  const [run, { runs: others }] = await Promise.all([api.keptRun(id), api.runs({ most: OTHERS })]);
  const noPlan = "No plan was recorded with this run, so its errors are not known.";
  const errors = run.errors ? errorTables(run.errors) : [h("p", { class: "why", text: noPlan })];
  const tables = h("div", { class: "run-tables" }, ...errors);
  const word = h("span", { class: "word", text: run.state });
  const over = h("p", { class: "why", role: "status" });
  const element = h(
    "div",
    { class: "run-detail" },
    h("button", { class: "link", text: "All runs", on: { click: leave } }),
    h(
      "div",
      { class: "run-line run-title" },
      h("span", { class: "dot", data: { tone: runTone(run) } }),
      h("b", { text: run.gait_name }),
      word,
    ),
    h("p", { class: "quiet", text: endOf(run) }),
    run.left_out ? h("p", { class: "why", data: { toneText: "caution" }, text: holeText(run) }) : null,
    facts(run),
    recordedPart(id, recorded),
    noteField(run),
    over,
    run.errors ? comparing(run, others, tables) : null,
    tables,
    stateLog(run),
    h(
      "div",
      { class: "run-files" },
      file(run, "csv", "CSV", "Download a table of time, state, commanded and measured strokes in mm"),
      file(run, "mcap", "MCAP", MCAP_HELP),
      deleteButton(run, leave, open),
    ),
  );
  return { element, follow: () => setText(over, standing(run)) };
}

/** The duration of a run and the expected one. */
function durationSummary({ errors, seconds: elapsed }) {
  if (!errors || errors.seconds === null)
    return elapsed === null || elapsed === undefined ? "–" : `${seconds(elapsed)} s`;
  return `${seconds(errors.seconds)} s, expected ${seconds(errors.estimate)} s`;
}
