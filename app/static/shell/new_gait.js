/** The dialog for a new gait: what the timeline is drawn from, with suggestions for the chosen robot. */

import { ApiError, api } from "../api/gaits.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h } from "../lib/dom.js";
import { refusalOf } from "../lib/field_error.js";
import { robotOptions, robots } from "./robots.js";
import { stepLength } from "../document/step.js";

const OWN = "own";
const KNOT_SECONDS = 0.4;
const ORIENTATIONS = [
  ["FB", "Along the diagonal (FB)"],
  ["FBS", "Along x (FBS)"],
];
const NUMBERS = [
  {
    key: "step",
    label: "Step",
    unit: "mm",
    min: 0,
    max: 60,
    step: "any",
    help: "Each foot steps once in an iteration. The step is how far the body moves in one iteration",
  },
  {
    key: "phase_knots",
    label: "Phase length",
    unit: "samples",
    min: 2,
    max: 50,
    step: 1,
    help: "Length of each stance phase and of each swing",
  },
  {
    key: "closing_knots",
    label: "Final stance",
    unit: "samples",
    min: 0,
    max: 100,
    step: 1,
    help: "How long all feet stay on the ground after the last swing",
  },
];

/** A label, its control and the place for what is wrong with it. */
function row(key, label, control, help) {
  const { element: error, setError } = refusalOf(control);
  const unit = control.dataset.unit;
  const box = unit ? h("span", { class: "box", data: { unit } }, control) : control;
  return {
    key,
    control,
    setError,
    element: h(
      "label",
      { class: "new-row", title: help },
      h("span", { class: "name", text: label }),
      box,
      error,
    ),
  };
}

const textField = (name, more = {}) =>
  h("input", { "aria-label": name, autocomplete: "off", required: true, ...more });
const select = (name, options) => h("select", { "aria-label": name }, ...options);
const choices = (pairs) => pairs.map(([value, text]) => h("option", { value, text }));
const digits = (text) =>
  text
    .split(/[^0-9]+/)
    .filter(Boolean)
    .map(Number);

function controls(list) {
  return [
    row("name", "Name", textField("Name of the new gait", { maxlength: "60" }), "The name of the new gait"),
    row("robot", "Robot", select("Robot of the new gait", robotOptions(list)), "The robot of the new gait"),
    row(
      "orientation",
      "Heading",
      select("Heading", choices(ORIENTATIONS)),
      "FB: walk along the diagonal between x and y, with feet in front and at the back. "
        + "FBS: walk along x, with feet in front, at the sides and at the back",
    ),
    row("pattern", "Pattern", select("Pattern", []), "Foot orders that work for this robot"),
    row(
      "order",
      "Foot order",
      textField("Order of the feet"),
      "The order in which the feet step. Each foot steps once",
    ),
    ...NUMBERS.map(({ key, label, unit, min, max, step, help }) =>
      row(
        key,
        label,
        h("input", { type: "number", "aria-label": label, min, max, step, required: true, data: { unit } }),
        `${help} (${min} to ${max} ${unit})`,
      ),
    ),
  ];
}

/** The form's values for the server; lengths in m. */
function body(value) {
  return {
    name: value("name").trim(),
    robot: value("robot"),
    orientation: value("orientation"),
    order: digits(value("order")),
    step: Number(value("step")) / 1000,
    phase_knots: Number(value("phase_knots")),
    closing_knots: Number(value("closing_knots")),
  };
}

/** Errors that the page can find by itself, by field. */
function problems(value, robot) {
  const found = {};
  if (!value("name").trim()) found.name = "Give the gait a name.";
  const order = digits(value("order"));
  if (
    [...order].sort((a, b) => a - b).join()
    !== Array.from({ length: robot.legs }, (_, foot) => foot + 1).join()
  ) {
    const example = robot.orders.FB[0].feet.join(" ");
    found.order = `Enter each of the feet 1 to ${robot.legs} once, for example ${example}.`;
  }
  for (const { key, label, unit, min, max, step } of NUMBERS) {
    const number = value(key) === "" ? NaN : Number(value(key));
    if (!(number >= min && number <= max))
      found[key] = `${label} needs a number between ${min} and ${max} ${unit}.`;
    else if (step === 1 && !Number.isInteger(number))
      found[key] = `${label} needs a whole number of ${unit}.`;
  }
  return found;
}

function form(list, preset) {
  const rows = controls(list);
  const of = Object.fromEntries(rows.map((one) => [one.key, one]));
  const value = (key) => of[key].control.value;
  const set = (key, text) => {
    of[key].control.value = text;
  };
  const robot = () => list.find(({ name }) => name === value("robot"));
  const orders = () => robot().orders[value("orientation")];
  const note = h("p", { class: "quiet", role: "status" });

  function showPattern() {
    const now = digits(value("order")).join();
    set("pattern", orders().find(({ feet }) => feet.join() === now)?.name ?? OWN);
  }

  function suggestOrder() {
    of.pattern.control.replaceChildren(
      ...choices([...orders().map(({ name }) => [name, name]), [OWN, "own order"]]),
    );
    set("order", orders()[0].feet.join(" "));
    of.order.setError(null);
    showPattern();
  }

  function sum() {
    const samples = robot().legs * 2 * Number(value("phase_knots")) + Number(value("closing_knots"));
    const { motors, strokes } = robot();
    const coupled = !robot().coupled
      ? ""
      : ` In this robot, ${motors} motors drive ${strokes} strokes, `
        + "so the feet cannot always follow the plan exactly. Check shows how the feet really move.";
    const lasts = ((samples - 1) * KNOT_SECONDS).toFixed(1);
    note.textContent = `One iteration has ${samples} samples and takes ${lasts} s.${coupled}`;
  }

  of.robot.control.addEventListener("change", () => {
    suggestOrder();
    set("phase_knots", robot().phase_knots);
    sum();
  });
  of.orientation.control.addEventListener("change", suggestOrder);
  of.pattern.control.addEventListener("change", () => {
    const chosen = orders().find(({ name }) => name === value("pattern"));
    if (chosen) set("order", chosen.feet.join(" "));
    else of.order.control.focus();
  });
  of.order.control.addEventListener("input", showPattern);
  // Only the field being typed in is checked again; the others keep their errors until then.
  for (const one of rows)
    one.control.addEventListener("input", () => {
      one.setError(problems(value, robot())[one.key] ?? null);
      sum();
    });

  set("robot", preset.robot ?? list[0].name);
  set("orientation", preset.orientation ?? "FB");
  suggestOrder();
  set("name", preset.name);
  of.name.control.addEventListener("focus", ({ target }) => target.select());
  set("step", preset.step ?? robot().step * 1000);
  set("phase_knots", robot().phase_knots);
  set("closing_knots", preset.closing_knots ?? 5);
  sum();
  return { rows, of, value, robot, note };
}

/** Shows what the server refuses at its field, or under all of them; and goes there. */
function refuse({ of }, general, error) {
  if (!(error instanceof ApiError)) throw error;
  const field = of[(error.where ?? "").replace(/^body\./, "")];
  (
    field ?? {
      setError: (sentence) => {
        general.hidden = false;
        general.textContent = sentence;
      },
    }
  ).setError(error.message);
  field?.control.focus();
}

/**
 * Asks for a new gait.
 * @param {Record<string, any>} preset `name`; where they are known `robot`, `orientation`, `step` (mm),
 *   `closing_knots`, and a `sentence` why it is asked
 * @returns {Promise<string|null>} the new gait's id, or null where the user thought better of it
 */
export async function askNewGait(preset) {
  const list = await robots();
  return openDialog((close) => {
    const parts = form(list, preset);
    const general = h("p", { class: "field-error", role: "alert", hidden: true });
    const create = h("button", { type: "submit", class: "primary", text: "Create" });
    const accept = async () => {
      const found = problems(parts.value, parts.robot());
      for (const one of parts.rows) one.setError(found[one.key] ?? null);
      general.hidden = true;
      const first = parts.rows.find(({ key }) => found[key]);
      if (first) return first.control.focus();
      if (create.disabled) return undefined;
      create.disabled = true;
      try {
        return close((await api.draw(body(parts.value))).id);
      } catch (error) {
        return refuse(parts, general, error);
      } finally {
        create.disabled = false;
      }
    };
    const usual =
      "In the new gait the feet step one after the other. "
      + "You can change the timeline of the gait afterwards.";
    const dialog = dialogFrame(
      "New gait",
      close,
      accept,
      h("p", { class: "quiet", text: preset.sentence ?? usual }),
      ...parts.rows.map(({ element }) => element),
      parts.note,
      general,
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
        create,
      ),
    );
    dialog.classList.add("new-gait");
    dialog.querySelector("form").noValidate = true;
    return dialog;
  });
}

/** What the dialog begins with where a gait's robot is changed for one with other legs. */
export function presetFor(robot, document) {
  const feet = document.timeline.feet.length;
  return {
    robot: robot.name,
    name: `${document.name}, ${robot.title.split(",")[0]}`.slice(0, 60),
    orientation: document.orientation,
    step: Number((stepLength(document) * 1000).toFixed(2)),
    closing_knots: document.options.closing_knots,
    sentence:
      `“${document.name}” is a gait for ${feet} legs, but ${robot.title} has ${robot.legs} legs. `
      + `Create makes a new gait for this robot. “${document.name}” does not change.`,
  };
}
