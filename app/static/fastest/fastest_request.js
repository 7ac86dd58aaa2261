/** The request of the dialog: its values, their prices as they become known, and the gait to be made. */

import { fastestApi } from "../api/fastest.js";
import { h, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { optionRows } from "./fastest_options.js";
import { choiceText, degrees, speedText } from "./fastest_words.js";

const FIRST = {
  robot: "deltawalker",
  order: [1, 2, 3, 4],
  heading: 0,
  overlap: false,
  course: "walk",
  turn: 0,
  step: null,
  margin: 0.006,
  clearance: 0.003,
  stop_bound: 1.5,
  sway: 0,
  cycles: 3,
};

/** What the chosen gait would be, in a sentence. */
function outcomeText(option, title, isLooking) {
  const unknown = isLooking ? "the studio is computing the speed." : "the speed is not known.";
  if (!option?.price) return `${title}: ${option?.sentence || unknown}`;
  const { price } = option;
  if (price.pace === null) return `${title}: no gait with these values keeps all limits.`;
  const cycle = price.on_the_spot
    ? `turns ${degrees(Math.abs(price.turn), 1)}°`
    : `walks ${mm(price.step)} mm`;
  return (
    `${title}: ${speedText(price)} in mid-walk. In one cycle of ${price.moves} moves and `
    + `${fixed(price.seconds, 1)} s, the robot ${cycle}. `
    + "The whole gait is slower, because its first and last steps are shorter."
  );
}

/** Names of foot orders that have one, by their feet. */
const orderNames = (options) =>
  new Map(
    options.filter(({ group }) => group === "order").map(({ value, name }) => [value.order.join("-"), name]),
  );

/** How many prices are known, while others are still looked for. */
const progressText = (known, count, isLooking) =>
  isLooking && known < count ? `The studio is computing the speeds: ${known} of ${count} are ready.` : "";

/**
 * Builds the rows of options with the sentence under them.
 * @param {(request: Record<string, any>, title: string) => void} changed called with each new request
 */
export function fastestRequest(changed) {
  let request = { ...FIRST };
  let names = new Map();
  let looking = null;
  const rows = optionRows((change) => ask(change));
  const [outcome, state] = [h("p", { class: "fast-outcome" }), h("p", { class: "quiet" })];
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  const nameOf = (order) => names.get(order.join("-")) ?? null;
  const title = () => choiceText(request, nameOf(request.order), request.course !== "walk");

  function showOutcome() {
    const [known, count] = rows.counts();
    setText(outcome, outcomeText(rows.chosen(request), title(), Boolean(looking)));
    setText(state, progressText(known, count, Boolean(looking)));
  }

  function refuse(sentence) {
    setText(error, sentence ?? "");
    error.hidden = !sentence;
  }

  function hear({ options, prices, sentence }) {
    if (options) {
      names = orderNames(options);
      rows.show(options, request);
      changed(request, nameOf(request.order) ?? request.order.join("-"));
    }
    if (prices) rows.take(prices);
    if (sentence) refuse(sentence);
    showOutcome();
  }

  /** Changes the request and looks for its prices; an older search ends. */
  async function ask(change) {
    request = { ...request, ...change };
    looking?.abort();
    const own = new AbortController();
    looking = own;
    refuse(null);
    rows.forget();
    showOutcome();
    try {
      await fastestApi.prices(request, own.signal, (line) => {
        if (looking === own) hear(line);
      });
    } catch ({ message }) {
      if (looking === own) refuse(message);
    }
    if (looking !== own) return;
    looking = null;
    rows.end();
    showOutcome();
  }

  return {
    elements: [rows.element, outcome, state, error],
    value: () => request,
    nameOf,
    ask,
    refuse,
    end() {
      looking?.abort();
      looking = null;
    },
  };
}
