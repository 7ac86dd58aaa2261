/**
 * What plots and robot draw: the plan that is looked at; where the gait's own has no motion, in grey, the
 * last plan of the same gait that worked, or else the nearest motion.
 */

import { planState } from "./plan_state.js";
import { hasNoMotion, ownPlan, shownDocument, shownPlan } from "./store.js";

/** @typedef {import("./store.js").State} State */

/** What is said of each grey: on the stage, in a plot, and of a value under the pointer. */
export const GREY = {
  worked: { stage: "Grey: the last valid plan.", plot: "grey: last valid plan", value: "last valid plan" },
  nearest: {
    stage: "Grey: the motion that breaks the limits least.",
    plot: "grey: motion that breaks the limits least",
    value: "motion that breaks the limits least",
  },
};

/** Whether the gait has no motion, and nothing else is looked at instead. @param {State} state */
export const isStuck = (state) => !state.iterate && !state.tryout && hasNoMotion(ownPlan(state));

/** Whether the plan that worked is of the shown gait and of its robot. @param {State} state */
const isOfShown = (state) =>
  state.worked?.id === state.view?.id && state.worked.robot === shownDocument(state)?.robot;

/** What is drawn in grey: "worked", "nearest", or null where nothing is. @param {State} state */
export function greyOf(state) {
  if (!isStuck(state)) return null;
  if (state.worked && isOfShown(state)) return "worked";
  return ownPlan(state).times.length ? "nearest" : null;
}

/** The plan that plots and robot draw. @param {State} state */
export const drawnPlan = (state) => (greyOf(state) === "worked" ? state.worked.plan : shownPlan(state));

/** @param {any} plan */
const works = (plan) => Boolean(plan?.times.length) && planState(plan)[1] === "good";

/**
 * Keeps the last plan of the shown gait that worked, for this tab alone.
 * @param {import("./store.js").Store} store
 */
export function mountWorkedPlan(store) {
  store.watch(
    (state) => [state.selected, state.view?.id, ownPlan(state)],
    (state) => {
      const { selected, view, worked } = state;
      const plan = ownPlan(state);
      if (view?.id === selected && works(plan)) {
        if (worked?.id !== selected || worked.plan !== plan)
          store.set({ worked: { id: selected, robot: shownDocument(state)?.robot, plan } });
      } else if (worked && worked.id !== selected) store.set({ worked: null });
    },
  );
}
