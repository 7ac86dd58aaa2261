/** Asks the studio for the pattern whenever the question changes; the newest question wins, each page has its own. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { measured } from "../state/live_plan.js";
import { asked, bodyOf, lengthOf, limbsOf } from "./pattern_problem.js";
import { timelineOf } from "./pattern_gaits.js";
import { patternGridModel } from "./pattern_grid_model.js";
import { runIsOn, shownDocument } from "../state/store.js";
import { attempt } from "../lib/toasts.js";

const REST_MS = 250;
/** So long without news of a search, and the page asks for it: an event may be lost while the line opens anew. */
const SILENCE_MS = 3000;

/** What of a gait's document the search for a gait of some limbs depends on: the gait that it makes is alike in all of it. */
const aboutLimbs = ({ robot, orientation, direction, step, options, timeline }) => ({ robot, orientation, direction, travel: step.slice(0, 2), options, time: timeline.sample_time });

/** Rows of the pattern that is looked at, or null. */
export function shownRows({ answer, running, chosen }) {
  return running?.pattern?.feet ?? answer?.patterns[chosen]?.feet ?? null;
}

/**
 * Keeps the answer current while the panel is open.
 * @param {object} store the page's
 * @param {object} question of `createProblem`
 * @param {() => boolean} isOpen
 * @returns {{ask: () => void, cancel: () => Promise<void>, useNow: () => Promise<void>}}
 */
export function mountSearch(store, question, isOpen) {
  let [newest, ended, since] = [0, 0, 0];
  /** Numbers of the newest question and of the one that is being answered. */
  let [latest, current] = [0, 0];
  /** The best pattern comes first; those after it are asked for once nobody has changed the question for a moment. */
  let [timer, silence, isMore, sent] = [0, 0, false, null];
  /** What was asked last, with the documents that it was about. */
  let submitted = null;

  /** Rows to keep: what is shown now, where it has the length; a gait's own drawing is kept by itself. */
  function drawingFor() {
    const rows = question.state.mode === "drawing" ? null : shownRows(question.state);
    return rows?.[0].length === lengthOf(question.state) ? rows : null;
  }

  function body() {
    const { state } = store;
    const document = shownDocument(state);
    const about = { robot: document.robot, legs: document.timeline.feet.length };
    const shown = patternGridModel(store, question);
    return bodyOf(question.state, {
      isFree: (limb, sample) => !shown || shown.isFree(limb, sample),
      gait: state.selected, limbs: limbsOf(question.state, about), document: state.pending.length ? document : null, drawing: drawingFor() });
  }

  const documents = () => (question.state.mode === "transition" ? [question.state.from.gait, question.state.to.gait] : [store.state.selected])
    .map((gait) => timelineOf(store, question, gait)).map((document) => document && JSON.stringify(question.state.mode === "limbs" ? aboutLimbs(document) : document));

  /** The question without the gait's name where only what the gait is like matters. */
  const submittedBody = (now) => JSON.stringify(question.state.mode === "limbs" ? { ...now, gait: null } : now);

  /** Whether the question that stands is not the one that was asked last; a document that was not at hand is the same. */
  function isNew() {
    const { answer, asking, error } = question.state;
    if (!submitted || error || (!asking && (!answer || answer.status === "cancelled"))) return true;
    return submitted.body !== submittedBody(body()) || documents().some((one, index) => one && submitted.documents[index] && one !== submitted.documents[index]);
  }

  function take({ id, state, progress, result, sentence }) {
    // An event may overtake the answer that its search was begun by.
    if (id < newest || (state === "running" && id === ended)) return;
    newest = id;
    if (state !== "running") ended = id;
    clearTimeout(silence);
    if (state === "running") {
      silence = setTimeout(hear, SILENCE_MS, id);
      if (!isMore) question.set({ running: { id, ...progress }, error: null });
      return;
    }
    const before = question.state.answer;
    if (isMore) {
      if (state === "done" && result.patterns.length && current === latest) question.set({ answer: { id, ...result, seconds: before.seconds } });
      return;
    }
    question.set({ running: null, asking: current !== latest, chosen: 0, error: state === "failed" ? { sentence } : null, answer: state === "failed" ? before : { id, ...result } });
    measured("question to pattern", since);
    if (result?.status === "optimal" && question.state.count > 1 && current === latest) timer = setTimeout(() => offer({ body: { ...sent, count: question.state.count }, more: true, number: latest }), REST_MS);
  }

  const hear = attempt(async (id) => { if (id === newest && id !== ended) take(await api.pattern(id)); });

  const offer = latestOnly(async (what) => {
    isMore = Boolean(what.more);
    if (!isMore) [since, sent] = [what.since, what.body];
    current = what.number;
    clearTimeout(silence);
    try {
      take(await api.patterns(what.body));
    } catch (error) {
      if (isMore) return;
      question.set({ running: null, asking: current !== latest, answer: null, error: { sentence: error.message, where: error.where } });
    }
  });

  function ask() {
    const { view } = store.state;
    const { mode, from, to } = question.state;
    if (!isOpen() || !view || runIsOn(store.state.robot)) return;
    if (mode === "transition" && !(from.gait && to.gait)) return;
    latest += 1;
    clearTimeout(timer);
    question.set({ asking: true });
    const now = body();
    submitted = { body: submittedBody(now), documents: documents() };
    offer({ body: { ...now, count: 1 }, since: performance.now(), number: latest });
  }

  /** Another gait was opened, or a gait was edited: what was found and chosen stays where that is another matter. */
  const submitIfNew = () => { if (isOpen() && store.state.view && isNew()) ask(); };

  question.watch(asked, ask);
  question.watch(({ documents: known }) => [known], () => { if (submitted) submitIfNew(); });
  store.watch(({ view, pending }) => [view?.id, view?.revision, pending.length], submitIfNew);
  store.watch(({ pattern }) => [pattern], ({ pattern }) => { if (pattern) take(pattern); });

  const tell = (act) => attempt(async () => { if (question.state.running) await act(question.state.running.id); });
  return { ask: submitIfNew, cancel: tell(api.cancelPattern), useNow: tell(api.usePattern) };
}
