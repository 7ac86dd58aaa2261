/**
 * Edits of the gait: applied on screen at once, sent one after the other, each a named undo entry on the server.
 *
 * An edit is a function from document to document, so that it can be put on top of what another tab did meanwhile.
 * It has a number, by which a state of the studio says that it is in it: one that is shown or sent again is made once.
 * A drawing that the server refuses stays on screen, marked, and goes along with the next edit. Where the server does not
 * answer, edits wait until it does.
 * Every act is of the gait that was shown when it was done: it reaches that one, also where another is shown by then.
 */

import { editNumber } from "../api/author.js";
import { CONFLICT, api } from "../api/gaits.js";
import { undoSegmentDraft } from "./segment_draft.js";
import { whyNotDrawn } from "../document/drawable.js";
import { acceptView, shownDocument } from "./store.js";
import { report, toast } from "../lib/toasts.js";

/** Refusals after which a drawing stays: of the document, by another state, by the database, by a full disk. */
const STAYS = [422, CONFLICT, 503, 507];
const MOST_TRIES = 8;
const NO_ANSWER = 0;
const RETRY_MS = 1000;
const NOT_ANSWERING =
  "The studio does not answer. " + "Your edits stay on this page and are sent when the studio answers.";

/** Sets cells of the timeline; locked cells keep their value. `cells` are [foot, sample], 0-based. */
export function paintCells(document, cells, swing) {
  const rows = document.timeline.feet.map((row) => [...row]);
  for (const [foot, sample] of cells) {
    if (rows[foot]?.[sample] !== undefined && document.timeline.locked?.[foot]?.[sample] !== "1")
      rows[foot][sample] = swing ? "0" : "1";
  }
  return { ...document, timeline: { ...document.timeline, feet: rows.map((row) => row.join("")) } };
}

/** Name of the undo entry for painted cells: "Foot 3, samples 8–12 to swing". */
function paintLabel(cells, swing) {
  const value = swing ? "swing" : "stance";
  const feet = [...new Set(cells.map(([foot]) => foot + 1))].sort((a, b) => a - b);
  const samples = cells.map(([, sample]) => sample + 1);
  const [first, last] = [Math.min(...samples), Math.max(...samples)];
  if (feet.length > 1) return `Feet ${feet.join(", ")}: ${cells.length} cells to ${value}`;
  return first === last
    ? `Foot ${feet[0]}, sample ${first} to ${value}`
    : `Foot ${feet[0]}, samples ${first}–${last} to ${value}`;
}

/** Creates the editing functions of the page. */
export function createEdits(store) {
  let sending = null;
  let queue = Promise.resolve();
  let running = 0;
  let retry = 0;

  const isShown = (gait) => store.state.selected === gait;

  async function put(gait, batch, tries = 1) {
    const { view: shown } = store.state;
    const view = shown?.id === gait ? shown : await api.view(gait);
    const document = batch.reduce((result, edit) => edit.apply(result), view.document);
    try {
      return await api.put(gait, document, batch.at(-1), view.revision);
    } catch (error) {
      if (error.status !== CONFLICT || error.where !== "revision" || tries === MOST_TRIES) throw error;
      if (isShown(gait)) acceptView(store, await api.view(gait));
      return put(gait, batch, tries + 1);
    }
  }

  /** Takes edits out of those to be sent; `more` is set where their gait is still shown. */
  function settle(batch, more) {
    const { pending, left } = store.state;
    const others = (edits) => edits.filter((edit) => !batch.includes(edit));
    store.set({ pending: others(pending), left: others(left), ...(isShown(batch[0].gait) ? more : {}) });
  }

  /** Sends edits; false where the studio did not answer. */
  async function sendNext(batch) {
    const { gait, drawing } = batch.at(-1);
    try {
      const view = await put(gait, batch);
      settle(batch, { refused: null, formError: null });
      acceptView(store, view);
    } catch (error) {
      if (error.status === NO_ANSWER) return false;
      const isStanding = batch.every((edit) => store.state.pending.includes(edit));
      if (isStanding && drawing && STAYS.includes(error.status)) keep(batch, error.message);
      else {
        const refusal = { sentence: error.message, where: error.where, batch };
        settle(batch, { formError: drawing ? null : error.message, formRefusal: drawing ? null : refusal });
        if (drawing || !isShown(gait)) report(error);
      }
    }
    return true;
  }

  function keep(batch, sentence) {
    const pending = store.state.pending.map((edit) =>
      batch.includes(edit) ? { ...edit, refused: true } : edit,
    );
    store.set({ pending, refused: sentence });
  }

  /**
   * What is sent next: edits of a gait that was left come first, and refused drawings go along with the next edit.
   * The newest edit's number stands for all of them, so that the same ones are sent again where no answer came.
   */
  function nextBatch() {
    const { pending, left } = store.state;
    if (left.length) return left.slice(0, 1);
    return pending.slice(0, pending.findIndex((edit) => !edit.refused) + 1);
  }

  async function drain() {
    for (let batch = nextBatch(); batch.length; batch = nextBatch()) {
      if (!(await sendNext(batch))) {
        sendLater();
        return;
      }
    }
    retry = 0;
  }

  function sendLater() {
    if (!retry) report(new Error(NOT_ANSWERING));
    clearTimeout(retry);
    retry = setTimeout(flush, RETRY_MS);
  }

  /** Requests that change the gait are sent one at a time, in the order of the actions. */
  function enqueue(act) {
    running += 1;
    const result = queue.then(act).finally(() => {
      running -= 1;
    });
    queue = result.catch(() => {});
    return result;
  }

  function flush() {
    sending ??= enqueue(drain).finally(() => {
      sending = null;
    });
    return sending;
  }

  /** `gait` is the one that the edit is of, where something was waited for since it was the shown one. */
  function edit(apply, label, { drawing = false, gait = store.state.view?.id } = {}) {
    if (!gait) return Promise.resolve();
    const one = { number: editNumber(), gait, apply, label, drawing, refused: false };
    if (!isShown(gait)) store.set({ left: [...store.state.left, one] });
    else if (drawing && whyNotDrawn(store.state.view?.document)) {
      toast(whyNotDrawn(store.state.view.document));
      return Promise.resolve();
    } else store.set({ pending: [...store.state.pending, one], formError: null });
    return flush();
  }

  function dropRefused() {
    store.set({ pending: store.state.pending.filter((one) => !one.refused), refused: null });
  }

  /** Takes back what the studio has not: refused drawings, or the last edit that waits for it. */
  function dropUnsent() {
    const { pending } = store.state;
    if (pending.some(({ refused }) => refused)) dropRefused();
    else store.set({ pending: pending.slice(0, -1) });
  }

  async function passHistory(gait, verb) {
    if (verb === "undo" && isShown(gait) && undoSegmentDraft(store)) return undefined;
    if (verb === "undo" && isShown(gait) && store.state.pending.length) return dropUnsent();
    try {
      acceptView(store, await api.history(gait, verb));
    } catch (error) {
      report(error);
    }
    return undefined;
  }

  async function passRedraw(gait, body) {
    if (isShown(gait)) dropRefused();
    try {
      acceptView(store, await api.redraw(gait, body));
      if (isShown(gait)) store.set({ formError: null });
    } catch (error) {
      if (isShown(gait)) store.set({ formError: error.message });
      else report(error);
    }
  }

  /** Converts the gait into the other kind; what that leaves behind is said. */
  async function passConvert(gait, to, revision) {
    if (isShown(gait)) dropRefused();
    const view = await api.convert(gait, to, revision);
    acceptView(store, view);
    if (isShown(gait) && view.notice) toast(view.notice);
  }

  /** Brings the parts of a sequence to one sample time, in the step of the edits that were refused for it. */
  async function passResample(gait, batch) {
    const view = store.state.view?.id === gait ? store.state.view : await api.view(gait);
    const { sequence } = batch.reduce((result, { apply }) => apply(result), view.document);
    try {
      const resampled = await api.resampleSequence(gait, {
        sequence,
        label: batch.at(-1).label,
        revision: view.revision,
      });
      acceptView(store, resampled);
      if (isShown(gait)) store.set({ formError: null, formRefusal: null });
      toast(resampled.resampled.join(" "));
    } catch (error) {
      report(error);
    }
  }

  async function passRestore(gait, number) {
    if (isShown(gait)) dropRefused();
    acceptView(store, await api.restoreVersion(gait, number));
  }

  /** Resolves once the studio has what was done before, or does not answer. */
  function settled() {
    flush();
    return enqueue(() => undefined);
  }

  /** Acts on the shown gait after its earlier edits are sent. */
  function pass(act, ...values) {
    const { selected } = store.state;
    if (!selected) return Promise.resolve();
    flush();
    return enqueue(() => act(selected, ...values));
  }

  /** Whether the studio has not received everything, which a reload would lose. */
  const areUnsent = () => running + store.state.pending.length + store.state.left.length > 0;

  return {
    edit,
    areUnsent,
    settled,
    dropRefused,
    paint: (cells, swing) =>
      edit((document) => paintCells(document, cells, swing), paintLabel(cells, swing), { drawing: true }),
    redraw: (body) => pass(passRedraw, body),
    convert: (to, revision = null) => pass(passConvert, to, revision),
    resample: (batch) => pass(passResample, batch),
    restoreVersion: (number) => pass(passRestore, number),
    undo: () => pass(passHistory, "undo"),
    redo: () => pass(passHistory, "redo"),
    save: () => pass(passHistory, "save"),
    shown: () => shownDocument(store.state),
  };
}
