/**
 * The live plan: while an edit is under way (a finger drags, a number is typed, an edit is on its way to the
 * server) the shown document is solved and its plan shown, until the server's own view takes its place.
 */

import { api } from "../api/gaits.js";
import { painted } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { isTip, simulationOver } from "./simulation.js";
import { hasNoMotion, ownPlan, shownDocument, shownText } from "./store.js";

/**
 * @typedef {import("./store.js").State} State
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 */

const IDLE_MS = 10;
const HELD_MS = 300;
const BROKEN_OFF = "The search for remedies was interrupted. Change the drawing to start a new search.";
const NOTHING = { list: [], searching: false, trying: false, complete: true };

/** Whether the page shows an edit that the server's view does not have yet. @param {State} state */
const editInProgress = ({ view, pending, gesture }) =>
  Boolean(view) && (gesture !== null || pending.length > 0);

/** Replaces the plan of a document that has none. @param {string} sentence */
function refusedPlan(sentence) {
  return {
    hash: null,
    source: "draft",
    note: sentence,
    refusal: { sentence, where: null },
    times: [],
    contact: [],
    body: [],
    feet: [],
    margin: [],
    heading: [],
    balance: null,
    robot_margin: 0,
    strokes_mm: null,
    foot_speeds_mm_s: null,
    motor_speeds_mm_s: null,
    duration: 0,
    live: null,
    seconds: null,
  };
}

/**
 * Resolves in a task of its own: reading a large answer and drawing it would hold up a frame together.
 */
const nextTask = () =>
  new Promise((resume) => {
    setTimeout(resume);
  });

/**
 * Notes how long an edit took until what it leads to was drawn (see the browser's performance timeline).
 * @param {string} name
 * @param {number} since
 */
export async function measured(name, since) {
  await painted();
  performance.measure(name, { start: since, end: performance.now() });
}

/** @param {Store} store */
function mountFollowing(store) {
  /** @type {string|null} */
  let requested = null;
  const offer = latestOnly(async ({ id, document, since }) => {
    let plan;
    try {
      ({ plan } = await api.live(id, { document }));
      await nextTask();
    } catch (/** @type {any} */ error) {
      plan = refusedPlan(error.message);
    }
    if (store.state.selected !== id || !editInProgress(store.state)) return;
    store.set({ live: { id, plan, since } });
    measured("edit to plots", since);
  });

  store.watch(
    ({ view, pending, gesture }) => [view, pending, gesture],
    (state) => {
      if (!editInProgress(state)) {
        requested = null;
        if (state.live) store.set({ live: null });
        return;
      }
      const text = shownText(state);
      if (text === requested) return;
      requested = text;
      offer({ id: state.view.id, document: shownDocument(state), since: performance.now() });
    },
  );
}

/** Whether a drawing makes no problem at all, such as one that ends in the air. @param {State} state */
export const isRefusedDrawing = (state) => {
  const plan = ownPlan(state);
  return hasNoMotion(plan) && plan.live?.status !== "infeasible" && isDrawing(shownDocument(state));
};

/** Whether a motion follows from the drawing alone. @param {any} document */
export const isDrawing = (document) =>
  Boolean(document)
  && !document.segment_table
  && !document.recorded
  && !document.sequence?.length
  && !document.poses;

/**
 * The first thing that physics says against the shown gait; null where it walks, or physics was not asked.
 * @param {State} state
 */
export function fallOf(state) {
  const simulation = simulationOver({ ...state, tryout: null, iterate: null });
  if (!simulation || !isDrawing(shownDocument(state))) return null;
  return simulation.findings.find(isTip) ?? null;
}

/**
 * Looks for what would help a drawing that cannot walk, or a recording that does not fit the robot, once
 * nobody has edited it for a moment. What is
 * found belongs to one document, to the letter: a later edit may lead to the same plan, and what was found
 * before it would take it back.
 * @param {Store} store
 */
function mountRemedies(store) {
  let timer = 0;
  /** @type {AbortController|null} */
  let search = null;
  /** @type {{text: string|null, gesture: any}} */
  let asked = { text: null, gesture: null };
  let since = 0;
  const wanted = (/** @type {State} */ state) =>
    hasNoMotion(ownPlan(state)) || fallOf(state) || ownPlan(state)?.misfit ? shownText(state) : null;

  function end() {
    clearTimeout(timer);
    search?.abort();
    search = null;
  }

  /** @param {string} text */
  async function ask(text) {
    const { view } = store.state;
    const mine = new AbortController();
    search = mine;
    let isFirst = true;
    const told = (/** @type {Record<string, any>} */ found) => {
      if (search !== mine) return;
      store.set({ remedies: { text, ...found } });
      if (isFirst && found.list.length) {
        isFirst = false;
        measured("edit to remedy", since);
      }
    };
    try {
      const document = shownDocument(store.state);
      await api.remedies(
        view.id,
        { document, tips: Boolean(fallOf(store.state)) },
        mine.signal,
        (/** @type {Record<string, any>} */ { remedies: list, ...rest }) => told({ ...rest, list }),
      );
      const { remedies } = store.state;
      if (search === mine && (!remedies || remedies.searching || remedies.trying))
        told({ ...NOTHING, ...remedies, searching: false, trying: false, sentence: BROKEN_OFF });
    } catch (/** @type {any} */ error) {
      told({ ...NOTHING, sentence: error.message });
    }
  }

  store.watch(
    (state) => [shownText(state)],
    () => {
      since = performance.now();
    },
  );
  store.watch(
    (state) => [state.view, state.pending, state.gesture, ownPlan(state), fallOf(state)],
    (state) => {
      const text = wanted(state);
      // A search that has begun goes on while the drawing is the same; one that waits for a finger to rest
      // may
      // begin sooner.
      if (text !== null && text === asked.text && (search || state.gesture === asked.gesture)) return;
      asked = { text, gesture: state.gesture };
      end();
      if (state.remedies && state.remedies.text !== text) store.set({ remedies: null });
      // While a finger is down the next edit is near, and a search would be in its way.
      if (text !== null && state.remedies?.text !== text)
        timer = setTimeout(() => ask(text), state.gesture ? HELD_MS : IDLE_MS);
    },
  );
}

/** Keeps the live plan and the remedies of the store current. @param {Store} store */
export function mountLivePlan(store) {
  mountFollowing(store);
  mountRemedies(store);
}
