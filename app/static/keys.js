/** The keyboard of the whole page. Nothing here powers, starts or moves the robot; Esc stops it. */

import { dialogOpen, showKeys } from "./dialogs.js";
import { byId } from "./dom.js";
import { runIsOn } from "./store.js";
import { stopRobot } from "./topbar.js";

const isTyping = (target) => target.closest?.("input, textarea, [contenteditable]") !== null && target.closest !== undefined;

/** True where Space belongs to the focused control: never on a control that acts on the robot. */
function ownsSpace(target) {
  if (target.closest?.("[data-robot]")) return false;
  return Boolean(target.closest?.("button, select, summary, a[href], [role=gridcell]"));
}

function withControl(event, edits) {
  const key = event.key.toLowerCase();
  if (key === "s") return edits.save;
  if (isTyping(event.target)) return null;
  if (key === "z") return event.shiftKey ? edits.redo : edits.undo;
  return key === "y" ? edits.redo : null;
}

function plain(event, playback) {
  const far = event.shiftKey ? 10 : 1;
  const acts = {
    ArrowLeft: () => playback.step(-far), ArrowRight: () => playback.step(far),
    Home: () => playback.toStart(), End: () => playback.toEnd(),
    l: () => playback.setLoop(!playback.loop), L: () => playback.setLoop(!playback.loop), "?": showKeys,
  };
  if (event.key === " " && !ownsSpace(event.target)) return () => playback.toggle();
  if (event.target.closest?.("select, [role=gridcell], [role=tab]") && event.key !== "?") return null;
  return acts[event.key] ?? null;
}

/**
 * Wires the keyboard.
 * @param {object} options
 * @param {object} options.store
 * @param {object} options.edits
 * @param {Playback} options.playback
 * @param {(() => boolean)[]} options.escapes tried in order while no run is on; the first that did something wins
 */
export function mountKeys({ store, edits, playback, escapes }) {
  function escape(event) {
    if (runIsOn(store.state.robot)) {
      stopRobot(store);
      event.preventDefault();
    } else if (!dialogOpen() && escapes.some((attempt) => attempt())) {
      event.preventDefault();
    }
  }

  function press(event) {
    if (event.key === "Escape") return escape(event);
    if (event.ctrlKey || event.metaKey) {
      const act = withControl(event, edits);
      if (!act) return undefined;
      event.preventDefault();
      return act();
    }
    if (event.altKey || isTyping(event.target)) return undefined;
    const act = plain(event, playback);
    if (!act) return undefined;
    event.preventDefault();
    return act();
  }

  window.addEventListener("keydown", press, true);
  window.addEventListener("keyup", (event) => {
    if (event.key === " " && event.target.closest?.("[data-robot]")) event.preventDefault();
  }, true);
  byId("viser").addEventListener("load", () => {
    const inner = byId("viser").contentWindow;
    inner.addEventListener("keydown", (event) => { if (event.key === "Escape") escape(event); }, true);
  });
}
