/** The options of the fastest gait as rows of choices, each with its price. */

import { h, setText } from "../lib/dom.js";
import { GROUPS, headingText, orderText, paceText } from "./fastest_words.js";

const LABELS = new Map(GROUPS.map((one) => [one.group, one]));

function textOf({ group, value, name }, onTheSpot) {
  if (group !== "order") return LABELS.get(group).text(value);
  return onTheSpot ? orderText(value, name) : `${orderText(value, name)}, ${headingText(value.heading)}`;
}

/** What of a question an option's value changes. */
const changeOf = ({ group, value }) => (group === "order" || group === "way" ? value : { [group]: value });

const isSame = (one, other) => (typeof one === "number" && typeof other === "number" ? Math.abs(one - other) < 1e-9 : JSON.stringify(one) === JSON.stringify(other));

/** Whether a question has an option's value; on the spot no direction counts. */
function isChosen(option, question) {
  const ignored = question.way === "walk" ? [] : option.group === "order" ? ["heading"] : ["turn"];
  return Object.entries(changeOf(option)).every(([key, value]) => ignored.includes(key) || isSame(value, question[key]));
}

function chip(option, question, choose) {
  const price = h("b", { class: "number" });
  const bar = h("i", { class: "fast-bar" });
  const input = h("input", { type: "radio", name: `fast-${option.group}`, checked: isChosen(option, question) });
  const feet = option.group === "order" ? `Feet ${option.value.order.join("-")}` : null;
  const element = h("label", { class: "fast-chip", title: option.sentence || feet },
    input, h("span", { text: textOf(option, question.way !== "walk") }), price, bar);
  input.addEventListener("change", () => { if (input.checked) choose(changeOf(option)); });
  return { element, input, price, bar };
}

/**
 * Builds the rows.
 * @param {(change: object) => void} choose takes what a chosen value changes in the question
 */
export function optionRows(choose) {
  const rows = new Map(GROUPS.map(({ group, label, help }) => {
    const chips = h("div", { class: "fast-chips" });
    return [group, { chips, element: h("fieldset", { class: "fast-row", title: help, hidden: true }, h("legend", { text: label }), chips) }];
  }));
  const element = h("div", { class: "fast-rows" }, ...[...rows.values()].map((row) => row.element));
  let [options, chips] = [[], []];

  /** The price of a chip, and a bar by which it can be compared with the others of its row. */
  function showPrice(number) {
    const [{ group, price, sentence }, { element: box, price: text, bar }] = [options[number], chips[number]];
    setText(text, price ? paceText(price) : sentence ? "not possible" : "…");
    box.toggleAttribute("data-none", Boolean(price ? price.pace === null : sentence));
    const paces = options.filter((one) => one.group === group && one.price?.on_the_spot === price?.on_the_spot).map((one) => one.price?.pace ?? 0);
    bar.style.setProperty("--share", String((price?.pace ?? 0) / Math.max(...paces, 1e-9)));
  }

  function showGroup(name) {
    options.forEach(({ group }, number) => { if (group === name) showPrice(number); });
  }

  return {
    element,
    /** How many options have a price, and how many there are. */
    counts: () => [options.filter(({ price, sentence }) => price || sentence).length, options.length],
    /** The price of what is asked, null while it is not known. */
    asked: (question) => options.find((one) => one.group === "way" && isChosen(one, question))?.price ?? null,
    /** Shows the options of a question; a focused choice stays focused. */
    show(list, question) {
      const focused = chips.findIndex(({ input }) => input === document.activeElement);
      const [group, place] = focused < 0 ? [] : [options[focused].group, options.slice(0, focused).filter((one) => one.group === options[focused].group).length];
      options = list;
      chips = list.map((option) => chip(option, question, choose));
      for (const [name, row] of rows) {
        const own = chips.filter((_, number) => list[number].group === name);
        row.chips.replaceChildren(...own.map((one) => one.element));
        row.element.hidden = !own.length;
        if (name === group) (own.find(({ input }) => input.checked) ?? own[place] ?? own[0])?.input.focus();
        showGroup(name);
      }
    },
    /** Takes prices that have become known. */
    take(prices) {
      for (const { number, price } of prices) options[number].price = price;
      for (const group of new Set(prices.map((one) => one.group))) showGroup(group);
    },
  };
}
