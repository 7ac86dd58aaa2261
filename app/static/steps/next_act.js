/**
 * The primary button at the foot of a step whose own act is not the next one: it names the next act on the
 * way to the robot and does it. An approval is given where its rules are read: there the button leads.
 */

import { byId, h, onPress, setAllowed, setText } from "../lib/dom.js";
import { toast } from "../lib/toasts.js";
import { hasNoMotion, shownPlan } from "../state/store.js";
import { approvalState, checkState, gaitParts, simulateState } from "./step_states.js";
import { openStep } from "./steps.js";

const SIMULATE_HELP = "Simulate exactly the waypoints that would be sent to the robot.";
const CHECK_HELP = "Check that the gait keeps every rule. Then you can approve the gait.";
const APPROVE_HELP = "Only an approved gait can be sent to the robot.";
const RUN_HELP = "The gait is approved. Now connect, arm and send.";

/** Each act: the step where it takes place, its button's text, the button that does it, and a line below. */
const ACTS = {
  simulate: { step: "simulate", text: "Simulate", button: "act-simulate", help: SIMULATE_HELP },
  check: { step: "check", text: "Check", button: "act-check", help: CHECK_HELP },
  approve: { step: "check", text: "Go to approval", button: null, focus: "act-approve", help: APPROVE_HELP },
  run: { step: "run", text: "Go to Run", button: null, help: RUN_HELP },
};

/** Why the act is not possible yet, in a sentence; why there is no motion stands in the step Design. */
const lackOf = (state, reason) =>
  hasNoMotion(shownPlan(state)) ? "This gait has no motion yet." : reason.split(/(?<=\.) /)[0];

/** The next act for the shown gait. */
function nextAct(state) {
  if (approvalState(state).mark === "done") return "run";
  if (checkState(state).mark === "done") return "approve";
  return simulateState(state).mark === "done" ? "check" : "simulate";
}

/** Builds the button with the line below it, in the foot of a step. */
function nextButton(store, step) {
  const [button, help] = [h("button", { class: "primary wide" }), h("p", { class: "why" })];
  const element = h("div", { class: "next-act" }, button, help);
  onPress(
    button,
    () => {
      const { step: where, button: id, focus } = ACTS[nextAct(store.state)];
      openStep(where);
      if (id) byId(id).click();
      if (focus) byId(focus).focus();
    },
    toast,
  );
  store.watch(gaitParts, (state) => {
    const act = ACTS[nextAct(state)];
    setText(button, act.text);
    const reason = act.button ? byId(act.button).getAttribute("aria-description") : null;
    setText(help, reason ? lackOf(state, reason) : act.help);
    setAllowed(button, reason, act.help);
    // Where the step has the button itself, it is not offered twice; who checks first may simulate later.
    element.hidden = act.step === step || (step === "check" && act !== ACTS.run);
  });
  return element;
}

/** Builds the buttons; the acts' own buttons are there already. */
export function mountNextActs(store) {
  for (const step of ["design", "simulate", "check"]) byId(`foot-${step}`).append(nextButton(store, step));
}
