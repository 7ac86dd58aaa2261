/** Handles over the 3D scene that are dragged on its floor. */

import { byId, h } from "../lib/dom.js";

/** Which way each arrow key goes on the floor. */
export const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The grid on which places are dragged, m; free of it with Alt. */
export const SNAP = 0.0005;

export const snapped = (value, grid) => Math.round(value / grid) * grid;

/** A pointer that is held down moves a handle only once it has gone this far, px. */
const LEAST_PX = 3;

/** A handle; `help` says what dragging and keys do. */
export function handle(className, name, help) {
  return h("div", {
    class: `goal-handle ${className}`,
    role: "slider",
    tabindex: "0",
    "aria-label": name,
    "aria-description": help,
    title: `${name}. ${help}`,
    data: { arrows: "" },
  });
}

/**
 * Makes a handle draggable and movable by keys; every change is shown, one edit is made at the end.
 * @param {HTMLElement} element
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {{begin: Function, drag: Function, key: Function, name: Function}} way `begin(point)` gives what
 *   `drag(point, from, free)` needs, `key(event)` a change or null; changes are functions from document to
 *   document
 */
export function movable(element, store, edits, way) {
  let change = null;
  let from = null;
  let pressed = null;
  const show = (next) => {
    change = next;
    store.set({ gesture: { apply: next } });
  };
  const end = (commit) => {
    const last = change;
    [change, from] = [null, null];
    delete element.dataset.held;
    if (!last) return false;
    store.set({ gesture: null });
    const [before, after] = [edits.shown(), last(edits.shown())];
    if (commit && JSON.stringify(after) !== JSON.stringify(before)) edits.edit(last, way.name(after));
    return true;
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pressed = [event.clientX, event.clientY];
    from = way.begin(pressed);
    if (!from) return;
    event.preventDefault();
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    element.dataset.held = "";
  });
  element.addEventListener("pointermove", (event) => {
    const isNear =
      !change && from && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < LEAST_PX;
    const next = from && !isNear && way.drag([event.clientX, event.clientY], from, event.altKey);
    if (next) show(next);
  });
  element.addEventListener("pointerup", () => end(true));
  element.addEventListener("pointercancel", () => end(false));
  element.addEventListener("keydown", (event) => {
    const next = event.ctrlKey || event.metaKey || event.altKey ? null : way.key(event);
    if (!next) return;
    event.preventDefault();
    event.stopPropagation();
    show(next);
  });
  element.addEventListener("keyup", (event) => {
    if (event.key.startsWith("Arrow")) end(true);
  });
  element.addEventListener("blur", () => end(true));
  return () => end(false);
}

/** The floor as it is seen, in the stage's pixels, and the pointer's place on it. */
export function floorOf(preview) {
  const view = preview.ground();
  if (!view) return null;
  const [stage, frame] = [byId("viser").parentElement, byId("viser")].map((element) =>
    element.getBoundingClientRect(),
  );
  const [dx, dy] = [frame.left - stage.left, frame.top - stage.top];
  return {
    key: `${view.key} ${dx} ${dy}`,
    toStage: (at) => {
      const seen = view.toScreen(at);
      return seen && [seen[0] + dx, seen[1] + dy];
    },
    ofPointer: ([x, y]) => view.toGround([x - frame.left, y - frame.top]),
  };
}

/**
 * Puts an element to a place on the stage, px.
 * @param {HTMLElement} element
 * @param {number[]} at
 */
export function place(element, [x, y]) {
  element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}
