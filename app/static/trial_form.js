/** Adding tracks: files, the wanted distance, and what they are laid over. */

import { h } from "./dom.js";
import { clockTime } from "./format.js";
import { attempt, toast } from "./toasts.js";
import { trialApi } from "./trial_api.js";

const FRAME_RATE = 13;

function field(name, help, attributes) {
  const input = h("input", { "aria-label": name, title: help, ...attributes });
  return { input, label: h("label", {}, h("span", { text: name }), input) };
}

const number = (name, help, value, attributes = {}) => field(name, help, { type: "number", step: "any", min: "0", value, required: true, ...attributes });

/** How far the shown gait's body goes as planned, cm. */
function wantedCm(view) {
  const body = view?.plan?.body;
  if (!body?.length) return null;
  const [first, last] = [body[0], body.at(-1)];
  return Number((Math.hypot(last[0] - first[0], last[1] - first[1]) * 100).toFixed(2)) || null;
}

/**
 * Builds the form.
 * @param {{view: object|null, all: () => void, done: (added: object[]) => void}} page `view` is the shown gait's
 */
export function trialForm({ view, all, done }) {
  const files = h("input", { type: "file", multiple: true, accept: ".csv,text/csv", "aria-label": "Track files", required: true });
  const expected = number("Wanted distance, cm", "Of the whole walk, all iterations together", wantedCm(view) ?? "");
  const iterations = number("Iterations", "How often every foot steps in the track", view?.document?.iterations ?? 3, { step: "1", min: "1", max: "50" });
  const rate = number("Frames a second", "Of the recording; the files do not tell", FRAME_RATE);
  const over = h("select", { "aria-label": "Laid over", title: "The plan that the tracks are compared with; it is kept with the trial" },
    view ? h("option", { value: `gait:${view.id}`, text: `${view.document.name}, as planned now` }) : null, h("option", { value: "", text: "no plan" }));
  const perCm = number("Pixels a centimetre", "Leave empty for tracks in centimetres", "", { required: false });
  const [x, y] = [number("Centre x, px", "Pixel of the platform's centre", "", { required: false }), number("Centre y, px", "Pixel of the platform's centre; y runs downwards", "", { required: false })];

  attempt(async () => {
    const { runs } = await trialApi.runs();
    over.append(...runs.map((run) => h("option", { value: `run:${run.id}`, text: `run of ${run.gait_name}, ${clockTime(run.started)}, ${run.by}` })));
  })();

  const keep = attempt(async (event) => {
    event.preventDefault();
    const [kind, id] = over.value.split(/:(.*)/);
    const pixels = perCm.input.value ? { per_cm: perCm.input.valueAsNumber, origin: [x.input.valueAsNumber || 0, y.input.valueAsNumber || 0] } : null;
    const added = [];
    for (const file of files.files) {
      added.push(await trialApi.add({
        name: file.name.replace(/\.csv$/i, ""), csv: await file.text(), expected_cm: expected.input.valueAsNumber,
        iterations: iterations.input.valueAsNumber, frame_rate: rate.input.valueAsNumber, pixels, ...(id ? { [kind]: id } : {}),
      }));
    }
    if (added.length > 1) toast(`${added.length} trials are kept.`);
    done(added);
  });

  return h("form", { class: "trial-form", on: { submit: keep } },
    h("button", { type: "button", class: "link", text: "All trials", on: { click: all } }),
    h("p", { class: "quiet", text: "Foot tracks as CSV: X_D1, Y_D1, X_D2, … and a row a frame, in centimetres with gaps left empty, or in pixels with 0,0 as a gap." }),
    h("label", {}, h("span", { text: "Files" }), files), expected.label, iterations.label, rate.label,
    h("label", {}, h("span", { text: "Laid over" }), over),
    h("details", {}, h("summary", { text: "The files are in pixels" }), perCm.label, x.label, y.label),
    h("button", { class: "primary", text: "Add trials" }));
}
