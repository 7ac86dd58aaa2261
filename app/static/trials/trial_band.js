/** Several trials of one gait and step in one plot: the mean path, the spread, each trial, and the plan. */

import { figureTable, footName } from "../lib/tables.js";
import { h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";
import { comparisonApi } from "./trial_comparison.js";
import { ground, legend, points } from "./trial_plot.js";
import { displacementFrame } from "./trial_displacement.js";

/** The studio lays so many over each other; of more, the newest are chosen. */
const MOST_TOGETHER = 20;
const TEXTS = { mean: "mean", trial: "each trial", plan: "planned" };

/** @param {Record<string, any>} band */
const kindsOf = ({ has_plan: hasPlan }) => ["mean", "trial", ...(hasPlan ? ["plan"] : [])];

/** Rectangles between the least and the greatest place of each moment, as one shape. */
function cover({ low, high }, toX, toY) {
  const boxes = low.x.map((_, at) => {
    const [left, right, top, bottom] = [
      toX(low.x[at]) - 0.5,
      toX(high.x[at]) + 0.5,
      toY(high.y[at]) - 0.5,
      toY(low.y[at]) + 0.5,
    ].map((value) => value.toFixed(1));
    return `M${left} ${top}H${right}V${bottom}H${left}Z`;
  });
  return boxes.join("");
}

/** The feet from above, and how far the trials lie apart as a pale area. */
function bandFromAbove(band) {
  const places = band.feet.map(({ place }) => place);
  const { toX, toY, size, step, lines } = ground(
    places.flatMap(({ low, high, plan }) => [low, high, ...(plan ? [plan] : [])]),
  );
  const line = (kind, foot, { x, y }) =>
    svg("polyline", { class: `way-${kind}`, "data-foot": foot + 1, points: points(x.map(toX), y.map(toY)) });
  const drawn = places.flatMap((place, foot) => [
    svg("path", { class: "spread", "data-foot": foot + 1, d: cover(place, toX, toY) }),
    ...(place.plan ? [line("plan", foot, place.plan)] : []),
    ...place.trials.map((way) => line("trial", foot, way)),
    line("mean", foot, place.mean),
  ]);
  const text = band.feet
    .map(({ end_spread_cm: spread }, foot) => `foot ${foot + 1} ends ± ${fixed(spread, 2)} cm`)
    .join("; ");
  return h(
    "figure",
    { class: "trial-plot" },
    svg(
      "svg",
      { viewBox: `0 0 ${size} ${size}`, role: "img", "aria-label": `Trials from above: ${text}` },
      ...lines,
      ...drawn,
    ),
    h(
      "figcaption",
      { class: "quiet" },
      `Feet seen from above, in the robot's frame. Grid: ${step} cm. `
        + "The pale area covers all trials in this plot.",
      legend(kindsOf(band), TEXTS),
    ),
  );
}

/** The displacement of the feet over the iterations. */
function bandOverIterations({ feet, iterations, ...band }) {
  const ways = feet.map(({ way }) => way);
  const all = ways.flatMap(({ low, high, plan }) => [...low, ...high, ...(plan ?? [])]);
  const range = all.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [0, 0.1]);
  const count = iterations.at(-1);
  const { drawing, toX, toY } = displacementFrame(range, count, {
    begin: "cm over iterations",
    end: String(count),
  });
  const xs = iterations.map(toX);
  const line = (kind, foot, values) =>
    svg("polyline", { class: `way-${kind}`, "data-foot": foot + 1, points: points(xs, values.map(toY)) });
  drawing.append(
    ...ways.flatMap((way, foot) => [
      svg("polygon", {
        class: "spread",
        "data-foot": foot + 1,
        points: `${points(xs, way.low.map(toY))} ${points([...xs].reverse(), way.high.map(toY).reverse())}`,
      }),
      ...(way.plan ? [line("plan", foot, way.plan)] : []),
      ...way.trials.map((one) => line("trial", foot, one)),
      line("mean", foot, way.mean),
    ]),
  );
  return h(
    "figure",
    { class: "trial-plot" },
    drawing,
    h(
      "figcaption",
      { class: "quiet" },
      `Distance of each foot along the ${band.has_plan ? "planned" : "mean"} direction`,
      legend(kindsOf(band), TEXTS),
    ),
  );
}

const HELP =
  "Mean: distance of the foot, averaged over the trials. Spread: distance of the end points from their mean "
  + "(root mean square). Planned: distance of the foot in the plan";

const spreadTable = ({ feet, has_plan: hasPlan }) =>
  figureTable(
    `Final distance of each foot along the ${hasPlan ? "planned" : "mean"} direction, cm`,
    HELP,
    ["", "mean", "spread", "planned"],
    feet.map(({ way, end_spread_cm: spread }, foot) => [
      footName(foot),
      ...[way.mean.at(-1), spread, way.plan?.at(-1) ?? null].map((value) => fixed(value, 2)),
    ]),
  );

/** A check box a trial, which includes it, and a button that opens the trial. */
function choice(trials, open, changed) {
  const boxes = trials.map(({ id, name }, index) => {
    const box = h("input", { type: "checkbox", "aria-label": name, value: id, on: { change: changed } });
    box.checked = index < MOST_TOGETHER;
    return {
      box,
      row: h(
        "li",
        {},
        h("label", {}, box),
        h("button", {
          class: "link",
          text: name,
          title: "Opens this trial and compares it with its plan",
          on: { click: () => open(id) },
        }),
      ),
    };
  });
  const element = h(
    "ul",
    { class: "band-trials", role: "list", "aria-label": "Trials in this plot" },
    ...boxes.map(({ row }) => row),
  );
  return { element, chosen: () => boxes.filter(({ box }) => box.checked).map(({ box }) => box.value) };
}

/**
 * Builds the band's page in the panel.
 * @param {Record<string, any>} group a row of the gaits compared, with its trials' `lines`, the newest first
 * @param {{all: () => void, open: (id: string) => void, tracks: Function}} acts
 * @returns {Promise<{element: HTMLElement, leave: () => void}>}
 */
export async function trialBand(group, { all, open, tracks }) {
  const plots = h("div", { class: "trial-plots" });
  const scene = h("div");
  let part = null;

  const draw = attempt(async () => {
    const ids = chosen();
    const band = ids.length ? await comparisonApi.band(ids) : null;
    if (ids.join() !== chosen().join()) return;
    part?.leave();
    part = band && tracks(ids);
    plots.replaceChildren(
      ...(band
        ? [bandFromAbove(band), bandOverIterations(band), spreadTable(band)]
        : [h("p", { class: "teach", text: "Choose at least one trial." })]),
    );
    scene.replaceChildren(...(part ? [part.element] : []));
    await part?.refresh();
  });

  const { element: list, chosen } = choice(group.lines, open, draw);
  const element = h(
    "div",
    { class: "run-detail" },
    h("button", { class: "link", text: "All trials", on: { click: all } }),
    h(
      "div",
      { class: "run-line run-title" },
      h("b", { text: `${group.gait_name}, ${fixed(group.step_cm, 1)} cm` }),
    ),
    list,
    scene,
    plots,
  );
  await draw();
  return {
    element,
    leave() {
      part?.leave();
    },
  };
}
