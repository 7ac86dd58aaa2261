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
/** After this time without news of a search the page polls it: a reconnecting socket loses events. */
const SILENCE_MS = 3000;
const GONE = "The studio was started again before this search had ended. Change a value to search again.";

/** What the search for a gait of some limbs depends on: the gait that it makes is alike in all of it. */
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

/** The problem as it is sent, and whether it differs from the one that was kept last. */
function submission(store, problem) {
  /** The problem kept last, with its documents. */
  let kept = null;

  /** The shown rows as a hint, if they have the right length. The server keeps a gait's own drawing. */
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

  function documents() {
    const { mode, from, to } = problem.state;
    return (mode === "transition" ? [from.gait, to.gait] : [store.state.selected])
      .map((gait) => timelineOf(store, problem, gait))
      .map((document) => document && JSON.stringify(mode === "limbs" ? aboutLimbs(document) : document));
  }

  /** The problem without the gait's name where only the gait's properties matter. */
  const textOf = (now) => JSON.stringify(problem.state.mode === "limbs" ? { ...now, gait: null } : now);

  return {
    body,
    keep(now) {
      kept = { text: textOf(now), documents: documents() };
    },
    isKept: () => kept !== null,
    /** A document that is not loaded counts as the same. */
    isNew() {
      const { result, waiting, error } = problem.state;
      if (!kept || error || (!waiting && (!result || result.status === "cancelled"))) return true;
      return (
        kept.text !== textOf(body())
        || documents().some((one, index) => one && kept.documents[index] && one !== kept.documents[index])
      );
    },
  };
}

/** Asks the server for one search after another; `take` gets the messages of the newest one until it ends. */
function searchLine(take) {
  /** Number of the newest search (null until the studio has given it), and of the search that ended last. */
  let [asked, ended] = [0, 0];
  /** Events that arrived before the newest search had its number. They may belong to an older search. */
  let early = [];
  let silence = 0;

  function hear(message) {
    if (asked === null) {
      early.push(message);
      return;
    }
    if (message.id !== asked || message.id === ended) return;
    clearTimeout(silence);
    if (message.state === "running") silence = setTimeout(poll, SILENCE_MS, message.id);
    else ended = message.id;
    take(message);
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

  async function ask(body) {
    clearTimeout(silence);
    [asked, early] = [null, []];
    try {
      const answer = await api.patterns(body);
      asked = answer.id;
      [answer, ...early].forEach(hear);
    } catch (error) {
      asked = 0;
      throw error;
    }
  }
  return { hear, ask };
}

/** Searches for the newest problem only, and puts what is found into the problem's state. */
function newestSearch(problem) {
  /** Numbers of the newest problem and of the one that the server searches. */
  let [latest, current] = [0, 0];
  /** The best pattern comes first. The others are requested once the problem has not changed for a moment. */
  let [timer, isMore, sent, since] = [0, false, null, 0];

  const line = searchLine((message) => {
    if (isMore) takeMore(message);
    else if (message.state === "running")
      problem.set({ running: { id: message.id, ...message.progress }, error: null });
    else takeBest(message);
  });

  function takeMore({ id, state, result }) {
    if (state === "done" && result.patterns.length && current === latest)
      problem.set({ result: { id, ...result, seconds: problem.state.result.seconds } });
  }

  function takeBest({ id, state, result, sentence }) {
    const hasFailed = state === "failed";
    problem.set({
      running: null,
      waiting: current !== latest,
      chosen: 0,
      error: hasFailed ? { sentence } : null,
      result: hasFailed ? problem.state.result : { id, ...result },
    });
    measured("question to pattern", since);
    const { count } = problem.state;
    if (result?.status === "optimal" && count > 1 && current === latest)
      timer = setTimeout(
        () => offer({ body: { ...sent, count: problem.state.count }, more: true, number: latest }),
        REST_MS,
      );
  }

  const offer = latestOnly(async (what) => {
    isMore = Boolean(what.more);
    if (!isMore) [since, sent] = [what.since, what.body];
    current = what.number;
    try {
      await line.ask(what.body);
    } catch (error) {
      if (isMore) return;
      problem.set({
        running: null,
        waiting: current !== latest,
        result: null,
        error: { sentence: error.message, where: error.where },
      });
    }
  });

  return {
    hear: line.hear,
    /** Ends the waiting of the problem before. */
    begin() {
      latest += 1;
      clearTimeout(timer);
    },
    search: (body) => offer({ body: { ...body, count: 1 }, since: performance.now(), number: latest }),
  };
}

/**
 * Keeps the result current while the panel is open.
 * @param {import("../state/store.js").Store} store the page's
 * @param {Record<string, any>} problem of `createProblem`
 * @param {() => boolean} isOpen
 * @returns {{submit: () => void, cancel: () => Promise<void>, useNow: () => Promise<void>}}
 */
export function mountSearch(store, problem, isOpen) {
  const submitted = submission(store, problem);
  const searching = newestSearch(problem);

  function submit() {
    const { view } = store.state;
    const { mode, from, to } = problem.state;
    if (!isOpen() || !view || runIsOn(store.state.robot)) return;
    if (mode === "transition" && [from, to].some(({ gait, sample }) => !gait || sample === null)) return;
    searching.begin();
    problem.set({ waiting: true });
    const body = submitted.body();
    submitted.keep(body);
    searching.search(body);
  }

  /** Submits after another gait was opened or edited, unless the problem is the same. */
  const submitIfNew = () => {
    if (isOpen() && store.state.view && submitted.isNew()) submit();
  };

  problem.watch(problemParts, submit);
  problem.watch(
    ({ documents: known }) => [known],
    () => {
      if (submitted.isKept()) submitIfNew();
    },
  );
  store.watch(({ view, pending }) => [view?.id, view?.revision, pending.length], submitIfNew);
  store.watch(
    ({ pattern }) => [pattern],
    ({ pattern }) => {
      if (pattern) searching.hear(pattern);
    },
  );

  const onRunning = (act) =>
    attempt(async () => {
      if (problem.state.running) await act(problem.state.running.id);
    });
  return { submit: submitIfNew, cancel: onRunning(api.cancelPattern), useNow: onRunning(api.usePattern) };
}
