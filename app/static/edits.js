/**
 * Edits of the gait: applied on screen at once, sent one after the other, each a named undo entry on the server.
 *
 * An edit is a function from document to document, so that it can be put on top of what another tab did meanwhile.
 * A drawing that the server refuses stays on screen, marked, and goes along with the next edit.
 */

import { api } from "./api.js";
import { undoDraft } from "./sheet_draft.js";
import { FOLLOWS, isSequence } from "./sequence_edits.js";
import { acceptView, shownDocument } from "./store.js";
import { report, toast } from "./toasts.js";

const STALE = 409;
const REFUSED = 422;
const MOST_TRIES = 8;

/** Sets cells of the timeline; locked cells keep their value. `cells` are [foot, sample], 0-based. */
export function paintCells(document, cells, swing) {
  const rows = document.timeline.feet.map((row) => [...row]);
  for (const [foot, sample] of cells) {
    if (rows[foot]?.[sample] !== undefined && document.timeline.locked?.[foot]?.[sample] !== "1") rows[foot][sample] = swing ? "0" : "1";
  }
  return { ...document, timeline: { ...document.timeline, feet: rows.map((row) => row.join("")) } };
}

/** Name of the undo entry for painted cells: "Foot 3, samples 8–12 to swing". */
export function paintLabel(cells, swing) {
  const value = swing ? "swing" : "stance";
  const feet = [...new Set(cells.map(([foot]) => foot + 1))].sort((a, b) => a - b);
  const samples = cells.map(([, sample]) => sample + 1);
  const [first, last] = [Math.min(...samples), Math.max(...samples)];
  if (feet.length > 1) return `Feet ${feet.join(", ")}: ${cells.length} cells to ${value}`;
  return first === last ? `Foot ${feet[0]}, sample ${first} to ${value}` : `Foot ${feet[0]}, samples ${first}–${last} to ${value}`;
}

/** Creates the editing functions of the page. */
export function createEdits(store) {
  let sending = null;
  let turn = Promise.resolve();

  async function put(batch, tries = 1) {
    const { view } = store.state;
    const document = batch.reduce((result, edit) => edit.apply(result), view.document);
    try {
      return await api.put(view.id, document, batch.at(-1).label, view.revision);
    } catch (error) {
      if (error.status !== STALE || error.where !== "revision" || tries === MOST_TRIES) throw error;
      acceptView(store, await api.view(view.id));
      return put(batch, tries + 1);
    }
  }

  async function sendNext(batch) {
    const rest = () => store.state.pending.filter((edit) => !batch.includes(edit));
    try {
      const view = await put(batch);
      store.set({ pending: rest(), refused: null, formError: null });
      acceptView(store, view);
    } catch (error) {
      const drawing = batch.at(-1).drawing && [REFUSED, STALE].includes(error.status);
      if (drawing) keep(batch, error.message);
      else store.set({ pending: rest(), formError: batch.at(-1).drawing ? null : error.message });
      if (!drawing && batch.at(-1).drawing) report(error);
    }
  }

  function keep(batch, sentence) {
    const pending = store.state.pending.map((edit) => (batch.includes(edit) ? { ...edit, refused: true } : edit));
    store.set({ pending, refused: sentence });
  }

  async function drain() {
    for (;;) {
      const { pending } = store.state;
      const next = pending.findIndex((edit) => !edit.refused);
      if (next < 0) return;
      await sendNext(pending.slice(0, next + 1));
    }
  }

  /** Requests that change the gait reach the studio one at a time, in the order of the acts behind them. */
  function inTurn(act) {
    const mine = turn.then(act);
    turn = mine.catch(() => {});
    return mine;
  }

  function flush() {
    sending ??= inTurn(drain).finally(() => { sending = null; });
    return sending;
  }

  function edit(apply, label, { drawing = false } = {}) {
    if (drawing && isSequence(store.state.view?.document)) {
      toast(FOLLOWS);
      return Promise.resolve();
    }
    store.set({ pending: [...store.state.pending, { apply, label, drawing, refused: false }], formError: null });
    return flush();
  }

  function dropRefused() {
    store.set({ pending: store.state.pending.filter((one) => !one.refused), refused: null });
  }

  async function passHistory(verb) {
    if (verb === "undo" && undoDraft(store)) return undefined;
    if (verb === "undo" && store.state.pending.length) return dropRefused();
    const { selected } = store.state;
    if (!selected) return undefined;
    try {
      acceptView(store, await api.history(selected, verb));
    } catch (error) {
      report(error);
    }
    return undefined;
  }

  function history(verb) {
    flush();
    return inTurn(() => passHistory(verb));
  }

  async function passRedraw(body) {
    dropRefused();
    try {
      acceptView(store, await api.redraw(store.state.selected, body));
      store.set({ formError: null });
    } catch (error) {
      store.set({ formError: error.message });
    }
  }

  async function passRestore(number) {
    dropRefused();
    acceptView(store, await api.restoreVersion(store.state.selected, number));
  }

  return {
    edit,
    dropRefused,
    paint: (cells, swing) => edit((document) => paintCells(document, cells, swing), paintLabel(cells, swing), { drawing: true }),
    redraw: (body) => {
      flush();
      return inTurn(() => passRedraw(body));
    },
    restoreVersion: (number) => {
      flush();
      return inTurn(() => passRestore(number));
    },
    undo: () => history("undo"),
    redo: () => history("redo"),
    save: () => history("save"),
    shown: () => shownDocument(store.state),
  };
}
