/** The dialog for a rotation: a turn on the spot by some angle, for the robot's clock. */

import { ApiError } from "../api/gaits.js";
import { fastestApi } from "../api/fastest.js";
import { freeName } from "../document/gait_names.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, setText } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { fixed } from "../lib/format.js";
import { robotOptions, robots } from "../shell/robots.js";

const PURPOSE =
  "The robot turns on the spot: the feet step one after the other, and the body turns with them. "
  + "With fewer cycles each cycle turns more, and the whole turn takes less time.";
const MOST_DEGREES = 720;
const MOST_CYCLES = 20;
const MOST_A_CYCLE = 90;
const [FIRST_DEGREES, FIRST_CYCLES] = [45, 3];

/** What a turn is called: `Rotate 45°`, `Rotate 45° right`. */
const titleOf = (degrees) => `Rotate ${Math.abs(degrees)}°${degrees < 0 ? " right" : ""}`;

/** What each cycle does, in a sentence. */
const cycleText = (degrees, cycles) =>
  `In each cycle every foot steps once, and the robot turns ${fixed(Math.abs(degrees) / cycles, 1)}° `
  + `to the ${degrees > 0 ? "left" : "right"}.`;

function fields(list) {
  const number = (name, min, max, value) =>
    h("input", { type: "number", "aria-label": name, min, max, step: 1, value });
  const controls = {
    name: h("input", { "aria-label": "Name of the new gait", maxlength: "60", autocomplete: "off" }),
    robot: h("select", { "aria-label": "Robot of the rotation" }, ...robotOptions(list)),
    turn: number("Turn", -MOST_DEGREES, MOST_DEGREES, FIRST_DEGREES),
    cycles: number("Cycles", 1, MOST_CYCLES, FIRST_CYCLES),
  };
  const units = { turn: "°", cycles: "" };
  const rows = [
    ["name", "Name", "The name of the new gait in the list"],
    ["robot", "Robot", "The robot for which you make a gait"],
    [
      "turn",
      "Turn",
      "How far the robot turns in all cycles together; to the left above 0, to the right below 0",
    ],
    ["cycles", "Cycles", "In each cycle every foot steps once. More cycles make smaller turns"],
  ];
  const refusals = Object.fromEntries(rows.map(([key]) => [key, refusalOf(controls[key])]));
  const elements = rows.map(([key, label, help]) => {
    const box =
      key in units ? h("span", { class: "box", data: { unit: units[key] } }, controls[key]) : controls[key];
    const name = h("span", { class: "name", text: label });
    return h("label", { class: "new-row", title: help }, name, box, refusals[key].element);
  });
  return { controls, refusals, elements };
}

/** The values of the fields; a field that is wrong says so and gets the focus, and there are none. */
function valuesOf({ controls, refusals }) {
  const range = { min: -MOST_DEGREES, max: MOST_DEGREES, unit: "°" };
  const turn = wholeNumber(controls.turn, "Turn", range);
  if (turn.value === 0) turn.sentence = "Turn is 0°. Enter how far the robot turns, for example 45.";
  const cycles = wholeNumber(controls.cycles, "Cycles", { min: 1, max: MOST_CYCLES });
  const each = Math.abs(turn.value) / cycles.value;
  if (each > MOST_A_CYCLE)
    cycles.sentence =
      `Each cycle would turn ${fixed(each, 1)}°, but can turn at most ${MOST_A_CYCLE}°. `
      + "Enter more cycles.";
  const name = controls.name.value.trim();
  const sentences = {
    name: name ? null : "Give the gait a name.",
    turn: turn.sentence ?? null,
    cycles: cycles.sentence ?? null,
  };
  const wrong = Object.keys(sentences).filter((key) => sentences[key]);
  for (const [key, sentence] of Object.entries(sentences)) refusals[key].setError(sentence);
  return { wrong, name, degrees: turn.value, cycles: cycles.value };
}

/** What is asked of the server. */
const rotation = (robot, degrees, cycles) => ({
  robot: robot.name,
  // Round the ring: neighbours in turn need no moves of the body alone.
  order: Array.from({ length: robot.legs }, (_, foot) => foot + 1),
  margin: robot.margin,
  course: "turn",
  turn: (degrees * Math.PI) / 180 / cycles,
  cycles,
});

function form(store, list, close) {
  const parts = fields(list);
  const { controls } = parts;
  const note = h("p", { class: "quiet", role: "status" });
  const general = h("p", { class: "field-error", role: "alert", hidden: true });
  const create = h("button", { type: "submit", class: "primary", text: "Create" });
  let isNamed = false;

  function follow() {
    const { wrong, degrees, cycles } = valuesOf(parts);
    const isKnown = !wrong.includes("turn") && !wrong.includes("cycles");
    setText(note, isKnown ? cycleText(degrees, cycles) : "");
    if (isKnown && !isNamed) controls.name.value = freeName(store.state, titleOf(degrees));
  }

  async function accept() {
    const { wrong, name, degrees, cycles } = valuesOf(parts);
    general.hidden = true;
    if (wrong.length) return controls[wrong[0]].focus();
    if (create.disabled) return undefined;
    create.disabled = true;
    try {
      const robot = list.find((one) => one.name === controls.robot.value);
      return close((await fastestApi.create(rotation(robot, degrees, cycles), name)).id);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      general.textContent = error.message;
      general.hidden = false;
      return undefined;
    } finally {
      create.disabled = false;
    }
  }

  controls.name.addEventListener("input", () => (isNamed = true));
  for (const control of [controls.name, controls.turn, controls.cycles])
    control.addEventListener("input", follow);
  controls.name.value = freeName(store.state, titleOf(FIRST_DEGREES));
  follow();
  return {
    accept,
    content: [
      h("p", { class: "quiet", text: PURPOSE }),
      ...parts.elements,
      note,
      general,
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
        create,
      ),
    ],
  };
}

/**
 * Asks for a rotation on the spot.
 * @param {import("../state/store.js").Store} store
 * @returns {Promise<string|null>} the new gait's id, or null where the user thought better of it
 */
export async function askRotation(store) {
  const list = await robots();
  return openDialog((close) => {
    const { accept, content } = form(store, list, close);
    const dialog = dialogFrame("Rotate on the spot", close, accept, ...content);
    dialog.classList.add("new-gait");
    dialog.querySelector("form").noValidate = true;
    return dialog;
  });
}
