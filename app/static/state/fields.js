/**
 * The controls of the Optimise section: numbers that are typed, stepped with the arrow keys or dragged by
 * their name, and choices. While a number changes the document is shown changed; one edit is made at the end.
 */

import { clamp } from "../lib/clamp.js";
import { h } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { limitHint } from "./limit_hint.js";
import { changing, textOf } from "./number_change.js";

/**
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("./edits.js").Edits} Edits
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 */

/**
 * A number. It has `write`, or `act` for what only the server can do.
 * @typedef {object} NumberField
 * @property {string} label the short name
 * @property {string} name
 * @property {string} unit "" for none
 * @property {number} min
 * @property {number} max
 * @property {number} step
 * @property {number} decimals
 * @property {string} help
 * @property {(document: GaitDocument) => number|null} read
 * @property {(document: GaitDocument, value: any) => GaitDocument} [write]
 * @property {(value: any) => void} [act]
 * @property {string} [empty] what no number means where none is allowed
 * @property {number} [fallback] where stepping begins then
 * @property {string} [unsaid] stands where the number says nothing of the document
 * @property {boolean} [whole] whether only whole numbers will do
 * @property {string} [limit] what the studio calls the number where it knows how far it can go
 * @property {(value: number) => number} [fromSI] turns what the studio says into the field's unit
 */

/**
 * @typedef {{label: string, name: string, help: string, options: string[][],
 *   read: (document: GaitDocument) => any,
 *   write: (document: GaitDocument, value: any) => GaitDocument}} ChoiceField
 * @typedef {{label: string, name: string, help: string, read: (shown: any) => string,
 *   commit: (text: string) => string|null}} TextField
 * @typedef {ReturnType<typeof changing>} Change
 * @typedef {{dirty: () => boolean, show: (always: boolean) => void, commit: () => void}} Text
 * @typedef {ReturnType<typeof refusalOf>} Refusal
 */

const PIXELS_A_STEP = 4;
/** @type {Record<string, number>} */
const WAYS = { ArrowUp: 1, ArrowDown: -1 };

/** @param {number|null} value @param {NumberField} field */
const isOutside = (value, { min, max }) => typeof value === "number" && (value < min || value > max);
/** @param {NumberField} field */
const unitOf = ({ unit }) => unit && ` ${unit}`;

/**
 * A page-wide act that the browser would take for its own undo of the text.
 * @param {KeyboardEvent} event
 * @param {Pick<Edits, "undo"|"redo">} edits
 */
export function historyAction({ key, ctrlKey, metaKey, shiftKey, altKey }, edits) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if (letter === "z") return shiftKey ? edits.redo : edits.undo;
  return letter === "y" ? edits.redo : null;
}

/**
 * What a finished text is worth: a number, null for none where none is allowed, or a sentence of refusal.
 * @param {HTMLInputElement} input
 * @param {NumberField} field
 * @returns {{value?: number|null, sentence?: string}}
 */
function judged(input, field) {
  if (field.whole) return wholeNumber(input, field.name, field);
  const text = input.value.trim();
  const range = `${field.min} and ${field.max}${unitOf(field)}`;
  if (input.validity.badInput || (text === "" && !field.empty))
    return { sentence: `${field.name} needs a number between ${range}.` };
  const value = text === "" ? null : Number(text);
  return isOutside(value, field)
    ? { sentence: `${field.name} is ${value}${unitOf(field)}; it must lie between ${range}.` }
    : { value };
}

/**
 * A number one step further, ten with Shift.
 * @param {NumberField} field
 * @param {number|null|undefined} value
 * @param {number} way
 */
function stepped(field, value, way) {
  const from = value ?? field.fallback ?? field.min;
  return textOf(clamp(from + way * field.step, field.min, field.max), field.decimals);
}

/**
 * Lets a person type. A text that was refused stays, with its error, until it is repaired or given up.
 * @param {HTMLInputElement} input
 * @param {Change} change
 * @param {NumberField} field
 * @param {Text} text
 * @param {{edits: Edits, refusal: Refusal}} parts
 * @returns {() => void} gives a text up
 */
function mountTyping(input, change, field, text, { edits, refusal }) {
  const finish = () => {
    const { sentence = null } = text.dirty() ? judged(input, field) : {};
    refusal.setError(sentence);
    if (!sentence) text.commit();
  };
  const giveUp = () => {
    refusal.setError(null);
    change.drop();
    text.show(true);
  };
  input.addEventListener("input", () => {
    const { value, sentence } = judged(input, field);
    if (sentence) {
      change.drop();
      return;
    }
    refusal.setError(null);
    change.show(value);
  });
  input.addEventListener("change", finish);
  input.addEventListener("blur", () => {
    finish();
    text.show(!refusal.hasError());
  });
  input.addEventListener("keydown", (event) => {
    const way = WAYS[event.key];
    const act = historyAction(event, edits);
    if (act) {
      event.preventDefault();
      const typing = text.dirty();
      giveUp();
      if (!typing) act();
    } else if (way && !event.ctrlKey && !event.altKey) {
      event.preventDefault();
      input.value = stepped(field, judged(input, field).value, way * (event.shiftKey ? 10 : 1));
      refusal.setError(null);
      change.show(Number(input.value));
    } else if (event.key === "Enter") {
      finish();
    } else if (event.key === "Escape" && text.dirty()) {
      giveUp();
    }
  });
  input.addEventListener("keyup", ({ key }) => {
    if (WAYS[key]) text.commit();
  });
  return giveUp;
}

/**
 * @param {HTMLElement} handle
 * @param {HTMLInputElement} input
 * @param {Change} change
 * @param {NumberField} field
 * @param {() => number|null} current
 */
function mountDragging(handle, input, change, field, current) {
  /** @type {{x: number, from: number, moved: boolean}|null} */
  let drag = null;
  handle.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    drag = { x: event.clientX, from: current() ?? field.fallback ?? field.min, moved: false };
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointermove", (event) => {
    if (!drag) return;
    const steps = Math.round((event.clientX - drag.x) / PIXELS_A_STEP);
    if (!steps && !drag.moved) return;
    drag.moved = true;
    const next = Number(clamp(drag.from + steps * field.step, field.min, field.max).toFixed(field.decimals));
    input.value = textOf(next, field.decimals);
    change.show(next);
  });
  const end = (/** @type {PointerEvent} */ event) => {
    if (!drag) return;
    const { moved } = drag;
    drag = null;
    if (moved && event.type === "pointerup") change.commit();
    else change.drop();
    if (!moved && event.type === "pointerup") input.focus();
  };
  handle.addEventListener("pointerup", end);
  handle.addEventListener("pointercancel", end);
  handle.addEventListener("click", (event) => event.preventDefault());
}

/**
 * The text in a number's input; it follows the document while nobody types.
 * @param {HTMLInputElement} input
 * @param {NumberField} field
 * @param {Change} change
 * @param {Refusal} refusal
 * @param {() => number|null} current the document's value
 * @returns {Text} `show` writes that value, with `always` also over what a person types
 */
function textOfInput(input, field, change, refusal, current) {
  let written = "";
  const dirty = () => input.validity.badInput || input.value !== written;
  const isTyped = (/** @type {string} */ shown) =>
    input === document.activeElement && dirty() && input.value !== shown;
  return {
    dirty,
    show(always) {
      const shown = textOf(current(), field.decimals);
      if (!always && (refusal.hasError() || isTyped(shown))) return;
      if (input.value !== shown || input.validity.badInput) input.value = shown;
      written = shown;
    },
    commit() {
      if (!field.act) written = input.value;
      change.commit();
    },
  };
}

/**
 * Builds the control of a number.
 * @param {Store} store
 * @param {Edits} edits
 * @param {NumberField} field
 */
export function numberField(store, edits, field) {
  const allowed = `${field.help}. Allowed: ${field.min} to ${field.max}${unitOf(field)}`;
  const input = h("input", {
    type: "number",
    step: "any",
    min: field.min,
    max: field.max,
    placeholder: field.empty ?? field.unsaid ?? null,
    data: field.unsaid ? { unsaid: "" } : {},
    autocomplete: "off",
    "aria-label": field.name,
    "aria-description": allowed,
  });
  const handle = h("span", { class: "name drag", text: field.label });
  const refusal = refusalOf(input);
  const limit = limitHint(store, field);
  const element = h(
    "label",
    { class: "field", title: `${allowed}. Drag the name of the field to change the value` },
    handle,
    h("span", { class: "box", data: { unit: field.unit } }, input),
    limit.element,
    refusal.element,
  );
  /** @type {number|null} */
  let value = null;
  const change = changing(store, edits, field, limit);
  const text = textOfInput(input, field, change, refusal, () => value);
  const giveUp = mountTyping(input, change, field, text, { edits, refusal });
  store.watch(
    ({ selected }) => [selected],
    () => {
      if (refusal.hasError()) giveUp();
    },
  );
  mountDragging(handle, input, change, field, () => value);
  return {
    element,
    cancel: () => change.drop(),
    /** @param {GaitDocument} shown */
    show(shown) {
      value = field.read(shown);
      if (!change.on) text.show(false);
      element.toggleAttribute("data-none", value === null);
    },
  };
}

/**
 * Builds the control of one of several words.
 * @param {Edits} edits
 * @param {ChoiceField} field `options` are [value, text] pairs
 */
export function choiceField(edits, field) {
  const select = h(
    "select",
    { "aria-label": field.name },
    ...field.options.map(([value, text]) => h("option", { value, text })),
  );
  select.addEventListener("change", () => {
    const value = select.value;
    const text = select.selectedOptions[0].textContent;
    edits.edit((document) => field.write(document, value), `${field.name} to ${text}`);
  });
  const element = h(
    "label",
    { class: "field", title: field.help },
    h("span", { class: "name", text: field.label }),
    select,
  );
  return {
    element,
    /** @param {GaitDocument} shown */
    show: (shown) => {
      select.value = String(field.read(shown));
    },
  };
}

/**
 * Builds the control of a text that is read when it is finished.
 * @param {Store} store
 * @param {TextField} field `commit` gives what is wrong with the text, which stays then, or null
 */
export function textField(store, field) {
  const input = h("input", { autocomplete: "off", inputmode: "numeric", "aria-label": field.name });
  const refusal = refusalOf(input);
  const element = h(
    "label",
    { class: "field", title: field.help },
    h("span", { class: "name", text: field.label }),
    h("span", { class: "box" }, input),
    refusal.element,
  );
  let last = "";
  const write = () => {
    input.value = last;
    refusal.setError(null);
  };
  input.addEventListener("change", () => refusal.setError(field.commit(input.value)));
  input.addEventListener("blur", () => {
    if (!refusal.hasError()) write();
  });
  input.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") write();
  });
  store.watch(
    ({ selected }) => [selected],
    () => {
      if (refusal.hasError()) write();
    },
  );
  return {
    element,
    /** @param {GaitDocument} shown */
    show(shown) {
      last = field.read(shown);
      if (input !== document.activeElement && !refusal.hasError()) write();
    },
  };
}
