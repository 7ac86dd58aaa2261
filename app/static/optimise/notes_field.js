/** The notes of the gait: kept as an edit when the field is left; a refused text stays, with the reason. */

import { h } from "../lib/dom.js";
import { historyAction } from "../state/fields.js";
import { refusalOf } from "../lib/field_error.js";

const MOST = 20_000;
const MEANWHILE =
  "The notes were changed in another window while you were typing. "
  + "To keep your text, leave the field. "
  + "To use the text from the other window, press Escape.";

function refusedNotes(text) {
  const { length } = [...text];
  return length > MOST
    ? `The notes have ${length} characters, but at most ${MOST} are possible. `
        + `Shorten the notes, or press Escape to restore the old notes.`
    : null;
}

/** The text of the field and of the document: `write` shows one, `isTyped` returns whether they differ. */
function shownText(area, refusal) {
  // A text area changes line ends, so compare with what it reads back.
  let written = "";
  return {
    isTyped: () => area.value !== written,
    take() {
      written = area.value;
    },
    write(text) {
      if (area.value !== text) area.value = text;
      written = area.value;
      refusal.setError(null);
    },
  };
}

/** The keys of the field: the page's undo while nothing is typed, Escape, and Save with what stands here. */
function mountNoteKeys(area, edits, { text, keep, giveUp }) {
  area.addEventListener("keydown", (event) => {
    const act = text.isTyped() ? null : historyAction(event, edits);
    if (act) {
      event.preventDefault();
      act();
    } else if (event.key === "Escape" && text.isTyped()) giveUp();
    else if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") keep();
  });
}

/**
 * Builds the field.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @returns {{element: HTMLElement, show: (document: Record<string, any>) => void}}
 */
export function notesField(store, edits) {
  const area = h("textarea", {
    "aria-label": "Notes",
    rows: "2",
    placeholder: "What the gait is for, what you observed",
  });
  const refusal = refusalOf(area);
  const element = h(
    "label",
    {
      class: "field notes-field",
      title: "Your own text about this gait. The notes do not change the motion",
    },
    h("span", { class: "name", text: "Notes" }),
    area,
    refusal.element,
  );
  const text = shownText(area, refusal);
  let known = "";

  function show({ notes }) {
    if (notes === known) return;
    known = notes;
    if (text.isTyped()) refusal.setError(MEANWHILE);
    else text.write(notes);
  }

  function giveUp() {
    known = edits.shown()?.notes ?? "";
    text.write(known);
  }

  /** Shows again what the studio refused, with its reason. */
  function bringBack(shown, notes, reason) {
    show(shown);
    if (!text.isTyped()) area.value = notes;
    refusal.setError(reason);
    store.set({ formError: null });
  }

  async function keep() {
    if (!text.isTyped()) return text.write(known);
    const { selected } = store.state;
    const notes = area.value;
    refusal.setError(refusedNotes(notes));
    if (refusal.hasError() || !edits.shown()) return undefined;
    known = notes;
    text.take();
    await edits.edit((document) => ({ ...document, notes }), "Notes");
    const { formError, selected: now } = store.state;
    const shown = edits.shown();
    if (formError && now === selected && shown && shown.notes !== notes) bringBack(shown, notes, formError);
    return undefined;
  }

  for (const type of ["change", "blur"]) area.addEventListener(type, keep);
  // Runs before the page asks whether it may be left, so that the typed notes count as an edit.
  window.addEventListener("beforeunload", keep, { capture: true });
  mountNoteKeys(area, edits, { text, keep, giveUp });
  store.watch(({ selected }) => [selected], giveUp);
  return { element, show };
}
