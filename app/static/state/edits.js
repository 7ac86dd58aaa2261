/**
 * Edits of the gait: applied on screen at once, sent one after the other, each a named undo entry.
 *
 * An edit is a function from document to document, so that it can be put on top of what another tab did
 * meanwhile. Each edit has a number. A view lists the numbers that it contains, so that no edit is shown or
 * made twice. A drawing that the server refuses stays on screen, marked, and goes along with the next
 * edit. Where the server does not answer, edits wait until it does.
 * Every act is of the gait that was shown when it was done, and reaches that one.
 */

import { editNumber } from "../api/author.js";
import { CONFLICT, api } from "../api/gaits.js";
import { undoSegmentDraft } from "./segment_draft.js";
import { whyNotDrawn } from "../document/drawable.js";
import { acceptView, editsMissingIn, shownDocument } from "./store.js";
import { report, toast } from "../lib/toasts.js";

/**
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 * @typedef {(document: GaitDocument) => GaitDocument} Apply
 * @typedef {{number: string, gait: string, apply: Apply, label: string, drawing: boolean,
 *   refused: boolean}} Edit
 * @typedef {ReturnType<typeof createEdits>} Edits
 */

/** Refusals after which a drawing stays: of the document, by another state, the database or a full disk. */
const STAYS = [422, CONFLICT, 503, 507];
const MOST_TRIES = 8;
const NO_ANSWER = 0;
const RETRY_MS = 1000;
const NOT_ANSWERING =
  "The studio does not answer. Your edits stay on this page and are sent when the studio answers.";
const PERHAPS_MADE = "The studio may have this edit already. Undo it when the studio answers.";

/** Edits that were sent without an answer. @type {WeakSet<Edit>} */
const unanswered = new WeakSet();

/**
 * Sets cells of the timeline; locked cells keep their value.
 * @param {GaitDocument} document
 * @param {number[][]} cells [foot, sample], 0-based
 * @param {boolean} swing
 */
export function paintCells(document, cells, swing) {
  /** @type {string[][]} */
  const rows = document.timeline.feet.map((/** @type {string} */ row) => [...row]);
  for (const [foot, sample] of cells) {
    if (rows[foot]?.[sample] !== undefined && document.timeline.locked?.[foot]?.[sample] !== "1")
      rows[foot][sample] = swing ? "0" : "1";
  }
  return { ...document, timeline: { ...document.timeline, feet: rows.map((row) => row.join("")) } };
}

/**
 * Name of the undo entry for painted cells: "Foot 3, samples 8–12 to swing".
 * @param {number[][]} cells
 * @param {boolean} swing
 */
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

/** @param {Store} store @param {string} gait */
const isShown = (store, gait) => store.state.selected === gait;

/** @param {Edit[]} batch @param {GaitDocument} document */
const withEdits = (batch, document) => batch.reduce((result, edit) => edit.apply(result), document);

/**
 * Sends edits, again on top of the newest state where another change came first.
 * @param {Store} store
 * @param {Edit[]} batch not empty
 * @returns {Promise<Record<string, any>>} the view
 */
async function put(store, batch, tries = 1) {
  const newest = batch[batch.length - 1];
  const { gait } = newest;
  const { view: shown } = store.state;
  const view = shown?.id === gait ? shown : await api.view(gait);
  try {
    const document = withEdits(editsMissingIn(view, batch), view.document);
    return await api.put(gait, document, newest, view.revision);
  } catch (/** @type {any} */ error) {
    if (error.status !== CONFLICT || error.where !== "revision" || tries === MOST_TRIES) throw error;
    if (isShown(store, gait)) acceptView(store, await api.view(gait));
    return put(store, batch, tries + 1);
  }
}

/**
 * Takes edits out of those to be sent.
 * @param {Store} store
 * @param {Edit[]} batch
 * @param {Partial<import("./store.js").State>} more is set where their gait is still shown
 */
function settle(store, batch, more) {
  const { pending, left } = store.state;
  const others = (/** @type {Edit[]} */ edits) => edits.filter((edit) => !batch.includes(edit));
  store.set({ pending: others(pending), left: others(left), ...(isShown(store, batch[0].gait) ? more : {}) });
}

/** @param {Store} store @param {Edit[]} batch @param {string} sentence */
function keepRefused(store, batch, sentence) {
  const pending = store.state.pending.map((edit) =>
    batch.includes(edit) ? { ...edit, refused: true } : edit,
  );
  store.set({ pending, refused: sentence });
}

/** @param {Store} store @param {Edit[]} batch @param {any} error */
function acceptRefusal(store, batch, error) {
  const { gait, drawing } = batch[batch.length - 1];
  const isStanding = batch.every((edit) => store.state.pending.includes(edit));
  if (isStanding && drawing && STAYS.includes(error.status)) {
    keepRefused(store, batch, error.message);
    return;
  }
  const refusal = { sentence: error.message, where: error.where, batch };
  settle(store, batch, { formError: drawing ? null : error.message, formRefusal: drawing ? null : refusal });
  if (drawing || !isShown(store, gait)) report(error);
}

/**
 * Sends edits; false where the studio did not answer.
 * @param {Store} store
 * @param {Edit[]} batch
 */
async function sendNext(store, batch) {
  try {
    const view = await put(store, batch);
    settle(store, batch, { refused: null, formError: null });
    acceptView(store, view);
  } catch (/** @type {any} */ error) {
    if (error.status === NO_ANSWER) {
      unanswered.add(batch[batch.length - 1]);
      return false;
    }
    acceptRefusal(store, batch, error);
  }
  return true;
}

/**
 * What is sent next: edits of a gait that was left come first, and refused drawings go along with the next
 * edit. A batch is sent under its newest edit's number; without an answer the same batch is sent again.
 * @param {Store} store
 */
function nextBatch({ state: { pending, left } }) {
  if (left.length) return left.slice(0, 1);
  return pending.slice(0, pending.findIndex((edit) => !edit.refused) + 1);
}

/**
 * Requests that change the gait are sent one at a time, in the order of the actions.
 * @param {Store} store
 */
function createSending(store) {
  /** @type {Promise<any>|null} */
  let sending = null;
  /** @type {Promise<any>} */
  let queue = Promise.resolve();
  let running = 0;
  let retry = 0;

  async function drain() {
    for (let batch = nextBatch(store); batch.length; batch = nextBatch(store)) {
      if (!(await sendNext(store, batch))) {
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

  /** @param {() => any} act @returns {Promise<any>} */
  function enqueue(act) {
    running += 1;
    const result = queue.then(act).finally(() => {
      running -= 1;
    });
    queue = result.catch(() => {});
    return result;
  }

  /** Sends the edits that wait. */
  function flush() {
    sending ??= enqueue(drain).finally(() => {
      sending = null;
    });
    return sending;
  }

  return { enqueue, flush, isRunning: () => running > 0 };
}

/** @param {Store} store */
function dropRefused(store) {
  store.set({ pending: store.state.pending.filter((one) => !one.refused), refused: null });
}

/**
 * Takes back what the studio has not: refused drawings, or the last edit that waits for it.
 * @param {Store} store
 */
function dropUnsent(store) {
  const { pending } = store.state;
  const isRefused = pending.some(({ refused }) => refused);
  const sent = pending.findLastIndex((edit) => unanswered.has(edit)) + 1;
  if (sent && (isRefused || sent === pending.length)) report(new Error(PERHAPS_MADE));
  else if (isRefused) dropRefused(store);
  else store.set({ pending: pending.slice(0, -1) });
}

/** @param {Store} store @param {string} gait @param {"undo"|"redo"|"save"} verb */
async function passHistory(store, gait, verb) {
  if (verb === "undo" && isShown(store, gait)) {
    if (undoSegmentDraft(store)) return;
    if (store.state.pending.length) {
      dropUnsent(store);
      return;
    }
  }
  try {
    acceptView(store, await api.history(gait, verb));
  } catch (/** @type {any} */ error) {
    report(error);
  }
}

/** @param {Store} store @param {string} gait @param {Record<string, any>} body */
async function passRedraw(store, gait, body) {
  if (isShown(store, gait)) dropRefused(store);
  try {
    acceptView(store, await api.redraw(gait, body));
    if (isShown(store, gait)) store.set({ formError: null });
  } catch (/** @type {any} */ error) {
    if (isShown(store, gait)) store.set({ formError: error.message });
    else report(error);
  }
}

/**
 * Converts the gait into the other kind; what that leaves behind is said.
 * @param {Store} store
 * @param {string} gait
 * @param {string} to
 * @param {number|null} revision
 */
async function passConvert(store, gait, to, revision) {
  if (isShown(store, gait)) dropRefused(store);
  const view = await api.convert(gait, to, revision);
  acceptView(store, view);
  if (isShown(store, gait) && view.notice) toast(view.notice);
}

/**
 * Brings the parts of a sequence to one sample time, in the step of the edits that were refused for it.
 * @param {Store} store
 * @param {string} gait
 * @param {Edit[]} batch
 */
async function passResample(store, gait, batch) {
  const view = store.state.view?.id === gait ? store.state.view : await api.view(gait);
  const { sequence } = withEdits(batch, view.document);
  const { label } = batch[batch.length - 1];
  try {
    const resampled = await api.resampleSequence(gait, { sequence, label, revision: view.revision });
    acceptView(store, resampled);
    if (isShown(store, gait)) store.set({ formError: null, formRefusal: null });
    toast(resampled.resampled.join(" "));
  } catch (/** @type {any} */ error) {
    report(error);
  }
}

/** @param {Store} store @param {string} gait @param {number} number */
async function passRestore(store, gait, number) {
  if (isShown(store, gait)) dropRefused(store);
  acceptView(store, await api.restoreVersion(gait, number));
}

/**
 * Creates the editing functions of the page.
 * @param {Store} store
 */
export function createEdits(store) {
  const { enqueue, flush, isRunning } = createSending(store);

  /**
   * Makes an edit and sends it.
   * @param {Apply} apply
   * @param {string} label
   * @param {{drawing?: boolean, gait?: string}} [options] `gait` is the one that the edit is of, where
   *   something was waited for since it was the shown one
   * @returns {Promise<any>}
   */
  function edit(apply, label, { drawing = false, gait = store.state.view?.id } = {}) {
    if (!gait) return Promise.resolve();
    const { view, pending, left } = store.state;
    const one = { number: editNumber(), gait, apply, label, drawing, refused: false };
    const whyNot = isShown(store, gait) && drawing ? whyNotDrawn(view?.document) : null;
    if (whyNot) {
      toast(whyNot);
      return Promise.resolve();
    }
    store.set(
      isShown(store, gait) ? { pending: [...pending, one], formError: null } : { left: [...left, one] },
    );
    return flush();
  }

  /**
   * Acts on the shown gait after its earlier edits are sent.
   * @template {any[]} Values
   * @param {(store: Store, gait: string, ...values: Values) => Promise<void>} act
   * @param {Values} values
   * @returns {Promise<any>}
   */
  function pass(act, ...values) {
    const { selected } = store.state;
    if (!selected) return Promise.resolve();
    flush();
    return enqueue(() => act(store, selected, ...values));
  }

  return {
    edit,
    /** Whether the studio has not received everything, which a reload would lose. */
    areUnsent: () => isRunning() || store.state.pending.length + store.state.left.length > 0,
    /** Resolves once the studio has what was done before, or does not answer. */
    settled() {
      flush();
      return enqueue(() => undefined);
    },
    takeBack: () => enqueue(() => dropUnsent(store)),
    /** @param {number[][]} cells @param {boolean} swing */
    paint: (cells, swing) =>
      edit((document) => paintCells(document, cells, swing), paintLabel(cells, swing), { drawing: true }),
    /** @param {Record<string, any>} body */
    redraw: (body) => pass(passRedraw, body),
    /** @param {string} to @param {number|null} [revision] */
    convert: (to, revision = null) => pass(passConvert, to, revision),
    /** @param {Edit[]} batch */
    resample: (batch) => pass(passResample, batch),
    /** @param {number} number */
    restoreVersion: (number) => pass(passRestore, number),
    undo: () => pass(passHistory, "undo"),
    redo: () => pass(passHistory, "redo"),
    save: () => pass(passHistory, "save"),
    shown: () => shownDocument(store.state),
  };
}
