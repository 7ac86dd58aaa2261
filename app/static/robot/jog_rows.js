/** The rows of a jog: a step either way, with where it stands, its target and its range. */

import { h, onPress, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { handleName, shortName } from "./jog_steps.js";
import { toast } from "../lib/toasts.js";

const ROUNDING_MM = 0.005;

function rangeBar() {
  const [way, start, target] = [h("i"), h("u"), h("b")];
  return { way, start, target, element: h("div", { class: "jog-range", role: "img" }, way, start, target) };
}

function stepButton(sign, press) {
  const button = h("button", { class: "icon-only", text: sign < 0 ? "−" : "+" });
  onPress(button, press, (why) => toast(why));
  return button;
}

/** Places the bar's marks: its ends are the ends of the range. */
function place(bar, { start_mm: start, target_mm: target, least_mm: least, most_mm: most }) {
  const [low, high] = [Math.min(least, start), Math.max(most, start)];
  const at = (value) => (high > low ? ((value - low) / (high - low)) * 100 : 50);
  bar.start.style.left = `calc(${at(start)}% - 1px)`;
  bar.target.style.left = `calc(${at(target)}% - 4px)`;
  bar.way.style.left = `${Math.min(at(start), at(target))}%`;
  bar.way.style.width = `${Math.abs(at(target) - at(start))}%`;
}

/** Why a step cannot be added; null where it can. */
function whyNot(handle, row, by) {
  if (!row) return "The studio has not answered yet.";
  const [least, most] = [row.least_mm - row.target_mm, row.most_mm - row.target_mm];
  if (by >= least - ROUNDING_MM && by <= most + ROUNDING_MM) return null;
  const range = `${fixed(least)} to ${fixed(most)} mm`;
  return `${handleName(handle)}: you can change the target by ${range}. Choose a shorter step.`;
}

/**
 * Builds one row.
 * @param {(sign: number) => void} step adds a step to the target; nothing moves
 */
function jogRow(step) {
  const name = h("span", { class: "name" });
  const [less, more] = [stepButton(-1, () => step(-1)), stepButton(1, () => step(1))];
  const bar = rangeBar();
  const number = h("span", { class: "number" });
  const element = h("div", { class: "jog-row" }, name, less, bar.element, more, number);
  return {
    element,
    show(handle, row, size) {
      setText(name, shortName(handle));
      for (const { button, sign, word } of [
        { button: less, sign: -1, word: "minus" },
        { button: more, sign: 1, word: "plus" },
      ]) {
        setAttribute(button, "aria-label", `${handleName(handle)} ${word}`);
        const help =
          `${handleName(handle)}: change the target by ${fixed(sign * size)} mm. `
          + "The robot does not move yet";
        setAllowed(button, whyNot(handle, row, sign * size), help);
      }
      const isMoved = row && Math.abs(row.target_mm - row.start_mm) > ROUNDING_MM;
      setText(number, row ? `${isMoved ? `${fixed(row.start_mm)} → ` : ""}${fixed(row.target_mm)} mm` : "–");
      const range = row && `${fixed(row.least_mm)} to ${fixed(row.most_mm)} mm`;
      const figures = row ? `: target ${fixed(row.target_mm)} mm, range ${range}` : "";
      setAttribute(bar.element, "aria-label", `${handleName(handle)}${figures}`);
      setAttribute(bar.element, "title", row ? `Range ${range}` : null);
      if (row) place(bar, row);
    },
  };
}

/** Builds three rows; `show` takes handles, the studio's rows for them or null, and the step's size, mm. */
export function jogRows(step) {
  const rows = [0, 1, 2].map((index) => jogRow((sign) => step(index, sign)));
  return {
    element: h("div", { class: "jog-rows" }, ...rows.map(({ element }) => element)),
    show: (handles, known, size) =>
      rows.forEach((row, index) => row.show(handles[index], known?.[index] ?? null, size)),
  };
}
