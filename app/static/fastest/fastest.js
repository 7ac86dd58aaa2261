/** The dialog for the fastest gait: options with their prices, the search, and a gait of what is chosen. */

import { ApiError } from "../api/gaits.js";
import { fastestApi } from "../api/fastest.js";
import { freeName } from "../document/gait_names.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { robotOptions, robots } from "../shell/robots.js";
import { fastestRequest } from "./fastest_request.js";
import { searchPart } from "./fastest_search.js";

const PURPOSE =
  "Here you create the gait with which the robot walks or turns fastest. "
  + "The number below a value is the speed of the gait with this value. "
  + "After you have created the gait, you can still change all values.";
const OTHER_LAW =
  "The timing of this robot's firmware is not known. "
  + "All times are computed with the firmware timing of the DeltaWalker.";
const MOST_CYCLES = 20;

function addStyles() {
  const href = new URL("./fastest.css", import.meta.url).pathname;
  if (!document.querySelector(`link[href="${href}"]`))
    document.head.append(h("link", { rel: "stylesheet", href }));
}

/** A robot's first foot order along x, begun with foot 1. */
function firstOrder({ orders }) {
  const { feet } = orders.FBS[0];
  const first = feet.indexOf(1);
  return [...feet.slice(first), ...feet.slice(0, first)];
}

function labelled(label, control, help, refusal = null) {
  return h(
    "label",
    { class: "new-row", title: help },
    h("span", { class: "name", text: label }),
    control,
    refusal?.element,
  );
}

/** Robot, name and cycles. */
function headFields(store, list, request) {
  const robot = h("select", { "aria-label": "Robot of the fastest gait" }, ...robotOptions(list));
  const name = h("input", { "aria-label": "Name of the new gait", maxlength: "60", autocomplete: "off" });
  const cycles = h("input", { type: "number", "aria-label": "Cycles", min: 1, max: MOST_CYCLES, step: 1 });
  const law = h("p", { class: "quiet", text: OTHER_LAW, hidden: true });
  const [nameRefusal, cyclesRefusal] = [refusalOf(name), refusalOf(cycles)];
  let isNamed = false;
  cycles.value = request.value().cycles;
  robot.addEventListener("change", () => {
    const chosen = list.find((one) => one.name === robot.value);
    request.ask({
      robot: chosen.name,
      order: firstOrder(chosen),
      heading: 0,
      overlap: false,
      margin: chosen.margin,
    });
  });
  name.addEventListener("input", () => {
    isNamed = true;
    nameRefusal.setError(null);
  });
  cycles.addEventListener("input", () => cyclesRefusal.setError(null));
  return {
    elements: [
      h(
        "div",
        { class: "fast-head" },
        labelled("Robot", robot, "The robot for which you make a gait"),
        labelled("Name", name, "The name of the new gait in the list", nameRefusal),
        labelled(
          "Cycles",
          cycles,
          "Number of cycles of the gait. The gait starts in the standard stance and ends at rest",
          cyclesRefusal,
        ),
      ),
      law,
    ],
    /** Follows the request, but for a name that a person has typed. */
    follow({ robot: shown }, title) {
      robot.value = shown;
      law.hidden = list.find((one) => one.name === shown)?.wired ?? true;
      if (!isNamed) name.value = freeName(store.state, `${title}, fastest`);
    },
    /** The name and the number of cycles; null where one of them is wrong, which then says so. */
    values() {
      const { value, sentence = null } = wholeNumber(cycles, "Cycles", { min: 1, max: MOST_CYCLES });
      const words = name.value.trim();
      nameRefusal.setError(words ? null : "Give the gait a name.");
      cyclesRefusal.setError(sentence);
      if (words && !sentence) return { name: words, cycles: value };
      (words ? cycles : name).focus();
      return null;
    },
  };
}

function form(store, list, close) {
  let [head, named] = [null, null];
  const request = fastestRequest((value, title) => {
    head.follow(value, title);
    search.show(store.state);
    if (value.robot !== named) search.rename();
    named = value.robot;
  });
  const search = searchPart(store, { request: request.value, nameOf: request.nameOf, use: request.ask });
  head = headFields(store, list, request);
  const create = h("button", { type: "submit", class: "primary", text: "Create" });

  async function accept() {
    const values = head.values();
    if (!values || create.disabled) return;
    create.disabled = true;
    try {
      close((await fastestApi.create({ ...request.value(), cycles: values.cycles }, values.name)).id);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      request.refuse(error.message);
    } finally {
      create.disabled = false;
    }
  }

  const buttons = h(
    "div",
    { class: "buttons" },
    h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
    create,
  );
  return {
    content: [
      h("p", { class: "quiet", text: PURPOSE }),
      ...head.elements,
      ...request.elements,
      search.element,
      buttons,
    ],
    accept,
    request,
    search,
  };
}

let isOpen = false;

/**
 * Asks for a fastest gait.
 * @param {import("../state/store.js").Store} store
 * @param {string|null} job id of the search that is shown first
 * @returns {Promise<string|null>} the new gait's id, or null where the user thought better of it
 */
export async function askFastest(store, job = null) {
  if (isOpen) return null;
  isOpen = true;
  let [parts, unwatch] = [null, () => {}];
  try {
    addStyles();
    const list = await robots();
    return await openDialog(
      (close) => {
        parts = form(store, list, close);
        const dialog = dialogFrame("Fastest gait", close, parts.accept, ...parts.content);
        dialog.classList.add("fastest");
        dialog.querySelector("form").noValidate = true;
        return dialog;
      },
      () => {
        const searched = store.state.jobs.find(({ id }) => id === job)?.request ?? {};
        parts.search.pick(job);
        unwatch = store.watch(({ jobs }) => [jobs], parts.search.show);
        parts.request.ask(searched);
      },
    );
  } finally {
    isOpen = false;
    unwatch();
    parts?.request.end();
  }
}
