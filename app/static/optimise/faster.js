/**
 * *Faster on the robot* compares a drawn gait with the same one for the robot's clock.
 * *Draw it freely* leads back.
 */

import { ApiError, api } from "../api/gaits.js";
import { isOnTheSpot, stepTurn } from "../document/step.js";
import { freeName } from "../document/gait_names.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { counted, fixed, mm } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";

const HELP =
  "Searches for a gait with the same foot order and step, timed for the robot's firmware. "
  + "You can compare both gaits before you use the new gait";
const FREELY =
  "Changes this gait into a drawn gait with the same foot order and step. "
  + "You can then paint the timeline";
const BROKEN_OFF = "The search stopped without a result. Try again when the studio is connected.";
const MORE = "To gain more speed, set more iterations of the gait, a longer step or a longer stop bound.";
const FEW =
  "This gait has fewer than three iterations. Its values in mid-walk (column “Now”) are the mean "
  + "over all iterations.";
const USE =
  "Replaces the drawn gait with the gait in column “For the robot's clock”. "
  + "Undo restores the drawn gait";
const NEW = "Saves the gait in column “For the robot's clock” as a new gait. The drawn gait stays unchanged";
const ABOUT =
  "with a gait for the robot's clock: a gait that is timed for the robot's firmware. "
  + "Both gaits have the same foot order and step. "
  + "The gait for the robot's clock has few poses. The motors move directly from pose to pose.";
const DEGREES = 180 / Math.PI;
/** Iterations from which a walk has some that are neither the first nor the last. */
const MIDDLE = 3;
/** A gait that gains less is told what would make it gain more. */
const WORTH = 1.1;
/** Characters of a name that leave room for what is put behind it. */
const LONGEST = 90;
const NOTHING = { now: null, faster: null, document: null, notice: null };

/** Why the shown gait cannot be converted; the server's own sentence, but for what the page alone knows. */
function whyNot({ view, pending }) {
  if (!view) return "No gait is selected.";
  return pending.length ? "The studio is still saving your last edit." : view.conversion_refusal;
}

function conversionButton(store, { text, help, isOf, act }) {
  const button = h("button", { class: "wide", text });
  onPress(button, attempt(act), (why) => toast(why));
  store.watch(
    ({ view, pending }) => [view, pending.length],
    (state) => {
      button.hidden = !state.view || !isOf(state.view.document);
      setAllowed(button, whyNot(state), help);
    },
  );
  return button;
}

/** The act, which a second press does not begin again before it has ended. */
function oneAtATime(act) {
  let isOn = false;
  return async () => {
    if (isOn) return;
    isOn = true;
    try {
      await act();
    } finally {
      isOn = false;
    }
  };
}

/** The button on a gait for the robot's clock. */
export const drawFreelyButton = (store, edits) =>
  conversionButton(store, {
    text: "Draw it freely",
    help: FREELY,
    isOf: ({ poses }) => Boolean(poses),
    act: () => edits.convert("drawn"),
  });

/**
 * The button on a drawn gait.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {(id: string) => Promise<void>} show shows a gait
 */
export const fasterButton = (store, edits, show) =>
  conversionButton(store, {
    text: "Faster on the robot",
    help: HELP,
    isOf: ({ poses }) => !poses,
    act: oneAtATime(() => compare(store, edits, show)),
  });

/** The figure that says how fast a gait is, as both sides name it. */
const rateOf = (document) => (isOnTheSpot(document) ? "turn_rate" : "speed");

/** A row of both gaits' figures: `key` is that of the figure, `text` makes it words. */
const figureRow = (name, unit, key, text) => ({ name, unit, key, text });

/** The figures of both gaits as rows under two heads. */
function groupsOf(document) {
  const onTheSpot = isOnTheSpot(document);
  const rate = rateOf(document);
  const turns = Math.abs(stepTurn(document)) > 0;
  const unit = onTheSpot ? "°/s" : "mm/s";
  const pace = (value) => (onTheSpot ? fixed(Math.abs(value) * DEGREES, 2) : mm(value, 2));
  const middle = [
    figureRow("Speed", unit, `cycle_${rate}`, pace),
    figureRow("Time", "s", "cycle_seconds", (value) => fixed(value)),
    figureRow("Moves", "", "cycle_moves", (value) => fixed(value, Number.isInteger(value) ? 0 : 1)),
  ];
  const all = [
    figureRow("Speed", unit, rate, pace),
    figureRow("Time", "s", "seconds", (value) => fixed(value)),
    figureRow("Moves", "", "moves", (value) => fixed(value, 0)),
    ...(onTheSpot ? [] : [figureRow("Travel", "mm", "distance", (value) => mm(value))]),
    ...(turns ? [figureRow("Turn", "°", "turn", (value) => fixed(value * DEGREES))] : []),
    figureRow("Least margin", "mm", "margin", (value) => mm(value)),
    figureRow("Stop acts within", "s", "stop_seconds", (value) => fixed(value, 2)),
  ];
  return [
    { head: "One iteration in mid-walk", rows: middle },
    { head: `Whole gait from rest to rest, ${counted(document.iterations, "iteration")}`, rows: all },
  ];
}

function table(document) {
  const cells = [];
  const cell = (row, side) => {
    const element = h("td", { class: "number", text: "…" });
    cells.push({ element, row, side });
    return element;
  };
  const line = (row) => {
    const unit = h("span", { class: "quiet", text: ` ${row.unit}` });
    const name = h("th", { scope: "row" }, row.name, unit);
    return h("tr", {}, name, cell(row, "now"), cell(row, "faster"));
  };
  const groups = groupsOf(document).map(({ head, rows }) =>
    h("tbody", {}, h("tr", {}, h("th", { scope: "rowgroup", colspan: "3", text: head })), ...rows.map(line)),
  );
  const columns = ["Now", "For the robot's clock"].map((text) => h("th", { scope: "col", text }));
  const element = h("table", { class: "sides" }, h("thead", {}, h("tr", {}, h("td"), ...columns)), ...groups);
  const show = (state) =>
    cells.forEach(({ element: place, row, side }) => {
      const waits = side === "faster" && state.state === "running";
      const value = state[side] ? state[side][row.key] : null;
      setText(place, waits ? "…" : value === null ? "–" : row.text(value));
    });
  return { element, show };
}

/** How much faster it is, in mid-walk and over all; a gait that is slower says so. */
function verdict({ now, faster }, document) {
  const rate = rateOf(document);
  const pace = (side, name) => Math.abs(side[`${name}${rate}`]);
  if (!now) return "The gait in column “Now” has no motion that can be sent to the robot.";
  const times = (name) => pace(faster, name) / pace(now, name);
  const words = (ratio) => `${fixed(ratio, 2)} times as fast${ratio < 1 ? " (slower)" : ""}`;
  const parts = faster.cycle_speed === null ? [] : [`${words(times("cycle_"))} in mid-walk`];
  parts.push(`${words(times(""))} from rest to rest`);
  const sentences = [`The gait for the robot's clock is ${parts.join(" and ")}.`];
  if (times("") < WORTH) sentences.push(MORE);
  if (document.iterations < MIDDLE) sentences.push(FEW);
  return sentences.join(" ");
}

/** What the line below the table says of a state. */
function lineOf(state, document) {
  if (state.state === "running") return `Looking for the fastest motion: ${state.stage}.`;
  return state.state === "solved" ? verdict(state, document) : state.sentence;
}

function isWorse({ state, now, faster }, document) {
  const rate = rateOf(document);
  if (state === "infeasible" || state === "failed") return true;
  return Boolean(now && faster && Math.abs(faster[rate]) < Math.abs(now[rate]));
}

/** The dialog's buttons; `take` gives what a press does. */
function buttons(close, take) {
  const use = h("button", { type: "submit", class: "primary", text: "Use this", title: USE });
  const asNew = h("button", { type: "button", text: "Save as a new gait", title: NEW });
  asNew.addEventListener("click", () => take("new"));
  const cancel = h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } });
  const allow = (isAllowed, isBetter) => {
    use.disabled = asNew.disabled = !isAllowed;
    use.classList.toggle("primary", isBetter);
  };
  return { element: h("div", { class: "buttons" }, cancel, asNew, use), allow };
}

/** Shows both gaits while the search is on; resolves to `use` or `new` with the last state, or to null. */
function ask(document, name, search) {
  const ending = new AbortController();
  return openDialog((close) => {
    const sides = table(document);
    const line = h("p", { role: "status", "aria-label": "Comparison" });
    const notice = h("p", { class: "quiet" });
    let last = null;
    const take = (act) => {
      if (last.state === "solved") close({ act, state: last });
    };
    const acts = buttons(close, take);
    const show = (state) => {
      last = state;
      sides.show(state);
      setText(line, lineOf(state, document));
      setText(notice, state.notice ?? "");
      const isBetter = !isWorse(state, document);
      line.toggleAttribute("data-worse", !isBetter);
      acts.allow(state.state === "solved", isBetter);
    };
    const fail = (sentence) => show({ ...NOTHING, now: last.now, state: "failed", sentence });
    show({ ...NOTHING, state: "running", stage: "waiting for the solver" });
    search(ending.signal, show).then(
      () => {
        if (last.state === "running") fail(BROKEN_OFF);
      },
      (error) => fail(error instanceof ApiError ? error.message : BROKEN_OFF),
    );
    const about = h("p", { class: "quiet", text: `This table compares “${name}” ${ABOUT}` });
    const content = [about, sides.element, line, notice, acts.element];
    const dialog = dialogFrame("Faster on the robot", close, () => take("use"), ...content);
    dialog.classList.add("faster");
    return dialog;
  }).finally(() => ending.abort());
}

async function compare(store, edits, show) {
  const { selected } = store.state;
  await edits.settled();
  const { view } = store.state;
  if (!view || view.id !== selected) return;
  const answer = await ask(view.document, view.name, (signal, told) => api.faster(selected, signal, told));
  if (!answer) return;
  if (answer.act === "use") {
    await edits.convert("poses", view.revision);
    return;
  }
  const name = freeName(store.state, `${view.name.slice(0, LONGEST)}, for the robot's clock`);
  await show((await api.create({ ...answer.state.document, name })).id);
}
