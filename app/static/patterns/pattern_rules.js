/** Rules and weights of the pattern search: a switch and a number each, with the thesis's value. */

import { h, setText } from "../lib/dom.js";
import { RULES, ruleOf, WEIGHTS } from "./pattern_problem.js";

const MOST_WEIGHT = 100000;

function numberInput(name, help, take) {
  const input = h("input", { type: "number", step: 1, "aria-label": name, title: help });
  input.addEventListener("change", () => {
    if (Number.isFinite(input.valueAsNumber)) take(input.valueAsNumber);
    else input.value = input.dataset.shown;
  });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.blur();
  });
  return input;
}

function showNumber(input, value) {
  input.dataset.shown = String(value);
  if (document.activeElement !== input || input.valueAsNumber === value) input.value = value;
}

function ruleRow(problem, one) {
  const change = (part) => {
    const { value, on } = ruleOf(problem.state, one);
    const next = { value, on, ...part };
    const rules = { ...problem.state.rules, [one.rule]: next };
    if (next.on === (one.usual !== null) && next.value === (one.first ?? one.usual)) delete rules[one.rule];
    problem.set({ rules });
  };
  const box = h("input", {
    type: "checkbox",
    role: "switch",
    "aria-label": `${one.name}: on`,
    title: one.help,
    on: { change: () => change({ on: box.checked }) },
  });
  const input = numberInput(`${one.name}, ${one.unit}`, one.help, (value) => change({ value }));
  const usual = h("span", {
    class: "quiet pattern-usual",
    title:
      one.usual === null
        ? "The footfall thesis (F) has no such rule"
        : `Number in the footfall thesis (F): ${one.usual} ${one.unit}`,
  });
  const element = h(
    "li",
    { class: "pattern-rule" },
    h("label", { title: one.help }, box, h("span", { text: one.name })),
    h("span", { class: "box", data: { unit: one.unit } }, input),
    usual,
  );
  return {
    element,
    show(state) {
      const { value, on, usual: isUsual } = ruleOf(state, one);
      box.checked = on;
      input.disabled = !on;
      showNumber(input, value);
      element.toggleAttribute("data-off", !on);
      element.toggleAttribute("data-own", !isUsual);
      setText(usual, one.usual === null ? "F: –" : `F: ${one.usual}`);
      input.toggleAttribute("aria-invalid", Boolean(state.error?.where?.split(".").includes(one.rule)));
    },
  };
}

function weightRow(problem, one) {
  const input = numberInput(one.name, `${one.help}. 0 to ${MOST_WEIGHT}`, (value) => {
    const weights = { ...problem.state.weights, [one.weight]: value };
    if (value === one.usual) delete weights[one.weight];
    problem.set({ weights });
  });
  const element = h(
    "li",
    { class: "pattern-rule" },
    h("span", { text: one.name, title: one.help }),
    h("span", { class: "box" }, input),
    h("span", { class: "quiet pattern-usual", text: String(one.usual) }),
  );
  return {
    element,
    show: (state) => {
      showNumber(input, state.weights[one.weight] ?? one.usual);
      element.toggleAttribute("data-own", one.weight in state.weights);
    },
  };
}

function fold(title, rows, reset, isOwn) {
  const note = h("span", { class: "quiet" });
  const button = h("button", { class: "link", text: "Use the thesis's numbers", on: { click: reset } });
  const element = h(
    "details",
    { class: "more" },
    h("summary", {}, title, note),
    h("ul", { class: "pattern-rules", "aria-label": title }, ...rows.map((row) => row.element)),
    button,
  );
  return {
    element,
    show(state) {
      rows.forEach((row) => row.show(state));
      const own = isOwn(state);
      setText(note, own ? `: ${own} changed` : "");
      button.hidden = !own;
    },
  };
}

/** Builds both lists, and keeps them current. */
export function patternRules(problem) {
  const rules = fold(
    "Rules",
    RULES.map((one) => ruleRow(problem, one)),
    () => problem.set({ rules: {} }),
    (state) => Object.keys(state.rules).length,
  );
  const weights = fold(
    "What counts as better",
    WEIGHTS.map((one) => weightRow(problem, one)),
    () => problem.set({ weights: {} }),
    (state) => Object.keys(state.weights).length,
  );
  rules.element.open = true;
  problem.watch(
    ({ rules: own, weights: heavy, error }) => [own, heavy, error],
    (state) => {
      rules.show(state);
      weights.show(state);
    },
  );
  return [rules.element, weights.element];
}
