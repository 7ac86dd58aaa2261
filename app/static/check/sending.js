/** How a plan is sent: merging and stop bound, set before Check because they change what is checked. */

import { h } from "../lib/dom.js";
import { numberField } from "../state/fields.js";
import { fixed, seconds, timesText } from "../lib/format.js";
import { shownDocument } from "../state/store.js";

const option = (name, factor = 1) => ({
  read: ({ options }) => (options[name] === null ? null : options[name] * factor),
  write: (document, value) => ({
    ...document,
    options: { ...document.options, [name]: value === null ? null : value / factor },
  }),
});

const FIELDS = [
  {
    label: "Merge within",
    name: "Merge waypoints within",
    unit: "mm",
    min: 0,
    max: 5,
    step: 0.1,
    decimals: 2,
    ...option("merge", 1000),
    help:
      "A waypoint is one message with a stroke for every motor. "
      + "The robot stops at each waypoint, so fewer waypoints take less time. "
      + "The studio leaves out a waypoint only if it is closer than this distance "
      + "to the straight path of the motors. The robot itself accepts an error of 1 mm at each waypoint. "
      + "At 0, the studio sends every sample",
  },
  {
    label: "Stop bound",
    name: "Stop bound",
    unit: "s",
    min: 0.8,
    max: 10,
    step: 0.1,
    decimals: 2,
    empty: "none",
    fallback: 1,
    ...option("stop_bound"),
    help:
      "Longest time from the press of Stop until the robot stops. The robot can only stop between two "
      + "moves, so the studio cuts long moves into shorter moves. The walk then takes longer. "
      + "If this field is empty, the studio cuts no move",
  },
];

/** What a move may last beyond its law, s, as the studio counts it (docs/firmware.md, Times). */
const OVERRUN = 0.18;

const bound = (value) => (value === null ? "none" : `${fixed(value)} s`);

function costRow(cost) {
  const { stop_bound: limit, merged_seconds: merged, every_seconds: every, is_chosen: chosen } = cost;
  const title =
    `With merging, the studio sends ${cost.merged_waypoints} waypoints. `
    + `Without merging, the studio sends ${cost.every_waypoints} waypoints`;
  return h(
    "tr",
    { data: chosen ? { chosen: "" } : {}, "aria-current": chosen ? "true" : null, title },
    h("th", { scope: "row", text: `${bound(limit)}${chosen ? " ✓" : ""}` }),
    h("td", { text: `${fixed(merged)} s` }),
    h("td", { text: `${fixed(every)} s` }),
    h("td", { text: `${seconds(cost.stop_seconds)} s` }),
  );
}

/** The cost of bound and merging in robot seconds, from the verdict; nothing without a verdict. */
export function costTable(verdict) {
  if (!verdict?.costs?.length) return [];
  const head = [
    "Stop bound",
    `Merged within ${fixed(verdict.costs[0].merge * 1000)} mm`,
    "Every sample",
    "Stop acts within",
  ];
  return [
    h("h3", { text: "Time on the robot" }),
    h(
      "table",
      { class: "costs", "aria-label": "Time on the robot" },
      h("thead", {}, h("tr", {}, ...head.map((text) => h("th", { scope: "col", text })))),
      h("tbody", {}, ...verdict.costs.map(costRow)),
    ),
    ...verdict.notes.map((text) => h("p", { class: "why", text })),
  ];
}

/** The robot hears Stop within the bound; its motors may take longer than their law says. */
const stopText = (stop) =>
  `After Stop, the robot stops within ${seconds(stop)} s (longest move plus a tolerance of ${OVERRUN} s).`;

function inShort(view) {
  const plan = view?.plan;
  if (!plan?.waypoint_count) return "";
  const {
    waypoint_count: count,
    times,
    robot_seconds: takes,
    every_knot_seconds: every,
    stop_seconds: stop,
  } = plan;
  if (view.document.poses) {
    return `${timesText(view)}. The studio sends ${count} waypoints, one for each pose. ${stopText(stop)}`;
  }
  const instead =
    Math.abs(every - takes) < 0.5
      ? ""
      : `The walk takes ${fixed(every, 0)} s if the studio sends every sample without a stop bound. `;
  const lasts = timesText(view) || `The walk takes about ${fixed(takes, 0)} s on the robot`;
  const sends = `The studio sends ${count} waypoints from ${times.length} samples.`;
  return `${lasts}. ${sends} ${instead}${stopText(stop)}`;
}

/** Builds the two fields and the line of what they cost. */
export function sendingFields(store, edits) {
  const fields = FIELDS.map((field) => numberField(store, edits, field));
  const [merge] = fields;
  const line = h("p", { class: "why" });
  store.watch(
    ({ view, pending, gesture }) => [view, pending, gesture],
    (state) => {
      const document = shownDocument(state);
      if (!document) return;
      fields.forEach((field) => field.show(document));
      merge.element.hidden = Boolean(document.poses);
    },
  );
  store.watch(
    ({ view }) => [view],
    ({ view }) => {
      line.textContent = inShort(view);
    },
  );
  return h(
    "div",
    { class: "sending", role: "group", "aria-label": "How the plan is sent" },
    h("div", { class: "fields" }, ...fields.map(({ element }) => element)),
    line,
  );
}
