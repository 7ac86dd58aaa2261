/** The options of the fastest gait as rows of choices, each with its price. */

import { h, setText } from "../lib/dom.js";
import { GROUPS, choiceText, speedText } from "./fastest_words.js";

const LABELS = new Map(GROUPS.map((one) => [one.group, one]));
const SAME = 1e-9;

function textOf({ group, value, name }, onTheSpot) {
  return group === "order" ? choiceText(value, name, onTheSpot) : LABELS.get(group).text(value);
}

/** What an option's value changes in a request. */
const changeOf = ({ group, value }) => (group === "order" || group === "course" ? value : { [group]: value });

function isSame(one, other) {
  if (typeof one === "number" && typeof other === "number") return Math.abs(one - other) < SAME;
  return JSON.stringify(one) === JSON.stringify(other);
}

/** Whether a request has an option's value; on the spot neither direction nor turn of a curve count. */
function isChosen(option, request) {
  const ignored = request.course === "walk" ? [] : ["heading", "turn"];
  return Object.entries(changeOf(option)).every(
    ([key, value]) => ignored.includes(key) || isSame(value, request[key]),
  );
}

function chip(option, request, choose) {
  const [price, bar] = [h("b", { class: "number" }), h("i", { class: "fast-bar" })];
  const input = h("input", {
    type: "radio",
    name: `fast-${option.group}`,
    checked: isChosen(option, request),
  });
  const element = h(
    "label",
    { class: "fast-chip" },
    input,
    h("span", { text: textOf(option, request.course !== "walk") }),
    price,
    bar,
  );
  input.addEventListener("change", () => {
    if (input.checked) choose(changeOf(option));
  });
  return { element, input, price, bar };
}

/** What stands under a value: its price, or why there is none yet. */
function priceText({ price, sentence }, isLooking) {
  if (price) return speedText(price);
  if (sentence) return "not known";
  return isLooking ? "…" : "not known";
}

/** The rows of the groups, still without choices. */
function groupRows() {
  return new Map(
    GROUPS.map(({ group, label, help }) => {
      const chips = h("div", { class: "fast-chips" });
      const element = h(
        "fieldset",
        { class: "fast-row", title: help, hidden: true },
        h("legend", { text: label }),
        chips,
      );
      return [group, { chips, element }];
    }),
  );
}

/** Each price of a row, and a bar by which it can be compared with the others. */
function showPrices(own, isLooking) {
  const most = (onTheSpot) =>
    Math.max(
      SAME,
      ...own.map(({ option: { price } }) =>
        price && price.on_the_spot === onTheSpot ? (price.pace ?? 0) : 0,
      ),
    );
  for (const {
    option,
    chip: { element: box, price: text, bar },
  } of own) {
    const feet = option.group === "order" ? `Feet ${option.value.order.join("-")}. ` : "";
    setText(text, priceText(option, isLooking));
    box.title = `${feet}${option.sentence}`;
    box.toggleAttribute("data-none", !option.price || option.price.pace === null);
    bar.style.setProperty("--share", String((option.price?.pace ?? 0) / most(option.price?.on_the_spot)));
  }
}

/**
 * Builds the rows.
 * @param {(change: Record<string, any>) => void} choose takes what a chosen value changes in the request
 */
export function optionRows(choose) {
  const rows = groupRows();
  const element = h("div", { class: "fast-rows" }, ...[...rows.values()].map((row) => row.element));
  let [options, chips, isLooking] = [[], [], false];

  function showGroup(name) {
    const all = options.map((option, number) => ({ option, chip: chips[number] }));
    showPrices(
      all.filter(({ option }) => option.group === name),
      isLooking,
    );
  }

  const showAll = () => GROUPS.forEach(({ group }) => showGroup(group));

  /** Where the focus is: the row and the place in it; nothing where it is elsewhere. */
  function focusedPlace() {
    const focused = chips.findIndex(({ input }) => input === document.activeElement);
    if (focused < 0) return {};
    const { group } = options[focused];
    return { group, place: options.slice(0, focused).filter((one) => one.group === group).length };
  }

  return {
    element,
    /** How many options have a price, and how many there are. */
    counts: () => [options.filter(({ price, sentence }) => price || sentence).length, options.length],
    /** The option that a request has as its course: its price is that of the whole request. */
    chosen: (request) => options.find((one) => one.group === "course" && isChosen(one, request)) ?? null,
    /** Shows the options of a request; a focused choice stays focused. */
    show(list, request) {
      const { group, place } = focusedPlace();
      [options, isLooking] = [list, true];
      chips = list.map((option) => chip(option, request, choose));
      for (const [name, row] of rows) {
        const own = chips.filter((_, number) => list[number].group === name);
        row.chips.replaceChildren(...own.map((one) => one.element));
        row.element.hidden = !own.length;
        if (name === group) (own.find(({ input }) => input.checked) ?? own[place] ?? own[0])?.input.focus();
      }
      showAll();
    },
    /** Takes prices that have become known. */
    take(prices) {
      for (const { number, price, sentence } of prices) Object.assign(options[number], { price, sentence });
      for (const group of new Set(prices.map((one) => one.group))) showGroup(group);
    },
    /** Forgets every price: they are of another request. */
    forget() {
      options.forEach((option) => Object.assign(option, { price: null, sentence: "" }));
      isLooking = true;
      showAll();
    },
    /** What has no price now gets none any more. */
    end() {
      isLooking = false;
      showAll();
    },
  };
}
