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

/**
 * @param {{store: Record<string, any>, edits: Record<string, any>, playback: import("../preview/playback.js").Playback, focused: () => [number, number]}} page `focused` gives the cell
 *   that holds the focus of the timeline
 */
export function createActions({ store, edits, playback, focused }) {
  const document = () => shownDocument(store.state);
  const region = () => selectedRegion(store.state);
  const state = () => ({ document: document(), region: region(), mirror: store.state.view?.mirror ?? null });
  const cellRegion = () => ({ feet: [focused()[0], focused()[0]], samples: [focused()[1], focused()[1]] });
  function put({ apply, label, drawing, selection, clipped }) {
    store.set({ preview: null, ...(selection === undefined ? {} : { selection }) });
    announce(label);
    if (clipped) toast(clipped);
    edits.edit(apply, label, { drawing });
  }

  /** What an operation works on; samples come and go at the focused cell where nothing is selected. */
  function stateFor(id) {
    const now = state();
    if (now.region || !OPERATIONS[id]?.columns || !now.document) return now;
    return { ...now, region: { feet: wholeOf(now.document).feet, samples: [focused()[1], focused()[1]] } };
  }

  function act(id, amount, where = stateFor(id)) {
    const outcome = outcomeOf(id, where, amount);
    if (outcome.reason) toast(outcome.reason);
    else put(outcome);
    return !outcome.reason;
  }

  /** The selection, or the focused cell of the grid; what takes away never takes the whole timeline by itself. */
  const chosen = () => region() ?? (focusOnGrid() ? cellRegion() : null);

  function take() {
    const block = blockOf(document(), region() ?? wholeOf(document()));
    announce(`Copied ${regionText(document(), region() ?? wholeOf(document()))}.`);
    return block;
  }

  /** Locks what is chosen; unlocks it where all of it is locked. */
  function toggleLock() {
    const cells = chosen();
    if (!cells) return toast(NOTHING);
    return act(outcomeOf("lock", { ...state(), region: cells }).reason ? "unlock" : "lock", undefined, {
      ...state(),
      region: cells,
    });
  }

  function clear() {
    const cells = chosen();
    return cells ? act("stance", undefined, { ...state(), region: cells }) : toast(NOTHING);
  }

  function cut() {
    const cells = chosen();
    if (!cells) return toast(NOTHING);
    const block = blockOf(document(), cells);
    const outcome = outcomeOf("stance", { ...state(), region: cells });
    if (outcome.reason && outcome.reason !== "Nothing would change.") return toast(outcome.reason);
    if (!outcome.reason) put({ ...outcome, label: `Cut ${regionText(document(), cells)}` });
    return block;
  }

  function paste(text) {
    const { block, reason } = blockFrom(text);
    if (reason) return toast(reason);
    const at = region() ? [region().feet[0], region().samples[0]] : focused();
    const apply = (now) => withBlock(now, at, block);
    const refusal = heldBack(document(), apply(document()));
    if (refusal)
      return toast(
        refusal === "Nothing would change." ? "These cells already have the pasted values." : refusal,
      );
    const { feet } = document().timeline;
    const selection = {
      feet: [at[0], Math.min(at[0] + block.length, feet.length) - 1],
      samples: [at[1], Math.min(at[1] + block[0].length, feet[0].length) - 1],
    };
    return put({
      apply,
      clipped: leftOut(document(), at, block),
      label: `Paste at ${regionText(document(), { feet: [at[0], at[0]], samples: [at[1], at[1]] })}`,
      drawing: true,
      selection,
    });
  }

  function loop() {
    const chosenNow = region();
    if (!chosenNow) return playback.setLoop(!playback.loop);
    const axis = axisOf(store.state);
    const [start, end] = [chosenNow.samples[0], chosenNow.samples[1] + 1]
      .map((column) => columnTime(axis, column))
      .map((time) => Math.min(Math.max(time, 0), playback.duration));
    const same =
      playback.loop && Math.abs(playback.loop[0] - start) < 1e-9 && Math.abs(playback.loop[1] - end) < 1e-9;
    playback.setLoop(same ? false : [start, end]);
    if (!same && (playback.time < start || playback.time > end)) playback.setTime(start);
    return undefined;
  }

  return {
    act,
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
    take,
    cut,
    clear,
    paste,
    loop,
    toggleLock,
    copyNow: () => putBlock(take()),
    cutNow: () => {
      const block = cut();
      return block && putBlock(block);
    },
    pasteNow: async () => paste(await clipboardText()),
  };
}
