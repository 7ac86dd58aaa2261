/**
 * The controls of the Optimise section: numbers that are typed, stepped with the arrow keys or dragged by their name,
 * and choices. While a number changes the document is shown changed, and one edit is made at the end.
 */

import { clamp } from "../lib/clamp.js";
import { h } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { limitHint } from "./limit_hint.js";

const PIXELS_A_STEP = 4;

const textOf = (value, decimals) => (value === null ? "" : String(Number(value.toFixed(decimals))));

/** The running change of a number: on screen at once, one edit at the end, or nothing. */
function changing(store, edits, field, limit) {
  let value;
  return {
    get on() {
      return value !== undefined;
    },
    show(next) {
      if (value === undefined) limit.begin(edits.shown());
      value = next;
      store.set({ gesture: { apply: (document) => (field.act ? document : field.write(document, next)) } });
    },
    commit() {
      if (value === undefined) return;
      const next = value;
      value = undefined;
      limit.end();
      store.set({ gesture: null });
      const before = field.read(edits.shown());
      const same = before === null || next === null ? before === next : Math.abs(before - next) < 1e-9;
      if (same) return;
      if (field.act) field.act(next);
      else
        edits.edit(
          (document) => field.write(document, next),
          `${field.name} to ${next === null ? field.empty : `${textOf(next, field.decimals)} ${field.unit}`.trim()}`,
        );
    },
    drop() {
      if (value === undefined) return false;
      value = undefined;
      limit.end();
      store.set({ gesture: null });
      return true;
    },
  };
}

const isOutside = (value, { min, max }) => typeof value === "number" && (value < min || value > max);
const unitOf = ({ unit }) => unit && ` ${unit}`;

/** A page-wide act that the browser would take for its own undo of the text. */
export function historyAction({ key, ctrlKey, metaKey, shiftKey, altKey }, edits) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if (letter === "z") return shiftKey ? edits.redo : edits.undo;
  return letter === "y" ? edits.redo : null;
}

/** What a finished text is worth: a number, null for none where none is allowed, or a sentence that refuses it. */
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
 * `text` is the field's: `show(always)` writes the document's value, `dirty()` tells whether a person is typing. A text that
 * was refused stays, with its error, until it is repaired or given up.
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
    if (sentence) return change.drop();
    refusal.setError(null);
    return change.show(value);
  });
  input.addEventListener("change", finish);
  input.addEventListener("blur", () => {
    finish();
    text.show(!refusal.hasError());
  });
  input.addEventListener("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const act = historyAction(event, edits);
    if (act) {
      event.preventDefault();
      const typing = text.dirty();
      giveUp();
      if (!typing) act();
    } else if (way && !event.ctrlKey && !event.altKey) {
      event.preventDefault();
      const { value } = judged(input, field);
      const next = clamp(
        (value ?? field.fallback ?? field.min) + way * field.step * (event.shiftKey ? 10 : 1),
        field.min,
        field.max,
      );
      input.value = textOf(next, field.decimals);
      refusal.setError(null);
      change.show(Number(input.value));
    } else if (event.key === "Enter") {
      finish();
    } else if (event.key === "Escape" && text.dirty()) {
      giveUp();
    }
  });
  input.addEventListener("keyup", (event) => {
    if (event.key === "ArrowUp" || event.key === "ArrowDown") text.commit();
  });
  return giveUp;
}

function mountDragging(handle, input, change, field, current) {
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
  const end = (commit) => (event) => {
    if (!drag) return;
    const { moved } = drag;
    drag = null;
    if (moved && commit) change.commit();
    else change.drop();
    if (!moved && event.type === "pointerup") input.focus();
  };
  handle.addEventListener("pointerup", end(true));
  handle.addEventListener("pointercancel", end(false));
  handle.addEventListener("click", (event) => event.preventDefault());
}

/**
 * A number.
 * @param {import("./store.js").Store} store
 * @param {Record<string, any>} edits
 * @param {Record<string, any>} field `label` (short), `name`, `unit`, `min`, `max`, `step`, `decimals`, `help`, `read(document)` and
 *   `write(document, value)`, or `act(value)` for what only the server can do; `empty` says what
 *   no number means where none is allowed, `fallback` where stepping begins then, `unsaid` what stands where the number
 *   says nothing of the document; `whole` where only whole numbers will do; `limit` is what the studio calls the number
 *   where it knows how far it can go, and `fromSI` turns what it says into the field's unit
 */
export function numberField(store, edits, field) {
  const input = h("input", {
    type: "number",
    step: "any",
    min: field.min,
    max: field.max,
    placeholder: field.empty ?? field.unsaid ?? null,
    data: field.unsaid ? { unsaid: "" } : {},
    autocomplete: "off",
    "aria-label": field.name,
    "aria-description": `${field.help}. Allowed: ${field.min} to ${field.max}${unitOf(field)}`,
  });
  const handle = h("span", { class: "name drag", text: field.label });
  const refusal = refusalOf(input);
  const limit = limitHint(store, field);
  const title =
    `${field.help}. Allowed: ${field.min} to ${field.max}${unitOf(field)}. `
    + "Drag the name of the field to change the value";
  const element = h(
    "label",
    { class: "field", title },
    handle,
    h("span", { class: "box", data: { unit: field.unit } }, input),
    limit.element,
    refusal.element,
  );
  let value = null;
  let written = "";
  const change = changing(store, edits, field, limit);
  const text = {
    dirty: () => input.validity.badInput || input.value !== written,
    show(always) {
      const shown = textOf(value, field.decimals);
      if (
        !always
        && (refusal.hasError() || (input === document.activeElement && text.dirty() && input.value !== shown))
      )
        return;
      if (input.value !== shown || input.validity.badInput) input.value = shown;
      written = shown;
    },
    commit() {
      if (!field.act) written = input.value;
      change.commit();
    },
  };
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
    show(shown) {
      value = field.read(shown);
      if (!change.on) text.show(false);
      element.toggleAttribute("data-none", value === null);
    },
  };
}

/** One of several words. `read` and `write` as for numbers; `options` are [value, text] pairs. */
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
    show: (shown) => {
      select.value = String(field.read(shown));
    },
  };
}

/** A text that is read when it is finished. `commit(text)` gives what was wrong with it, or null; until then it stays. */
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
    show(shown) {
      last = field.read(shown);
      if (input !== document.activeElement && !refusal.hasError()) write();
    },
  };
}
