/** The band over the timeline that names the parts of a sequence, and their borders through the rows. */

import { clamp } from "../lib/clamp.js";
import { axisKey, axisOf, columnFraction } from "../state/time_axis.js";
import { byId, h, setAttribute } from "../lib/dom.js";
import { isSequence } from "../document/sequence_edits.js";
import { figuresOf } from "./sequence_row.js";
import { shownDocument, shownPlan } from "../state/store.js";

/** A sample's moment is the middle of its column, and two parts share the sample where they meet. */
function placeOf(axis, { first, last }) {
  const [from, to] = [first, last].map((sample) => clamp(columnFraction(axis, sample + 0.5), 0, 1));
  return { left: `${100 * from}%`, width: `${100 * (to - from)}%`, seen: to > from };
}

/** How often a part's iteration is run through, in words; nothing for once. */
function runsOf({ sequence }, { part, is_transition: isTransition }) {
  const runs = isTransition ? 1 : (sequence[part]?.times ?? 1) * (sequence[part]?.gait.iterations ?? 1);
  return runs > 1 ? ` ${runs}×` : "";
}

function stretch(axis, one, runs, times, playback) {
  const { left, width, seen } = placeOf(axis, one);
  if (!seen) return null;
  const title = `${one.is_transition ? "Transition to " : ""}${one.name}${runs}: ${figuresOf(one)}`;
  const element = h(
    "div",
    {
      class: "stretch",
      title,
      data: { source: one.source, ...(one.is_transition ? { transition: "" } : {}) },
      on: { click: () => playback.setTime(times[one.first]) },
    },
    !one.is_transition && h("span", { text: `${one.name}${runs}` }),
  );
  Object.assign(element.style, { left, width });
  return element;
}

function border(axis, { first }) {
  const fraction = columnFraction(axis, first + 0.5);
  if (first === 0 || fraction <= 0 || fraction >= 1) return null;
  const element = h("i", { class: "part-border" });
  element.style.left = `${100 * fraction}%`;
  return element;
}

/** Draws the band and keeps it current; a click sets the playhead to where a part begins. */
export function mountSequenceBand(store, playback) {
  const [band, borders] = [byId("parts"), h("div", { class: "part-borders" })];
  byId("overlay").prepend(borders);
  store.watch(
    (state) => [state.view, shownPlan(state), axisKey(state)],
    (state) => {
      const on = isSequence(shownDocument(state));
      band.hidden = !on;
      setAttribute(byId("timeline"), "aria-readonly", on ? "true" : null);
      byId("parts-label").hidden = !on;
      const [axis, plan] = [axisOf(state), shownPlan(state)];
      const placed = on ? (plan?.parts ?? []).filter(({ first }) => first !== null) : [];
      band.replaceChildren(
        ...placed
          .map((one) => stretch(axis, one, runsOf(shownDocument(state), one), plan.times, playback))
          .filter(Boolean),
      );
      borders.replaceChildren(...placed.map((one) => border(axis, one)).filter(Boolean));
    },
  );
}
