/** Shows what does not fit in the segment table, with buttons that repair it. */

import { capital, lowered } from "../lib/format.js";
import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import {
  commit,
  segmentDraftOf,
  dropSegmentDraft,
  protectedCells,
  shownSegmentSheet,
} from "../state/segment_draft.js";
import { errorSentence, errorsOf, ownRow, segmentSheetOf, tableOf } from "../document/segment_sheet.js";
import { latestOnly } from "../lib/latest_only.js";
import { shownDocument } from "../state/store.js";
import { report } from "../lib/toasts.js";

const range = (first, count) =>
  count === 1 ? `segment ${first + 1}` : `segments ${first + 1}–${first + count}`;

/** A repair of the server as `{label, help, change}`. */
function offerOf({ foot, first, names, inserted, table }, sheet, document) {
  const own = Array.from({ length: sheet.legs }, (_, one) => one).find((one) => ownRow(sheet, one) === foot);
  const words = names.join(", ");
  const label = !names.length
    ? "Make the link fit"
    : inserted
      ? `Insert ${words}`
      : `${capital(range(first, names.length))} to ${words}`;
  const help = inserted
    ? `Inserts ${range(first, names.length)}, in which the other feet wait`
    : `Changes the segments of foot ${own + 1}. Changes the link too, if necessary`;
  const mended = segmentSheetOf({ ...document, segment_table: table });
  const moved =
    inserted && names.length
      ? ([row, column]) => [row + (row >= first ? names.length : 0), column]
      : undefined;
  return {
    label,
    help,
    step: {
      moved,
      change: (now) => ({ ...mended, iterations: now.iterations }),
      label: `Foot ${own + 1}: ${lowered(label)}`,
      kept: [],
    },
  };
}

const button = (text, title, click) => h("button", { text, title, on: { click } });

function moreText(count) {
  if (count > 1) return ` ${count} more cells have errors.`;
  return count === 1 ? " 1 more cell has an error." : "";
}

/** The first error, with the number of the others. */
function errorLine(sheet, errors, stops) {
  return h("p", {
    text: `${errorSentence(sheet, errors[0])}${moreText(errors.length - 1)}`,
    title: stops
      ? "The gait uses its last valid table until you correct all errors."
      : "The gait can have only one iteration until you correct all errors.",
  });
}

/**
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {HTMLElement} note
 * @param {() => void} focus gives the focus back to the grid
 */
export function mountSegmentSheetRepairs(store, edits, note, focus) {
  let offers = [];
  let requested = "";

  const load = latestOnly(async ({ text, sheet, document, body }) => {
    try {
      const { repairs } = await api.tableRepairs(body);
      if (text !== requested) return;
      offers = repairs.map((repair) => offerOf(repair, sheet, document));
      draw();
    } catch (error) {
      report(error);
    }
  });

  function request(sheet) {
    const kept = protectedCells(segmentDraftOf(store.state).steps).map(([row, foot]) => [
      ownRow(sheet, foot),
      row,
    ]);
    const body = { table: tableOf(sheet), kept };
    const text = JSON.stringify(body);
    if (text === requested) return;
    [requested, offers] = [text, []];
    load({ text, sheet, document: shownDocument(store.state), body });
  }

  const act = (does) => () => {
    does();
    focus();
  };

  function draw() {
    const sheet = shownSegmentSheet(store.state);
    const errors = sheet ? errorsOf(sheet) : [];
    const stops = segmentDraftOf(store.state).steps.length > 0;
    note.hidden = errors.length === 0;
    if (note.hidden) {
      note.replaceChildren();
      [requested, offers] = ["", []];
      return;
    }
    note.dataset.tone = stops ? "bad" : "caution";
    const takeBack = button(
      "Take it back",
      "Restores the last valid table. Ctrl+Z undoes only the last change",
      act(() => dropSegmentDraft(store)),
    );
    const repairs = offers.map(({ label, help, step }) =>
      button(
        label,
        help,
        act(() => commit(store, edits, step)),
      ),
    );
    note.replaceChildren(
      errorLine(sheet, errors, stops),
      h("div", { class: "buttons" }, ...repairs, stops && takeBack),
    );
    request(sheet);
  }

  store.watch((state) => [state.view, state.pending, state.segmentDrafts], draw);
}
