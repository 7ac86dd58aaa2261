/** Submits the problem to the server whenever it changes, and takes the result of the newest search. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { measured } from "../state/live_plan.js";
import { problemParts, bodyOf, lengthOf, limbsOf } from "./pattern_problem.js";
import { timelineOf } from "./pattern_gaits.js";
import { patternGridModel } from "./pattern_grid_model.js";
import { runIsOn, shownDocument } from "../state/store.js";
import { attempt } from "../lib/toasts.js";

const REST_MS = 250;
/** After this time without news of a search the page polls it: an event is lost while the socket reconnects. */
const SILENCE_MS = 3000;
const GONE = "The studio was started again before this search had ended. Change a value to search again.";

/** What of a gait's document the search for a gait of some limbs depends on: the gait that it makes is alike in all of it. */
const aboutLimbs = ({ robot, orientation, direction, step, options, timeline }) => ({
  robot,
  orientation,
  direction,
  travel: step.slice(0, 2),
  options,
  time: timeline.sample_time,
});

/** Rows of the pattern that is looked at, or null. */
export function shownRows({ result, running, chosen }) {
  return running?.pattern?.feet ?? result?.patterns[chosen]?.feet ?? null;
}

/**
 * Keeps the result current while the panel is open.
 * @param {import("../state/store.js").Store} store the page's
 * @param {Record<string, any>} problem of `createProblem`
 * @param {() => boolean} isOpen
 * @returns {{submit: () => void, cancel: () => Promise<void>, useNow: () => Promise<void>}}
 */
export function mountSearch(store, problem, isOpen) {
  /**
   * Number of the newest search (null until the studio has given it), number of the search that ended last,
   * and when the newest search began.
   */
  let [asked, ended, since] = [0, 0, 0];
  /** Events that arrived before the newest search had its number. They may belong to an older search. */
  let early = [];
  /** Numbers of the newest problem and of the one that the server searches. */
  let [latest, current] = [0, 0];
  /** The best pattern comes first. The others are requested once the problem has not changed for a moment. */
  let [timer, silence, isMore, sent] = [0, 0, false, null];
  /** The problem submitted last, with its documents. */
  let submitted = null;

  /** The shown rows as a hint, if they have the right length. The server keeps a gait's own drawing by itself. */
  function drawingFor() {
    const rows = problem.state.mode === "drawing" ? null : shownRows(problem.state);
    return rows?.[0].length === lengthOf(problem.state) ? rows : null;
  }

  function body() {
    const { state } = store;
    const document = shownDocument(state);
    const about = { robot: document.robot, legs: document.timeline.feet.length };
    const shown = patternGridModel(store, problem);
    return bodyOf(problem.state, {
      isFree: (limb, sample) => !shown || shown.isFree(limb, sample),
      gait: state.selected,
      limbs: limbsOf(problem.state, about),
      document: state.pending.length ? document : null,
      drawing: drawingFor(),
    });
  }

  const documents = () =>
    (problem.state.mode === "transition"
      ? [problem.state.from.gait, problem.state.to.gait]
      : [store.state.selected]
    )
      .map((gait) => timelineOf(store, problem, gait))
      .map(
        (document) =>
          document && JSON.stringify(problem.state.mode === "limbs" ? aboutLimbs(document) : document),
      );

  /** The problem without the gait's name where only the gait's properties matter. */
  const submittedBody = (now) =>
    JSON.stringify(problem.state.mode === "limbs" ? { ...now, gait: null } : now);

  /** Whether the problem differs from the one submitted last. A document that is not loaded counts as the same. */
  function isNew() {
    const { result, waiting, error } = problem.state;
    if (!submitted || error || (!waiting && (!result || result.status === "cancelled"))) return true;
    return (
      submitted.body !== submittedBody(body())
      || documents().some(
        (one, index) => one && submitted.documents[index] && one !== submitted.documents[index],
      )
    );
  }

  function hear(message) {
    if (asked === null) early.push(message);
    else if (message.id === asked && message.id !== ended) accept(message);
  }

  function accept({ id, state, progress, result, sentence }) {
    if (state !== "running") ended = id;
    clearTimeout(silence);
    if (state === "running") {
      silence = setTimeout(poll, SILENCE_MS, id);
      if (!isMore) problem.set({ running: { id, ...progress }, error: null });
      return;
    }
    const before = problem.state.result;
    if (isMore) {
      if (state === "done" && result.patterns.length && current === latest)
        problem.set({ result: { id, ...result, seconds: before.seconds } });
      return;
    }
    problem.set({
      running: null,
      waiting: current !== latest,
      chosen: 0,
      error: state === "failed" ? { sentence } : null,
      result: state === "failed" ? before : { id, ...result },
    });
    measured("question to pattern", since);
    if (result?.status === "optimal" && problem.state.count > 1 && current === latest)
      timer = setTimeout(
        () => offer({ body: { ...sent, count: problem.state.count }, more: true, number: latest }),
        REST_MS,
      );
  }

  async function poll(id) {
    if (id !== asked || id === ended) return;
    try {
      hear(await api.pattern(id));
    } catch (error) {
      if (error.status === 404) hear({ id, state: "failed", sentence: GONE });
      else silence = setTimeout(poll, SILENCE_MS, id);
    }
  }

  const offer = latestOnly(async (what) => {
    isMore = Boolean(what.more);
    if (!isMore) [since, sent] = [what.since, what.body];
    current = what.number;
    clearTimeout(silence);
    [asked, early] = [null, []];
    try {
      const answer = await api.patterns(what.body);
      asked = answer.id;
      [answer, ...early].forEach(hear);
    } catch (error) {
      asked = 0;
      if (isMore) return;
      problem.set({
        running: null,
        waiting: current !== latest,
        result: null,
        error: { sentence: error.message, where: error.where },
      });
    }
  });

  function submit() {
    const { view } = store.state;
    const { mode, from, to } = problem.state;
    if (!isOpen() || !view || runIsOn(store.state.robot)) return;
    if (mode === "transition" && [from, to].some(({ gait, sample }) => !gait || sample === null)) return;
    latest += 1;
    clearTimeout(timer);
    problem.set({ waiting: true });
    const now = body();
    submitted = { body: submittedBody(now), documents: documents() };
    offer({ body: { ...now, count: 1 }, since: performance.now(), number: latest });
  }

  /** Submits after another gait was opened or edited, unless the problem is the same. */
  const submitIfNew = () => {
    if (isOpen() && store.state.view && isNew()) submit();
  };

  problem.watch(problemParts, submit);
  problem.watch(
    ({ documents: known }) => [known],
    () => {
      if (submitted) submitIfNew();
    },
  );
  store.watch(({ view, pending }) => [view?.id, view?.revision, pending.length], submitIfNew);
  store.watch(
    ({ pattern }) => [pattern],
    ({ pattern }) => {
      if (pattern) hear(pattern);
    },
  );

  const onRunning = (act) =>
    attempt(async () => {
      if (problem.state.running) await act(problem.state.running.id);
    });
  return { submit: submitIfNew, cancel: onRunning(api.cancelPattern), useNow: onRunning(api.usePattern) };
}
