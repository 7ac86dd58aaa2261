/**
 * The card First steps at the top of the inspector: four acts that tick themselves when they are done.
 *
 * It opens by itself where no gait of the data folder was edited and no run was made, and stays until it is
 * closed. The browser keeps which acts are done and whether the card is closed. Help (?) opens it again. It
 * takes no focus by itself.
 */

import { byId, h, icon, setAttribute, setText } from "../lib/dom.js";
import { recalled, remember } from "../lib/remembered.js";
import { addHelp } from "../shell/key_list.js";
import { planIsOn } from "../state/store.js";
import { ACTS, showPlace, watchActs } from "./acts.js";

const KEY = "first-steps";
const ALL_DONE = "You have done all four exercises. To see this card again, press ? and choose First steps.";

/** Whether nothing was made in this data folder yet: no gait, no edit, no job and no run. */
async function isFirstRun({ gaits, jobs }) {
  if (jobs.length || gaits.some(({ kind, edited }) => kind !== "builtin" || edited)) return false;
  const answer = await fetch("/api/runs?limit=1");
  return answer.ok && (await answer.json()).total === 0;
}

/** An act in the list: its title opens its sentence and the way to its control. */
function actItem(act, { store, opened }) {
  const mark = h("i", { class: "act-mark", "aria-hidden": "true" });
  const word = h("span", { class: "hidden-text" });
  const title = h(
    "button",
    { class: "act-title", type: "button", on: { click: () => opened(act.key) } },
    mark,
    h("span", { text: act.title }),
    word,
  );
  const sentence = h("p", {});
  const where = h("button", {
    class: "link",
    type: "button",
    text: "Show me where",
    "aria-label": `Show me where: ${act.title}`,
    on: { click: () => showPlace(act, store.state) },
  });
  const body = h("div", { class: "act-body" }, sentence, where);
  const element = h("li", {}, title, body);
  return {
    element,
    show(state, isDone, isOpen) {
      setAttribute(element, "data-done", isDone);
      setAttribute(element, "data-open", isOpen);
      setAttribute(title, "aria-expanded", String(isOpen));
      setText(word, isDone ? ", done" : "");
      setText(sentence, act.sentence(state));
      body.hidden = !isOpen;
    },
  };
}

const closeButton = () =>
  h(
    "button",
    {
      class: "plain icon-only",
      type: "button",
      "aria-label": "Close first steps",
      title: "Close this card. To see the card again, press ? and choose First steps",
    },
    icon("close"),
  );

/** Calls `begin` once the studio has greeted the page, where nothing was made in its data folder yet. */
function onFirstRun(store, begin) {
  let isAsked = false;
  store.watch(
    ({ greeted }) => [greeted],
    (state) => {
      if (!state.greeted || isAsked) return;
      isAsked = true;
      isFirstRun(state).then(
        (isFirst) => {
          if (isFirst) begin();
        },
        () => {},
      );
    },
  );
}

/**
 * Builds the card.
 * @param {import("../state/store.js").Store} store
 * @param {EventTarget} playback
 */
export function mountFirstSteps(store, playback) {
  const card = byId("first-steps");
  const kept = recalled(KEY, { done: "", begun: false, closed: false });
  const done = new Set(kept.done.split(" ").filter(Boolean));
  let opened = null;

  const firstToDo = () => ACTS.find(({ key }) => !done.has(key))?.key ?? null;
  const keep = (change) => {
    Object.assign(kept, change, { done: [...done].join(" ") });
    remember(KEY, kept);
  };
  const open = (key) => {
    opened = opened === key ? null : key;
    show();
  };

  const count = h("span", { class: "quiet", role: "status" });
  const end = h("p", { class: "act-body", text: ALL_DONE });
  const close = closeButton();
  const items = new Map(ACTS.map((act) => [act.key, actItem(act, { store, opened: open })]));
  card.append(
    h("div", { class: "first-steps-head" }, h("h3", { text: "First steps" }), count, close),
    h("ol", { role: "list" }, ...[...items.values()].map(({ element }) => element)),
    end,
  );

  function show() {
    const { state } = store;
    card.hidden = !kept.begun || kept.closed || planIsOn(state.robot);
    if (card.hidden) return;
    for (const [key, item] of items) item.show(state, done.has(key), opened === key);
    setText(count, `${done.size} of ${ACTS.length} done`);
    end.hidden = firstToDo() !== null;
  }

  function begin() {
    keep({ begun: true, closed: false });
    opened = firstToDo();
    show();
  }

  close.addEventListener("click", () => {
    const hadFocus = card.contains(document.activeElement);
    keep({ closed: true });
    show();
    if (hadFocus) byId("help").focus();
  });
  watchActs(store, playback, (key) => {
    if (done.has(key)) return;
    done.add(key);
    keep({});
    if (opened === null || opened === key) opened = firstToDo();
    show();
  });
  const help = "Show four first exercises, from playing a gait to sending a gait to the robot";
  addHelp({ text: "First steps", help, act: begin });

  opened = firstToDo();
  store.watch(({ view, robot }) => [view?.document, robot?.emulated, planIsOn(robot)], show);
  if (kept.begun || kept.closed) return;
  onFirstRun(store, () => {
    if (!kept.begun) begin();
  });
}
