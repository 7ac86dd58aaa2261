/** The list of runs that were kept, with its filter. */

import { api } from "../api/gaits.js";
import { h, setAttribute, setText } from "../lib/dom.js";
import { clockTime, counted, fixed, seconds } from "../lib/format.js";
import { ticket } from "../lib/latest_only.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { attempt } from "../lib/toasts.js";
import { unreadableRow } from "../shell/storage_notice.js";
import { overrideText } from "../state/override.js";

const TONES = {
  done: "good",
  running: "accent",
  stopped: "caution",
  stopping: "caution",
  interrupted: "caution",
  fault: "bad",
  lost: "bad",
  refused: "quiet",
};
const PAGE = 30;

export const runTone = ({ state }) => TONES[state] ?? "quiet";

const durationOf = (run) => run.errors?.seconds ?? run.seconds ?? null;
const figures = (run) =>
  [
    durationOf(run) === null ? null : `${seconds(durationOf(run))} s`,
    Number.isFinite(run.errors?.largest_mm) ? `error ${fixed(run.errors.largest_mm, 2)} mm` : null,
  ]
    .filter(Boolean)
    .join(" · ");

/** A run in a list: gait, result, who, when, duration and largest error. */
function runRow(run, open) {
  const when = clockTime(run.started);
  const largest = run.errors?.largest_mm;
  const error = Number.isFinite(largest) ? `Largest error of a motor: ${fixed(largest, 2)} mm.` : "";
  const title = `${run.sentence || "Show this run together with the plan."} ${error}`.trim();
  const button = h(
    "button",
    { class: "run-row", title, data: { run: run.id }, on: { click: () => open(run.id) } },
    h(
      "span",
      { class: "run-line" },
      h("span", { class: "dot", data: { tone: runTone(run) } }),
      h("b", { text: run.gait_name }),
      h("span", { class: "word", text: run.state }),
    ),
    h("span", { class: "run-line quiet" }, h("span", { text: `${run.by} · ${when}` })),
    h("span", { class: "run-line quiet", text: figures(run) || run.sentence }),
    run.override
      ? h("span", { class: "run-line quiet", text: overrideText(run.override, run.override.by) })
      : null,
    run.note ? h("span", { class: "run-line run-note", text: run.note }) : null,
  );
  return h("li", {}, button);
}

function choice(name, help) {
  return h("select", { "aria-label": name, title: help });
}

/** A day with its label. */
function dayField(text, name, help) {
  const input = h("input", { type: "date", "aria-label": name, title: help });
  return { input, element: h("label", { class: "run-day quiet", title: help }, h("span", { text }), input) };
}

function fill(select, all, options) {
  const kept = select.value;
  select.replaceChildren(
    h("option", { value: "", text: all }),
    ...options.map(({ value, text }) => h("option", { value, text })),
  );
  select.value = options.some(({ value }) => value === kept) ? kept : "";
}

const plain = (values) => values.map((value) => ({ value, text: value }));

/** The fields of the filter, with what they ask for. */
function filterPart() {
  const [gait, state, operator] = [
    choice("Gait of the runs", "Show only the runs of the chosen gait"),
    choice("Result of the runs", "Show only the runs with the chosen result"),
    choice("Operator of the runs", "Show only the runs that the chosen person sent"),
  ];
  const [since, until] = [
    dayField("Since", "Runs since", "Show only the runs that started on this day or later"),
    dayField("Until", "Runs until", "Show only the runs that started on this day or earlier"),
  ];
  return {
    element: h(
      "div",
      { class: "run-filter", role: "group", "aria-label": "Filter" },
      gait,
      state,
      operator,
      since.element,
      until.element,
    ),
    fields: [gait, state, operator, since.input, until.input],
    wanted: (offset) => ({
      gait: gait.value,
      state: state.value,
      operator: operator.value,
      since: since.input.value,
      until: until.input.value,
      offset,
      most: PAGE,
    }),
    /** Offers what the studio's answer names. */
    offer({ gaits, states, operators }) {
      fill(
        gait,
        "Every gait",
        gaits.map(({ id, name }) => ({ value: id, text: name })),
      );
      fill(state, "Every result", plain(states));
      fill(operator, "Everybody", plain(operators));
    },
  };
}

/**
 * Builds the list.
 * @param {(id: string) => void} open
 * @returns {{element: HTMLElement, refresh: () => Promise<Record<string, any>[]|null>}} `refresh` resolves to
 *   the runs that are listed
 */
export function runList(open) {
  const filter = filterPart();
  const [count, list] = [
    h("p", { class: "quiet", role: "status" }),
    h("ul", { class: "run-list", role: "list", "aria-label": "Runs" }),
  ];
  oneTabStop(list);
  const more = h("button", { class: "link", text: "Older runs", hidden: true });
  let [shown, unreadable] = [[], []];
  const begin = ticket();

  const load = attempt(async (offset) => {
    const isOld = begin();
    const answer = await api.runs(filter.wanted(offset));
    if (isOld()) return null;
    const [before, damagedBefore] = offset ? [shown, unreadable] : [[], []];
    shown = [...before, ...answer.runs];
    unreadable = [...damagedBefore, ...answer.unreadable];
    filter.offer(answer);
    list.replaceChildren(
      ...shown.map((run) => runRow(run, open)),
      ...unreadable.map((entry) => unreadableRow(entry, () => load(0))),
    );
    setText(count, answer.total ? counted(answer.total, "run") : noRuns(answer));
    setAttribute(more, "hidden", shown.length + unreadable.length >= answer.total);
    return shown;
  });

  for (const field of filter.fields) field.addEventListener("change", () => load(0));
  more.addEventListener("click", () => load(shown.length + unreadable.length));
  return {
    element: h("div", { class: "run-all" }, filter.element, count, list, more),
    refresh: () => load(0),
  };
}

const noRuns = ({ states }) =>
  states.length
    ? "No run matches the filters."
    : "No run yet. Send an approved gait to the robot. "
      + "This list then shows the run with its measured strokes.";
