/** The top bar: name, saved state, undo and redo, link, robot, operator, and Stop. */

import { sendStop } from "../api/gaits.js";
import { ownSteps } from "../api/author.js";
import { byId, h, onPress, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { NOT_TAKEN, takeOverStop } from "./early_stop.js";
import { sendToStudio } from "../state/server_events.js";
import { clockTime, lowered, seconds } from "../lib/format.js";
import { freeName } from "../document/gait_names.js";
import { showKeys } from "./key_list.js";
import { holderSentence } from "../state/lease.js";
import { changeOperator } from "../state/operator.js";
import { refusalOf } from "../lib/field_error.js";
import { segmentDraftOf } from "../state/segment_draft.js";
import { acceptRobot, runIsOn, stopLimit } from "../state/store.js";
import { toast } from "../lib/toasts.js";

const LINK_TONES = { ready: "good", connecting: "caution", lost: "bad" };
const ROBOT_TONES = {
  armed: "accent",
  moving: "accent",
  done: "good",
  pausing: "caution",
  paused: "caution",
  stopping: "caution",
  stopped: "bad",
  fault: "bad",
  disarmed: "quiet",
};

export const robotTone = (robot) => ROBOT_TONES[robot?.robot] ?? "quiet";
const linkTone = (robot) => LINK_TONES[robot?.link] ?? "quiet";

/** True if the socket reports that a stop was taken although its request failed. */
const isStopped = ({ connected, robot }) => connected && ["stopping", "stopped"].includes(robot?.robot);

/**
 * Sends Stop on two ways, each of which is enough: a request is tried again, and needs no known state; what
 * goes over the socket waits for no other request of this page, of which a browser lets six at most be on.
 */
export async function stopRobot(store) {
  const button = byId("stop");
  button.dataset.busy = "";
  try {
    sendToStudio(`stop ${store.state.operator}`);
    acceptRobot(store, await sendStop(store.state.operator));
  } catch {
    if (!isStopped(store.state)) toast(NOT_TAKEN, { tone: "bad", of: "studio" });
  } finally {
    delete button.dataset.busy;
  }
}

/** What is wrong with a name; null where nothing is. */
function refusedName(name, { gaits, selected }) {
  if (!name) return "A gait needs a name. Write a name, or press Escape.";
  const taken = gaits.some((gait) => gait.id !== selected && gait.name === name);
  return taken
    ? `Another gait is called “${name}”. `
        + `Write another name, such as “${freeName({ gaits }, name)}”, or press Escape.`
    : null;
}

/** The field with the name; a refused name stays, with its sentence, until it is repaired or given up. */
function nameField(store, edits) {
  const input = byId("gait-name");
  const refusal = refusalOf(input);
  input.parentElement.append(refusal.element);
  const show = () => {
    if (refusal.hasError()) return;
    input.value = edits.shown()?.name ?? "";
  };
  const giveUp = () => {
    refusal.setError(null);
    show();
  };
  input.addEventListener("change", () => {
    const name = input.value.trim();
    const current = edits.shown()?.name;
    if (current === undefined) return;
    refusal.setError(name === current ? null : refusedName(name, store.state));
    if (!refusal.hasError() && name !== current)
      edits.edit((document) => ({ ...document, name }), `Name to ${name}`);
    show();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.blur();
    if (event.key === "Escape") {
      giveUp();
      input.blur();
    }
  });
  store.watch(({ selected }) => [selected], giveUp);
  return {
    input,
    show: () => {
      if (document.activeElement !== input) show();
    },
  };
}

function mountName(store, edits) {
  const { input, show } = nameField(store, edits);
  store.watch(
    (state) => [state.view, state.pending, state.refused, state.segmentDrafts, state.connected],
    (now) => {
      const { view } = now;
      const unfit = segmentDraftOf(now).steps.length > 0;
      show();
      input.size = Math.max(4, input.value.length);
      const file = view && `If you rename the gait, its file name stays gaits/${view.id}.json`;
      setAttribute(input, "title", view ? `${view.name}. ${file}` : null);
      setText(byId("saved-state"), savedWord(now, unfit));
      setAttribute(
        byId("saved-state"),
        "title",
        view ? `${unfit ? `${UNFIT} ` : ""}${savedHelp(view)}` : null,
      );
    },
  );
}

const UNFIT =
  "After your last change, some segments of the segment table do not fit together. "
  + "The gait still uses the old table. Your change exists only in this tab.";

/** How the shown gait is kept, in a few words. */
function savedWord({ view, pending, refused, connected }, unfit) {
  if (!view) return "";
  if (refused) return "Drawing not accepted";
  if (unfit) return "Table does not fit";
  if (pending.length) return connected ? "Sending" : "Not sent";
  return view.edited ? "Not saved to a file" : "Saved";
}

/** Every edit is in the studio's database before it is shown as done; Save writes its file for others. */
function savedHelp(view) {
  const file = view.saved_at
    ? `Last saved to the data folder: ${clockTime(view.saved_at)}.`
    : "The gait has no file in the data folder yet.";
  return view.edited
    ? "The studio stores every edit at once, even before you press Save. "
        + `${file} Save writes the gait to its file.`
    : file;
}

function mountHistory(store, edits) {
  const [undo, redo, save] = ["undo", "redo", "save"].map(byId);
  onPress(undo, edits.undo);
  onPress(redo, edits.redo);
  onPress(save, edits.save);
  store.watch(
    ({ view, refused, segmentDrafts }) => [view, refused, segmentDrafts],
    (state) => {
      const { view, refused } = state;
      const own = ownSteps(view);
      const draft = segmentDraftOf(state).steps.at(-1)?.label;
      const label = draft ?? (refused ? "the drawing that the studio did not accept" : own.undo);
      setText(byId("undo-label"), label ? lowered(label) : "");
      setAllowed(undo, label ? null : "Nothing to undo.", `Undo: ${label} (Ctrl+Z)`);
      setAllowed(redo, own.redo ? null : "Nothing to redo.", `Redo: ${own.redo} (Ctrl+Shift+Z)`);
      if (label) setAttribute(undo, "aria-description", label);
      if (own.redo) setAttribute(redo, "aria-description", own.redo);
      setAllowed(
        save,
        !view ? "No gait is selected." : view.edited ? null : draft ? UNFIT : "Everything is saved.",
        "Write this gait to its file in the data folder (Ctrl+S)",
      );
    },
  );
}

/** A dot and a word; the word alone may be left to readers. */
function showState(element, tone, word, isQuiet) {
  element.replaceChildren(
    h("span", { class: "dot", data: { tone } }),
    h("span", { class: "word", text: word }),
  );
  element.classList.toggle("hidden-text", isQuiet);
}

/** What the robot does; the name of the gait that runs where it is not the shown one. */
function robotWord(now, selected) {
  const word = now?.robot ?? "unknown";
  const isOther = runIsOn(now) && now.run?.gait_name && now.run.gait !== selected;
  return isOther ? `${word}: ${now.run.gait_name}` : word;
}

function mountRobotState(store) {
  const sentence = h("span", { class: "hidden-text" });
  const [link, robot] = ["link", "robot-status"].map(byId);
  store.watch(
    ({ robot: now, connected, selected }) => [
      now?.link,
      now?.robot,
      now?.emulated,
      now?.device,
      now?.run?.gait_name,
      connected,
      selected,
    ],
    ({ robot: now, connected, selected }) => {
      const isReady = connected && now?.link === "ready";
      showState(
        link,
        connected ? linkTone(now) : "bad",
        connected ? (now?.link ?? "unknown") : "no studio",
        isReady,
      );
      showState(robot, robotTone(now), robotWord(now, selected), !isReady);
      robot.append(sentence);
      setAttribute(
        link,
        "title",
        now ? `${now.emulated ? "Emulated robot" : "Robot"} at ${now.device}` : null,
      );
      document.querySelector(".states").toggleAttribute("data-stale", !connected);
    },
  );
  store.watch(
    ({ robot: now }) => [now?.sentence, now?.stop_text, now?.lease?.page, now?.lease?.is_gone],
    ({ robot: now }) => {
      const words = [now?.sentence, now?.stop_text, holderSentence(now)].filter(Boolean).join(" ");
      setText(sentence, ` ${words}`);
      setAttribute(robot, "title", words || null);
    },
  );
}

function mountOperator(store) {
  const operator = byId("operator");
  operator.addEventListener("click", () => changeOperator(store));
  store.watch(
    (state) => [state.operator],
    (state) => {
      operator.replaceChildren(
        h("span", {
          class: "initial",
          "aria-hidden": "true",
          text: state.operator ? state.operator.charAt(0).toUpperCase() : "?",
        }),
        h("span", { class: "name", text: state.operator || "Your name" }),
      );
      operator.toggleAttribute("data-named", Boolean(state.operator));
      setAttribute(
        operator,
        "aria-label",
        state.operator ? `Operator ${state.operator}` : "Your name. Operator not named",
      );
      operator.title =
        "The studio saves your name with each approval and each run. Click to change your name.";
    },
  );
}

/** Wires the top bar. */
export function mountTopbar(store, edits) {
  mountName(store, edits);
  mountHistory(store, edits);
  mountRobotState(store);
  mountOperator(store);
  byId("help").addEventListener("click", showKeys);
  takeOverStop();
  byId("stop").addEventListener("click", () => stopRobot(store));
  store.watch(
    (state) => [stopLimit(state)],
    (state) => {
      const limit = stopLimit(state);
      const within = limit
        ? `The robot finishes its current move and stops within ${seconds(limit)} s.`
        : "The robot finishes its current move and then stops.";
      byId("stop").title = `Stop the robot (Esc during a run). ${within}`;
    },
  );
}
