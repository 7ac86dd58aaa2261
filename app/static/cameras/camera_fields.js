/** Fields of a foot's colour and of the spots that may be a foot. */

import { h } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

/**
 * A share of 0 to 100 % as a slider.
 * @param {string} name
 * @param {string} help
 * @param {(share: number, last: boolean) => void} changed `last` is false while a finger drags
 * @returns {{element: HTMLElement, show: (share: number) => void}}
 */
export function shareField(name, help, changed) {
  const input = h("input", { type: "range", min: "0", max: "100", step: "1", "aria-label": name });
  const words = h("span", { class: "number quiet" });
  const tell = () => {
    words.textContent = `${input.value} %`;
    input.setAttribute("aria-valuetext", words.textContent);
  };
  const taken = (last) => () => {
    tell();
    changed(input.valueAsNumber / 100, last);
  };
  input.addEventListener("input", taken(false));
  input.addEventListener("change", taken(true));
  return {
    element: h("label", { class: "camera-share", title: help }, h("span", { text: name }), input, words),
    show(share) {
      input.value = String(Math.round(share * 100));
      tell();
    },
  };
}

const LIMITS = [
  {
    key: "least_area",
    name: "Least area, px²",
    max: 1e7,
    factor: 1,
    decimals: 0,
    help: "The studio does not take a smaller spot of colour as a foot",
  },
  {
    key: "most_area",
    name: "Largest area, px²",
    max: 1e7,
    factor: 1,
    decimals: 0,
    help: "The studio does not take a larger spot of colour as a foot",
  },
  {
    key: "least_fill",
    name: "Least fill, %",
    max: 100,
    factor: 100,
    decimals: 0,
    help:
      "A foot must fill at least this percentage of the smallest circle around it. "
      + "A round sole fills nearly 100 %",
  },
];

/** Limits on area and fill; `changed` is told what is new. */
export function limitFields(changed) {
  const fields = LIMITS.map(({ key, name, help, max, factor }) => {
    const input = h("input", {
      type: "number",
      min: "0",
      max: String(max),
      step: "any",
      required: true,
      "aria-label": name,
      title: help,
    });
    input.addEventListener("change", () => {
      if (input.checkValidity()) changed({ [key]: input.valueAsNumber / factor });
    });
    return { input, label: h("label", {}, h("span", { text: name }), input) };
  });
  return {
    element: h("div", { class: "camera-limits" }, ...fields.map(({ label }) => label)),
    show(limits) {
      LIMITS.forEach(({ key, factor, decimals }, index) => {
        const { input } = fields[index];
        if (input !== document.activeElement) input.value = fixed(limits[key] * factor, decimals);
      });
    },
  };
}
