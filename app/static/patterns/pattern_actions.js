/** Actions on a pattern: show it walking in 3D, make a gait of it, or draw it into the open gait. */

import { openView } from "../timeline/views.js";
import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { ticket } from "../lib/latest_only.js";
import { bodyOf, limbsOf, ruleOf, RULES } from "./pattern_problem.js";
import { whyNotDrawn } from "../document/drawable.js";
import { shownDocument } from "../state/store.js";
import { announce, attempt, toast } from "../lib/toasts.js";

const LABEL = "Complete the drawing";
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

/** Why drawing a pattern would not change the open gait, or null if it would. */
const nothingToDraw = (pattern, document) =>
  pattern?.feet.join() === document?.timeline.feet.join() ? NOTHING_NEW : null;

/**
 * Builds the buttons.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} problem
 * @param {{edits: Record<string, any>, playback: import("../preview/playback.js").Playback, show: (id: string) => Promise<void>}} page
 */
export function patternActions(store, problem, { edits, playback, show }) {
  const make = h("button", { class: "primary", text: "Make gait" });
  const walk = h("button", { text: "Walk it" });
  const element = h("div", { class: "pattern-acts" }, walk, make);

  function body() {
    const document = shownDocument(store.state);
    const limbs = limbsOf(problem.state, { robot: document.robot, legs: document.timeline.feet.length });
    const [pattern] = usable(problem.state);
    return {
      question: bodyOf(problem.state, {
        gait: store.state.selected,
        limbs,
        document: store.state.pending.length ? document : null,
        drawing: null,
        isFree: () => false,
      }),
      feet: pattern.feet,
    };
  }

  const begin = ticket();
  /** Ends the walk, also one that is still being computed. */
  const leave = () => {
    begin();
    if (store.state.iterate?.pattern) store.set({ iterate: null });
  };

  const makeGait = attempt(async () => {
    leave();
    const { selected: gait } = store.state;
    if (problem.state.mode === "drawing") {
      const { document } = await api.patternDocument(body());
      await edits.edit(
        (now) => ({
          ...now,
          timeline: { ...now.timeline, feet: document.timeline.feet },
          ...(document.held ? { held: document.held } : {}),
        }),
        LABEL,
        { drawing: true, gait },
      );
      announce("The open gait now has this pattern. Undo restores the old drawing.");
      openView("cells");
      return;
    }
    const view = await api.patternGait(body());
    await show(view.id);
    openView("cells");
    document.querySelector('#gaits [aria-current="true"]')?.scrollIntoView({ block: "nearest" });
    toast(`The new gait “${view.name}” is open.${adviceFor(view.plan, problem.state)}`, { of: "studio" });
  });

  const toggleWalk = attempt(async () => {
    if (store.state.iterate?.pattern) {
      playback.pause();
      leave();
      return;
    }
    const isOld = begin();
    const { selected } = store.state;
    const plan = await api.patternPlan(body());
    if (isOld() || store.state.selected !== selected) return;
    if (!plan.times.length)
      throw new Error(plan.refusal?.sentence ?? "No motion was found for this pattern.");
    const note = `The 3D view shows the pattern, not the open gait. ${plan.note}`;
    store.set({ iterate: { job: null, number: null, pattern: true, plan: { ...plan, note } } });
    if (plan.live?.status === "infeasible")
      toast("The motion in 3D breaks at least one limit. " + `${adviceText(problem.state)}`);
    playback.toStart();
    playback.play();
  });

  onPress(make, makeGait, (why) => toast(why));
  onPress(walk, toggleWalk, (why) => toast(why));
  // A walk shows the pattern at its start, so another pattern ends it; more of the best beside it do not.
  problem.watch(
    (state) => [state.result?.patterns[state.chosen]?.feet.join(), state.running === null, state.mode],
    leave,
  );

  return {
    element,
    leave,
    show() {
      const [pattern, why] = usable(problem.state);
      const isDrawing = problem.state.mode === "drawing";
      const whyNot =
        why
        ?? (isDrawing
          ? (whyNotDrawn(shownDocument(store.state)) ?? nothingToDraw(pattern, shownDocument(store.state)))
          : null);
      setText(make, isDrawing ? LABEL : "Make gait");
      setAllowed(
        make,
        whyNot,
        isDrawing
          ? "Draws the pattern into the open gait. " + "Undo restores the old drawing"
          : "Makes a new gait with this pattern, adds the gait to the list " + "and opens it",
      );
      const walking = Boolean(store.state.iterate?.pattern);
      setText(walk, walking ? "Stop walking" : "Walk it");
      setAllowed(
        walk,
        walking ? null : why,
        walking
          ? "Shows the plan of the open gait again"
          : "Shows in 3D how the robot walks with this pattern. Nothing is saved",
      );
    },
  };
}
