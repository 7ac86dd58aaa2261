/** The Sequence section: gaits that follow each other. It stands where other gaits have the segment table. */

import { api } from "../api/gaits.js";
import { freeName } from "../document/gait_names.js";
import { isSequence } from "../document/sequence_edits.js";
import { byId, h, onPress, setAllowed } from "../lib/dom.js";
import { counted, fixed, mm } from "../lib/format.js";
import { openStep } from "../steps/steps.js";
import { attempt, toast } from "../lib/toasts.js";
import { selectGait } from "../shell/gait_list.js";
import { jobIsOn } from "../shell/job_list.js";
import { numberField } from "../state/fields.js";
import { acceptView, runIsOn, shownDocument, shownPlan } from "../state/store.js";
import { partAdder } from "./part_adder.js";
import { partRows } from "./sequence_rows.js";
import { SAMPLE_TIMES, sequenceTrouble } from "./sequence_trouble.js";

const TEACH =
  "Each part starts with the feet, body and heading that the previous part ends with. "
  + "You check and approve the sequence as a whole, not part by part.";
const OPTIMISE =
  "After every edit, the studio computes the motions of the parts again. "
  + "The button Optimise parts also improves the footholds of each part, over all its repetitions.";
const ALL_EXACT = "There is nothing to optimise. Each part is already optimised, made by hand or recorded.";

function totals() {
  const element = h("dl", { class: "summary", "aria-label": "The whole sequence" });
  return {
    element,
    show(plan) {
      const rows = plan?.times?.length && plan.body.length ? wholeOf(plan) : [];
      element.replaceChildren(
        ...rows.flatMap(([name, value]) => [h("dt", { text: name }), h("dd", { text: value })]),
      );
    },
  };
}

function wholeOf({ body, heading, duration }) {
  const way = [0, 1].map((axis) => body.at(-1)[axis] - body[0][axis]);
  return [
    ["Travel", `${mm(Math.hypot(...way))} mm`],
    ["along x, y", `${mm(way[0])}, ${mm(way[1])} mm`],
    ["Turn", `${fixed(((heading.at(-1) - heading[0]) * 180) / Math.PI, 0)}°`],
    ["Duration", `${fixed(duration)} s`],
  ];
}

/** The box that says which gaits changed since they became parts. */
function staleness(takeOver) {
  const text = h("span");
  const element = h(
    "div",
    { class: "box-note", data: { tone: "caution" }, hidden: true },
    text,
    h(
      "div",
      { class: "buttons" },
      h("button", {
        text: "Update all",
        title: "Copies the current version of each changed gait into the sequence",
        on: { click: () => takeOver() },
      }),
    ),
  );
  return {
    element,
    show(sources) {
      const changed = sources.filter((state) => state === "changed").length;
      element.hidden = changed === 0;
      text.textContent =
        changed === 1
          ? "The gait of one part has changed since you added the part."
          : `The gaits of ${changed} parts have changed since you added the parts.`;
    },
  };
}

/** Makes a sequence of the shown gait; of the first that can be a part where the shown one cannot. */
async function createSequence(store) {
  const { gaits, selected } = store.state;
  const shown = gaits.find(({ id }) => id === selected);
  const first =
    shown && !shown.part_refusal
      ? shown
      : gaits.find(({ part_refusal: refusal, problem, walks }) => !refusal && !problem && walks !== false);
  const view = await api.sequence({ name: freeName(store.state, "Sequence"), parts: [{ gait: first.id }] });
  await selectGait(store, view.id);
  openStep("design");
  if (shown && first !== shown)
    toast(
      `“${shown.name}” cannot be a part of a sequence `
        + `(${shown.part_refusal}). The sequence begins with “${first.name}” instead. `
        + "Choose other gaits under “Gait to add”.",
    );
}

/** What a sequence is offered: to optimise its parts. */
function exactParts(store) {
  const button = h("button", { class: "wide", text: "Optimise parts" });
  onPress(
    button,
    attempt(() => api.optimiseParts(store.state.selected)),
    (why) => toast(why),
  );
  store.watch(
    (state) => [state.jobs, state.view, state.pending.length],
    ({ jobs, view, pending }) => {
      if (!isSequence(view?.document)) return;
      const busy =
        jobs.some((job) => job.gait === view.id && jobIsOn(job))
        && "The studio is already optimising the parts. Wait until the jobs end, or cancel the jobs.";
      const open = view.plan.parts.some(({ source }) => ["live", "draft"].includes(source));
      setAllowed(
        button,
        busy || (pending.length ? "The studio is still saving your last edit." : open ? null : ALL_EXACT),
        "Optimises each part that has no optimised motion yet",
      );
    },
  );
  return h("div", { class: "sequence-only" }, button, h("p", { class: "why", text: OPTIMISE }));
}

/** Takes over a part's gait as it is now, or all of them; different sample times can be resampled. */
function takingOver(store) {
  const take = async (part, resample) =>
    acceptView(store, await api.refreshSequence(store.state.selected, part, resample));
  return attempt(async (part = null) => {
    try {
      await take(part, false);
    } catch (error) {
      if (error.where !== SAMPLE_TIMES) throw error;
      const resample = attempt(() => take(part, true));
      store.set({
        formError: error.message,
        formRefusal: { sentence: error.message, where: error.where, resample },
      });
    }
  });
}

/**
 * Builds the section, and the entry of the menu New that makes a sequence; `cancel` ends a drag.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {import("../preview/playback.js").Playback} playback
 * @param {{addNew: (entry: Record<string, any>) => void}} gaitTools
 */
export function mountSequence(store, edits, playback, gaitTools) {
  gaitTools.addNew({
    text: "New sequence",
    help: "Makes a sequence that begins with the shown gait. You add more gaits in the inspector",
    act: attempt(() => createSequence(store)),
  });
  const takeOver = takingOver(store);
  const [rows, whole, stale] = [partRows(store, edits, playback, takeOver), totals(), staleness(takeOver)];
  const between = betweenParts(store, edits);
  const count = h("span");
  const trouble = sequenceTrouble(edits);
  byId("sequence").append(
    h("h3", {}, "Sequence", count),
    partAdder(store, edits),
    rows.grid,
    trouble.element,
    stale.element,
    whole.element,
    between.element,
    h("p", { class: "teach", text: TEACH }),
  );
  byId("optimise").append(exactParts(store));
  const show = (state) => {
    const document_ = shownDocument(state);
    const on = isSequence(document_);
    document.body.toggleAttribute("data-sequence", on);
    byId("sequence").hidden = !on;
    if (!on) return;
    const plan = shownPlan(state);
    rows.show(state);
    between.show(document_);
    whole.show(plan);
    stale.show(state.view.sources ?? []);
    count.textContent = counted(document_.sequence.length, "part");
    trouble.show(state, document_, plan);
  };
  store.watch(
    (state) => [
      state.view,
      state.pending,
      state.gesture,
      state.formError,
      state.formRefusal,
      shownPlan(state),
    ],
    show,
  );
  // A sequence is edited by its parts, so that they come first where a person turns to one.
  store.watch(
    ({ view }) => [view?.id],
    ({ view, robot }) => {
      if (isSequence(view?.document) && !runIsOn(robot)) openStep("design");
    },
  );
  return { cancel: () => rows.cancel() || between.cancel() };
}

const option = (name, factor = 1) => ({
  read: ({ options }) => options[name] * factor,
  write: (document, value) => ({
    ...document,
    options: { ...document.options, [name]: factor === 1 ? Math.round(value) : value / factor },
  }),
});

const FIELDS = [
  {
    label: "Body speed",
    name: "Body speed between parts",
    unit: "mm/s",
    min: 1,
    max: 60,
    step: 1,
    decimals: 1,
    help: "Largest speed of the body while the robot changes from one part to the next",
    ...option("body_speed", 1000),
  },
  {
    label: "Clearance",
    name: "Clearance between parts",
    unit: "mm",
    min: 0,
    max: 15,
    step: 0.5,
    decimals: 2,
    help: "Each foot rises at least this high when it steps between two parts",
    ...option("clearance", 1000),
  },
  {
    label: "Stability margin",
    name: "Stability margin between parts",
    unit: "mm",
    min: 0,
    max: 30,
    step: 0.5,
    decimals: 2,
    help:
      "Smallest allowed distance of the centre of pressure from the edge of the support polygon, "
      + "while feet step between two parts",
    ...option("margin", 1000),
  },
  {
    label: "Phase length",
    name: "Phase length between parts",
    unit: "samples",
    min: 2,
    max: 50,
    step: 1,
    decimals: 0,
    help: "Length of each stance and swing, when feet step between two parts",
    ...option("phase_knots"),
  },
];

/** Builds the fields; `show` gives them the document. */
function betweenParts(store, edits) {
  const fields = FIELDS.map((field) => numberField(store, edits, field));
  const element = h(
    "details",
    { class: "more" },
    h("summary", { text: "Between parts" }),
    h("div", { class: "fields" }, ...fields.map((field) => field.element)),
  );
  return {
    element,
    show: (document) => fields.forEach((field) => field.show(document)),
    cancel: () => fields.some((field) => field.cancel?.()),
  };
}
