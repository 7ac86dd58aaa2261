/** Where the shown motion comes from, in one quiet line: a file, or a computed result and whether it still holds. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { clockTime, fixed, shortHash } from "../lib/format.js";

const QUIET = { text: "", title: null, tone: null };

function ofFile({ file, form, assumed }) {
  const text = form === "waypoints" ? `Waypoints of ${file}; Optimise replaces them.` : `Recorded in ${file}; Optimise replaces it.`;
  return { text, title: assumed.join("\n") || null, tone: null };
}

function details({ solver, method, program, motion, trajectory }) {
  return `${solver}, method ${method}, Footfall Studio ${program}\nasked ${shortHash(motion)}, result ${shortHash(trajectory)}`;
}

function ofResult(provenance, source, isEdited) {
  const { made, seconds, matches, at_hand: isHere } = provenance;
  const [when, title] = [clockTime(made), details(provenance)];
  if (!matches || isEdited) return { text: `Optimised ${when} for another version: stale.`, title, tone: "caution" };
  if (isHere) return { text: `Optimised ${when} in ${fixed(seconds * 1000, 0)} ms.`, title, tone: null };
  if (source === "optimised") return { text: `Optimised elsewhere ${when}; shown is a result from here.`, title, tone: null };
  return { text: `Optimised elsewhere ${when}; the result is not here. Optimise again.`, title, tone: "caution" };
}

function words({ view, pending, gesture }) {
  if (!view) return QUIET;
  const isEdited = pending.length > 0 || Boolean(gesture);
  if (view.document.recorded) return isEdited ? QUIET : ofFile(view.document.recorded);
  return view.provenance ? ofResult(view.provenance, view.plan?.source, isEdited) : QUIET;
}

/** Builds the line and keeps it current. */
export function originLine(store) {
  const element = h("p", { class: "why", role: "note", "aria-label": "Origin of the motion" });
  store.watch(({ view, pending, gesture }) => [view, pending.length, gesture], (state) => {
    const { text, title, tone } = words(state);
    setText(element, text);
    setAttribute(element, "title", title);
    setAttribute(element, "data-tone-text", tone);
  });
  return element;
}
