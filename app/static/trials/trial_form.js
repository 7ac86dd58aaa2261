/** Adding tracks: files, the wanted distance, and what they are laid over. */

import { h } from "../lib/dom.js";
import { textOf } from "../lib/file_text.js";
import { clockTime, counted } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { trialApi } from "../api/trials.js";

const FRAME_RATE = 13;

function field(name, help, attributes) {
  const input = h("input", { "aria-label": name, title: help, ...attributes });
  return { input, label: h("label", {}, h("span", { text: name }), input) };
}

const number = (name, help, value, attributes = {}) =>
  field(name, help, { type: "number", step: "any", min: "0", value, required: true, ...attributes });

/** How far the shown gait's body goes as planned, cm. */
function wantedCm(view) {
  const body = view?.plan?.body;
  if (!body?.length) return null;
  const [first, last] = [body[0], body.at(-1)];
  return Number((Math.hypot(last[0] - first[0], last[1] - first[1]) * 100).toFixed(2)) || null;
}

/** The choice of the plan that tracks are laid over: a gait as it is planned now, or that of a run. */
function planChoice(store, kept) {
  const { view } = store.state;
  const select = h("select", {
    "aria-label": "Compare with plan",
    title: "The tracks are compared with this plan. The plan is saved with the trial",
  });
  const option = (value, text) => h("option", { value, text });
  let [runs, touched] = [[], false];

  /** Another gait may be shown by now: the one that was shown first stays to be chosen. */
  function fill(wanted) {
    const now = store.state.view;
    const gaits = [...new Map([view, now].filter(Boolean).map((one) => [one.id, one.document.name]))];
    select.replaceChildren(
      ...gaits.map(([id, name]) => option(`gait:${id}`, `${name}, as planned now`)),
      option("", "no plan"),
      ...runs.map((run) =>
        option(`run:${run.id}`, `run of ${run.gait_name}, ${clockTime(run.started)}, ${run.by}`),
      ),
    );
    if ([...select.options].some(({ value }) => value === wanted)) select.value = wanted;
  }

  const wanted = kept.run ? `run:${kept.run}` : kept.gait ? `gait:${kept.gait}` : undefined;
  fill(wanted);
  attempt(async () => {
    ({ runs } = await trialApi.runs());
    fill(wanted && !touched ? wanted : select.value);
  })();
  select.addEventListener("change", () => {
    touched = true;
  });
  for (const kind of ["pointerdown", "focus"]) select.addEventListener(kind, () => fill(select.value));
  return select;
}

/**
 * The fields of every trial: the wanted distance, the iterations, and the plan that it is laid over.
 * @param {import("../state/store.js").Store} store
 * @param {{expected_cm?: number, iterations?: number, gait?: string, run?: string}} [kept] what was written
 *   before
 * @returns {{labels: HTMLElement[], values: () => Record<string, any>}}
 */
export function walkFields(store, kept = {}) {
  const { view } = store.state;
  const expected = number(
    "Wanted distance, cm",
    "Distance that the robot should walk, over all iterations together",
    kept.expected_cm ?? wantedCm(view) ?? "",
  );
  const iterations = number(
    "Iterations",
    "Number of iterations of the gait in each track",
    kept.iterations ?? view?.document?.iterations ?? 3,
    { step: "1", min: "1", max: "50" },
  );
  let isTyped = expected.input.value === "" || kept.expected_cm !== undefined;
  expected.input.addEventListener("input", () => {
    isTyped = true;
  });
  iterations.input.addEventListener("input", () => {
    const step = wantedCm(view) / (view?.document?.iterations || 1);
    if (!isTyped && iterations.input.valueAsNumber > 0)
      expected.input.value = String(Number((step * iterations.input.valueAsNumber).toFixed(2)));
  });
  const over = planChoice(store, kept);
  return {
    labels: [
      expected.label,
      iterations.label,
      h("label", {}, h("span", { text: "Compare with plan" }), over),
    ],
    values() {
      const [kind, id] = over.value.split(/:(.*)/);
      return {
        expected_cm: expected.input.valueAsNumber,
        iterations: iterations.input.valueAsNumber,
        ...(id ? { [kind]: id } : {}),
      };
    },
  };
}

/** The fields of tracks in pixels; `value` is null for tracks in centimetres. */
function pixelFields() {
  const optional = { required: false };
  const perCm = number(
    "Pixels a centimetre",
    "Leave this field empty if the tracks are in centimetres",
    "",
    optional,
  );
  const x = number("Centre x, px", "Horizontal pixel position of the platform's centre", "", optional);
  const y = number(
    "Centre y, px",
    "Vertical pixel position of the platform's centre, counted from the top",
    "",
    optional,
  );
  const summary = h("summary", { text: "The files are in pixels" });
  return {
    element: h("details", {}, summary, perCm.label, x.label, y.label),
    value: () =>
      perCm.input.value
        ? {
            per_cm: perCm.input.valueAsNumber,
            origin: [x.input.valueAsNumber || 0, y.input.valueAsNumber || 0],
          }
        : null,
  };
}

/** The files with the times of the frames, where the rate of a film varies. */
const clockField = () =>
  field(
    "Frame times",
    "For films whose frame rate varies: choose for each track file one file with the time of each frame in "
      + "seconds, one time per line or in a column called time. The studio pairs the files in the order of "
      + "their names, and does not use the frame rate",
    { type: "file", multiple: true, accept: ".csv,.txt,text/csv,text/plain" },
  );

/** Refuses files of frame times that are more or fewer than the tracks. */
function requirePairs(tracks, times) {
  if (times.length && times.length !== tracks.length)
    throw new Error(
      `${counted(times.length, "file")} of frame times for ${counted(tracks.length, "track")}. `
        + "Choose one for each track.",
    );
}

const FORM_TEXT =
  "Choose CSV files with foot tracks. The columns are X_D1, Y_D1, X_D2, …, with one row for each frame. "
  + "If a foot was not seen in a frame, its cells are empty (tracks in centimetres) or 0 (tracks in pixels).";

const inOrder = ({ files }) => [...files].sort((a, b) => a.name.localeCompare(b.name));

/**
 * Builds the form.
 * @param {Object} page
 * @param {import("../state/store.js").Store} page.store
 * @param {() => void} page.all
 * @param {(added: Record<string, any>[]) => void} page.done
 */
export function trialForm({ store, all, done }) {
  const files = h("input", {
    type: "file",
    multiple: true,
    accept: ".csv,text/csv",
    "aria-label": "Track files",
    required: true,
  });
  const rate = number(
    "Frames a second",
    "Frame rate of the recording. The files do not contain the frame rate",
    FRAME_RATE,
  );
  const clocks = clockField();
  const inPixels = pixelFields();
  const walk = walkFields(store);

  const keep = attempt(async (event) => {
    event.preventDefault();
    const pixels = inPixels.value();
    const [tracks, times] = [files, clocks.input].map(inOrder);
    requirePairs(tracks, times);
    const added = [];
    for (const [index, file] of tracks.entries()) {
      added.push(
        await trialApi.add({
          name: file.name.replace(/\.csv$/i, ""),
          csv: await textOf(file),
          ...(times.length
            ? { frame_times: await textOf(times[index]) }
            : { frame_rate: rate.input.valueAsNumber }),
          pixels,
          ...walk.values(),
        }),
      );
    }
    const remarks = added.flatMap(({ name, remarks: said }) => said.map((one) => `${name}: ${one}`));
    const words = added.length > 1 ? [`${added.length} trials were added.`, ...remarks] : remarks;
    if (words.length) toast(words.join(" "));
    done(added);
  });

  const [expected, iterations, over] = walk.labels;
  return h(
    "form",
    { class: "trial-form", on: { submit: keep } },
    h("button", { type: "button", class: "link", text: "All trials", on: { click: all } }),
    h("p", { class: "quiet", text: FORM_TEXT }),
    h("label", {}, h("span", { text: "Files" }), files),
    expected,
    iterations,
    rate.label,
    clocks.label,
    over,
    inPixels.element,
    h("button", { class: "primary", text: "Add trials" }),
  );
}
