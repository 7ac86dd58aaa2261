/**
 * The live plan: while an edit is under way (a finger drags, a number is typed, an edit is on its way to the server)
 * the shown document is solved and its plan shown, until the server's own view takes its place.
 */

import { api } from "../api/gaits.js";
import { painted } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { hasNoMotion, ownPlan, shownDocument, shownText } from "./store.js";

const IDLE_MS = 150;
const HELD_MS = 600;
const MOST_TRIES = 3;

/** Whether the page shows an edit that the server's view does not have yet. */
const editInProgress = ({ view, pending, gesture }) => Boolean(view) && (gesture !== null || pending.length > 0);

/** Replaces the plan of a document that has none. */
function refusedPlan(sentence) {
  return {
    hash: null, source: "draft", note: sentence, refusal: { sentence, where: null }, times: [], contact: [], body: [], feet: [],
    margin: [], heading: [], balance: null, strokes_mm: null, foot_speeds_mm_s: null, motor_speeds_mm_s: null, duration: 0, live: null, seconds: null,
  };
}

/** Resolves in a task of its own, so that reading a large answer and drawing it do not hold up a frame together. */
const nextTask = () => new Promise((resume) => { setTimeout(resume); });

/** Notes how long an edit took until what it leads to was drawn (see the browser's performance timeline). */
export async function measured(name, since) {
  await painted();
  performance.measure(name, { start: since, end: performance.now() });
}

function mountFollowing(store) {
  let requested = null;
  const offer = latestOnly(async ({ id, document, since }) => {
    let plan;
    try {
      ({ plan } = await api.live(id, { document }));
      await nextTask();
    } catch (error) {
      plan = refusedPlan(error.message);
    }
    if (store.state.selected !== id || !editInProgress(store.state)) return;
    store.set({ live: { id, plan, since } });
    measured("edit to plots", since);
  });

  store.watch(({ view, pending, gesture }) => [view, pending, gesture], (state) => {
    if (!editInProgress(state)) {
      requested = null;
      if (state.live) store.set({ live: null });
      return;
    }
    const text = shownText(state);
    if (text === requested) return;
    requested = text;
    offer({ id: state.view.id, document: shownDocument(state), since: performance.now() });
  });
}

/**
 * Looks for ways out of an infeasible gait once nobody has edited it for a moment. They belong to one document, to the
 * letter: a later edit may lead to the same plan, and what was found before it would take it back.
 */
function mountRemedies(store) {
  let timer = 0;
  const isInfeasible = (state) => hasNoMotion(ownPlan(state));

  const ask = (text, tries) => {
    // While a finger is down the next edit is near, and a search would be in its way.
    const wait = (store.state.gesture ? HELD_MS : IDLE_MS) * 2 ** tries;
    timer = setTimeout(() => offer({ id: store.state.view.id, document: shownDocument(store.state), text, tries }), wait);
  };
  const offer = latestOnly(async ({ id, document, text, tries }) => {
    let found;
    try {
      const { remedies, remedies_complete: complete } = await api.live(id, { document, remedies: true });
      found = { text, list: remedies, complete };
    } catch (error) {
      found = { text, list: [], complete: true, sentence: error.message };
    }
    if (shownText(store.state) !== text || !isInfeasible(store.state)) return;
    store.set({ remedies: found });
    if (!found.complete && tries < MOST_TRIES) ask(text, tries + 1);
  });

  store.watch((state) => [state.view, state.pending, state.gesture, ownPlan(state)], (state) => {
    clearTimeout(timer);
    const text = isInfeasible(state) ? shownText(state) : null;
    if (state.remedies && state.remedies.text !== text) store.set({ remedies: null });
    if (text !== null && state.remedies?.text !== text) ask(text, 0);
  });
}

/** Keeps the live plan and the remedies of the store current. */
export function mountLivePlan(store) {
  mountFollowing(store);
  mountRemedies(store);
}
