/** Makes a segment table of a drawn gait, as drawn or with phases long enough for a step's two segments. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { counted } from "../lib/format.js";
import { drawnRows, isDrawn } from "../document/drawn_timeline.js";
import { latestOnly } from "../lib/latest_only.js";
import { shownDocument } from "../state/store.js";
import { toast } from "../lib/toasts.js";

const EMPTY =
  "The footfalls of this gait are drawn on the timeline. "
  + "A segment table describes the same footfalls in words. "
  + "In each segment, every foot makes one named movement, such as Lift A, Step A or Wait A.";

/** The document drawn with phases that fit two segments, or null if a person drew the timeline. */
function withRoom(document) {
  const { timeline, options } = document;
  if (!isDrawn(document)) return null;
  const phase = Math.max(4, options.phase_knots + (options.phase_knots % 2));
  const closing = Math.max(1, Math.ceil(options.closing_knots / (phase / 2))) * (phase / 2);
  const roomy = { ...document, options: { ...options, phase_knots: phase, closing_knots: closing } };
  return { ...roomy, timeline: { ...timeline, feet: drawnRows(roomy), locked: null } };
}

async function made(document) {
  try {
    return await api.createTable(document);
  } catch (error) {
    return { table: null, sentence: error.message };
  }
}

/** The table of a drawing, or why there is none; then also the drawing with more room, where that has one. */
async function findTables(document) {
  const found = await made(document);
  const other = found.table ? null : withRoom(document);
  const { table } = other ? await made(other) : { table: null };
  return { found, offer: table && { ...other, segment_table: table } };
}

/** Draws a document's timeline as an offer has it, with its table. */
const redrawn =
  ({ options, timeline, segment_table: table }) =>
  (document) => ({
    ...document,
    timeline,
    options: { ...document.options, phase_knots: options.phase_knots, closing_knots: options.closing_knots },
    segment_table: table,
  });

/** The button that draws the timeline again, with longer phases. */
function roomyButton(edits) {
  let offer = null;
  const draw = () => {
    const phase = offer.options.phase_knots;
    edits.edit(redrawn(offer), `Make a segment table with phases of ${phase} samples`, { drawing: true });
  };
  const element = h("button", { class: "wide", hidden: true, on: { click: draw } });
  return {
    element,
    show(found) {
      offer = found;
      element.hidden = !offer;
      if (!offer) return;
      const { phase_knots: phase, closing_knots: closing } = offer.options;
      setText(element, `Make a table with phases of ${phase} samples`);
      element.title =
        `Draws the timeline again with phases of ${phase} samples and a final stance of `
        + `${counted(closing, "sample")}. Then makes the table. Undo restores the old timeline`;
    },
  };
}

/** The buttons of a gait without a table, and why its timeline cannot become one. */
export function mountSegmentSheetCreation(store, edits) {
  const make = h("button", { class: "primary wide", text: "Make a segment table" });
  const why = h("p", { class: "why" });
  const roomy = roomyButton(edits);
  const teach = h("p", { class: "teach", text: EMPTY });
  let found = null;

  const request = latestOnly(async ({ id, revision, document }) => {
    const answer = await findTables(document);
    if (store.state.view?.id !== id || store.state.view.revision !== revision) return;
    found = answer.found;
    setAllowed(
      make,
      found.table ? null : found.sentence,
      "Makes a table that describes the footfalls of this timeline as named segments. Undo removes the table",
    );
    setText(why, found.sentence ?? "");
    roomy.show(answer.offer);
  });

  const takeFound = () => {
    const apply = (document) => ({ ...document, segment_table: found.table });
    if (found?.table) edits.edit(apply, "Make a segment table", { drawing: true });
  };
  onPress(make, takeFound, toast);
  store.watch(
    ({ view }) => [view?.id, view?.revision],
    (state) => {
      const { view } = state;
      if (!view || view.document.segment_table || view.document.sequence?.length) return;
      setAllowed(make, "The studio is looking for a table that fits this timeline.");
      roomy.element.hidden = true;
      request({ id: view.id, revision: view.revision, document: shownDocument(state) });
    },
  );
  return h("div", { class: "making" }, teach, make, why, roomy.element);
}
