/** One trial: the displacement of each foot compared with its plan, by iteration, with a note and files. */

import { trialApi } from "../api/trials.js";
import { h, onPress, setText } from "../lib/dom.js";
import { clockTime, counted, fixed } from "../lib/format.js";
import { figureTable, footName } from "../lib/tables.js";
import { attempt } from "../lib/toasts.js";
import { comparisonPart } from "./trial_comparison.js";
import { displacementPlot } from "./trial_displacement.js";
import { exampleMark } from "./trial_list.js";
import { photosPart } from "./trial_photos.js";
import { pathPlot } from "./trial_plot.js";
import { followTrial } from "./trial_sync.js";

const published = ({ distance, angle_deg: angle, error_percent: error }) => [
  fixed(distance, 2),
  fixed(angle, 1),
  fixed(error, 0),
];
const net = ({ net_distance: distance, net_angle_deg: angle, net_error_percent: error }) => [
  fixed(distance, 2),
  fixed(angle, 1),
  fixed(error, 0),
];

const ANGLE_HELP =
  "Angle: direction of the movement, measured from the x axis of the platform where the " + "robot walks";
const PUBLISHED_HELP =
  "Distance as in the published tables, from the largest displacements of a foot along "
  + `x and y. This distance is never negative. ${ANGLE_HELP}`;
const NET_HELP = `Movement of each foot from the first to the last frame. ${ANGLE_HELP}`;

function movementTable(caption, help, figures, plan, columns) {
  const rows = figures.feet.map((foot, index) => [footName(index), ...columns(foot)]);
  rows.push([{ text: "mean" }, ...columns(figures)]);
  if (plan) rows.push([{ text: "planned" }, ...columns(plan.figures)]);
  return figureTable(caption, help, ["", "cm", "angle °", "error %"], rows);
}

function iterationTable({ parts }) {
  return figureTable(
    "Movement in each iteration",
    "Mean movement of the feet from the first to the last frame of each iteration, with time and speed",
    ["", "cm", "s", "mm/s"],
    parts.map((part, index) => [
      { text: `iteration ${index + 1}` },
      fixed(part.net_distance, 2),
      fixed(part.seconds, 1),
      fixed(part.speed_mm_s, 2),
    ]),
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
    ["Wanted", `${fixed(trial.expected_cm, 1)} cm`],
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
        "One HTML file with the figures, plots, note, photos and origin of this trial. You can open the file offline and print it",
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
 * Builds a trial's page in the panel.
 * @param {import("../state/store.js").Store} store
 * @param {string} id
 * @param {{all: () => void, remove: (trial: Record<string, any>) => void, tracks: Function, video: (id: string) => void}} acts `tracks` makes the
 *   switch of the 3D scene
 * @returns {Promise<{element: HTMLElement, leave: () => void}>}
 */
export async function trialDetail(store, id, { all, remove, tracks, video }) {
  const [trial, paths] = await Promise.all([trialApi.read(id), trialApi.paths(id)]);
  const sources = { tracked: paths.track, planned: paths.plan, simulated: null };
  const [head, plots, tail] = ["trial-part", "trial-plots", "trial-part"].map((name) =>
    h("div", { class: name }),
  );
  const comparison = comparisonPart(id, (simulated) => {
    sources.simulated = simulated;
    drawPlots();
  });
  const scene = tracks([id]);
  const note = notePart(async (text) => {
    if (!(await sync.change({ note: text }, "Note kept."))) note.offer();
  });
  let shown = trial;
  let isLate = false;

  /** Draws the plots, but not under a hand that holds a mark: when that lets go. */
  function drawPlots() {
    isLate = plots.querySelector("[data-held]") !== null;
    if (isLate) return;
    const moved = async (part, frame) => {
      if (!(await sync.change({ ends: shown.parts.map(({ end }, index) => (index === part ? frame : end)) })))
        drawPlots();
    };
    keepingMark(plots, () =>
      plots.replaceChildren(pathPlot(sources), displacementPlot(sources, shown, moved)),
    );
  }

  function draw(now) {
    shown = now;
    note.show(now.note);
    head.replaceChildren(
      ...[
        h("button", { class: "link", text: "All trials", on: { click: all } }),
        h("div", { class: "run-line run-title" }, h("b", { text: now.name })),
        exampleLine(now),
        deletedLine(now),
        facts(now),
        sourcePart(now, video),
      ].filter(Boolean),
    );
    tail.replaceChildren(
      ...[
        endsLine(now, (changes) => sync.change(changes)),
        comparison.element,
        iterationTable(now),
        movementTable("Movement as published", PUBLISHED_HELP, now.figures, now.plan, published),
        movementTable("Movement from first to last frame", NET_HELP, now.figures, now.plan, net),
        slipTable(now),
        filesLine(now, remove),
      ].filter(Boolean),
    );
    drawPlots();
    attempt(comparison.refresh)();
    scene.refresh();
  }

  plots.addEventListener("lostpointercapture", () => {
    if (isLate) drawPlots();
  });
  draw(trial);
  const sync = followTrial(store, trial, draw);
  const element = h(
    "div",
    { class: "run-detail" },
    head,
    note.element,
    photosPart(id),
    scene.element,
    plots,
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

/** How often a foot was out of sight, and how often something else was taken for it. */
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

/**
 * Builds the note's field, which stays while the rest of a trial is drawn again.
 * @param {(note: string) => Promise<*>} keep
 * @returns {{element: HTMLElement, show: (note: string) => void, offer: () => void}} `show` tells what is kept now; what was typed
 *   stays, and `offer` lets it be kept once more
 */
function notePart(keep) {
  const area = h("textarea", {
    "aria-label": "Note",
    rows: "2",
    maxlength: "4000",
    placeholder: "Note: floor, cable, observations",
  });
  const words = h("span");
  const mine = h("button", { class: "link", text: "Save what I typed" });
  const theirs = h("button", { class: "link", text: "Use the saved note" });
  const choice = h(
    "p",
    { class: "why", role: "group", "aria-label": "Two notes", hidden: true },
    words,
    " ",
    mine,
    " · ",
    theirs,
  );
  let known = "";

  const typed = () => area.value.trim();

  function offer() {
    choice.hidden = typed() === known;
    setText(words, known ? `The saved note is “${known}”.` : "The saved note is empty.");
  }

  area.addEventListener("change", () => {
    if (choice.hidden && typed() !== known) keep(typed());
  });
  mine.addEventListener("click", () => {
    choice.hidden = true;
    keep(typed());
  });
  theirs.addEventListener("click", () => {
    area.value = known;
    choice.hidden = true;
  });
  return {
    element: h("div", { class: "trial-note" }, area, choice),
    offer,
    show(note) {
      const isTyped = typed() !== known;
      const isOther = note !== known;
      known = note;
      if (!isTyped) area.value = note;
      else if (isOther || !choice.hidden) offer();
    },
  };
}
