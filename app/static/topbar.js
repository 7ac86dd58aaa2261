/** The top bar: name, saved state, undo and redo, link, robot, operator, and Stop. */

import { sendStop } from "./api.js";
import { byId, h, onPress, setAllowed, setAttribute, setText, stateParts } from "./dom.js";
import { showKeys } from "./dialogs.js";
import { clockTime, seconds } from "./format.js";
import { changeOperator } from "./operator.js";
import { runIsOn } from "./store.js";
import { toast } from "./toasts.js";

const LINK_TONES = { ready: "good", connecting: "caution", lost: "bad" };
const ROBOT_TONES = {
  armed: "accent", moving: "accent", done: "good", pausing: "caution", paused: "caution", stopping: "caution",
  stopped: "bad", fault: "bad", disarmed: "quiet",
};

export const robotTone = (robot) => ROBOT_TONES[robot?.robot] ?? "quiet";
export const linkTone = (robot) => LINK_TONES[robot?.link] ?? "quiet";

/** Sends Stop; needs neither the WebSocket nor a known state. */
export async function stopRobot(store) {
  const button = byId("stop");
  button.dataset.busy = "";
  try {
    store.set({ robot: await sendStop(store.state.operator) });
  } catch {
    toast("Stop did not reach the studio: it does not answer. Cut the robot's power.", { tone: "bad" });
  } finally {
    delete button.dataset.busy;
  }
}

function mountName(store, edits) {
  const input = byId("gait-name");
  const rename = () => {
    const name = input.value.trim();
    const current = edits.shown()?.name;
    if (name && current && name !== current) edits.edit((document) => ({ ...document, name }), `Name to ${name}`);
    else input.value = current ?? "";
  };
  input.addEventListener("change", rename);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.blur();
    if (event.key === "Escape") { input.value = edits.shown()?.name ?? ""; input.blur(); }
  });
  store.watch(({ view, pending, refused }) => [view, pending, refused], ({ view, pending, refused }) => {
    if (document.activeElement !== input) input.value = edits.shown()?.name ?? "";
    input.size = Math.max(4, input.value.length);
    const state = !view ? "" : refused ? "· drawing not accepted" : pending.length ? "· saving the edit" : view.edited ? "· edited" : "· saved";
    setText(byId("saved-state"), state);
    setAttribute(byId("saved-state"), "title", view?.saved_at ? `Saved ${clockTime(view.saved_at)}` : null);
  });
}

function mountHistory(store, edits) {
  const [undo, redo, save] = ["undo", "redo", "save"].map(byId);
  onPress(undo, edits.undo);
  onPress(redo, edits.redo);
  onPress(save, edits.save);
  store.watch(({ view, refused }) => [view, refused], ({ view, refused }) => {
    const label = refused ? "the drawing that was not accepted" : (view?.undo ?? null);
    setText(byId("undo-label"), label ? label.charAt(0).toLowerCase() + label.slice(1) : "");
    setAllowed(undo, label ? null : "Nothing to undo.", `Undo: ${label} (Ctrl+Z)`);
    setAllowed(redo, view?.redo ? null : "Nothing to redo.", `Redo: ${view?.redo} (Ctrl+Shift+Z)`);
    if (label) setAttribute(undo, "aria-description", label);
    if (view?.redo) setAttribute(redo, "aria-description", view.redo);
    setAllowed(save, !view ? "No gait is selected." : view.edited ? null : "Everything is saved.", "Save to the data folder (Ctrl+S)");
  });
}

function mountStates(store) {
  const sentence = h("span", { class: "hidden-text" });
  const [link, robot, operator] = ["link", "robot-status", "operator"].map(byId);
  store.watch(({ robot: now, connected, selected }) => [now?.link, now?.robot, now?.emulated, now?.device, now?.run?.gait_name, connected, selected], ({ robot: now, connected, selected }) => {
    link.replaceChildren(...stateParts(connected ? linkTone(now) : "bad", "Link", connected ? (now?.link ?? "unknown") : "no studio"));
    setAttribute(link, "title", now ? `${now.emulated ? "Emulated robot" : "Robot"} at ${now.device}` : null);
    document.querySelector(".states").toggleAttribute("data-stale", !connected);
    robot.replaceChildren(...stateParts(robotTone(now), "Robot", `${now?.robot ?? "unknown"}${runIsOn(now) && now.run?.gait_name && now.run.gait !== selected ? `: ${now.run.gait_name}` : ""}`), sentence);
  });
  store.watch(({ robot: now }) => [now?.sentence, now?.stop_text], ({ robot: now }) => {
    const words = [now?.sentence, now?.stop_text].filter(Boolean).join(" ");
    setText(sentence, words);
    setAttribute(robot, "title", words || null);
  });
  store.watch((state) => [state.operator], (state) => {
    operator.replaceChildren(h("span", { class: "name quiet", text: "Operator" }), h("b", { text: state.operator || "not named" }));
    operator.toggleAttribute("data-named", Boolean(state.operator));
    operator.title = "Your name, kept with approvals and runs. Click to change it.";
  });
}

/** Wires the top bar. */
export function mountTopbar(store, edits) {
  mountName(store, edits);
  mountHistory(store, edits);
  mountStates(store);
  byId("operator").addEventListener("click", () => changeOperator(store));
  byId("help").addEventListener("click", showKeys);
  byId("stop").addEventListener("click", () => stopRobot(store));
  store.watch(({ robot }) => [robot?.stop_seconds], ({ robot }) => {
    const within = robot?.stop_seconds ? `Takes effect within ${seconds(robot.stop_seconds)} s, after the move that is running.` : "Takes effect after the move that is running.";
    byId("stop").title = `Stop the robot (Esc while a run is on). ${within}`;
  });
}
