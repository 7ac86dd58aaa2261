/** What the timeline's buttons, menu and keys do: operations on the selection, clipboard, loop. */

import { counted } from "../lib/format.js";
import { blockFrom, clipboardText, putBlock } from "./clipboard.js";
import { OPERATIONS, outcomeOf } from "../document/operations.js";
import { blockOf, heldBack, withBlock } from "../document/timeline_operators.js";
import { wholeOf, regionText } from "../document/region.js";
import { selectedRegion } from "../state/selection.js";
import { axisOf, columnTime } from "../state/time_axis.js";
import { shownDocument } from "../state/store.js";
import { announce, toast } from "../lib/toasts.js";

const NOTHING = "No cells are selected. Select cells first, with Shift+arrows, Ctrl+drag or the Select tool.";
const UNCHANGED = "Nothing would change.";

/** What of a block does not fit on the timeline from a cell on, in words; null where all of it fits. */
function leftOut({ timeline }, [foot, sample], block) {
  const feet = foot + block.length - timeline.feet.length;
  const samples = sample + block[0].length - timeline.feet[0].length;
  const parts = [
    samples > 0 && `${counted(samples, "sample")} after the end`,
    feet > 0 && `${counted(feet, "row")} below the last foot`,
  ].filter(Boolean);
  return parts.length
    ? `Some of the copied cells did not fit and were not pasted: ${parts.join(" and ")}.`
    : null;
}

const focusOnGrid = () => Boolean(globalThis.document.activeElement?.closest("#timeline [role=gridcell]"));

/** The rectangle that is one cell. */
const cellRegion = ([foot, sample]) => ({ feet: [foot, foot], samples: [sample, sample] });

/** The rectangle that a block covers from a cell on, as far as the timeline goes. */
const coveredBy = (block, [foot, sample], { feet }) => ({
  feet: [foot, Math.min(foot + block.length, feet.length) - 1],
  samples: [sample, Math.min(sample + block[0].length, feet[0].length) - 1],
});

/** What the acts share: the shown timeline, what is chosen on it, and how an operation is carried out. */
function createBench({ store, edits, focused }) {
  const document = () => shownDocument(store.state);
  const region = () => selectedRegion(store.state);
  const stateOn = (cells) => ({
    document: document(),
    region: cells,
    mirror: store.state.view?.mirror ?? null,
  });

  /** What an operation works on; samples come and go at the focused cell where nothing is selected. */
  function stateFor(id) {
    const now = stateOn(region());
    if (now.region || !OPERATIONS[id]?.columns || !now.document) return now;
    return { ...now, region: { ...cellRegion(focused()), feet: wholeOf(now.document).feet } };
  }

  function put({ apply, label, drawing, selection, clipped }) {
    store.set({ preview: null, ...(selection === undefined ? {} : { selection }) });
    announce(label);
    if (clipped) toast(clipped);
    edits.edit(apply, label, { drawing });
  }

  function act(id, amount, where = stateFor(id)) {
    const outcome = outcomeOf(id, where, amount);
    if (outcome.reason) toast(outcome.reason);
    else put(outcome);
    return !outcome.reason;
  }

  /** The selection, else the focused cell of the grid: what takes away never takes the whole timeline. */
  const chosen = () => region() ?? (focusOnGrid() ? cellRegion(focused()) : null);

  return { document, region, stateOn, stateFor, put, act, chosen };
}

/** Acts on the chosen cells: lock and clear. */
const cellActs = ({ act, chosen, stateOn }) => ({
  /** Locks what is chosen; unlocks it where all of it is locked. */
  toggleLock() {
    const cells = chosen();
    if (!cells) return toast(NOTHING);
    const where = stateOn(cells);
    return act(outcomeOf("lock", where).reason ? "unlock" : "lock", undefined, where);
  },
  clear() {
    const cells = chosen();
    return cells ? act("stance", undefined, stateOn(cells)) : toast(NOTHING);
  },
});

/** Acts between the timeline and a clipboard; `take` and `cut` give the block, `paste` takes text. */
function clipboardActs({ document, region, stateOn, put, chosen }, focused) {
  function take() {
    const cells = region() ?? wholeOf(document());
    announce(`Copied ${regionText(document(), cells)}.`);
    return blockOf(document(), cells);
  }

  /** @returns {string[]|null} */
  function cut() {
    const cells = chosen();
    const outcome = cells ? outcomeOf("stance", stateOn(cells)) : { reason: NOTHING };
    if (outcome.reason && outcome.reason !== UNCHANGED) {
      toast(outcome.reason);
      return null;
    }
    const block = blockOf(document(), cells);
    if (!outcome.reason) put({ ...outcome, label: `Cut ${regionText(document(), cells)}` });
    return block;
  }

  function paste(text) {
    const { block, reason } = blockFrom(text);
    if (reason) return toast(reason);
    /** @type {[number, number]} */
    const at = region() ? [region().feet[0], region().samples[0]] : focused();
    const apply = (now) => withBlock(now, at, block);
    const refusal = heldBack(document(), apply(document()));
    if (refusal)
      return toast(refusal === UNCHANGED ? "These cells already have the pasted values." : refusal);
    return put({
      apply,
      clipped: leftOut(document(), at, block),
      label: `Paste at ${regionText(document(), cellRegion(at))}`,
      drawing: true,
      selection: coveredBy(block, at, document().timeline),
    });
  }

  return {
    take,
    cut,
    paste,
    copyNow: () => putBlock(take()),
    cutNow: () => {
      const block = cut();
      return block && putBlock(block);
    },
    pasteNow: async () => paste(await clipboardText()),
  };
}

/** Repeats the selected samples, else the whole timeline; ends the loop where it is so already. */
function toggleLoop(store, playback) {
  const region = selectedRegion(store.state);
  if (!region) return playback.setLoop(!playback.loop);
  const axis = axisOf(store.state);
  const [start, end] = [region.samples[0], region.samples[1] + 1]
    .map((column) => columnTime(axis, column))
    .map((time) => Math.min(Math.max(time, 0), playback.duration));
  const same =
    playback.loop && Math.abs(playback.loop[0] - start) < 1e-9 && Math.abs(playback.loop[1] - end) < 1e-9;
  playback.setLoop(same ? false : [start, end]);
  if (!same && (playback.time < start || playback.time > end)) playback.setTime(start);
  return undefined;
}

/**
 * @param {{store: Record<string, any>, edits: Record<string, any>,
 *   playback: import("../preview/playback.js").Playback, focused: () => [number, number]}} page
 *   `focused` gives the cell that holds the focus of the timeline
 */
export function createActions({ store, edits, playback, focused }) {
  const bench = createBench({ store, edits, focused });
  const { document, stateFor } = bench;
  return {
    act: bench.act,
    outcome: (id, amount) => outcomeOf(id, stateFor(id), amount),
    /** Shows what an operation would make of the timeline; returns the outcome. */
    preview(id, amount) {
      const outcome = outcomeOf(id, stateFor(id), amount);
      store.set({ preview: outcome.reason ? null : outcome.document });
      return outcome;
    },
    dropPreview: () => {
      if (!store.state.preview) return false;
      store.set({ preview: null });
      return true;
    },
    scope: (id) => (document() ? regionText(document(), stateFor(id).region ?? wholeOf(document())) : ""),
    state: stateFor,
    loop: () => toggleLoop(store, playback),
    ...cellActs(bench),
    ...clipboardActs(bench, focused),
  };
}
