/** Actions on a pattern: show it walking in 3D, make a gait of it, or draw it into the open gait. */

import { openView } from "../timeline/views.js";
import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { ticket } from "../lib/latest_only.js";
import { bodyOf, limbsOf, ruleOf, RULES } from "./pattern_problem.js";
import { whyNotDrawn } from "../document/drawable.js";
import { shownDocument } from "../state/store.js";
import { announce, attempt, toast } from "../lib/toasts.js";

/**
 * What the page lends to the pattern search.
 * @typedef {{
 *   edits: Record<string, any>,
 *   playback: import("../preview/playback.js").Playback,
 *   show: (id: string) => Promise<void>,
 * }} Page
 */

/** The buttons' texts. */
const MAKE = {
  text: "Make gait",
  help: "Makes a new gait with this pattern, adds the gait to the list and opens it",
};
const COMPLETE = {
  text: "Complete the drawing",
  help: "Draws the pattern into the open gait. Undo restores the old drawing",
};
const WALK = { text: "Walk it", help: "Shows in 3D how the robot walks with this pattern. Nothing is saved" };
const STOP = { text: "Stop walking", help: "Shows the plan of the open gait again" };

const NOTHING_NEW =
  "This pattern is the same as the drawing, so there is nothing to complete. "
  + "Choose another pattern under “Best patterns”, or free some of the fixed cells.";
const BALANCE = RULES.find(({ rule }) => rule === "balance");
/** Advice for a pattern without a motion: what the panel offers and is not done yet. */
function adviceText(state) {
  const ways = [
    state.mode === "transition" && !state.walkable && "tick “Swings that the feet can do”",
    !ruleOf(state, BALANCE).on && "switch on the rule “Balance margin”",
    "choose another pattern under “Best patterns”",
    "shorten the step",
  ].filter(Boolean);
  const words = `${ways.slice(0, -1).join(", ")} or ${ways.at(-1)}`;
  return `The live optimiser finds no motion for this pattern. You can ${words}.`;
}

const adviceFor = (plan, state) =>
  plan.live?.status === "infeasible" ? ` ${adviceText(state)}` : " Press Play to see the gait walk.";

/** The pattern in the grid, or why none can be used. */
function usable({ result, running, chosen, waiting }) {
  if (running || waiting) return [null, "The pattern search is still running."];
  const pattern = result?.patterns[chosen] ?? null;
  return [pattern, pattern ? null : "The search has found no pattern."];
}

/** Why the open gait cannot be completed with a pattern, or null if it can. */
const whyNotCompleted = (pattern, document) =>
  whyNotDrawn(document) ?? (pattern?.feet.join() === document?.timeline.feet.join() ? NOTHING_NEW : null);

/** The chosen pattern with its problem, as the server takes it. */
function chosenBody({ state }, problem) {
  const document = shownDocument(state);
  const limbs = limbsOf(problem.state, { robot: document.robot, legs: document.timeline.feet.length });
  const [pattern] = usable(problem.state);
  return {
    question: bodyOf(problem.state, {
      gait: state.selected,
      limbs,
      document: state.pending.length ? document : null,
      drawing: null,
      isFree: () => false,
    }),
    feet: pattern.feet,
  };
}

/** The walk of the chosen pattern in 3D; `end` also ends a walk that is still being computed. */
function patternWalk(store, problem, playback) {
  const begin = ticket();
  const isOn = () => Boolean(store.state.iterate?.pattern);

  function end() {
    begin();
    if (isOn()) store.set({ iterate: null });
  }

  async function start() {
    const isOld = begin();
    const { selected } = store.state;
    const plan = await api.patternPlan(chosenBody(store, problem));
    if (isOld() || store.state.selected !== selected) return;
    if (!plan.times.length)
      throw new Error(plan.refusal?.sentence ?? "No motion was found for this pattern.");
    const note = `The 3D view shows the pattern, not the open gait. ${plan.note}`;
    store.set({ iterate: { job: null, number: null, pattern: true, plan: { ...plan, note } } });
    if (plan.live?.status === "infeasible")
      toast(`The motion in 3D breaks at least one limit. ${adviceText(problem.state)}`);
    playback.toStart();
    playback.play();
  }

  const toggle = attempt(async () => {
    if (!isOn()) return start();
    playback.pause();
    return end();
  });
  return { isOn, end, toggle };
}

async function completeDrawing(store, problem, edits) {
  const { selected: gait } = store.state;
  const { document } = await api.patternDocument(chosenBody(store, problem));
  const apply = (now) => ({
    ...now,
    timeline: { ...now.timeline, feet: document.timeline.feet },
    ...(document.held ? { held: document.held } : {}),
  });
  await edits.edit(apply, COMPLETE.text, { drawing: true, gait });
  announce("The open gait now has this pattern. Undo restores the old drawing.");
  openView("cells");
}

async function makeGait(store, problem, show) {
  const view = await api.patternGait(chosenBody(store, problem));
  await show(view.id);
  openView("cells");
  document.querySelector('#gaits [aria-current="true"]')?.scrollIntoView({ block: "nearest" });
  toast(`The new gait “${view.name}” is open.${adviceFor(view.plan, problem.state)}`, { of: "studio" });
}

/**
 * Builds the buttons.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} problem
 * @param {Page} page
 */
export function patternActions(store, problem, { edits, playback, show }) {
  const [make, walk] = [h("button", { class: "primary", text: MAKE.text }), h("button", { text: WALK.text })];
  const walking = patternWalk(store, problem, playback);
  const isDrawing = () => problem.state.mode === "drawing";
  const use = attempt(async () => {
    walking.end();
    await (isDrawing() ? completeDrawing(store, problem, edits) : makeGait(store, problem, show));
  });
  onPress(make, use, (why) => toast(why));
  onPress(walk, walking.toggle, (why) => toast(why));
  // A walk shows the pattern at its start, so another pattern ends it; more of the best beside it do not.
  problem.watch(
    (state) => [state.result?.patterns[state.chosen]?.feet.join(), state.running === null, state.mode],
    walking.end,
  );
  const showButton = (button, { text, help }, why) => {
    setText(button, text);
    setAllowed(button, why, help);
  };
  return {
    element: h("div", { class: "pattern-acts" }, walk, make),
    leave: walking.end,
    show() {
      const [pattern, why] = usable(problem.state);
      if (isDrawing())
        showButton(make, COMPLETE, why ?? whyNotCompleted(pattern, shownDocument(store.state)));
      else showButton(make, MAKE, why);
      showButton(walk, walking.isOn() ? STOP : WALK, walking.isOn() ? null : why);
    },
  };
}
