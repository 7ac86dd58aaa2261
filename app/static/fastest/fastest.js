/** The dialog for the fastest gait: options with their prices, the search, and a gait made of what is chosen. */

import { ApiError } from "../api/gaits.js";
import { fastestApi } from "../api/fastest.js";
import { freeName } from "../document/gait_names.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { refusalOf } from "../lib/field_error.js";
import { robotOptions, robots } from "../shell/robots.js";
import { optionRows } from "./fastest_options.js";
import { searchPart } from "./fastest_search.js";
import { degrees, headingText, orderText, paceText } from "./fastest_words.js";

const PURPOSE = "The gait that goes farthest in a second on the robot. Under each value stands how fast the fastest gait with it is, everything else as chosen. All of it can be changed afterwards.";
const OTHER_LAW = "This robot has no firmware of its own here; the DeltaWalker's law of time stands in.";
const DEFAULTS = { robot: "deltawalker", order: [1, 2, 3, 4], heading: 0, overlap: false, way: "walk", turn: 0, step: null, margin: 0.006, clearance: 0.003, stop_bound: 1.5, sway: 0, cycles: 3 };
const MOST_CYCLES = 20;

function addStyles() {
  const href = new URL("./fastest.css", import.meta.url).pathname;
  if (!document.querySelector(`link[href="${href}"]`)) document.head.append(h("link", { rel: "stylesheet", href }));
}

/** What the chosen gait would be, in a sentence. */
function outcome(price, title) {
  if (!price) return `${title}: its price is being looked for.`;
  if (price.pace === null) return `${title}: no gait keeps every limit with these values.`;
  const cycle = price.on_the_spot ? `${degrees(Math.abs(price.turn), 1)}°` : `${mm(price.step)} mm`;
  return `${title}: ${paceText(price)} in mid-walk, ${cycle} in ${price.moves} moves and ${fixed(price.seconds, 1)} s a cycle.`;
}

function form(store, list, close) {
  let question = { ...DEFAULTS };
  let names = new Map();
  let looking = null;
  let isNamed = false;
  const nameOf = (order) => names.get(order.join("-")) ?? null;
  const robot = h("select", { "aria-label": "Robot of the fastest gait" }, ...robotOptions(list));
  const name = h("input", { "aria-label": "Name of the new gait", maxlength: "60", required: true, autocomplete: "off" });
  const cycles = h("input", { type: "number", "aria-label": "Cycles", min: 1, max: MOST_CYCLES, step: 1, value: question.cycles, required: true });
  const [result, state, law] = [h("p", { class: "fast-outcome", role: "status" }), h("p", { class: "quiet" }), h("p", { class: "quiet", text: OTHER_LAW, hidden: true })];
  const general = h("p", { class: "field-error", role: "alert", hidden: true });
  const create = h("button", { type: "submit", class: "primary", text: "Create" });
  const refusals = new Map([["name", refusalOf(name)], ["cycles", refusalOf(cycles)]]);
  const rows = optionRows((change) => ask(change));
  const search = searchPart(store, { question: () => question, nameOf, use: take });

  const title = () => orderText(question, nameOf(question.order));
  function showOutcome() {
    const [known, count] = rows.counts();
    setText(result, outcome(rows.asked(question), question.way === "walk" ? `${title()}, ${headingText(question.heading)}` : title()));
    setText(state, known < count && looking ? `Prices: ${known} of ${count} known; the others are being looked for.` : "");
    if (!isNamed) name.value = freeName(store.state, `${title()}, fastest`);
  }

  function hear(line) {
    if (line.options) {
      names = new Map(line.options.filter(({ group }) => group === "order").map(({ value, name: own }) => [value.order.join("-"), own]));
      rows.show(line.options, question);
    }
    if (line.prices) rows.take(line.prices);
    if (line.sentence) refuse(line.sentence);
    showOutcome();
  }

  function refuse(sentence) {
    setText(general, sentence);
    general.hidden = false;
  }

  async function ask(change) {
    question = { ...question, ...change };
    looking?.abort();
    const own = new AbortController();
    looking = own;
    general.hidden = true;
    search.show(store.state);
    try {
      await fastestApi.prices(question, own.signal, (line) => { if (looking === own) hear(line); });
    } catch ({ message }) {
      if (looking === own) refuse(message);
    }
    if (looking !== own) return;
    looking = null;
    showOutcome();
  }

  /** Takes over what a gait of a search was asked. */
  function take({ order, heading, overlap, margin, stop_bound: bound }, asked) {
    const { robot: own, way, turn, step, clearance, sway } = asked;
    ask({ robot: own, way, turn, step, clearance, sway, order, heading, overlap, margin, stop_bound: bound });
    rows.element.scrollIntoView({ block: "nearest" });
  }

  robot.addEventListener("change", () => {
    const chosen = list.find((one) => one.name === robot.value);
    law.hidden = chosen.wired;
    ask({ robot: chosen.name, order: Array.from({ length: chosen.legs }, (_, foot) => foot + 1), heading: 0, overlap: false });
  });
  name.addEventListener("input", () => { isNamed = true; refusals.get("name").setError(null); });
  cycles.addEventListener("input", () => { question = { ...question, cycles: Number(cycles.value) }; refusals.get("cycles").setError(null); });

  async function accept() {
    const wrong = { name: name.value.trim() ? null : "Give the gait a name.",
      cycles: Number.isInteger(question.cycles) && question.cycles >= 1 && question.cycles <= MOST_CYCLES ? null : `Cycles needs a whole number between 1 and ${MOST_CYCLES}.` };
    for (const [key, { setError }] of refusals) setError(wrong[key]);
    general.hidden = true;
    if (wrong.name || wrong.cycles) { (wrong.name ? name : cycles).focus(); return; }
    if (create.disabled) return;
    create.disabled = true;
    try {
      close((await fastestApi.create(question, name.value.trim())).id);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      refuse(error.message);
    } finally {
      create.disabled = false;
    }
  }

  const field = (label, control, refusal, help) => h("label", { class: "new-row", title: help }, h("span", { class: "name", text: label }), control, refusal?.element);
  const content = [h("p", { class: "quiet", text: PURPOSE }),
    h("div", { class: "fast-head" }, field("Robot", robot, null, "Which robot it is for"), field("Name", name, refusals.get("name"), "What the gait is called"), field("Cycles", cycles, refusals.get("cycles"), "From the standard stance to rest")),
    law, rows.element, result, state, search.element, general,
    h("div", { class: "buttons" }, h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }), create)];
  return { content, accept, begin: () => ask({}), show: search.show, leave: () => looking?.abort() };
}

/**
 * Asks for a fastest gait.
 * @param {object} store
 * @returns {Promise<string|null>} the new gait's id, or null where the user thought better of it
 */
export async function askFastest(store) {
  addStyles();
  const list = await robots();
  let [parts, unwatch] = [null, null];
  const id = await openDialog((close) => {
    parts = form(store, list, close);
    const dialog = dialogFrame("Fastest gait", close, parts.accept, ...parts.content);
    dialog.classList.add("fastest");
    dialog.querySelector("form").noValidate = true;
    return dialog;
  }, () => {
    unwatch = store.watch(({ jobs }) => [jobs], parts.show);
    parts.begin();
  });
  unwatch?.();
  parts.leave();
  return id;
}
