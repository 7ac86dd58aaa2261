/** Learns physics parameters from trials: the data, the running job, earlier results, and the kept sets. */

import { learningApi } from "../api/learning.js";
import { trialApi } from "../api/trials.js";
import { h, setText } from "../lib/dom.js";
import { textOf } from "../lib/file_text.js";
import { clockTime, fixed } from "../lib/format.js";
import { announce, attempt, report, toast } from "../lib/toasts.js";
import { trialChoice } from "./learning_choice.js";
import { learnedResult } from "./learning_result.js";

const POLL_MS = 1000;
/** Longest wait between two polls of a studio that does not answer. */
const MOST_POLL_MS = 30000;
const PURPOSE =
  "Learning finds physics parameters that no data sheet gives, such as friction, backlash "
  + "and centre of mass. "
  + "For this, learning compares simulated walks with walks of the real robot. "
  + "To use the fitted values in simulations, keep them as a set. Then choose the set in Simulate.";
const TABLE_HELP =
  "Table: one CSV file with one row for each trajectory, like trajectory_averages.csv "
  + "(rows TrajAa, TrajAb, …). "
  + "Trajectories: the CSV files of the motions that the robot walked, "
  + "such as walk_a.csv, ambl_b.csv, mtri_c.csv and adjs_d.csv.";
const OPEN = new Set(["running", "cancelling"]);

function addStyles() {
  const href = new URL("./learning.css", import.meta.url).pathname;
  if (!document.querySelector(`link[href="${href}"]`))
    document.head.append(h("link", { rel: "stylesheet", href }));
}

/** A time that is only known roughly. */
const aboutTime = (seconds) =>
  seconds < 90
    ? `${fixed(seconds, 0)} s`
    : seconds < 5400
      ? `${fixed(seconds / 60, 0)} min`
      : `${fixed(seconds / 3600, 1)} h`;

function progressText({ state, done, total, left_seconds: left = null }) {
  if (state !== "running") return "cancelling";
  return `${done} of ${total} simulations${left === null ? "" : `, about ${aboutTime(left)} left`}`;
}

/** The running job: its data, a bar, how many simulations are done, and Cancel. */
function progressPart(cancel) {
  const [bar, source, text] = [
    h("i"),
    h("p"),
    h("p", { class: "quiet", role: "status", "aria-label": "Learning" }),
  ];
  const element = h(
    "div",
    {},
    source,
    h(
      "div",
      { class: "simulating" },
      h("div", { class: "progress" }, bar),
      h("button", { text: "Cancel", "aria-label": "Cancel learning", on: { click: cancel } }),
    ),
    text,
  );
  return {
    element,
    show(job) {
      const { done, total } = job;
      bar.style.transform = `scaleX(${done / Math.max(total, 1)})`;
      setText(source, job.source && `Learning from ${job.source}`);
      setText(text, progressText(job));
    },
    showError(sentence) {
      setText(text, sentence);
    },
  };
}

function jobRow(job, open) {
  const words = [
    h("span", { class: "run-line" }, h("b", { text: job.source }), h("span", { text: job.state })),
    h(
      "span",
      { class: "run-line quiet" },
      h("span", { text: [job.by, clockTime(job.made)].filter(Boolean).join(" · ") }),
    ),
  ];
  if (job.state !== "done")
    return h(
      "li",
      { title: job.sentence },
      h("div", { class: "run-row" }, ...words, h("span", { class: "quiet", text: job.sentence })),
    );
  return h(
    "li",
    {},
    h("button", { class: "run-row", title: job.sentence, on: { click: () => open(job.id) } }, ...words),
  );
}

function setRow(set, remove) {
  return h(
    "li",
    { class: "learned-set" },
    h(
      "span",
      { title: set.title },
      h("b", { text: set.key }),
      h("span", {
        class: "quiet",
        text: ` ${[set.note, set.by, clockTime(set.made)].filter(Boolean).join(" · ")}`,
      }),
    ),
    h("button", {
      class: "link",
      text: "Delete",
      "aria-label": `Delete ${set.key}`,
      on: { click: () => remove(set) },
      title:
        "Deletes this set of physics parameters. Undo restores the set. "
        + "While the set is deleted, simulations that used this set count as out of date",
    }),
  );
}

/** Shows how far a running job is until it has ended; `ended` gets it then. */
function followJob(job, ended) {
  const progress = progressPart(attempt(async () => progress.show(await learningApi.cancel(job.id))));
  let timer = null;
  let wait = POLL_MS;

  function begin() {
    timer = setTimeout(poll, wait);
  }

  async function poll() {
    try {
      const now = await learningApi.course(job.id);
      if (timer === null) return;
      if (OPEN.has(now.state)) {
        progress.show(now);
        wait = POLL_MS;
        begin();
      } else await ended(now);
    } catch (error) {
      if (timer === null) return;
      progress.showError(error.message);
      if (error.status === 0) {
        wait = Math.min(2 * wait, MOST_POLL_MS);
        begin();
      } else report(error);
    }
  }

  progress.show(job);
  return {
    element: progress.element,
    begin,
    leave() {
      clearTimeout(timer);
      timer = null;
    },
  };
}

const namedList = (label, head, items) =>
  items.length
    ? [h("h2", { text: head }), h("ul", { class: "run-list", role: "list", "aria-label": label }, ...items)]
    : [];

/** The page of learning; `first` is the running job, or the choice of data. */
function learningPage(first, { jobs, sets }, { all, open, remove }) {
  const ended = jobs.filter(({ state }) => !OPEN.has(state)).map((job) => jobRow(job, open));
  const kept = sets.map((set) => setRow(set, remove));
  return h(
    "div",
    { class: "run-all learning" },
    h("button", { class: "link", text: "All trials", on: { click: all } }),
    h("div", { class: "run-line run-title" }, h("b", { text: "Learn from trials" })),
    h("p", { class: "quiet", text: PURPOSE }),
    ...first,
    ...namedList("Learning jobs", "Learned", ended),
    ...namedList("Sets of physics parameters", "Sets", kept),
  );
}

/**
 * Opens learning in the panel of trials.
 * @param {Object} page
 * @param {import("../state/store.js").Store} page.store
 * @param {(element: Element, onLeave?: () => void) => void} page.show
 * @param {() => () => boolean} page.begin returns a function that returns whether something else was opened
 *   since
 * @param {() => void} page.all
 */
export async function openLearning({ store, show, begin, all }) {
  addStyles();
  const setsChanged = () => store.set({ physicsSets: (store.state.physicsSets ?? 0) + 1 });
  const showResult = (job) => show(learnedResult(job, { back: list, keep }));

  const list = attempt(async () => {
    const isOld = begin();
    const [{ trials }, jobs, sets] = await Promise.all([
      trialApi.list(),
      learningApi.courses(),
      learningApi.sets(),
    ]);
    if (isOld()) return;
    const on = jobs.find(({ state }) => OPEN.has(state));
    const followed = on && followJob(on, ended);
    const first = followed ? [followed.element] : [trialChoice(trials, start), tableChoice(start)];
    show(learningPage(first, { jobs, sets }, { all, open, remove }), followed?.leave);
    followed?.begin();
  });

  async function ended(job) {
    announce(job.sentence);
    if (job.state === "done") showResult(job);
    else await list();
  }

  /** Does something, then shows the list again unless something else was opened meanwhile. */
  async function changed(act) {
    const isOld = begin();
    const made = await act();
    if (!isOld()) await list();
    return made;
  }

  const start = attempt((wanted) => changed(() => learningApi.start(wanted)));
  const open = attempt(async (id) => {
    const isOld = begin();
    const job = await learningApi.course(id);
    if (!isOld()) showResult(job);
  });

  const keep = attempt(async ({ id }, name) => {
    const { key } = await changed(() => learningApi.keep(id, name));
    setsChanged();
    toast(
      `The set “${key}” is saved. To use the set in simulations, choose the set in Simulate under Physics.`,
    );
  });

  const remove = attempt(async (set) => {
    await changed(() => learningApi.removeSet(set));
    setsChanged();
    const undo = attempt(async () => {
      await changed(() => learningApi.restoreSet(set));
      setsChanged();
    });
    toast(`“${set.key}” is deleted.`, { action: { label: "Undo", act: undo } });
  });

  await list();
}

/** Files of the published trials. */
function tableChoice(start) {
  const file = (name, multiple) =>
    h("input", { type: "file", accept: ".csv,text/csv", "aria-label": name, multiple, required: true });
  const [table, trajectories] = [
    file("Table of trials", false),
    file("Trajectories that the robot walked", true),
  ];
  const iterations = h("input", {
    type: "number",
    "aria-label": "Iterations of the gait in each trial",
    min: "1",
    max: "50",
    step: "1",
    value: "3",
    required: true,
  });
  const submit = attempt(async (event) => {
    event.preventDefault();
    const named = [...trajectories.files].map(async (one) => [one.name, await textOf(one)]);
    start({
      table: {
        csv: await textOf(table.files[0]),
        trajectories: Object.fromEntries(await Promise.all(named)),
        iterations: iterations.valueAsNumber,
      },
    });
  });
  return h(
    "details",
    { class: "run-states" },
    h("summary", { text: "Learn from a published table of trials" }),
    h(
      "form",
      { class: "trial-form", on: { submit } },
      h("p", { class: "quiet", text: TABLE_HELP }),
      h("label", {}, h("span", { text: "Table" }), table),
      h("label", {}, h("span", { text: "Trajectories" }), trajectories),
      h("label", {}, h("span", { text: "Iterations" }), iterations),
      h("button", { class: "primary", text: "Learn from the table" }),
    ),
  );
}
