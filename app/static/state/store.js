/**
 * The page's only state: one frozen object, replaced as a whole, watched by selection.
 *
 * Everything that several tabs must agree on comes from the server; the rest (`selected`, `shownJob`,
 * `pending`, `left` (edits of gaits that were left before they were sent), `gesture`, `tool`, `selection`,
 * `preview`, `zoom`, `live`, `tryout`, `worked`, `remedies`, `iterate`, `formRefusal` (the edit behind
 * `formError`), `segmentDrafts`, `runRange`, `jog`, `simulation`, `tracks`, `trialWanted`,
 * `simulateWanted` (a gait), `fastestWanted`, `atlasWanted`, `physicsSets`) belongs to this tab alone.
 */

/**
 * @typedef {import("./edits.js").Edit} Edit
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 */

const INITIAL = Object.freeze({
  connected: false,
  greeted: false,
  version: "",
  start: "",
  gaits: Object.freeze([]),
  jobs: Object.freeze([]),
  robot: null,
  storage: null,
  selected: null,
  poseSearch: null,
  view: null,
  pending: Object.freeze([]),
  left: Object.freeze([]),
  gesture: null,
  tool: "paint",
  selection: null,
  preview: null,
  zoom: null,
  live: null,
  tryout: null,
  worked: null,
  remedies: null,
  iterate: null,
  pattern: null,
  refused: null,
  segmentDrafts: Object.freeze({}),
  formError: null,
  formRefusal: null,
  shownJob: null,
  checked: Object.freeze({}),
  runSummary: null,
  run: null,
  trace: null,
  runRange: null,
  simulation: null,
  tracks: Object.freeze([]),
  jog: null,
  motorTest: null,
  cameras: null,
  setups: null,
  trialMade: null,
  trialChanges: Object.freeze({}),
  videoChanged: null,
  publishedChanged: null,
  trialWanted: null,
  simulateWanted: null,
  fastestWanted: null,
  atlasWanted: null,
  physicsSets: 0,
  operator: "",
});

/**
 * The fields that begin with a value; every other one begins as null.
 * @typedef {{connected: boolean, greeted: boolean, version: string, start: string, operator: string,
 *   tool: string, physicsSets: number, gaits: Record<string, any>[], jobs: Record<string, any>[],
 *   tracks: Record<string, any>[], pending: Edit[], left: Edit[], segmentDrafts: Record<string, any>,
 *   checked: Record<string, any>, trialChanges: Record<string, any>}} Begun
 * @typedef {Begun & Record<Exclude<keyof typeof INITIAL, keyof Begun>, any>} State
 */

/**
 * A state that can be watched; `watch` calls back after the current task, once for any number of changes.
 * @template {Record<string, any>} Shape
 * @typedef {object} Watchable
 * @property {Shape} state
 * @property {(patch: Partial<Shape>) => void} set
 * @property {(isOn: boolean) => void} hold shows nothing new until it is let go, unless the robot's state
 *   changes; then the newest
 * @property {(select: (state: Shape) => any[], render: (state: Shape) => void) => () => void} watch renders
 *   at once and after each change of the values that `select` gives; gives what ends it
 */

/** @typedef {Watchable<State>} Store */

/**
 * Creates the page's store.
 * @param {Partial<State>} [initial]
 */
export const createStore = (initial = {}) => /** @type {Store} */ (watchable({ ...INITIAL, ...initial }));

/**
 * Makes a state watchable.
 * @param {Record<string, any>} initial
 * @returns {Watchable<any>}
 */
export function watchable(initial) {
  /** @type {Record<string, any>} */
  let state = Object.freeze({ ...initial });
  let scheduled = false;
  /** @type {Record<string, any>|null} */
  let held = null;
  /** @type {{select: (state: any) => any[], render: (state: any) => void, last: any[]}[]} */
  let watchers = [];

  function flush() {
    // What the robot says is never held back.
    if (held && held.robot === state.robot) return;
    if (held) held = state;
    scheduled = false;
    for (const watcher of watchers) {
      const values = watcher.select(state);
      if (values.every((value, index) => Object.is(value, watcher.last[index]))) continue;
      watcher.last = values;
      watcher.render(state);
    }
  }

  return {
    get state() {
      return state;
    },
    set(patch) {
      state = Object.freeze({ ...state, ...patch });
      if (scheduled && !held) return;
      scheduled = true;
      queueMicrotask(flush);
    },
    hold(isOn) {
      held = isOn ? state : null;
      if (!isOn && scheduled) queueMicrotask(flush);
    },
    watch(select, render) {
      const watcher = { select, render, last: select(state) };
      watchers = [...watchers, watcher];
      render(state);
      return () => {
        watchers = watchers.filter((other) => other !== watcher);
      };
    },
  };
}

/** @type {Record<string, any>} */
const shown = { view: null, pending: null, gesture: null, document: null };

/**
 * The document as the user sees it: the server's, with edits under way and the running gesture on top.
 * @param {Pick<State, "view"|"pending"|"gesture">} state
 * @returns {any} a GaitDocument, or null
 */
export function shownDocument({ view, pending, gesture }) {
  if (!view) return null;
  if (shown.view !== view || shown.pending !== pending || shown.gesture !== gesture) {
    const edits = gesture ? [...pending, gesture] : pending;
    Object.assign(shown, {
      view,
      pending,
      gesture,
      document: edits.reduce((document, edit) => edit.apply(document), view.document),
    });
  }
  return shown.document;
}

/**
 * The document as the timeline draws it: what an operation would make of it, while that is only looked at.
 * @param {State} state
 */
export const previewedDocument = (state) => state.preview ?? shownDocument(state);

/**
 * The shown document as text: states with the same text have the same plan and the same remedies.
 * @param {State} state
 */
export function shownText(state) {
  return state.view ? JSON.stringify([state.view.id, shownDocument(state)]) : null;
}

/**
 * The plan of the gait: what an edit under way leads to, else the server's.
 * @param {{live?: any, view?: any}} state
 */
export const ownPlan = ({ live, view }) => live?.plan ?? view?.plan ?? null;

/**
 * The plan that is looked at: an iteration of the solver, else that of a way out, else the gait's own.
 * @param {{iterate?: any, tryout?: any, live?: any, view?: any}} state
 */
export const shownPlan = (state) => state.iterate?.plan ?? state.tryout ?? ownPlan(state);

/**
 * Whether a plan is that of a drawing that has no motion, so that ways out are looked for.
 * @param {any} plan
 */
export function hasNoMotion(plan) {
  return plan?.live?.status === "infeasible" || Boolean(plan?.refusal && !plan.times.length);
}

/**
 * Why the check that was seen of a gait no longer counts.
 * @param {Record<string, any>} view
 * @param {{revision: number}} seen
 */
export function checkGone(view, { revision }) {
  if (view.revision !== revision) return "the gait changed";
  return view.simulation?.fresh
    ? "the gait was simulated again after the check"
    : "the plan was computed again after the check";
}

/**
 * Edits that a view does not have yet; those before one that it has went along with that.
 * @param {Record<string, any>} view
 * @param {Edit[]} edits
 */
export function editsMissingIn({ edits: made = [] }, edits) {
  const had = edits.findLastIndex(({ number }) => made.includes(number)) + 1;
  return had ? edits.slice(had) : edits;
}

/**
 * Takes over the whole state of a studio. One that was started again counts its answers from 1.
 * @param {Store} store
 * @param {Record<string, any>} hello
 */
export function acceptHello(store, { start, version, gaits, robot, storage, jobs, motor_test: motorTest }) {
  const { start: before, view, robot: shown } = store.state;
  const isAnother = start !== before;
  store.set({
    connected: true,
    greeted: true,
    start,
    view: isAnother && view ? { ...view, stamp: 0 } : view,
    version,
    gaits,
    robot: !isAnother && shown?.stamp > robot.stamp ? shown : robot,
    storage,
    motorTest,
    jobs: jobs.reduce(withJob, []),
  });
}

/**
 * Takes over a view unless it is of another gait or older than what is shown.
 * @param {Store} store
 * @param {Record<string, any>} view
 */
export function acceptView(store, view) {
  const { selected, view: current, checked, refused, pending } = store.state;
  if (view.id !== selected) return;
  if (current && current.id === view.id && view.stamp < current.stamp) return;
  const seen =
    view.verdict || view.approval
      ? { word: view.approval ? "approved" : (checked[view.id]?.word ?? "checked"), revision: view.revision }
      : checked[view.id];
  const missing = editsMissingIn(view, pending);
  store.set({
    view,
    pending: missing,
    refused: missing.some((edit) => edit.refused) ? refused : null,
    checked: seen ? { ...checked, [view.id]: seen } : checked,
  });
}

/**
 * Takes over a state of the robot unless it is older than what is shown: an answer may come after an event.
 * @param {Store} store
 * @param {Record<string, any>} robot
 */
export function acceptRobot(store, robot) {
  if (robot.stamp >= (store.state.robot?.stamp ?? 0)) store.set({ robot });
}

/**
 * Takes a changed gait's line over into the list.
 * @param {Store} store
 * @param {Record<string, any>} view
 */
export function acceptLine(store, view) {
  const { gaits } = store.state;
  const old = gaits.find(({ id }) => id === view.id);
  if (!old) return;
  const line = Object.fromEntries(Object.keys(old).map((key) => [key, view[key]]));
  if (JSON.stringify(line) !== JSON.stringify(old))
    store.set({ gaits: gaits.map((one) => (one === old ? line : one)) });
}

/**
 * Takes over what can be undone now, where it is of the shown state: other tabs come and go.
 * @param {Store} store
 * @param {Record<string, any>} message
 */
export function acceptSteps(store, { id, revision, undo, redo, steps }) {
  const { view } = store.state;
  if (view?.id === id && view.revision === revision) store.set({ view: { ...view, undo, redo, steps } });
}

/**
 * Takes over how the shown sequence's parts stand to the gaits that they were copied from.
 * @param {Store} store
 * @param {Record<string, any>} message
 */
export function acceptSources(store, { id, revision, sources }) {
  const { view } = store.state;
  if (view?.id === id && view.revision === revision) store.set({ view: { ...view, sources } });
}

/**
 * Replaces one job in the list, newest first.
 * @param {Record<string, any>[]} jobs
 * @param {Record<string, any>} job
 */
export function withJob(jobs, job) {
  const others = jobs.filter(({ id }) => id !== job.id);
  return [...others, job].sort((a, b) => b.number - a.number);
}

/** True while the robot carries out a run or may still move. @param {any} robot */
export function runIsOn(robot) {
  if (!robot) return false;
  return (
    ["moving", "pausing", "paused", "stopping"].includes(robot.robot)
    || Boolean(robot.run && robot.run.phase !== "ended")
  );
}

/** True while an approved plan is carried out; not while the robot is jogged or reset. @param {any} robot */
export const planIsOn = (robot) => Boolean(robot?.run && robot.run.phase !== "ended");

/**
 * The longest time of a stop, s: of the run that is on, else of the one that would be sent, else of the last.
 * @param {Pick<State, "robot"|"runSummary">} state
 */
export function stopLimit({ robot, runSummary }) {
  return runIsOn(robot) ? robot.stop_seconds : (runSummary?.stop_seconds ?? robot?.stop_seconds);
}
