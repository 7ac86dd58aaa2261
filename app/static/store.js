/**
 * The page's only state: one frozen object, replaced as a whole, watched by selection.
 *
 * Everything that several tabs must agree on comes from the server; the rest (`selected`, `shownJob`, `pending`,
 * `gesture`) belongs to this tab alone.
 */

const INITIAL = Object.freeze({
  connected: false,
  greeted: false,
  version: "",
  gaits: Object.freeze([]),
  jobs: Object.freeze([]),
  robot: null,
  selected: null,
  view: null,
  pending: Object.freeze([]),
  gesture: null,
  refused: null,
  formError: null,
  shownJob: null,
  checked: Object.freeze({}),
  runSummary: null,
  operator: "",
});

/** Creates the store; `watch` calls back after the current task, once for any number of changes. */
export function createStore(initial = {}) {
  let state = Object.freeze({ ...INITIAL, ...initial });
  let scheduled = false;
  const watchers = [];

  function flush() {
    scheduled = false;
    for (const watcher of watchers) {
      const values = watcher.select(state);
      if (values.every((value, index) => Object.is(value, watcher.last[index]))) continue;
      watcher.last = values;
      watcher.render(state);
    }
  }

  return {
    get state() { return state; },
    set(patch) {
      state = Object.freeze({ ...state, ...patch });
      if (scheduled) return;
      scheduled = true;
      queueMicrotask(flush);
    },
    /** `select` returns the list of values that `render` depends on; renders at once and after each change. */
    watch(select, render) {
      watchers.push({ select, render, last: select(state) });
      render(state);
    },
  };
}

/** The document as the user sees it: the server's, with edits under way and the running gesture on top. */
export function shownDocument({ view, pending, gesture }) {
  if (!view) return null;
  const edits = gesture ? [...pending, gesture] : pending;
  return edits.reduce((document, edit) => edit.apply(document), view.document);
}

/** Takes over a view unless it is of another gait or older than what is shown. */
export function acceptView(store, view) {
  const { selected, view: current, checked } = store.state;
  if (view.id !== selected) return;
  if (current && current.id === view.id && view.stamp < current.stamp) return;
  const seen = view.approval ? "approved" : view.verdict ? (checked[view.id] ?? "checked") : checked[view.id];
  store.set({ view, checked: seen ? { ...checked, [view.id]: seen } : checked });
}

/** Replaces one job in the list, newest first. */
export function withJob(jobs, job) {
  const others = jobs.filter(({ id }) => id !== job.id);
  return [...others, job].sort((a, b) => b.created - a.created || String(b.id).localeCompare(String(a.id)));
}

/** True while the robot carries out a run or may still move. */
export function runIsOn(robot) {
  if (!robot) return false;
  return ["moving", "pausing", "paused", "stopping"].includes(robot.robot) || Boolean(robot.run && robot.run.phase !== "ended");
}
