/** The result of learning: parameters, the quality of predictions, and keeping them as a named set. */

import { h, svg } from "../lib/dom.js";
import { clockTime, compact, fixed } from "../lib/format.js";
import { captionedTable } from "../lib/tables.js";
import { gridPlaces, gridStep } from "../trials/trial_plot.js";

const UNKNOWN = "not identifiable";
const FITTED =
  "Each fitted value has a range of one standard deviation below and above. "
  + "A parameter that the trials cannot determine keeps its usual value";
const ERRORS =
  "Mean absolute error of the predictions over all gaits. “Left out” means that the predicted "
  + "gait was not used for learning";
const FALLS =
  "If the robot falls in the simulation of a gait, the whole distance of that gait counts as error. ";
const figure = (value) => (value === 0 ? "0" : compact(value));
const withUnit = (value, unit) => `${figure(value)} ${unit}`.trim();

const table = (caption, title, head, rows) =>
  captionedTable({ class: "run-table learned-table", title }, caption, head, rows);

function parameterRow({
  title,
  unit,
  default: usual,
  fitted,
  low,
  high,
  is_identifiable: isIdentifiable,
  effect,
  left,
}) {
  const help =
    `Effect of this parameter over its whole range: up to ${fixed(effect)} standard deviations of `
    + "one trial, in the distance or angle of a gait. "
    + `Uncertainty after learning: ${fixed(left * 100, 0)} % of the uncertainty before`;
  return h(
    "tr",
    { title: help },
    h("th", { scope: "row", text: title }),
    h("td", { text: withUnit(usual, unit) }),
    isIdentifiable
      ? h(
          "td",
          {},
          h("b", { text: figure(fitted) }),
          h("span", { class: "quiet range", text: `${figure(low)} to ${figure(high)}` }),
        )
      : h("td", { class: "quiet", text: UNKNOWN }),
  );
}

const parameterTable = ({ parameters }) =>
  table("Parameters", FITTED, ["", "usual", "fitted"], parameters.map(parameterRow));

const predictionTable = ({ foretold: predicted }) =>
  table(
    "Error of the predicted distance and angle",
    ERRORS,
    ["", "cm", "°"],
    predicted.map(({ title, error_cm: distance, error_deg: angle, angles, falls }) =>
      h(
        "tr",
        falls ? { title: `${FALLS}The mean error of the angle uses only the other gaits (${angles})` } : {},
        h("th", { scope: "row", text: falls ? `${title} (falls: ${falls}, angles: ${angles})` : title }),
        h("td", { text: fixed(distance, 2) }),
        h("td", { text: fixed(angle) }),
      ),
    ),
  );

function gaitTable({ gaits, foretold: predicted }) {
  const distances = (name) => predicted.find((one) => one.name === name).distances_cm;
  const columns = [
    gaits.map((gait) => gait.distance_cm),
    distances("as planned"),
    distances("default"),
    distances("left out"),
  ];
  return table(
    "Gaits, cm",
    "Distance as in the published tables, from the largest displacements of the feet",
    ["", "real", "plan", "usual", "left out"],
    gaits.map(({ name }, place) =>
      h(
        "tr",
        {},
        h("th", { scope: "row", text: name }),
        ...columns.map((values) => h("td", { text: fixed(values[place]) })),
      ),
    ),
  );
}

/** Says that strokes were cut to the motors' range, as those of published trajectories are. */
function cutNote({ gaits }) {
  const cut = gaits.filter((gait) => gait.cut_mm > 0).sort((a, b) => b.cut_mm - a.cut_mm);
  if (!cut.length) return null;
  const [{ name: first, cut_mm: largest }] = cut;
  return h("p", {
    class: "quiet learned-cut",
    title: cut.map(({ name, cut_mm: most }) => `${name}: ${fixed(most)} mm`).join("\n"),
    text:
      `${cut.length} of ${gaits.length} gaits had strokes outside the motors’ range. `
      + "Learning limited these strokes to the range. "
      + `The largest change is ${fixed(largest)} mm (${first}).`,
  });
}

function keeping(job, keep) {
  if (!job.result.parameters.some((one) => one.is_identifiable)) {
    return h("p", {
      class: "box-note",
      text:
        "These trials cannot determine any physics parameter, so there "
        + "are no fitted values to keep. Add trials of other gaits, or more trials of each gait.",
    });
  }
  const name = h("input", {
    "aria-label": "Name of the set",
    placeholder: "Name, for example “lab floor”",
    maxlength: "80",
    required: true,
  });
  return h(
    "form",
    {
      class: "learned-keep",
      on: {
        submit: (event) => {
          event.preventDefault();
          keep(job, name.value);
        },
      },
    },
    name,
    h("button", {
      class: "primary",
      text: "Keep as a set",
      title:
        "Saves the fitted values as a set with "
        + "this name. To use the set in simulations, choose the set in Simulate under Physics",
    }),
  );
}

/**
 * Builds the page of a job that has a result.
 * @param {Record<string, any>} job
 * @param {{back: () => void, keep: (job: Record<string, any>, name: string) => void}} actions
 */
export function learnedResult(job, { back, keep }) {
  const { result } = job;
  return h(
    "div",
    { class: "run-detail" },
    h("button", { class: "link", text: "Learn from trials", on: { click: back } }),
    h("div", { class: "run-line run-title" }, h("b", { text: `Learned from ${job.source}` })),
    h("p", {
      class: "quiet",
      text: [job.by, clockTime(job.made), `${result.simulations} simulations`].filter(Boolean).join(" · "),
    }),
    h("p", { text: job.sentence }),
    parameterTable(result),
    predictionTable(result),
    predictionPlot(result),
    h("details", { class: "run-states" }, h("summary", { text: "Every gait" }), gaitTable(result)),
    cutNote(result),
    keeping(job, keep),
  );
}

const SIZE = { width: 276, height: 220, left: 30, right: 8, top: 8, bottom: 30 };

/** Numbers need so many times the room of lines. */
const TICK_ROOM = 5;

/** The predictions that are drawn, each with its own mark, so that they differ not only by colour. */
const MARKS = [
  { name: "as planned", mark: (x, y) => svg("circle", { class: "said-plan", r: 3, cx: x, cy: y }) },
  {
    name: "default",
    mark: (x, y) => svg("path", { class: "said-default", d: `M${x - 3} ${y - 3}l6 6m0 -6l-6 6` }),
  },
  {
    name: "fitted",
    mark: (x, y) => svg("rect", { class: "said-fitted", x: x - 3, y: y - 3, width: 6, height: 6 }),
  },
  { name: "left out", mark: (x, y) => svg("circle", { class: "said-left-out", r: 3.4, cx: x, cy: y }) },
];

const label = (x, y, text, anchor = "middle") => svg("text", { x, y, "text-anchor": anchor, text });

function legend(predicted) {
  return h(
    "span",
    { class: "said-legend" },
    ...MARKS.map(({ name, mark }) =>
      h(
        "span",
        {},
        svg("svg", { viewBox: "0 0 10 10", "aria-hidden": "true" }, mark(5, 5)),
        predicted.find((prediction) => prediction.name === name).title,
      ),
    ),
  );
}

/** @param {{gaits: Record<string, any>[], foretold: Record<string, any>[]}} result of a job */
function predictionPlot({ gaits, foretold: predicted }) {
  const drawn = MARKS.map((one) => ({ ...one, prediction: predicted.find(({ name }) => name === one.name) }));
  const measured = gaits.map(({ distance_cm: distance }) => distance);
  const all = [...measured, ...drawn.flatMap(({ prediction }) => prediction.distances_cm)];
  const [low, high] = [Math.floor(Math.min(...all)), Math.ceil(Math.max(...all))];
  const scale = (from, to) => (value) =>
    Number((from + ((value - low) / Math.max(high - low, 1)) * (to - from)).toFixed(1));
  const toX = scale(SIZE.left, SIZE.width - SIZE.right);
  const toY = scale(SIZE.height - SIZE.bottom, SIZE.top);
  const ticks = gridPlaces(low, high, gridStep((high - low) * TICK_ROOM));
  const values = gaits.map(({ name, distance_cm: distance }, place) => {
    const said = drawn.map(
      ({ prediction }) => `${fixed(prediction.distances_cm[place])} ${prediction.title}`,
    );
    return `${name}: ${fixed(distance)} measured, ${said.join(", ")}`;
  });
  return h(
    "figure",
    { class: "trial-plot" },
    svg(
      "svg",
      {
        viewBox: `0 0 ${SIZE.width} ${SIZE.height}`,
        class: "said-plot",
        role: "img",
        "aria-label": `Distances in cm. ${values.join("; ")}`,
      },
      ...ticks.flatMap((tick) => [
        svg("line", { class: "grid", x1: toX(tick), x2: toX(tick), y1: toY(low), y2: toY(high) }),
        svg("line", { class: "grid", x1: toX(low), x2: toX(high), y1: toY(tick), y2: toY(tick) }),
        label(toX(tick), SIZE.height - SIZE.bottom + 12, String(tick)),
        label(SIZE.left - 5, toY(tick) + 3, String(tick), "end"),
      ]),
      svg("line", { class: "right-line", x1: toX(low), y1: toY(low), x2: toX(high), y2: toY(high) }),
      label((SIZE.left + SIZE.width) / 2, SIZE.height - 4, "measured, cm"),
      ...drawn.flatMap(({ prediction, mark }) =>
        measured.map((value, place) => mark(toX(value), toY(prediction.distances_cm[place]))),
      ),
    ),
    h(
      "figcaption",
      { class: "quiet" },
      h("span", {
        text:
          "Horizontal: measured distance, cm. Vertical: "
          + "predicted distance, cm. On the diagonal line, both distances are equal.",
      }),
      legend(predicted),
    ),
  );
}
