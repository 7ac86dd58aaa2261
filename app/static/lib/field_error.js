/** The error message of a control: what is wrong with its text, and what would be right. */

import { h, setAttribute } from "./dom.js";

let count = 0;

/**
 * Builds the message; hidden while there is none.
 * @param {HTMLElement} control the control with the text
 * @returns {{element: HTMLElement, setError: (sentence: string|null) => void, hasError: () => boolean}}
 */
export function refusalOf(control) {
  count += 1;
  const id = `refusal-${count}`;
  const element = h("small", { id, class: "field-error", role: "alert", hidden: true });
  return {
    element,
    hasError: () => !element.hidden,
    setError(sentence) {
      element.hidden = !sentence;
      element.textContent = sentence ?? "";
      setAttribute(control, "aria-invalid", sentence ? "true" : null);
      setAttribute(control, "aria-describedby", sentence ? id : null);
    },
  };
}

/**
 * What a whole number is worth, or the sentence that refuses it.
 * @param {HTMLInputElement} input
 * @param {string} name
 * @param {{min: number, max: number, unit?: string}} range
 */
export function wholeNumber(input, name, { min, max, unit = "" }) {
  const text = input.value.trim();
  const range = `a whole number between ${min} and ${max}${unit && ` ${unit}`}`;
  if (input.validity.badInput || text === "") return { sentence: `${name} needs ${range}.` };
  const value = Number(text);
  if (Number.isInteger(value) && value >= min && value <= max) return { value };
  return { sentence: `${name} is ${value}${unit && ` ${unit}`}, but must be ${range}.` };
}
