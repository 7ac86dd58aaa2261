/** One trial: the displacement of each foot compared with its plan, by iteration, with a note and files. */

import { trialApi } from "../api/trials.js";
import { h, onPress } from "../lib/dom.js";
import { clockTime, counted, fixed } from "../lib/format.js";
import { figureTable, footName } from "../lib/tables.js";
import { attempt } from "../lib/toasts.js";
import { comparisonPart } from "./trial_comparison.js";
import { displacementPlot } from "./trial_displacement.js";
import { exampleMark } from "./trial_list.js";
import { notePart } from "./trial_note.js";
import { photosPart } from "./trial_photos.js";
import { pathPlot } from "./trial_plot.js";
import { followTrial } from "./trial_sync.js";
import { NET_HEAD, NET_HELP, angleText, distanceText, errorText, netCells } from "./trial_words.js";

const publishedCells = ({ distance, angle_deg: angle, error_percent: error, extent_distance: extent }) => [
  distanceText(distance),
  angleText(angle),
  errorText(error),
  distanceText(extent),
];

const PUBLISHED_HEAD = ["cm", "angle °", "error %", "extent cm"];
const PUBLISHED_HELP =
  "Movement by the definitions of the published tables. Distance, angle and error: from the largest "
  + "displacements of a foot from its first place along +x and +y, as in thesis Tables 5.2 to 5.8. They are "
  + "never negative. Extent: from the largest less the smallest x and y, as in thesis Tables A.1 to A.4";

function movementTable(caption, help, head, { figures, plan }, columns) {
  const rows = figures.feet.map((foot, index) => [footName(index), ...columns(foot)]);
  rows.push([{ text: "mean" }, ...columns(figures)]);
  if (plan) rows.push([{ text: "planned" }, ...columns(plan.figures)]);
  return figureTable(caption, help, ["", ...head], rows);
}

function iterationTable({ parts, step_mean: step }) {
  const pace = ({ seconds, speed_mm_s: speed }) => [fixed(seconds, 1), fixed(speed, 2)];
  return figureTable(
    "Net movement in each iteration",
    "Mean movement of the feet from the first to the last frame of each iteration, with time and speed. "
      + "Mean: as “Individual step” in thesis Tables 5.5 to 5.8",
    ["", "net cm", "angle °", "s", "mm/s"],
    [
      ...parts.map((part, index) => [
        { text: `iteration ${index + 1}` },
        ...netCells(part).slice(0, 2),
        ...pace(part),
      ]),
      [{ text: "mean" }, distanceText(step.distance), angleText(step.angle_deg), ...pace(step)],
    ],
  );
}

function slipTable({ slip }) {
  const help = "Distance that each foot slid on the ground while it stood between two steps";
  return figureTable(
    "Slip of standing feet, cm",
    help,
    ["", "largest", "mean"],
    slip.map((slides, index) => [
      footName(index),
      fixed(Math.max(...slides), 2),
      fixed(slides.reduce((sum, value) => sum + value, 0) / slides.length, 2),
    ]),
  );
}

function facts(trial) {
  const rows = [
    ["By", trial.by || "–"],
    ["Added", clockTime(trial.made)],
    ["Gait", trial.gait_name || "–"],
    ["Wanted", `${distanceText(trial.expected_cm)} cm`],
    [
      "Speed",
      `${fixed(trial.speed_mm_s, 2)} mm/s, ${fixed(trial.body_lengths_s, 4)} body lengths/s`,
      "Net distance divided by the time from the first to the last frame. "
        + "The length of the body is the width of the robot's plate",
    ],
    ["Frames", `${trial.frames}, ${fixed(trial.frame_rate, 1)} a second`],
    [
      "Gaps",
      trial.filled ? `${trial.gaps.length} (${counted(trial.filled, "missing position")} filled in)` : "none",
    ],
    ...(trial.plan
      ? [
          [
            "Placement",
            `${fixed(trial.plan.turn_deg, 1)}°, feet ± ${fixed(Math.max(...trial.plan.gaps_cm) * 10, 1)} mm`,
            "The studio turned the plan by this angle to fit the feet in the first frame. "
              + "The second value is the largest remaining distance between a foot and the plan",
          ],
        ]
      : []),
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

function endsLine(trial, change) {
  if (trial.parts.length < 2) return null;
  if (trial.ends_from === "run")
    return h("p", { class: "quiet", text: "The ends of the iterations come from the recorded run." });
  if (trial.ends_by_hand) {
    const again = h("button", { class: "link", text: "Find them again" });
    onPress(again, () => change({ ends: null }));
    return h("p", { class: "quiet" }, "The ends of the iterations were moved by hand. ", again);
  }
  return h("p", {
    class: trial.is_clear ? "quiet" : "why",
    text: trial.is_clear
      ? "The ends of the iterations were computed from the steps of the feet."
      : "The steps of two iterations overlap. Check the marks at the ends of the iterations.",
  });
}

/** That no robot did it, where it is an example. */
const exampleLine = ({ is_example: isExample }) =>
  isExample
  && h(
    "p",
    { class: "why" },
    exampleMark(),
    " This trial was simulated. "
      + "The studio does not use simulated trials to compare gaits or to learn physics parameters.",
  );

/** That a trial is deleted, with a way back; nothing else can be done to it. */
function deletedLine({ id, deleted }) {
  if (!deleted) return null;
  const back = h("button", { class: "link", text: "Bring it back" });
  onPress(
    back,
    attempt(() => trialApi.restore(id)),
  );
  return h(
    "p",
    { class: "why", role: "status", data: { toneText: "caution" } },
    "This trial is deleted. ",
    back,
  );
}

function filesLine(trial, remove) {
  const at = `/api/trials/${encodeURIComponent(trial.id)}`;
  const erase = h("button", {
    class: "link",
    text: "Delete",
    title: "Removes this trial from the list. Undo brings the trial back",
    on: { click: () => remove(trial) },
  });
  return h(
    "div",
    { class: "run-files" },
    h("a", {
      href: `${at}/track.csv`,
      download: "",
      text: "Track as CSV",
      title: "Places of the feet in cm. Where a foot was not seen, the cell is empty",
    }),
    h("a", {
      href: `${at}/report`,
      download: "",
      text: "Report",
      title:
        "One HTML file with the figures, plots, note, photos and origin of this trial. "
        + "You can open the file offline and print it",
    }),
    !trial.deleted && erase,
  );
}

/** Redraws the plots; the mark that had the focus has it again. */
function keepingMark(plots, redraw) {
  const label = document.activeElement?.getAttribute?.("aria-label");
  redraw();
  if (label?.startsWith("End of iteration"))
    [...plots.querySelectorAll(".end-handle")]
      .find((one) => one.getAttribute("aria-label") === label)
      ?.focus();
}

/**
 * The plots of a trial, with marks at the ends of iterations that can be moved.
 * @param {Record<string, Record<string, any>|null>} sources paths, which may change before the next `draw`
 * @param {(ends: number[]) => Promise<boolean>} keep
 * @returns {{element: HTMLElement, draw: (trial?: Record<string, any>) => void}}
 */
function plotsPart(sources, keep) {
  const element = h("div", { class: "trial-plots" });
  let shown = null;
  let isLate = false;

  async function moved(part, frame) {
    const ends = shown.parts.map(({ end }, index) => (index === part ? frame : end));
    if (!(await keep(ends))) draw();
  }

  /** Draws the plots, but not under a hand that holds a mark: when that lets go. */
  function draw(trial = shown) {
    shown = trial;
    isLate = element.querySelector("[data-held]") !== null;
    if (isLate) return;
    keepingMark(element, () =>
      element.replaceChildren(pathPlot(sources), displacementPlot(sources, shown, moved)),
    );
  }

  element.addEventListener("lostpointercapture", () => {
    if (isLate) draw();
  });
  return { element, draw };
}

/** What a trial is, above its note and plots. */
const headParts = (trial, { all, video }) =>
  [
    h("button", { class: "link", text: "All trials", on: { click: all } }),
    h("div", { class: "run-line run-title" }, h("b", { text: trial.name })),
    exampleLine(trial),
    deletedLine(trial),
    facts(trial),
    sourcePart(trial, video),
  ].filter(Boolean);

/** What was measured in a trial, and its files. */
const tailParts = (trial, { change, comparison, remove }) =>
  [
    endsLine(trial, change),
    comparison,
    iterationTable(trial),
    movementTable("Net movement", NET_HELP, NET_HEAD, trial, netCells),
    movementTable("Movement as published", PUBLISHED_HELP, PUBLISHED_HEAD, trial, publishedCells),
    slipTable(trial),
    filesLine(trial, remove),
  ].filter(Boolean);

/**
 * Builds a trial's page in the panel.
 * @param {import("../state/store.js").Store} store
 * @param {string} id
 * @param {Object} acts
 * @param {() => void} acts.all
 * @param {(trial: Record<string, any>) => void} acts.remove
 * @param {Function} acts.tracks makes the switch of the 3D scene
 * @param {(id: string) => void} acts.video
 * @returns {Promise<{element: HTMLElement, leave: () => void}>}
 */
export async function trialDetail(store, id, { all, remove, tracks, video }) {
  const [trial, paths] = await Promise.all([trialApi.read(id), trialApi.paths(id)]);
  const sources = { tracked: paths.track, planned: paths.plan, simulated: null };
  const [head, tail] = [1, 2].map(() => h("div", { class: "trial-part" }));
  const plots = plotsPart(sources, (ends) => sync.change({ ends }));
  const comparison = comparisonPart(id, (simulated) => {
    sources.simulated = simulated;
    plots.draw();
  });
  const scene = tracks([id]);
  const note = notePart(async (text) => {
    if (!(await sync.change({ note: text }, "Note kept."))) note.offer();
  });
  const change = (changes) => sync.change(changes);

  function draw(now) {
    note.show(now.note);
    head.replaceChildren(...headParts(now, { all, video }));
    tail.replaceChildren(...tailParts(now, { change, comparison: comparison.element, remove }));
    plots.draw(now);
    attempt(comparison.refresh)();
    scene.refresh();
  }

  draw(trial);
  const sync = followTrial(store, trial, draw);
  const element = h(
    "div",
    { class: "run-detail" },
    head,
    note.element,
    photosPart(id),
    scene.element,
    plots.element,
    tail,
  );
  return {
    element,
    leave() {
      sync.leave();
      comparison.leave();
      scene.leave();
    },
  };
}

const stretches = (count, what) => (count ? `${what}${count === 1 ? "" : `, ${count} times`}.` : null);

/**
 * How often a foot was out of sight, and how often something else was taken for it.
 * @param {Record<string, any>} trial
 */
function sights({ unseen, false: wrong }) {
  const words = [
    stretches(unseen.length, "The camera did not see a foot"),
    stretches(wrong.length, "The studio mistook something else for a foot"),
  ].filter(Boolean);
  return words.length
    ? `${words.join(" ")} The studio marks these gaps in the track and fills them with straight lines.`
    : null;
}

/**
 * Builds the lines; nothing for tracks out of files.
 * @param {Record<string, any>} trial
 * @param {(video: string) => void} open a video
 */
function sourcePart(trial, open) {
  const { source, remarks, plan } = trial;
  const doubts = [
    ...remarks,
    source ? sights(trial) : null,
    plan && !plan.fits ? plan.fit_sentence : null,
    plan?.astray_sentence,
  ].filter(Boolean);
  if (!source && !doubts.length) return null;
  const video =
    source?.video
    && h("button", {
      class: "link",
      text: source.camera ? `Recording of ${source.camera}` : "Video of this trial",
      title: "Opens the video in which the feet were tracked",
      on: { click: () => open(source.video) },
    });
  return h(
    "div",
    { class: "trial-source" },
    source
      && h(
        "p",
        { class: "quiet" },
        video,
        video && " · ",
        `tracked with the camera setup “${source.setup_name}”, version ${source.setup_revision}`,
      ),
    ...doubts.map((text) => h("p", { class: "why", data: { toneText: "caution" }, text })),
  );
}
