/**
 * What a drag on the timeline does: paint, move a swing or its end, lock, select, move what is selected.
 *
 * A drag is `{to(cell), commit()}`; cells are [foot, sample], 0-based. While it lasts it shows its effect as
 * the store's `gesture`; `commit` makes it one edit.
 */

import { paintCells } from "../state/edits.js";
import { heldBack, relocated, withLocks } from "../document/timeline_operators.js";
import { spanning, regionText } from "../document/region.js";
import { selectedRegion } from "../state/selection.js";
import { shownDocument } from "../state/store.js";
import { differing, moved, movedLabel, swingAt } from "../document/swings.js";
import { toast } from "../lib/toasts.js";

const between = (from, to) => {
  const count = Math.abs(to - from);
  return Array.from({ length: count + 1 }, (_, index) => from + Math.sign(to - from) * index);
};

const span = (foot, samples) => samples.map((sample) => [foot, sample]);

/** The document with a foot's swing somewhere else. */
function withSwing(document, foot, from, to) {
  const { toSwing, toStance } = differing(from, to);
  return paintCells(paintCells(document, span(foot, toStance), false), span(foot, toSwing), true);
}

export const isLocked = ({ timeline }, [foot, sample]) => timeline.locked?.[foot]?.[sample] === "1";

const UNLOCK = "To unlock cells, press K, or drag with Shift from a locked cell.";

export function reportLocked([foot, sample]) {
  toast(`Foot ${foot + 1}, sample ${sample + 1} is locked. ${UNLOCK}`);
}

/** Paints the value that the first cell gets; locked cells keep theirs. */
export function painting(store, edits, start) {
  const document = shownDocument(store.state);
  const { feet } = document.timeline;
  const swing = feet[start[0]][start[1]] !== "0";
  const cells = new Map();
  let last = start;
  return {
    to([foot, sample]) {
      const reached = foot === last[0] ? span(foot, between(last[1], sample)) : [[foot, sample]];
      last = [foot, sample];
      const fresh = reached.filter((cell) => !isLocked(document, cell) && !cells.has(cell.join()));
      fresh.forEach((cell) => cells.set(cell.join(), cell));
      if (!fresh.length) return;
      const now = [...cells.values()];
      store.set({ gesture: { apply: (one) => paintCells(one, now, swing) } });
    },
    commit() {
      const changed = [...cells.values()].filter(([foot, sample]) => (feet[foot][sample] === "0") !== swing);
      if (changed.length) edits.paint(changed, swing);
    },
  };
}

/** Moves a swing, or one end of it; without a move the cell becomes stance. */
export function moving(store, edits, start, part) {
  const [foot, sample] = start;
  const { timeline } = shownDocument(store.state);
  const line = { row: timeline.feet[foot], locked: timeline.locked?.[foot], foot };
  const from = swingAt(line.row, sample);
  let now = { to: from, by: 0 };
  let touched = false;
  return {
    to([, at]) {
      if (at === sample && !touched) return;
      touched = true;
      const next = moved(line, from, part, at - sample);
      if (next.reason && next.reason !== now.reason) toast(next.reason);
      const same = next.by === now.by;
      now = next;
      if (!same) store.set({ gesture: { apply: (document) => withSwing(document, foot, from, next.to) } });
    },
    commit() {
      const { to, by } = now;
      if (!touched) edits.paint([start], false);
      else if (by)
        edits.edit((document) => withSwing(document, foot, from, to), movedLabel(foot, part, to, by), {
          drawing: true,
        });
    },
  };
}

/**
 * Locks a rectangle, or unlocks it where it began on a locked cell. `tap` is called where the drag stays on
 * its cell.
 */
export function locking(store, edits, start, tap = null) {
  const document = shownDocument(store.state);
  const locks = !isLocked(document, start);
  let region = null;
  const choose = (cell) => {
    region = spanning(start, cell);
    const chosen = region;
    store.set({ gesture: { apply: (now) => withLocks(now, chosen, locks) } });
  };
  return {
    to(cell) {
      if (region || !tap || cell.join() !== start.join()) choose(cell);
    },
    commit() {
      if (!region) tap?.();
      else lockRegion(edits, document, region, locks);
    },
  };
}

/** Locks or unlocks a region: one edit, or none where it is so already. */
export function lockRegion(edits, document, region, locks) {
  const apply = (now) => withLocks(now, region, locks);
  if (heldBack(document, apply(document))) return;
  edits.edit(apply, `${locks ? "Lock" : "Unlock"} ${regionText(document, region)}`, { drawing: true });
}

/** Selects a rectangle. */
export function selecting(selection, start, from = start) {
  return { to: (cell) => selection.between(from, cell), commit() {} };
}

/**
 * Takes the selected cells to other samples, or a copy of them. `tap` is called where the drag stays on its
 * cell.
 */
export function carrying(store, edits, start, { copies, tap }) {
  const document = shownDocument(store.state);
  const region = selectedRegion(store.state);
  const least = -region.samples[0];
  const most = document.timeline.feet[0].length - 1 - region.samples[1];
  let by = 0;
  let reason = null;
  let touched = false;
  const selectionAt = (shift) => ({ ...region, samples: region.samples.map((sample) => sample + shift) });
  return {
    to([, sample]) {
      const next = Math.min(Math.max(sample - start[1], least), most);
      if (next === by) return;
      touched = true;
      by = next;
      reason = by ? heldBack(document, relocated(document, region, by, copies)) : null;
      if (reason && reason !== "Nothing would change.") toast(reason);
      const shift = by;
      store.set({
        selection: selectionAt(by),
        gesture: reason || !by ? null : { apply: (now) => relocated(now, region, shift, copies) },
      });
    },
    commit() {
      const shift = by;
      if (!touched) return tap();
      if (!shift || reason) return store.set({ selection: region });
      const way = `${shift > 0 ? "+" : "−"}${Math.abs(shift)}`;
      const label = `${copies ? "Copy" : "Move"} ${regionText(document, region)} by ${way}`;
      return edits.edit((now) => relocated(now, region, shift, copies), label, { drawing: true });
    },
    drop: () => store.set({ selection: region }),
  };
}
