/** Where strokes of a recorded motion were clipped, by foot and samples. */

import { h } from "../lib/dom.js";
import { counted, fixed } from "../lib/format.js";
import { ownPlan } from "../state/store.js";

/**
 * Joins places of one foot at samples that follow each other.
 * @param {{foot: number, sample: number, mm: number}[]} places
 * @returns {{foot: number, first: number, last: number, worst: number, mm: number}[]}
 */
export function clippedStretches(places) {
  const stretches = [];
  const sorted = [...places].sort((a, b) => a.foot - b.foot || a.sample - b.sample);
  for (const { foot, sample, mm } of sorted) {
    const last = stretches.at(-1);
    if (last?.foot === foot && last.last === sample - 1) {
      last.last = sample;
      if (mm > last.mm) [last.mm, last.worst] = [mm, sample];
    } else stretches.push({ foot, first: sample, last: sample, worst: sample, mm });
  }
  return stretches.sort((a, b) => a.first - b.first);
}

/** @param {{first: number, last: number}} stretch */
const samplesOf = ({ first, last }) =>
  first === last ? `sample ${first + 1}` : `samples ${first + 1} to ${last + 1}`;

function row(stretch, goTo) {
  const place = `Foot ${stretch.foot + 1}, ${samplesOf(stretch)}`;
  return h(
    "li",
    {},
    h("button", {
      class: "link",
      text: place,
      "aria-label": `Go to ${place}`,
      on: { click: () => goTo({ sample: stretch.worst, foot: stretch.foot }) },
    }),
    h("b", { class: "number", text: `${fixed(stretch.mm, 2)} mm` }),
  );
}

function asRecorded({ recorded: { fit, ...recorded }, ...document }) {
  const { within_stroke: _, ...rest } = fit;
  return { ...document, recorded: { ...recorded, fit: { ...rest, within_stroke: null } } };
}

/**
 * Builds the list and keeps it current.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {(place: {sample: number, foot: number}) => void} goTo
 */
export function clippedStrokes(store, edits, goTo) {
  const list = h("ul", { class: "lacks", role: "list", "aria-label": "Clipped strokes" });
  const title = h("summary", {});
  const back = h("button", {
    class: "link",
    text: "Leave the strokes as recorded",
    title: "Takes the clipping back. The recording is then beyond the motors' range again",
    on: { click: () => edits.edit(asRecorded, "Strokes as recorded") },
  });
  const element = h("details", { class: "more", hidden: true }, title, list, back);
  store.watch(
    (state) => [ownPlan(state)?.clipped_mm],
    (state) => {
      const places = ownPlan(state)?.clipped_mm ?? [];
      element.hidden = !places.length;
      if (!places.length) return;
      const stretches = clippedStretches(places);
      const most = Math.max(...places.map(({ mm }) => mm));
      title.textContent = `Clipped by up to ${fixed(most, 2)} mm, in ${counted(stretches.length, "place")}`;
      list.replaceChildren(...stretches.map((stretch) => row(stretch, goTo)));
    },
  );
  return element;
}
