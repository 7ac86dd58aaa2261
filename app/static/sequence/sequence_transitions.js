/** Options of the transitions between the parts of a sequence, under a fold. */

import { h } from "../lib/dom.js";
import { numberField } from "../state/fields.js";

const option = (name, factor = 1) => ({
  read: ({ options }) => options[name] * factor,
  write: (document, value) => ({ ...document, options: { ...document.options, [name]: factor === 1 ? Math.round(value) : value / factor } }),
});

const FIELDS = [
  { label: "Body", name: "Body speed between parts", unit: "mm/s", min: 1, max: 60, step: 1, decimals: 1,
    help: "Largest speed of the body where it moves over standing feet, or with them", ...option("body_speed", 1000) },
  { label: "Clearance", name: "Clearance between parts", unit: "mm", min: 0, max: 15, step: 0.5, decimals: 2,
    help: "How high a foot rises at least where it steps to another place", ...option("clearance", 1000) },
  { label: "Margin", name: "Stability margin between parts", unit: "mm", min: 0, max: 30, step: 0.5, decimals: 2,
    help: "Least distance of the centre of pressure from the support polygon's edge while feet step", ...option("margin", 1000) },
  { label: "Phases", name: "Phase knots between parts", unit: "knots", min: 2, max: 50, step: 1, decimals: 0,
    help: "Length of each stance and of each swing of those steps", ...option("phase_knots") },
];

/** Builds the fields; `show` gives them the document. */
export function betweenParts(store, edits) {
  const fields = FIELDS.map((field) => numberField(store, edits, field));
  const element = h("details", { class: "more" }, h("summary", { text: "Between parts" }), h("div", { class: "fields" }, ...fields.map((field) => field.element)));
  return { element, show: (document) => fields.forEach((field) => field.show(document)), cancel: () => fields.some((field) => field.cancel?.()) };
}
