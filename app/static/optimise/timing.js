/** Searches the fastest timing in the background, compares it with the drawn one, and makes a gait of it. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { jobIsOn } from "../shell/job_list.js";
import { stepTurn } from "../document/step.js";
import { attempt, toast } from "../lib/toasts.js";

const HELP =
  "Finds the shortest phases for this foot order and step. "
  + "The motion keeps the limits for motors, stability margin and clearance";

/** The newest search of the selected gait, unless the gait has changed since. */
function timingOf({ jobs, selected }) {
  const job = jobs.find((one) => one.gait === selected && one.kind === "timing") ?? null;
  return job && (jobIsOn(job) || job.fresh) ? job : null;
}

const TURNS = "Fastest timing works only for gaits that do not turn. Set Turn to 0.";

function whyNot(state) {
  const { view, pending } = state;
  if (!view) return "No gait is selected.";
  if (pending.length) return "The studio is still saving your last edit.";
  if (view.document.poses)
    return "The robot's firmware decides the timing of this gait. Fastest timing cannot change this timing.";
  if (view.document.segment_table)
    return "This gait is defined by its segment table. To use Fastest timing, draw on the timeline first.";
  if (stepTurn(view.document) !== 0) return TURNS;
  const job = timingOf(state);
  return job && jobIsOn(job)
    ? "A search is running. Cancel the search, or wait until the search ends."
    : null;
}

/** The button that begins the search. */
export function timingButton(store) {
  const button = h("button", { class: "wide", text: "Fastest timing" });
  onPress(
    button,
    attempt(() => api.timing(store.state.selected)),
    (why) => toast(why),
  );
  store.watch(
    ({ jobs, view, pending, selected }) => [jobs, view, pending.length, selected],
    (state) => setAllowed(button, whyNot(state), HELP),
  );
  return button;
}

/** Why the button is greyed, where that lies in the gait itself. */
export function timingNote(store) {
  const element = h("p", { class: "why" });
  store.watch(
    ({ view, pending }) => [view, pending],
    (state) => setText(element, whyNot({ ...state, pending: [] }) === TURNS ? TURNS : ""),
  );
  return element;
}

/** One bar of phases, as long as they take, in the colour of the foot that is in the air. */
function bar(name, durations, phases, longest, document) {
  const pieces = durations.map((seconds, index) => {
    const air = document.timeline.feet.findIndex((row) => row[phases[index].first] === "0");
    const piece = h("i", {
      data: air < 0 ? {} : { foot: air + 1 },
      title: `${air < 0 ? "all feet down" : `foot ${air + 1} in the air`}: ${fixed(seconds, 2)} s`,
    });
    piece.style.flexGrow = seconds;
    return piece;
  });
  const total = durations.reduce((sum, seconds) => sum + seconds, 0);
  const strip = h("div", { class: "phases" }, ...pieces);
  strip.style.width = `${(100 * total) / longest}%`;
  return [
    h("span", { class: "quiet", text: name }),
    h("div", {}, strip),
    h("b", { class: "number", text: `${fixed(total)} s` }),
  ];
}

/** Shows the gait of whole samples and lets the exact tier solve it: the live tier may not get that far. */
async function use(usable, store, edits) {
  const { selected } = store.state;
  await edits.edit(
    ({ name, notes }) => ({ ...usable.document, name, notes }),
    `Timing of ${fixed(usable.seconds)} s`,
  );
  if (store.state.selected === selected && !store.state.pending.length) await api.optimise(selected);
}

/** What the usable timing does to the robot's time, and whether that is any help. */
function onRobot({ seconds, robot_seconds: after }, { plan_seconds: planned, robot_seconds: before }) {
  if (after === null) return ["The gait with this timing cannot be sent to the robot.", false];
  if (before === null) return [`The gait with this timing takes ${fixed(after)} s on the robot.`, true];
  const change =
    `Planned time: ${fixed(planned)} → ${fixed(seconds)} s. Time on the robot: `
    + `${fixed(before)} → ${fixed(after)} s.`;
  return after < before
    ? [change, true]
    : [`${change} The robot stops at each waypoint, so this timing does not make the robot faster.`, false];
}

const NO_WHOLE =
  "Each phase must last a whole number of samples. "
  + "The search found no shorter timing with whole samples that keeps all limits.";
/** What to do where the timing itself does not help. */
const INSTEAD = {
  faster:
    "Try “Faster on the robot”. "
    + "It keeps the foot order and the step, and adapts the moves to the robot's firmware.",
  fewer:
    "Fewer waypoints make the robot faster. In Check & approve, merge waypoints within 1 mm or choose "
    + "a longer stop bound.",
};
const insteadOf = (view) => (view.conversion_refusal ? INSTEAD.fewer : INSTEAD.faster);

/** What the box says of a search without a result. */
function withoutResult(job) {
  if (jobIsOn(job)) return "The search is running and takes some seconds.";
  return job.state === "infeasible"
    ? `${job.sentence} Change the drawing first. The list “What would help” shows possible changes.`
    : job.sentence;
}

function found({ result }, view, store, edits) {
  const { document } = view;
  const drawn = result.phases.map(({ first, last }) => (last - first + 1) * document.timeline.sample_time);
  const scale = result.drawn_seconds / drawn.reduce((sum, seconds) => sum + seconds, 0);
  const longest = Math.max(result.drawn_seconds, result.total_seconds);
  const bars = h(
    "div",
    {
      class: "timings",
      role: "img",
      "aria-label": `As drawn ${fixed(result.drawn_seconds)} s, fastest ${fixed(result.total_seconds)} s`,
    },
    ...bar(
      "As drawn",
      drawn.map((seconds) => seconds * scale),
      result.phases,
      longest,
      document,
    ),
    ...bar(
      "Fastest",
      result.phases.map(({ seconds }) => seconds),
      result.phases,
      longest,
      document,
    ),
  );
  const { usable } = result;
  if (!usable) return [bars, h("p", { class: "why", text: `${NO_WHOLE} ${insteadOf(view)}` })];
  const [change, helps] = onRobot(usable, view);
  const note = h("p", { text: change });
  if (!helps) return [bars, note, h("p", { class: "why", text: insteadOf(view) })];
  const label = `Use ${fixed(usable.seconds)} s`;
  const button = h("button", {
    text: label,
    title: "Uses the phases and motor limits of this timing for the gait, and starts Optimise",
    on: { click: attempt(() => use(usable, store, edits)) },
  });
  const rounded = `Phases are rounded to whole samples of ${fixed(usable.sample_time, 2)} s.`;
  return [bars, note, h("div", { class: "buttons" }, button, h("span", { class: "why", text: rounded }))];
}

/** The box with what the search found. */
export function timingAnswer(store, edits) {
  const element = h("div", {
    class: "box-note",
    role: "region",
    "aria-label": "Fastest timing",
    hidden: true,
  });
  return {
    element,
    show(state) {
      const job = timingOf(state);
      element.hidden = !job || !state.view || job.state === "cancelled";
      if (element.hidden) return;
      const done = job.state === "done" && job.result;
      element.dataset.tone = done ? "good" : jobIsOn(job) ? "plain" : "caution";
      element.replaceChildren(
        h("h4", { text: "Fastest timing" }),
        ...(done ? found(job, state.view, store, edits) : [h("p", { text: withoutResult(job) })]),
      );
    },
  };
}
