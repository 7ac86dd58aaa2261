/** The Optimise section: what is asked for, the button, the answer, and the curve that stays. */

import { api } from "./api.js";
import { mountConvergence } from "./convergence.js";
import { byId, h, onPress, setAllowed, setAttribute } from "./dom.js";
import { fixed } from "./format.js";
import { jobIsOn, jobOf } from "./jobs.js";
import { shownDocument } from "./store.js";
import { attempt, toast } from "./toasts.js";

const diagonal = (document) => document.orientation === "FB";

/** Body travel an iteration along the gait's heading, m. */
export const stepLength = ({ step }) => Math.hypot(step[0], step[1]);

function withStep(document, metres) {
  const [dx, dy] = diagonal(document) ? [metres / Math.SQRT2, metres / Math.SQRT2] : [metres, 0];
  return { ...document, step: [dx, dy, document.step[2]] };
}

const option = (name, factor) => ({
  read: (document) => (document.options?.[name] ?? null) === null ? "" : document.options[name] * factor,
  write: (document, value) => ({ ...document, options: { ...document.options, [name]: value === null ? null : value / factor } }),
});

const FIELDS = [
  { id: "step", label: "Step", unit: "mm", min: 0, max: 60, help: "Travel of the body an iteration, along the gait's heading",
    read: (document) => stepLength(document) * 1000, write: (document, value) => withStep(document, (value ?? 0) / 1000) },
  { id: "turn", label: "Turn", unit: "°", min: -90, max: 90, help: "Turn of the body an iteration, counter-clockwise",
    read: (document) => (document.step[2] * 180) / Math.PI,
    write: (document, value) => ({ ...document, step: [document.step[0], document.step[1], ((value ?? 0) * Math.PI) / 180] }) },
  { id: "height", label: "Body height", unit: "mm", min: 53, max: 60.5,
    help: "Height of the motors' plane over the standing feet at the start and at the goal", ...option("plane_height", 1000) },
  { id: "clearance", label: "Clearance", unit: "mm", min: 0, max: 15, help: "How high a foot passes in the middle of its swing", ...option("clearance", 1000) },
  { id: "margin", label: "Stability margin", unit: "mm", min: 0, max: 30, help: "Least distance of the balance point from the support polygon's edge", ...option("margin", 1000) },
];

function numberField(edits, field) {
  const input = h("input", { type: "number", id: `field-${field.id}`, step: "any", min: field.min, max: field.max, placeholder: field.empty ?? null, autocomplete: "off" });
  input.addEventListener("change", () => {
    const value = input.value.trim() === "" ? null : Number(input.value);
    if (value === null && !field.empty) return;
    edits.edit((document) => field.write(document, value), `${field.label} to ${value === null ? field.empty : `${fixed(value)} ${field.unit}`}`);
  });
  const label = h("label", { class: "field", title: `${field.help} (${field.min} to ${field.max} ${field.unit})` },
    field.label, h("span", { class: "box", data: { unit: field.unit } }, input));
  const show = (document) => {
    if (input === globalThis.document.activeElement && input.value !== "") return;
    const value = field.read(document);
    input.value = value === "" ? "" : String(Number(value.toFixed(2)));
  };
  return { label, show, input };
}

function orderField(store, edits) {
  const input = h("input", { id: "field-order", autocomplete: "off", inputmode: "numeric" });
  input.addEventListener("change", () => {
    const { order, options } = edits.shown();
    const wanted = input.value.split(/[^0-9]+/).filter(Boolean).map(Number);
    if (wanted.length === 1 && input.value.trim().length === order.length) wanted.splice(0, 1, ...[...input.value.trim()].map(Number));
    if ([...wanted].sort((a, b) => a - b).join() !== [...order].sort((a, b) => a - b).join()) {
      store.set({ formError: `The foot order "${input.value}" does not name each of the ${order.length} feet once. Write for example ${order.join(" ")}.` });
    } else if (wanted.join() !== order.join()) {
      edits.redraw({ order: wanted, phase_knots: options?.phase_knots ?? 5, closing_knots: options?.closing_knots ?? 5 });
    }
  });
  const label = h("label", { class: "field", title: "Which foot steps when. Another order draws the timeline anew" }, "Foot order", h("span", { class: "box" }, input));
  return { label, show: (document) => { if (input !== globalThis.document.activeElement) input.value = document.order.join(" "); } };
}

function workspaceField(edits) {
  const select = h("select", { id: "field-workspace" }, h("option", { value: "stroke", text: "stroke" }), h("option", { value: "cylinder", text: "cylinder" }));
  select.addEventListener("change", () => {
    const value = select.value;
    edits.edit((document) => ({ ...document, options: { ...document.options, workspace: value } }), `Workspace to ${value}`);
  });
  const label = h("label", { class: "field", title: "stroke: what the motors truly reach; cylinder: the paper's simpler, smaller space" }, "Workspace", select);
  return { label, show: (document) => { select.value = document.options?.workspace ?? "stroke"; } };
}

/** Buttons that loosen what the explanation complains of. */
function relaxations(edits, document, sentences) {
  const text = sentences.join(" ");
  if (/in the air/.test(text)) return [];
  const remedy = (label, change, name) => h("button", { text: label, on: { click: () => edits.edit(change, name) } });
  const withOption = (name, value) => (one) => ({ ...one, options: { ...one.options, [name]: value } });
  const shorter = Math.max(1, Math.round(stepLength(document) * 1000 * 0.75 * 2) / 2);
  const { workspace, margin } = document.options;
  const buttons = [];
  if (stepLength(document) * 1000 > shorter) buttons.push(remedy(`Use step ${fixed(shorter)} mm`, (one) => withStep(one, shorter / 1000), `Step to ${fixed(shorter)} mm`));
  if (workspace === "cylinder") buttons.push(remedy("Use workspace stroke", withOption("workspace", "stroke"), "Workspace to stroke"));
  if (margin > 0 && /margin|balance/.test(text)) buttons.push(remedy("Use margin 0 mm", withOption("margin", 0), "Stability margin to 0 mm"));
  return buttons;
}

function showAnswer(box, edits, state) {
  const job = jobOf(state);
  const bad = job?.fresh && ["infeasible", "failed", "interrupted"].includes(job.state);
  box.hidden = !bad;
  if (!bad) return;
  const sentences = (job.result?.explanation ?? []).filter((sentence) => sentence !== job.sentence);
  setAttribute(box, "data-tone", job.state === "failed" ? "bad" : "caution");
  const buttons = job.state === "infeasible" ? relaxations(edits, shownDocument(state), job.result?.explanation ?? []) : [];
  box.replaceChildren(h("h4", { text: job.sentence }),
    sentences.length ? h("ul", { role: "list" }, ...sentences.map((text) => h("li", { text }))) : "",
    buttons.length ? h("div", { class: "buttons" }, ...buttons) : "");
}

/** Builds the section. */
export function mountOptimise(store, edits) {
  const fields = FIELDS.map((field) => ({ ...field, ...numberField(edits, field) }));
  const [order, workspace] = [orderField(store, edits), workspaceField(edits)];
  const rows = [fields[0], fields[1], order, ...fields.slice(2), workspace];
  const error = h("p", { class: "box-note", role: "alert", data: { tone: "bad" }, hidden: true });
  const answer = h("div", { class: "box-note", hidden: true });
  const button = h("button", { class: "primary wide", text: "Optimise" });
  onPress(button, attempt(async () => {
    const { id } = await api.optimise(store.state.selected);
    store.set({ shownJob: id });
  }), (why) => toast(why));
  byId("optimise").append(...rows.map(({ label }) => label), error, answer, button);
  mountConvergence(store, byId("optimise"));

  store.watch(({ view, pending, formError }) => [view, pending, formError], (state) => {
    const document = shownDocument(state);
    if (!document) return;
    rows.forEach((row) => row.show(document));
    fields[1].label.hidden = document.step[2] === 0;
    error.hidden = !state.formError;
    error.textContent = state.formError ?? "";
  });
  store.watch(({ jobs, shownJob, view, pending }) => [jobs, shownJob, view?.id, view?.document, pending.length], (state) => {
    showAnswer(answer, edits, state);
    const busy = state.jobs.some((job) => job.gait === state.selected && jobIsOn(job));
    const why = !state.view ? "No gait is selected." : busy ? "This gait is being optimised. Cancel the job or wait for it." : null;
    setAllowed(button, why ?? (state.pending.length ? "The last edit is not accepted yet." : null), "Find the motion that fits this timeline");
  });
}
