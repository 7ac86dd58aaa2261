/** The four acts of the first steps: title, sentence, the control to use, and the sign that it was done. */

import { byId } from "../lib/dom.js";
import { hasNoMotion, ownPlan, planIsOn } from "../state/store.js";
import { lineInList } from "../shell/gait_list.js";
import { openDrawer } from "../shell/drawers.js";
import { openedStep, openStep } from "../steps/steps.js";
import { openView } from "../timeline/views.js";

/** A drawn gait of the program, for which remedies are looked for. */
const DRAWN = "walk";
const REAL =
  "This studio drives a real robot. "
  + "To try this exercise with an emulated robot, start the studio with the option --robot emulator.";
const STEP_LABEL = /^(Step|Goal) to /;

/** Whether a gait is drawn: not for the robot's clock, not of segments or parts. Others have no remedies. */
const isDrawn = ({ poses, segment_table: table, sequence }) => !poses && !table && !sequence?.length;

/** The step Design with its fields in sight. */
function stepField() {
  openStep("design");
  return byId("optimise").querySelector('input[aria-label="Step"]');
}

function remedyPlace(state) {
  const { view } = state;
  if (!view || !isDrawn(view.document)) {
    openDrawer("gaits");
    return lineInList(DRAWN);
  }
  if (!hasNoMotion(ownPlan(state))) return stepField();
  openStep("design");
  return byId("optimise").querySelector(".remedy button") ?? stepField();
}

/** The button at the foot of the inspector, which is the next act. */
function nextButton() {
  openStep(openedStep());
  const buttons = [...document.querySelectorAll(".inspector-foot button.primary")];
  return buttons.find((button) => button.checkVisibility()) ?? byId("tab-run");
}

/**
 * @typedef {Record<string, any>} Act
 * @property {string} key
 * @property {string} title
 * @property {(state: Record<string, any>) => string} sentence
 * @property {(state: Record<string, any>) => HTMLElement|null} place the control; brings it into sight
 */

/** @type {Act[]} */
export const ACTS = [
  {
    key: "play",
    title: "Play the walk",
    place: () => byId("play"),
    sentence: () => "Press the button Play below the 3D preview, or press the space bar.",
  },
  {
    key: "step",
    title: "Drag the step",
    place: stepField,
    sentence: () =>
      "Drag the word Step to the left or to the right. "
      + "The plan and the robot in 3D change while you drag.",
  },
  {
    key: "remedy",
    title: "Make the step too long, then use a remedy",
    place: remedyPlace,
    sentence: ({ view }) =>
      view && isDrawn(view.document)
        ? "Set Step to 30 mm. No motion is possible with this step. "
          + "The page then shows remedies: changes that make a motion possible. "
          + "Press “Use this” beside one remedy."
        : "In the list of gaits, under Examples, choose Walk 10 mm. Then set Step to 30 mm.",
  },
  {
    key: "send",
    title: "Send the gait to the emulated robot",
    place: nextButton,
    sentence: ({ robot }) =>
      robot?.emulated === false
        ? REAL
        : "Press the button at the bottom of this panel until the robot walks. "
          + "The button always does the next action: Simulate, Check, Approve, Connect, Arm, Send.",
  },
];

/**
 * Calls `done` with the key of each act that the person has done in this page.
 * @param {import("../state/store.js").Store} store
 * @param {EventTarget} playback
 * @param {(key: string) => void} done
 */
export function watchActs(store, playback, done) {
  playback.addEventListener("state", (/** @type {CustomEvent} */ { detail }) => {
    if (detail.playing) done("play");
  });
  let offered = [];
  store.watch(
    ({ remedies }) => [remedies],
    ({ remedies }) => {
      if (remedies) offered = remedies.list.map(({ label }) => label);
    },
  );
  store.watch(
    ({ pending }) => [pending],
    ({ pending }) => {
      for (const { label } of pending) {
        if (STEP_LABEL.test(label)) done("step");
        if (offered.includes(label)) done("remedy");
      }
    },
  );
  store.watch(
    ({ robot }) => [planIsOn(robot)],
    ({ robot }) => {
      if (planIsOn(robot)) done("send");
    },
  );
}

/** Shows the place of an act: under the keyboard, and outlined until something else has the focus. */
export function showPlace(act, state) {
  openView("cells");
  const place = act.place(state);
  if (!place) return;
  const outlined = place.closest(".field") ?? place;
  outlined.dataset.shownPlace = "";
  place.addEventListener(
    "blur",
    () => {
      delete outlined.dataset.shownPlace;
    },
    { once: true },
  );
  place.scrollIntoView({ block: "nearest" });
  place.focus();
}
