/**
 * The four steps from a drawing to a walking robot: tabs in the top bar, each with its state. The inspector
 * shows one of them.
 */

import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { gaitParts, stepStates } from "./step_states.js";

/** Each step with the line under its title in the inspector. */
const STEPS = {
  design: { title: "Design", help: "Choose where and how the robot walks. The plan follows your edits." },
  simulate: { title: "Simulate", help: "Simulate exactly the waypoints that would be sent to the robot." },
  check: {
    title: "Check & approve",
    help: "Check that the gait keeps every rule. Then you can approve the gait.",
  },
  run: { title: "Run", help: "Only an approved gait can be sent to the robot." },
};
const NAMES = Object.keys(STEPS);

let current = NAMES[0];
const followers = [];

/** The step that the inspector shows: `design`, `simulate`, `check` or `run`. */
export const openedStep = () => current;

/** Calls `act` with the name of each step that is opened. */
export function onStep(act) {
  followers.push(act);
}

/** Shows a step in the inspector. */
export function openStep(name) {
  const hadFocus = document.activeElement?.closest("#sections, .inspector-foot, .pipeline");
  current = name;
  setAttribute(document.body, "data-step", name);
  setAttribute(document.body, "data-inspector-folded", null);
  for (const one of NAMES) {
    const isOpen = one === name;
    setAttribute(byId(`tab-${one}`), "aria-selected", String(isOpen));
    byId(`tab-${one}`).tabIndex = isOpen ? 0 : -1;
    byId(one).hidden = byId(`foot-${one}`).hidden = !isOpen;
  }
  setText(byId("step-title"), STEPS[name].title);
  setText(byId("step-help"), STEPS[name].help);
  byId("sections").scrollTop = 0;
  // What had the focus is hidden now, or another step's tab.
  if (hadFocus && (hadFocus.matches(".pipeline") || !document.activeElement.checkVisibility()))
    byId(`tab-${name}`).focus();
  followers.forEach((act) => act(name));
}

function mountTab(name, index) {
  const tab = byId(`tab-${name}`);
  const [mark, word] = [
    h("span", { class: "step-mark", "aria-hidden": "true" }),
    h("span", { class: "step-title", text: STEPS[name].title }),
  ];
  tab.append(mark, word);
  tab.addEventListener("click", () => openStep(name));
  tab.addEventListener("keydown", (event) => {
    const to = { ArrowLeft: index - 1, ArrowRight: index + 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const next = NAMES[(to + NAMES.length) % NAMES.length];
    openStep(next);
    byId(`tab-${next}`).focus();
  });
  return { tab, mark };
}

/** Builds the tabs and keeps their states current. */
export function mountSteps(store) {
  const tabs = Object.fromEntries(NAMES.map((name, index) => [name, mountTab(name, index)]));
  openStep(current);
  const watched = ({ robot, ...state }) => [
    ...gaitParts(state),
    robot?.run,
    robot?.robot,
    robot?.previous_run,
  ];
  store.watch(watched, (state) => {
    for (const [name, { mark, word, share }] of Object.entries(stepStates(state))) {
      const { tab, mark: disc } = tabs[name];
      setAttribute(disc, "data-mark", mark);
      disc.style.setProperty("--share", String(share ?? 0));
      setAttribute(tab, "aria-label", `${STEPS[name].title}: ${word}`);
      setAttribute(tab, "title", `${STEPS[name].title}: ${word}`);
    }
  });
}
