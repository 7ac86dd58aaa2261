/** The verdict strip: the only place that says where the shown gait stands. Each part opens its step. */

import { isThin, planState } from "../state/plan_state.js";
import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { capital, fixed, lowered, mm, paceText } from "../lib/format.js";
import { simulationOver } from "../state/simulation.js";
import { announce } from "../lib/toasts.js";
import { hasNoMotion, shownPlan } from "../state/store.js";
import { approvalState, checkState, gaitParts, simulateState, stepStates } from "./step_states.js";
import { openStep } from "./steps.js";

const MARGIN_HELP =
  "Stability margin: how far the balance point stays inside the area between "
  + "the feet on the ground. Below 0 the robot tips. "
  + "For a motion that the optimiser found, the balance point is the centre of pressure. "
  + "The balance point of any other motion is the centre of mass.";
const LIVE_HELP =
  "A live plan is computed again after every edit. "
  + "The footholds and the body height of a live plan are set in advance, not optimised.";

const NO_PLAN = "There is no plan yet. Press Optimise to see the gait move.";

const SETTLED_MS = 1000;
const NONE = "–";
/** Said by the mark alone. */
const USUAL = "Plan found";

/** How bad a margin is: `bad` below 0, `caution` where it is small and not simulated, else null. */
function marginTone(plan, mark) {
  if (plan.balance < 0) return "bad";
  return mark === "old" && isThin(plan) ? "caution" : null;
}

/** What is known of the plan: mark, figure and the sentence on hover. */
function planPart(state) {
  const plan = shownPlan(state);
  if (!plan) return { mark: "none", figure: state.view ? "none yet" : NONE, help: NO_PLAN };
  const { mark } = stepStates(state).design;
  const [word] = planState(plan);
  const isMotion = plan.times.length > 0 && word !== "No motion";
  const margin = isMotion && plan.balance !== null ? `margin ${mm(plan.balance)} mm` : null;
  const figure = [word === USUAL && margin ? null : lowered(word), margin].filter(Boolean).join(", ");
  const tone = margin && marginTone(plan, mark);
  const thin =
    tone !== "caution"
      ? ""
      : `The robot needs a stability margin of ${mm(plan.robot_margin)} mm. `
        + "Below this margin only Simulate shows whether the robot walks.";
  const live = word === USUAL && plan.live ? LIVE_HELP : "";
  const help = [`${word}.`, thin, plan.note, live, isMotion ? MARGIN_HELP : ""].filter(Boolean).join(" ");
  return { mark, figure, tone, help };
}

function robotPart(state) {
  const plan = shownPlan(state);
  const { view } = state;
  const seconds = hasNoMotion(plan) ? null : plan?.robot_seconds;
  if (!seconds) return { figure: NONE, help: "Time and speed on the robot are not known yet." };
  const speed = plan === view?.plan ? paceText(view) : "";
  const takes = `On the robot the motion takes about ${fixed(seconds)} s${speed && `, at ${speed}`}.`;
  return {
    figure: [`${fixed(seconds)} s`, speed].filter(Boolean).join("  "),
    help: `${takes} This time does not include the moves to the start pose.`,
  };
}

function simulatedPart(state) {
  const { mark, word } = simulateState(state);
  const variations = mark === "done" || mark === "failed" ? simulationOver(state)?.variations : null;
  const walking = variations?.runs.filter(({ walks }) => walks).length;
  const figure = mark === "none" ? NONE : variations ? `${walking}/${variations.count}` : word;
  if (mark === "none") return { mark, figure, help: "Not simulated yet." };
  if (mark === "old") {
    return { mark, figure, help: "The simulation is out of date. Simulate the gait again." };
  }
  const share = variations
    ? ` With slightly changed conditions, the robot walked in ${walking} of ${variations.count} simulations.`
    : "";
  return { mark, figure, help: `${capital(word)}.${share}` };
}

function checkedPart(state) {
  const { mark, word } = checkState(state);
  if (mark === "none") return { mark, figure: NONE, help: "The gait is not checked yet." };
  if (mark === "old") return { mark, figure: word, help: "The check is out of date. Check the gait again." };
  return { mark, figure: word, help: `Check: ${word}.` };
}

function approvedPart(state) {
  const { mark, word } = approvalState(state);
  const help =
    mark === "none"
      ? "Not approved yet."
      : mark === "old"
        ? (state.view?.revoked ?? "The gait changed, so it is no longer approved.")
        : `Approval: ${word}.`;
  return { mark, figure: mark === "none" ? NONE : word, help };
}

const PARTS = [
  { name: "Plan", step: "design", of: planPart },
  { name: "On the robot", step: "design", of: robotPart },
  { name: "Simulated", step: "simulate", of: simulatedPart },
  { name: "Checked", step: "check", of: checkedPart },
  { name: "Approved", step: "check", of: approvedPart },
];

function build({ name, step, of }) {
  const [mark, figure] = [h("span", { class: "step-mark", "aria-hidden": "true" }), h("b")];
  const element = h(
    "button",
    { class: "verdict-part", on: { click: () => openStep(step) } },
    mark,
    h("span", { class: "quiet", text: name }),
    " ",
    figure,
  );
  return {
    element,
    show(state) {
      const { mark: kind = null, figure: text, help, tone = null } = of(state);
      mark.hidden = kind === null;
      setAttribute(mark, "data-mark", kind);
      setText(figure, text);
      setAttribute(figure, "data-tone-text", tone);
      setAttribute(element, "title", help);
    },
  };
}

/** What is shown instead of the gait's plan, in a few words. */
function previewText({ iterate, preview, view, live, gesture, pending }) {
  if (iterate?.pattern) return "Shown: the pattern, not the open gait";
  if (iterate) return "Shown: an iteration of the optimiser, not the plan";
  if (preview) return "Preview";
  if (view && (gesture || pending.length || (live && live.plan !== view.plan))) return "Edit under way";
  return "";
}

/** Announces changed states once nothing changes any more: a drag would be read out at every step. */
function announcer() {
  let [announced, timer] = [null, null];
  return (state) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const { design, simulate } = stepStates(state);
      const words = {
        Plan: design.word,
        Simulated: simulate.word,
        Checked: checkState(state).word,
        Approved: approvalState(state).word,
      };
      const changed = Object.entries(words).filter(([name, word]) => announced && announced[name] !== word);
      if (changed.length) announce(`${changed.map(([name, word]) => `${name}: ${word}`).join(". ")}.`);
      announced = words;
    }, SETTLED_MS);
  };
}

/** Builds the strip and keeps it current. */
export function mountVerdict(store) {
  const announceChange = announcer();
  const parts = PARTS.map(build);
  const preview = h("span", { class: "verdict-preview" });
  byId("verdict").append(...parts.map(({ element }) => element), preview);
  store.watch(gaitParts, (state) => {
    parts.forEach((part) => part.show(state));
    announceChange(state);
    setText(preview, previewText(state));
  });
}
