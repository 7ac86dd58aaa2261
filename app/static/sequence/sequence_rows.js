/** The rows of the Sequence section, an ARIA grid: a part is moved, repeated or taken out by one edit. */

import { moved, removed, repeated, restarted } from "../document/sequence_edits.js";
import { h } from "../lib/dom.js";
import { shownDocument, shownPlan } from "../state/store.js";
import { partRow, showRow } from "./sequence_row.js";

/** What of the plan belongs to a part; nothing while the plan is still of another order. */
function stretchOf(plan, index, name, isTransition) {
  return (
    plan?.parts?.find((one) => one.part === index && one.is_transition === isTransition && one.name === name)
    ?? null
  );
}

function sourceOf({ view }, part) {
  const at = view.document.sequence?.indexOf(part) ?? -1;
  return view.sources?.[at] ?? null;
}

/** One of all names is reached by Tab; the arrows move on from there. */
function rovingNames(rows) {
  const mark = (index) =>
    rows.forEach(({ name, element }, other) => {
      // The other controls of a row follow its name; those of all other rows are left out.
      for (const control of [name, ...element.querySelectorAll("button, input")])
        control.tabIndex = other === index ? 0 : -1;
    });
  return {
    mark,
    focus(index) {
      const at = Math.min(Math.max(index, 0), rows.length - 1);
      mark(at);
      rows[at].name.focus();
    },
  };
}

/** What a part's row does, by its place. */
function partActions(store, edits, playback, focus) {
  const document = () => shownDocument(store.state);
  const count = () => document().sequence.length;
  const change = ({ apply, label }) => edits.edit(apply, label);
  return {
    count,
    times: (index, times) => change(repeated(document(), index, times)),
    runThrough: (index) => change(restarted(document(), [index], false)),
    move(from, to) {
      if (to < 0 || to >= count() || to === from) return;
      change(moved(document(), from, to));
      focus(to);
    },
    remove(index) {
      if (count() === 1) return;
      change(removed(document(), index));
      focus(Math.min(index, count() - 1));
    },
    goTo(index) {
      const plan = shownPlan(store.state);
      const stretch = plan?.parts?.find((one) => one.part === index && !one.is_transition);
      if (plan?.times.length && stretch && stretch.first !== null)
        playback.setTime(plan.times[stretch.first]);
    },
  };
}

function press(event, index, actions, focus) {
  const keys = event.altKey
    ? { ArrowUp: () => actions.move(index, index - 1), ArrowDown: () => actions.move(index, index + 1) }
    : {
        ArrowUp: () => focus(index - 1),
        ArrowDown: () => focus(index + 1),
        Home: () => focus(0),
        End: () => focus(Infinity),
        Delete: () => actions.remove(index),
        Backspace: () => actions.remove(index),
        Enter: () => actions.goTo(index),
      };
  if (!keys[event.key]) return;
  event.preventDefault();
  event.stopPropagation();
  keys[event.key]();
}

/**
 * Builds the grid; `show` gives it the state, `cancel` ends a drag.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {import("../preview/playback.js").Playback} playback
 * @param {(index: number) => void} takeOver takes a part's gait over as it is now
 */
export function partRows(store, edits, playback, takeOver) {
  const grid = h("div", { class: "parts-list", role: "grid", "aria-label": "Parts of the sequence" });
  const rows = [];
  const { mark, focus } = rovingNames(rows);
  const actions = partActions(store, edits, playback, focus);

  function grow(index) {
    const row = partRow({
      times: (times) => actions.times(index, times),
      move: (way) => actions.move(index, index + way),
      remove: () => actions.remove(index),
      takeOver: () => takeOver(index),
      runThrough: () => actions.runThrough(index),
    });
    row.name.addEventListener("keydown", (event) => press(event, index, actions, focus));
    row.element.addEventListener("focusin", () => mark(index));
    rows.push(row);
    grid.append(row.element);
  }

  function show(state) {
    const { sequence } = shownDocument(state);
    const plan = shownPlan(state);
    while (rows.length < sequence.length) grow(rows.length);
    while (rows.length > sequence.length) rows.pop().element.remove();
    mark(
      Math.max(
        0,
        rows.findIndex(({ name }) => name.tabIndex === 0),
      ),
    );
    sequence.forEach((part, index) =>
      showRow(rows[index], {
        index,
        count: sequence.length,
        part,
        plan,
        source: sourceOf(state, part),
        planned: stretchOf(plan, index, part.gait.name, false),
        move: stretchOf(plan, index, part.gait.name, true),
      }),
    );
  }

  return { grid, show, cancel: mountReordering(grid, () => rows, actions.move, actions.goTo).cancel };
}

const SLACK_PX = 4;

/**
 * @param {HTMLElement} grid that holds the rows
 * @param {() => Array} rows each with its `element` and `name`
 * @param {(from: number, to: number) => void} move
 * @param {(index: number) => void} tap a press without a drag
 */
function mountReordering(grid, rows, move, tap) {
  let drag = null;

  /** How many rows have their middle above the pointer. */
  const placeAt = (y) =>
    rows().filter(({ element }) => {
      const { top, bottom } = element.getBoundingClientRect();
      return y > (top + bottom) / 2;
    }).length;

  function mark() {
    rows().forEach(({ element }, index) => {
      element.toggleAttribute("data-dragged", Boolean(drag?.on) && index === drag.from);
      element.toggleAttribute("data-before", Boolean(drag?.on) && index === drag.gap);
      element.toggleAttribute(
        "data-after",
        Boolean(drag?.on) && index === rows().length - 1 && drag.gap === rows().length,
      );
    });
  }

  function end() {
    const done = drag;
    drag = null;
    mark();
    return done;
  }

  grid.addEventListener("pointerdown", (event) => {
    const from = rows().findIndex(({ name }) => name.contains(event.target));
    if (event.button !== 0 || from < 0) return;
    drag = { from, y: event.clientY, on: false, gap: from };
    grid.setPointerCapture(event.pointerId);
    event.preventDefault();
    rows()[from].name.focus();
  });
  grid.addEventListener("pointermove", (event) => {
    if (!drag) return;
    drag.on ||= Math.abs(event.clientY - drag.y) > SLACK_PX;
    drag.gap = placeAt(event.clientY);
    mark();
  });
  grid.addEventListener("pointerup", () => {
    const done = end();
    if (!done) return;
    if (!done.on) tap(done.from);
    else move(done.from, done.gap > done.from ? done.gap - 1 : done.gap);
  });
  grid.addEventListener("pointercancel", end);
  return { cancel: () => Boolean(drag && end()?.on) };
}
