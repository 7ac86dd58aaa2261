/** The popover of an operation that needs a number; the timeline shows a preview of the result. */

import { h, setAllowed, setText } from "../lib/dom.js";
import { OPERATIONS } from "../document/operations.js";
import { lengthOf, wholeOf } from "../document/region.js";

const whole = (text) => (/^[-−+]?\d+$/.test(text.trim()) ? Number(text.trim().replace("−", "-")) : null);

function sentenceOf({ name, least, most, unit }, value) {
  if (value === null) return `“${name}” needs a whole number.`;
  if (value < least || value > most) {
    return `“${name}” must lie between ${least} and ${most}${unit ? ` ${unit}` : ""}.`;
  }
  return null;
}

function numberField(label, value, unit, step = 1) {
  const input = h("input", { type: "number", step, "aria-label": label, value });
  return {
    input,
    row: h(
      "label",
      { class: "amount" },
      h("span", { text: label }),
      input,
      h("span", { class: "unit", text: unit }),
    ),
  };
}

/** The factor and the new length set each other; `wrong()` returns the error in the typed factor, or null. */
function factorField(length, from, changed) {
  const field = numberField("Factor", "1", "×", 0.1);
  const show = () => {
    field.input.value = String(Math.round((Number(length.value) / from()) * 100) / 100);
  };
  const wrong = () => (Number(field.input.value) > 0 ? null : "“Factor” needs a number above 0.");
  length.addEventListener("input", () => {
    if (whole(length.value)) show();
  });
  field.input.addEventListener("input", () => {
    if (!wrong()) length.value = String(Math.max(1, Math.round(from() * Number(field.input.value))));
    changed();
  });
  show();
  return { row: field.row, wrong };
}

/** Puts a popover over the tool row, no higher than there is room under the top bar. */
export function fitAbove(place, popover) {
  popover.style.maxHeight = `${place.getBoundingClientRect().top - 56}px`;
  place.append(popover);
}

/**
 * Opens the popover.
 * @returns {{close: () => void, refresh: () => void}}
 */
export function openAmount({ actions, id, place, anchor, close }) {
  const { name, amount } = OPERATIONS[id];
  const region = () => actions.state(id).region ?? wholeOf(actions.state(id).document);
  const { input, row } = numberField(
    amount.name,
    amount.start({ ...actions.state(id), region: region() }),
    amount.unit,
  );
  const title = h("h3", { text: name });
  const note = h("p", { class: "note", role: "status" });
  const apply = h("button", { type: "submit", class: "primary", text: "Apply" });
  const scope = h("p", { class: "scope" });

  function look() {
    const wrong = sentenceOf(amount, whole(input.value)) ?? factor?.wrong();
    const outcome = wrong ? { reason: wrong } : actions.preview(id, whole(input.value));
    if (wrong) actions.dropPreview();
    setText(scope, `Works on ${actions.scope(id)}.`);
    setText(note, outcome.reason ?? outcome.note ?? "");
    note.dataset.toneText = outcome.reason ? "bad" : "";
    setAllowed(apply, outcome.reason);
    return outcome;
  }

  function finish() {
    if (look().reason) return;
    const value = whole(input.value);
    close();
    actions.act(id, value);
    anchor.focus();
  }

  const factor = amount.factor ? factorField(input, () => lengthOf(region()), look) : null;
  const cancel = h("button", {
    type: "button",
    text: "Cancel",
    on: {
      click: () => {
        close();
        anchor.focus();
      },
    },
  });
  const form = h(
    "form",
    { novalidate: true, on: { submit: (event) => event.preventDefault() } },
    title,
    scope,
    row,
    factor?.row,
    note,
    h("div", { class: "buttons" }, cancel, apply),
  );
  const popover = h("div", { class: "op-popover", role: "dialog", "aria-label": name }, form);
  form.addEventListener("submit", finish);
  input.addEventListener("input", look);
  fitAbove(place, popover);
  look();
  input.focus();
  input.select();
  return { close: () => popover.remove(), refresh: look };
}
