/** The list of trials, and gaits by steps compared in a table that sorts by any column. */

import { h, onPress, setAllowed, setText, svg } from "../lib/dom.js";
import { clockTime, counted, fixed } from "../lib/format.js";
import { ticket } from "../lib/latest_only.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { attempt } from "../lib/toasts.js";
import { trialApi } from "../api/trials.js";
import { unreadableRow } from "../shell/storage_notice.js";
import { NET_HEAD, NET_HELP, distanceText, netCells } from "./trial_words.js";

const COLUMNS = [
  {
    key: "gait_name",
    text: "gait",
    help:
      "Gait, and its step length per iteration in cm. "
      + "For trials without a plan, this is the wanted step length",
  },
  ...["net_distance", "net_angle_deg", "net_error_percent"].map((key, index) => ({
    key,
    text: NET_HEAD[index],
    help: `Mean over the trials. ${NET_HELP}`,
  })),
  { key: "speed_mm_s", text: "mm/s", help: "Net distance divided by the time. Mean over the trials" },
];

const order = { key: "gait_name", up: true };

/** Distances of a gait's trials as a small line, with the wanted one dotted. */
function sparkline({ distances, expected_cm: wanted }) {
  const [width, height] = [46, 14];
  const high = Math.max(...distances, wanted) * 1.1;
  const y = (value) => (height - (value / high) * height).toFixed(1);
  const x = (index) =>
    (distances.length === 1 ? width / 2 : 2 + (index / (distances.length - 1)) * (width - 4)).toFixed(1);
  return svg(
    "svg",
    {
      class: "sparkline",
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": `Net distances ${distances.map(distanceText).join(", ")} cm`,
    },
    svg("line", { x1: 0, x2: width, y1: y(wanted), y2: y(wanted) }),
    svg("polyline", { points: distances.map((value, index) => `${x(index)},${y(value)}`).join(" ") }),
    ...distances.map((value, index) => svg("circle", { r: 1.6, cx: x(index), cy: y(value) })),
  );
}

const spread = (value, by) =>
  by === null ? distanceText(value) : `${distanceText(value)} ± ${distanceText(by)}`;

/** A gait's name with its step, and with the iterations where two rows differ only in them. */
function nameOf(group, groups) {
  const isTwin = groups.some(
    (other) =>
      other !== group
      && other.gait_name === group.gait_name
      && fixed(other.step_cm, 1) === fixed(group.step_cm, 1),
  );
  const name = `${group.gait_name}, ${fixed(group.step_cm, 1)} cm`;
  return isTwin ? `${name}, ${counted(group.iterations, "iteration")}` : name;
}

function compareRow(group, groups, band) {
  const name = nameOf(group, groups);
  const show = h("button", {
    class: "link",
    text: "Show band",
    "aria-label": `Show band of ${name}`,
    title: "Draws the trials of this gait in one plot, with their mean, their spread and the plan",
    on: { click: () => band(group) },
  });
  return h(
    "tr",
    {},
    h(
      "th",
      { scope: "row" },
      h("span", { text: name }),
      h("span", { class: "more quiet" }, `× ${group.trials.length}`, sparkline(group), show),
    ),
    h("td", { text: spread(group.net_distance, group.net_distance_spread) }),
    ...netCells(group)
      .slice(1)
      .map((text) => h("td", { text })),
    h("td", { text: fixed(group.speed_mm_s, 2) }),
  );
}

function sorted(groups) {
  const value = (group) => group[order.key];
  const way = order.up ? 1 : -1;
  return [...groups].sort(
    (a, b) =>
      way
      * (typeof value(a) === "string"
        ? value(a).localeCompare(value(b)) || a.step_cm - b.step_cm
        : value(a) - value(b)),
  );
}

function comparedTable(groups, band) {
  const rows = h("tbody");
  const heads = COLUMNS.map(({ key, text, help }) => {
    const button = h("button", { class: "plain", text, title: `${help}. Press to sort by this column` });
    button.addEventListener("click", () => {
      Object.assign(order, { key, up: order.key === key ? !order.up : true });
      fill();
    });
    return { key, cell: h("th", { scope: "col" }, button) };
  });
  function fill() {
    rows.replaceChildren(...sorted(groups).map((group) => compareRow(group, groups, band)));
    for (const { key, cell } of heads)
      cell.setAttribute("aria-sort", key !== order.key ? "none" : order.up ? "ascending" : "descending");
  }
  fill();
  return h(
    "table",
    { class: "run-table trial-compared" },
    h("caption", { text: "Gaits compared" }),
    h("thead", {}, h("tr", {}, ...heads.map(({ cell }) => cell))),
    rows,
  );
}

/** What marks a trial that no robot did. */
export const exampleMark = () => h("span", { class: "trial-example", text: "Example, made by simulation" });

/** What an empty list teaches, and an example to look at. */
function emptyPart(open) {
  const button = h("button", { text: "Look at an example" });
  const words = h("p", { class: "quiet", role: "status", "aria-label": "Example" });
  const allow = (busy) => {
    setAllowed(
      button,
      busy,
      "Simulates a gait of the gait library and saves the result as a trial. "
        + "The trial is marked as an example",
    );
    setText(
      words,
      busy
        ?? "The simulation takes a few seconds. You can delete the example like any trial. "
          + "The example is not used to compare gaits.",
    );
  };
  const make = attempt(async () => {
    // The list is drawn anew when the trial is there. The example opens unless somebody left the list.
    const list = button.closest(".trial-part");
    allow("The studio is simulating a gait of the gait library…");
    try {
      const { id } = await trialApi.example();
      if (list?.isConnected) open(id);
    } finally {
      allow(null);
    }
  });
  allow(null);
  onPress(button, make);
  return h(
    "div",
    { class: "trial-empty" },
    h("p", {
      class: "teach",
      text:
        "There is no trial yet. Add the foot tracks of a recording. The page then shows how far, how fast "
        + "and in which direction each foot moved, and compares the movement with the plan.",
    }),
    h("div", { class: "buttons" }, button),
    words,
  );
}

function trialRow(trial, open) {
  const button = h(
    "button",
    {
      class: "run-row",
      data: { trial: trial.id },
      title: "Opens this trial and compares it with its plan",
      on: { click: () => open(trial.id) },
    },
    trial.is_example && h("span", { class: "run-line" }, exampleMark()),
    h(
      "span",
      { class: "run-line" },
      h("b", { text: trial.name }),
      h("span", { text: `${distanceText(trial.net_distance)} of ${distanceText(trial.expected_cm)} cm` }),
    ),
    h(
      "span",
      { class: "run-line quiet" },
      h("span", { text: [trial.gait_name, trial.by, clockTime(trial.made)].filter(Boolean).join(" · ") }),
    ),
    trial.note ? h("span", { class: "run-line run-note", text: trial.note }) : null,
  );
  return h("li", {}, button);
}

/** A kept trial that has no figures: why, and a way to be rid of it. */
function figurelessRow({ id, name, sentence }) {
  const away = h("button", {
    type: "button",
    class: "link",
    text: "Delete",
    "aria-label": `Delete ${name}`,
    on: { click: attempt(() => trialApi.remove(id)) },
  });
  return h(
    "li",
    { class: "why", data: { toneText: "caution" } },
    `The trial “${name}” cannot be shown. ${sentence} `,
    away,
  );
}

function listParts({ trials, compared, unreadable }, { open, band, changed }) {
  const groups = compared.map((group) => ({
    ...group,
    lines: trials.filter(({ id }) => group.trials.includes(id)),
  }));
  const file = (form, text, help) =>
    h("a", { href: `/api/trials/table?form=${form}`, download: "", text, title: help });
  const list = h(
    "ul",
    { class: "run-list", role: "list", "aria-label": "Trials" },
    ...trials.map((trial) => trialRow(trial, open)),
    ...unreadable.map((entry) => (entry.table ? unreadableRow(entry, changed) : figurelessRow(entry))),
  );
  oneTabStop(list);
  return [
    ...(trials.length ? [] : [emptyPart(open)]),
    ...(groups.length
      ? [
          comparedTable(groups, band),
          h(
            "div",
            { class: "run-files" },
            file("csv", "CSV", "Saves the table as a CSV file"),
            file("latex", "LaTeX", "Saves the table in LaTeX, for a paper"),
            h("a", {
              href: "/api/trials/report",
              download: "",
              text: "Report",
              title: "One HTML file with this table, and one plot of the trials of each gait",
            }),
          ),
        ]
      : []),
    list,
  ];
}

const trialOf = (row) => row.getAttribute("data-trial");

/**
 * Builds the list, which follows changes of trials.
 * @param {Object} acts
 * @param {import("../state/store.js").Store} acts.store
 * @param {(id: string) => void} acts.open
 * @param {() => void} acts.add
 * @param {(group: Record<string, any>) => void} acts.band
 * @param {() => void} acts.videos
 * @param {() => void} acts.cameras
 * @param {() => void} acts.learn
 * @returns {Promise<{element: HTMLElement, leave: () => void}>}
 */
export async function trialList({ store, open, add, band, videos, cameras, learn }) {
  const first = store.state.trialChanges;
  const body = h("div", { class: "trial-part" });
  const begin = ticket();

  async function fill() {
    const isOld = begin();
    const content = await trialApi.list();
    if (isOld()) return;
    const held = body.contains(document.activeElement) ? trialOf(document.activeElement) : null;
    body.replaceChildren(...listParts(content, { open, band, changed: attempt(fill) }));
    if (held) [...body.querySelectorAll("button")].find((one) => trialOf(one) === held)?.focus();
  }

  await fill();
  const forget = store.watch(
    ({ trialChanges }) => [trialChanges],
    ({ trialChanges }) => {
      if (trialChanges !== first) attempt(fill)();
    },
  );
  const element = h(
    "div",
    { class: "run-all" },
    h(
      "div",
      { class: "trial-ways" },
      h("button", { class: "primary", text: "Add trials…", on: { click: add } }),
      h("button", {
        text: "From a video…",
        title: "Tracks the feet in a video of the robot, taken from under the glass platform",
        on: { click: videos },
      }),
      h("button", {
        class: "link",
        text: "Cameras",
        on: { click: cameras },
        title: "Opens the list of cameras, where you see live pictures, set up cameras and record runs",
      }),
      h("button", {
        class: "link",
        text: "Learn from trials",
        title: "Fits unknown physics parameters, such as floor friction, to the measured walks of the robot",
        on: { click: learn },
      }),
    ),
    body,
  );
  return {
    element,
    leave() {
      begin();
      forget();
    },
  };
}
