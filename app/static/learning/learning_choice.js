/** The trials to learn from: a list to tick, the button that starts, and in words what is still needed. */

import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { counted, fixed } from "../lib/format.js";
import { toast } from "../lib/toasts.js";

const LEAST_GAITS = 3;
const TEST = "To test the fitted values, learning predicts each gait from the trials of the other gaits.";
const WHERE =
  "For each trial, the studio must know which gait or run the robot walked. "
  + "Choose the gait or run when you add the trial.";

const gaitOf = ({ gait_name: gait, name, expected_cm: wanted, iterations }) =>
  `${gait || name}, ${fixed(wanted / iterations)} cm × ${iterations}`;

/** Why nothing can be learned from a trial; null where it can. */
function whyNot({ is_example: isExample, gait, run }) {
  if (isExample) return "This example was made by simulation. Learning uses only trials of a real robot.";
  return gait || run
    ? null
    : "The studio does not know which waypoints were sent to the robot in this "
        + "trial. Add the trial again, and choose its gait or run under “Compare with plan”.";
}

function trialLine(trial, changed) {
  const why = whyNot(trial);
  const box = h("input", {
    type: "checkbox",
    value: trial.id,
    checked: !why,
    disabled: Boolean(why),
    on: { change: changed },
  });
  const label = h(
    "label",
    {},
    box,
    h("span", { text: trial.name }),
    !trial.is_example && h("span", { class: "quiet", text: gaitOf(trial) }),
  );
  return { box, trial, element: h("li", {}, label, why && h("p", { class: "quiet", text: why })) };
}

/** What is missing, from the trials and the count of gaits that are ticked; null where nothing is. */
function missingText(trials, gaits) {
  if (gaits >= LEAST_GAITS) return null;
  const ticked = gaits ? `You ticked trials of ${counted(gaits, "gait")}` : "No trial is ticked";
  const have = trials.some((trial) => !whyNot(trial)) ? ticked : "There is no trial to learn from yet";
  return (
    `${have}. Learning needs at least ${LEAST_GAITS} gaits that differ in name or step length. `
    + `${TEST} ${WHERE}`
  );
}

/**
 * A list of trials to tick, and the button that starts.
 * @param {Record<string, any>[]} trials lines of the list of trials
 * @param {(wanted: {trials: string[]}) => void} start
 * @returns {HTMLElement}
 */
export function trialChoice(trials, start) {
  const press = h("button", { class: "primary", text: "Learn" });
  const needs = h("p", { class: "why", role: "status", "aria-label": "What Learn needs" });
  const lines = trials.map((trial) => trialLine(trial, refresh));
  const chosen = () => lines.filter(({ box }) => box.checked).map(({ trial }) => trial);

  function refresh() {
    const gaits = new Set(chosen().map(gaitOf)).size;
    const missing = missingText(trials, gaits);
    setAllowed(
      press,
      missing,
      "Fits physics parameters to the ticked trials. For this, the studio "
        + "simulates each gait of these trials about forty times. "
        + "You can continue to work during the simulations",
    );
    setText(needs, missing ?? "");
    needs.hidden = !missing;
  }
  refresh();
  onPress(
    press,
    () => start({ trials: chosen().map(({ id }) => id) }),
    (why) => toast(why),
  );
  const list = h(
    "ul",
    { class: "learning-trials", "aria-label": "Trials to learn from" },
    ...lines.map(({ element }) => element),
  );
  return h("div", { class: "learning-choice" }, trials.length ? list : null, press, needs);
}
