/** The keyboard of the whole page. Nothing here powers, starts or moves the robot; Esc stops it. */

import { dialogOpen } from "../lib/dialogs.js";
import { byId, isShown } from "../lib/dom.js";
import { foldDrawer } from "./drawers.js";
import { showKeys } from "./key_list.js";
import { goToPart } from "./part_keys.js";
import { runIsOn } from "../state/store.js";
import { stopRobot } from "./topbar.js";

const isTyping = (target) =>
  target.closest?.("input, textarea, [contenteditable]") !== null && target.closest !== undefined;

/**
 * True where Space belongs to the focused control: never on a control that acts on the robot, or a cell that
 * was pointed at.
 */
function ownsSpace(target, withShift) {
  if (target.closest?.("[data-robot]") || (!withShift && target.closest?.("[data-pointed]"))) return false;
  return Boolean(target.closest?.("button, select, summary, a[href], [role=gridcell]"));
}

/** True where no key of the page acts: in a dialog, and where keys drive the robot. */
const isElsewhere = ({ target }) => dialogOpen() || Boolean(target.closest?.("[data-drive]"));

/** True where letters, Delete and Ctrl with a letter mean something else, or the timeline is not shown. */
const ownsLetters = (target) =>
  !isShown(byId("timeline"))
  || Boolean(
    target.closest?.("select, [role=grid]:not(#timeline), [role=listbox], [role=dialog], [data-keys]"),
  );

/**
 * What a key with Ctrl does; null for nothing.
 * @param {KeyboardEvent} event
 * @param {Record<string, any>} page
 */
function withControl(event, { edits, timeline, actions }) {
  const key = event.key.toLowerCase();
  if (key === "s") return edits.save;
  if (isTyping(event.target)) return null;
  if (key === "z") return event.shiftKey ? edits.redo : edits.undo;
  if (key === "y") return edits.redo;
  if (ownsLetters(event.target)) return null;
  return { a: timeline.selectAll, d: () => actions.act("duplicate") }[key] ?? null;
}

function onTimeline(event, { store, actions, zoom }) {
  const byKey = {
    l: actions.loop,
    k: actions.toggleLock,
    f: zoom.fit,
    b: () => store.set({ tool: "paint" }),
    "+": () => zoom.closer(true),
    "=": () => zoom.closer(true),
    "-": () => zoom.closer(false),
    "−": () => zoom.closer(false),
    delete: actions.clear,
    backspace: actions.clear,
  };
  return ownsLetters(event.target) ? null : (byKey[event.key.toLowerCase()] ?? null);
}

/**
 * True where an arrow key, Home or End belongs to the focused control; a list leaves Left and Right to the
 * preview.
 */
function ownsArrow({ target, key }) {
  const owner = target.closest?.("select, [role=gridcell], [role=tab], [role=menu], [data-arrows]");
  return Boolean(owner) && !(owner.dataset.arrows === "upright" && key.startsWith("Arrow"));
}

const foldInspector = () => document.body.toggleAttribute("data-inspector-folded");

/** Keys that only look: they work without the studio too. */
const LOOKS = new Set([" ", "ArrowLeft", "ArrowRight", "Home", "End", "?", "[", "]"]);

function plain(event, page) {
  const { playback, store } = page;
  const far = event.shiftKey ? 10 : 1;
  const byKey = {
    ArrowLeft: () => playback.step(-far),
    ArrowRight: () => playback.step(far),
    Home: () => playback.toStart(),
    End: () => playback.toEnd(),
  };
  if (event.key === " " && !ownsSpace(event.target, event.shiftKey)) return () => playback.toggle();
  const folds = { "?": showKeys, "[": foldDrawer, "]": foldInspector }[event.key];
  if (folds) return folds;
  const does = store.state.view && onTimeline(event, page);
  if (does) return does;
  return ownsArrow(event) ? null : (byKey[event.key] ?? null);
}

/**
 * Wires the keyboard.
 * @param {Record<string, any>} page `store`, `edits`, `playback`, the timeline with its `actions` and `zoom`,
 *   and `escapes`: tried in order while no run is on; the first that did something wins
 */
export function mountKeys(page) {
  const { store, escapes } = page;
  function escape(event) {
    if (runIsOn(store.state.robot)) {
      stopRobot(store);
      event.preventDefault();
    } else if (
      !dialogOpen()
      && !event.target.closest?.("[data-own-escape]")
      && escapes.some((attempt) => attempt())
    ) {
      event.preventDefault();
    }
  }

  function press(event) {
    if (event.key === "Escape") return escape(event);
    if (isElsewhere(event)) return undefined;
    if (event.key === "F6") {
      event.preventDefault();
      return goToPart(event.shiftKey ? -1 : 1);
    }
    const isOff = "offline" in document.body.dataset;
    if (isOff && (event.ctrlKey || event.metaKey || !LOOKS.has(event.key))) return undefined;
    if (event.ctrlKey || event.metaKey) {
      const act = withControl(event, page);
      if (!act) return undefined;
      event.preventDefault();
      return act();
    }
    if (event.altKey || isTyping(event.target)) return undefined;
    const act = plain(event, page);
    if (!act) return undefined;
    event.preventDefault();
    return act();
  }

  window.addEventListener("keydown", press, true);
  window.addEventListener(
    "keyup",
    (event) => {
      const target = /** @type {Element} */ (event.target);
      if (event.key === " " && target.closest?.("[data-robot]")) event.preventDefault();
    },
    true,
  );
  byId("viser").addEventListener("load", () => {
    const inner = byId("viser").contentWindow;
    inner.addEventListener(
      "keydown",
      (event) => {
        if (event.key === "Escape") escape(event);
      },
      true,
    );
  });
}
