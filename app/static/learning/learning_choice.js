/** Chooses the data to learn from: kept trials, or the published table with its trajectories. */

import { h, onPress, setAllowed } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";

const LEAST_GAITS = 3;
const gaitOf = ({ gait_name: gait, name, expected_cm: wanted, iterations }) => `${gait || name}, ${fixed(wanted / iterations)} cm × ${iterations}`;

function trialLine(trial, changed) {
  const known = Boolean(trial.gait || trial.run);
  const box = h("input", { type: "checkbox", value: trial.id, checked: known, disabled: !known, on: { change: changed } });
  const why = known ? null : "It is not known what the robot was sent: add the trial again, laid over its run or gait";
  return { box, trial, element: h("li", {}, h("label", { title: why }, box, h("span", { text: trial.name }), h("span", { class: "quiet", text: gaitOf(trial) }))) };
}

/** A list of trials to tick, and the button that starts. */
export function trialChoice(trials, start) {
  const press = h("button", { class: "primary", text: "Learn" });
  const lines = trials.map((trial) => trialLine(trial, refresh));
  const chosen = () => lines.filter(({ box }) => box.checked).map(({ trial }) => trial);

  function refresh() {
    const gaits = new Set(chosen().map(gaitOf)).size;
    setAllowed(press, gaits < LEAST_GAITS ? `The ticked trials are of ${gaits} gaits; ${LEAST_GAITS} different gaits or steps are needed, so that one can be left out.` : null, "Simulates every gait some forty times, in the background");
  }
  refresh();
  onPress(press, () => start({ trials: chosen().map(({ id }) => id) }), (why) => toast(why));
  return h("div", { class: "learning-choice" },
    trials.length ? h("ul", { class: "learning-trials", "aria-label": "Trials to learn from" }, ...lines.map(({ element }) => element)) : h("p", { class: "teach", text: "No trial yet. Add trials of three gaits or steps, each laid over its run or gait." }), press);
}

/** Files of the published trials. */
export function tableChoice(start) {
  const file = (name, multiple) => h("input", { type: "file", accept: ".csv,text/csv", "aria-label": name, multiple, required: true });
  const [table, trajectories] = [file("Table of trials", false), file("Trajectories that were walked", true)];
  const iterations = h("input", { type: "number", "aria-label": "Iterations of each trial", min: "1", max: "50", step: "1", value: "3", required: true });
  const submit = attempt(async (event) => {
    event.preventDefault();
    const texts = await Promise.all([...trajectories.files].map(async (one) => [one.name, await one.text()]));
    start({ table: { csv: await table.files[0].text(), trajectories: Object.fromEntries(texts), iterations: iterations.valueAsNumber } });
  });
  return h("details", { class: "run-states" }, h("summary", { text: "From a published table" }),
    h("form", { class: "trial-form", on: { submit } },
      h("p", { class: "quiet", text: "A table like trajectory_averages.csv (TrajAa, TrajAb, …) and the trajectories walk_a.csv, ambl_b.csv, mtri_c.csv, adjs_d.csv, … that its rows walked." }),
      h("label", {}, h("span", { text: "Table" }), table), h("label", {}, h("span", { text: "Trajectories" }), trajectories),
      h("label", {}, h("span", { text: "Iterations" }), iterations), h("button", { class: "primary", text: "Learn from the table" })));
}
